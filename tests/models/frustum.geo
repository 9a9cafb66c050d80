// A cone without its tip.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.25;
Cone(1) = {0, 0, 0, 0, 0, 1.2, 1, 0.5};
