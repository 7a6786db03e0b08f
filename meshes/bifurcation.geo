// A vessel of diameter 1 along x that divides at x = 1.8 into two of diameter `branch` in the plane
// z = 0, `angle` degrees to either side; of tets, n per unit length. algorithm 1: Delaunay, 10: HXT;
// optimise 0: as they come. Patches inlet (x = 0), left (y > 0), right (y < 0), wall.
SetFactory("OpenCASCADE");
DefineConstant[
  n = {12, Name "n"},
  branch = {0.8, Name "branch"},
  angle = {40, Name "angle"},
  reach = {2.2, Name "reach"},
  algorithm = {1, Name "algorithm"},
  optimise = {1, Name "optimise"}
];
x = reach * Cos(angle * Pi / 180);
y = reach * Sin(angle * Pi / 180);
Cylinder(1) = {0, 0, 0, 2, 0, 0, 0.5};
Cylinder(2) = {1.8, 0, 0, x, y, 0, branch / 2};
Cylinder(3) = {1.8, 0, 0, x, -y, 0, branch / 2};
vessel() = BooleanUnion { Volume{1}; Delete; } { Volume{2, 3}; Delete; };
e = 1e-2;
sx = branch / 2 * Sin(angle * Pi / 180) + e;
sy = branch / 2 * Cos(angle * Pi / 180) + e;
sz = branch / 2 + e;
inlet() = Surface In BoundingBox {-e, -1, -1, e, 1, 1};
left() = Surface In BoundingBox {1.8 + x - sx, y - sy, -sz, 1.8 + x + sx, y + sy, sz};
right() = Surface In BoundingBox {1.8 + x - sx, -y - sy, -sz, 1.8 + x + sx, -y + sy, sz};
wall() = Surface{:};
wall() -= inlet();
wall() -= left();
wall() -= right();
Physical Surface("inlet") = inlet();
Physical Surface("left") = left();
Physical Surface("right") = right();
Physical Surface("wall") = wall();
Physical Volume("fluid") = {vessel()};
Mesh.CharacteristicLengthMin = 1 / n;
Mesh.CharacteristicLengthMax = 1 / n;
Mesh.Algorithm3D = algorithm;
Mesh.Optimize = optimise;
