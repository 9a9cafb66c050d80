// A mounting bracket: base plate with a slot, upright plate, and a stiffening rib between them (millimetres).
// Mesh: gmsh -3 -nt 1 -format msh41 bracket.geo -o bracket.msh
SetFactory("OpenCASCADE");
General.NumThreads = 1;
Mesh.MeshSizeMax = 5;
Mesh.MeshSizeMin = 3;

Box(1) = {0, 0, 0, 60, 40, 8};     // base plate
Box(2) = {0, 0, 8, 8, 40, 32};     // upright plate
Box(3) = {8, 16, 8, 20, 8, 18};    // rib
Box(4) = {38, 12, 0, 12, 16, 8};   // slot
BooleanUnion(5) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
BooleanDifference(6) = { Volume{5}; Delete; }{ Volume{4}; Delete; };

e = 1e-3;
Physical Volume("steel", 1) = {6};
bottom() = Surface In BoundingBox{-e, -e, -e, 60 + e, 40 + e, e};
back() = Surface In BoundingBox{-e, -e, -e, e, 40 + e, 40 + e};
slot() = Surface In BoundingBox{38 - e, 12 - e, -e, 50 + e, 28 + e, 8 + e};
all() = Surface{:};
free() = all();
free() -= {bottom(), back(), slot()};
Physical Surface("bottom", 1) = {bottom()};
Physical Surface("back", 2) = {back()};
Physical Surface("slot", 3) = {slot()};
Physical Surface("free", 4) = {free()};
Physical Curve("edges", 1) = {Curve{:}};
Physical Point("corners", 1) = {Point{:}};
