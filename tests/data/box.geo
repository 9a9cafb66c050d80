// Box of 3 x 2 x 1; every point, curve, face and the volume keeps its number as its colour (no physical groups).
// Mesh: gmsh -3 -nt 1 -format msh41 -save_all box.geo -o box.msh
SetFactory("OpenCASCADE");
General.NumThreads = 1;
Mesh.MeshSizeMax = 0.6;
Box(1) = {0, 0, 0, 3, 2, 1};
