// A quarter of a round vessel of tets along x that narrows from radius 200 to 90. Patches inlet, outlet, wall, symy, symz.
SetFactory("OpenCASCADE");
Point(1) = {0, 0, 0};
Point(2) = {0, 200, 0};
Point(3) = {400, 200, 0};
Point(4) = {850, 90, 0};
Point(5) = {1200, 90, 0};
Point(6) = {1200, 0, 0};
For i In {1 : 6}
  Line(i) = {i, i % 6 + 1};
EndFor
Curve Loop(1) = {1 : 6};
Plane Surface(1) = {1};
body() = Extrude {{1, 0, 0}, {0, 0, 0}, Pi / 2} { Surface{1}; };
e = 1;
inlet() = Surface In BoundingBox {-e, -300, -300, e, 300, 300};
outlet() = Surface In BoundingBox {1200 - e, -300, -300, 1200 + e, 300, 300};
symz() = Surface In BoundingBox {-e, -300, -e, 1300, 300, e};
symy() = Surface In BoundingBox {-e, -e, -300, 1300, e, 300};
wall() = Surface{:};
wall() -= {inlet(), outlet(), symy(), symz()};
Physical Surface("inlet") = inlet();
Physical Surface("outlet") = outlet();
Physical Surface("wall") = wall();
Physical Surface("symy") = symy();
Physical Surface("symz") = symz();
Physical Volume("fluid") = {body(1)};
Field[1] = MathEval;
Field[1].F = "36 * (0.775 - 0.225 * tanh((x - 620) / 150))";
Background Field = 1;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthMin = 18;
Mesh.CharacteristicLengthMax = 36;
Mesh.Optimize = 1;
Mesh.OptimizeThreshold = 0.5;
