// A prism over a triangle with an edge of thirty degrees.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.2;
Point(1) = {0, 0, 0};
Point(2) = {2, 0, 0};
Point(3) = {2, 2 * Tan(Pi / 6), 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 1};
Curve Loop(1) = {1, 2, 3};
Plane Surface(1) = {1};
Extrude {0, 0, 1} { Surface{1}; }
