// A pipe along a trefoil knot: eighteen cylinders with balls at their joints; only the volume is in a group, so
// that the joints are no features.
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.3;
parts[] = {};
For k In {0:17}
  s = 2 * Pi * k / 18;
  t = 2 * Pi * (k + 1) / 18;
  px = Sin(s) + 2 * Sin(2 * s); py = Cos(s) - 2 * Cos(2 * s); pz = -1.4 * Sin(3 * s);
  qx = Sin(t) + 2 * Sin(2 * t); qy = Cos(t) - 2 * Cos(2 * t); qz = -1.4 * Sin(3 * t);
  v = newv; Cylinder(v) = {px, py, pz, qx - px, qy - py, qz - pz, 0.35}; parts[] += v;
  v = newv; Sphere(v) = {px, py, pz, 0.35}; parts[] += v;
EndFor
BooleanUnion{ Volume{parts[0]}; Delete; }{ Volume{parts[{1:#parts[]-1}]}; Delete; }
Physical Volume("knot") = {Volume{:}};
