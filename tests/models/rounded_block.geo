// A block with one filleted edge.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.25;
Box(1) = {0, 0, 0, 2, 1.2, 1};
Fillet{1}{9}{0.4}
