// A straight vessel of diameter 1 along x, centre line y = z = 0.5, of tets; n per diameter.
// algorithm 1: Delaunay, 10: HXT; optimise 0: as they come; periodic 1: both ends alike and joined.
// Patches inlet (x = 0), outlet, wall.
SetFactory("OpenCASCADE");
DefineConstant[
  n = {12, Name "n"},
  length = {5, Name "length"},
  algorithm = {1, Name "algorithm"},
  optimise = {1, Name "optimise"},
  periodic = {0, Name "periodic"}
];
Cylinder(1) = {0, 0.5, 0.5, length, 0, 0, 0.5};
e = 1e-3;
inlet() = Surface In BoundingBox {-e, -1, -1, e, 2, 2};
outlet() = Surface In BoundingBox {length - e, -1, -1, length + e, 2, 2};
If (periodic)
  Periodic Surface {outlet()} = {inlet()} Translate {length, 0, 0};
EndIf
wall() = Surface{:};
wall() -= inlet();
wall() -= outlet();
Physical Surface("inlet") = inlet();
Physical Surface("outlet") = outlet();
Physical Surface("wall") = wall();
Physical Volume("fluid") = {1};
Mesh.CharacteristicLengthMin = 1 / n;
Mesh.CharacteristicLengthMax = 1 / n;
Mesh.Algorithm3D = algorithm;
Mesh.Optimize = optimise;
