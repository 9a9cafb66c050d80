// A copper insert glued to a steel block: two materials that share an interior feature surface.
// Mesh: gmsh -3 -nt 1 -format msh22 two_materials.geo -o two_materials.msh
SetFactory("OpenCASCADE");
General.NumThreads = 1;
Mesh.MeshSizeMax = 0.6;
Box(1) = {0, 0, 0, 2, 1, 1};
Box(2) = {2, 0, 0, 1, 1, 1};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
e = 1e-3;
Physical Volume("steel", 1) = {1};
Physical Volume("copper", 2) = {2};
interface() = Surface In BoundingBox{2 - e, -e, -e, 2 + e, 1 + e, 1 + e};
all() = Surface{:};
outside() = all();
outside() -= {interface()};
Physical Surface("outside", 1) = {outside()};
Physical Surface("interface", 2) = {interface()};
Physical Curve("edges", 1) = {Curve{:}};
Physical Point("corners", 1) = {Point{:}};
