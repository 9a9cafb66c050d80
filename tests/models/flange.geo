// A flange: a hub on a disc with four bolt holes and a bore.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.17;
Cylinder(1) = {0, 0, 0, 0, 0, 0.4, 1.2};
Cylinder(2) = {0, 0, 0.4, 0, 0, 0.8, 0.5};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0.85, 0, 0, 0, 0, 0.4, 0.15};
Cylinder(5) = {-0.85, 0, 0, 0, 0, 0.4, 0.15};
Cylinder(6) = {0, 0.85, 0, 0, 0, 0.4, 0.15};
Cylinder(7) = {0, -0.85, 0, 0, 0, 0.4, 0.15};
Cylinder(8) = {0, 0, 0, 0, 0, 1.2, 0.25};
BooleanDifference{ Volume{3}; Delete; }{ Volume{4:8}; Delete; }
