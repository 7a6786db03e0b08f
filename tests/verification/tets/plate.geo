// A square duct of side 1 along x to x = 3.5, with a plate across it from x = 2 on, y = 0.4 to 0.6, of
// tets, n per unit length. Patches in, up and down (behind the plate), wall.
SetFactory("OpenCASCADE");
DefineConstant[ n = {10, Name "n"} ];
Box(1) = {0, 0, 0, 3.5, 1, 1};
Box(2) = {2, 0.4, 0, 2, 0.2, 1};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
e = 1e-3;
in() = Surface In BoundingBox {-e, -e, -e, e, 1 + e, 1 + e};
up() = Surface In BoundingBox {3.5 - e, 0.5, -e, 3.5 + e, 1 + e, 1 + e};
down() = Surface In BoundingBox {3.5 - e, -e, -e, 3.5 + e, 0.5, 1 + e};
wall() = Surface{:};
wall() -= in();
wall() -= up();
wall() -= down();
Physical Surface("in") = {in()};
Physical Surface("up") = {up()};
Physical Surface("down") = {down()};
Physical Surface("wall") = {wall()};
Physical Volume("fluid") = Volume{:};
Mesh.CharacteristicLengthMin = 1 / n;
Mesh.CharacteristicLengthMax = 1 / n;
Mesh.Optimize = 1;
