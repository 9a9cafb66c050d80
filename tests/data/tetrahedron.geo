// A regular tetrahedron: its hex meshes have a node of four curves inside.
// Mesh: gmsh -3 -nt 1 -format msh41 -save_all tetrahedron.geo -o tetrahedron.msh
General.NumThreads = 1;
Mesh.MeshSizeMax = 0.45;
Point(1) = {1, 1, 1};
Point(2) = {-1, -1, 1};
Point(3) = {-1, 1, -1};
Point(4) = {1, -1, -1};
Line(1) = {1, 2};
Line(2) = {1, 3};
Line(3) = {1, 4};
Line(4) = {2, 3};
Line(5) = {2, 4};
Line(6) = {3, 4};
Curve Loop(1) = {1, 4, -2};
Curve Loop(2) = {2, 6, -3};
Curve Loop(3) = {3, -5, -1};
Curve Loop(4) = {4, 6, -5};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Plane Surface(4) = {4};
Surface Loop(1) = {1, 2, 3, 4};
Volume(1) = {1};
