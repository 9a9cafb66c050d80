// A box without one corner: three concave edges that meet.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.3;
Box(1) = {0, 0, 0, 2, 2, 2};
Box(2) = {1, 1, 1, 2, 2, 2};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
