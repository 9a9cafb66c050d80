// A ball. Its surface has no curve or point that must survive: the seam of the sphere is in no group.
// gmsh -3 -nt 1 -format msh41 ball.geo -o ball.msh
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 1};
MeshSize {:} = 0.28;
Mesh.Algorithm3D = 1;
Physical Volume("ball") = {1};
Physical Surface("skin") = {1};
