// Three materials that meet along one interior edge: a wall across a box and one that ends on it.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.28;
Box(1) = {0, 0, 0, 1, 2, 1};
Box(2) = {1, 0, 0, 1, 0.8, 1};
Box(3) = {1, 0.8, 0, 1, 1.2, 1};
Coherence;
