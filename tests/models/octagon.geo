// A prism over a regular octagon: blunt edges of 135 degrees.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.3;
For i In {0:7}
  Point(i + 1) = {Cos(Pi / 4 * i), Sin(Pi / 4 * i), 0};
EndFor
For i In {0:7}
  Line(i + 1) = {i + 1, (i + 1) % 8 + 1};
EndFor
Curve Loop(1) = {1:8};
Plane Surface(1) = {1};
Extrude {0, 0, 1} { Surface{1}; }
