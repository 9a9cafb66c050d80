// A bearing block: a plate, a web and an eye with its bore.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.18;
Box(1) = {-1, -0.5, 0, 2, 1, 0.4};
Cylinder(2) = {0, -0.5, 0.9, 0, 1, 0, 0.6};
Box(3) = {-0.6, -0.5, 0.4, 1.2, 1, 0.5};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Cylinder(5) = {0, -0.5, 0.9, 0, 1, 0, 0.35};
BooleanDifference{ Volume{4}; Delete; }{ Volume{5}; Delete; }
