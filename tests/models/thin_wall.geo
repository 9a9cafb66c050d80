// A channel with walls of a tenth of its width.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.15;
Box(1) = {0, 0, 0, 2, 1, 0.8};
Box(2) = {-1, 0.1, 0.1, 4, 0.8, 2};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
