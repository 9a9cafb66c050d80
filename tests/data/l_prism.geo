// L-shaped prism: one concave edge of 270 degrees (no physical groups).
// Mesh: gmsh -3 -nt 1 -format msh41 -save_all l_prism.geo -o l_prism.msh
SetFactory("OpenCASCADE");
General.NumThreads = 1;
Mesh.MeshSizeMax = 0.6;
Box(1) = {0, 0, 0, 3, 1, 1};
Box(2) = {0, 1, 0, 1, 1, 1};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
