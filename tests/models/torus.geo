// A torus: one smooth surface, a handle.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.3;
Torus(1) = {0, 0, 0, 2, 0.7};
