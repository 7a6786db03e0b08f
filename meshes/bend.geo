// A vessel of diameter 1: from the origin 1 along x, a quarter turn of radius `turn`, 1 along y; of
// tets, n per diameter. algorithm 1: Delaunay, 10: HXT; optimise 0: as they come. Patches inlet
// (x = 0), outlet, wall.
SetFactory("OpenCASCADE");
DefineConstant[
  n = {12, Name "n"},
  turn = {1.5, Name "turn"},
  algorithm = {1, Name "algorithm"},
  optimise = {1, Name "optimise"}
];
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, turn, 0};
Point(4) = {1 + turn, turn, 0};
Point(5) = {1 + turn, turn + 1, 0};
Line(1) = {1, 2};
Circle(2) = {2, 3, 4};
Line(3) = {4, 5};
Wire(1) = {1, 2, 3};
Disk(100) = {0, 0, 0, 0.5};
Rotate {{0, 1, 0}, {0, 0, 0}, Pi / 2} { Surface{100}; }
vessel() = Extrude { Surface{100}; } Using Wire {1};
Delete { Surface{100}; }
e = 1e-3;
inlet() = Surface In BoundingBox {-e, -1, -1, e, 1, 1};
outlet() = Surface In BoundingBox {turn, turn + 1 - e, -1, turn + 2, turn + 1 + e, 1};
wall() = Surface{:};
wall() -= inlet();
wall() -= outlet();
Physical Surface("inlet") = inlet();
Physical Surface("outlet") = outlet();
Physical Surface("wall") = wall();
Physical Volume("fluid") = {vessel()};
Mesh.CharacteristicLengthMin = 1 / n;
Mesh.CharacteristicLengthMax = 1 / n;
Mesh.Algorithm3D = algorithm;
Mesh.Optimize = optimise;
