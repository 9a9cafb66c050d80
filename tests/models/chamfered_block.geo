// A block with chamfers of 45 degrees along its four upright edges: edges of 135 degrees.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.22;
Box(1) = {0, 0, 0, 2, 1.5, 1};
Chamfer{1}{1, 3, 5, 7}{1, 1, 1, 1}{0.3}
