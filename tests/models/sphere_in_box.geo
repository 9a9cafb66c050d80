// A ball of another material inside a box: a closed smooth interior surface.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.28;
Box(1) = {0, 0, 0, 2, 2, 2};
Sphere(2) = {1, 1, 1, 0.55};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
