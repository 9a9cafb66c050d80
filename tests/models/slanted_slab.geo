// A slab on a parallelogram of 45 and 135 degrees.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.22;
Point(1) = {0, 0, 0};
Point(2) = {2, 0, 0};
Point(3) = {2.7, 0.7, 0};
Point(4) = {0.7, 0.7, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Extrude{0, 0, 1}{ Surface{1}; }
