// Two steps.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.3;
Box(1) = {0, 0, 0, 3, 1, 0.5};
Box(2) = {1, 0, 0.5, 2, 1, 0.5};
Box(3) = {2, 0, 1, 1, 1, 0.5};
BooleanUnion{ Volume{1}; Delete; }{ Volume{2, 3}; Delete; }
