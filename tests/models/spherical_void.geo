// A cube with a spherical void.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.22;
Box(1) = {-1, -1, -1, 2, 2, 2};
Sphere(2) = {0, 0, 0, 0.5};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
