// A cylinder that stands on a block: its singular arcs go on below the reentrant curve.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.22;
Box(1) = {-1, -1, 0, 2, 2, 1};
Cylinder(2) = {0, 0, 1, 0, 0, 1, 0.4};
BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; }
