// A rod of another material through a box: an interior cylinder that ends on two sides.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.3;
Box(1) = {0, 0, 0, 2, 2, 2};
Cylinder(2) = {1, 1, 0, 0, 0, 2, 0.45};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
