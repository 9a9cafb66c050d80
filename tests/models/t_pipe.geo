// Two solid cylinders that meet in a T.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.25;
Cylinder(1) = {-1.5, 0, 0, 3, 0, 0, 0.5};
Cylinder(2) = {0, 0, 0, 0, 0, 1.5, 0.5};
BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; }
