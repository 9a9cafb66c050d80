// A plate with a round hole: four flat sides and a cylinder inside them.
SetFactory("OpenCASCADE");
MeshSize {:} = 0.25;
Mesh.MeshSizeMax = 0.25;
Box(1) = {0, 0, 0, 3, 2, 0.6};
Cylinder(2) = {1.5, 1, -1, 0, 0, 3, 0.5};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
