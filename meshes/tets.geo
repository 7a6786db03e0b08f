// A box lx x ly x lz of tets as gmsh makes them of itself, one corner at the origin; periodic 1:
// opposite sides alike and joined. n cells per unit length. algorithm 1: Delaunay, 10: HXT; optimise 0: as they come, slivers
// among them. Patches left, right (x), bottom, top (y), back, front (z).
SetFactory("OpenCASCADE");
DefineConstant[
  n = {16, Name "n"},
  lx = {1, Name "lx"},
  ly = {1, Name "ly"},
  lz = {1, Name "lz"},
  algorithm = {1, Name "algorithm"},
  optimise = {1, Name "optimise"},
  periodic = {0, Name "periodic"}
];
Box(1) = {0, 0, 0, lx, ly, lz};
e = 1e-3 / n;
left() = Surface In BoundingBox {-e, -e, -e, e, ly + e, lz + e};
right() = Surface In BoundingBox {lx - e, -e, -e, lx + e, ly + e, lz + e};
bottom() = Surface In BoundingBox {-e, -e, -e, lx + e, e, lz + e};
top() = Surface In BoundingBox {-e, ly - e, -e, lx + e, ly + e, lz + e};
back() = Surface In BoundingBox {-e, -e, -e, lx + e, ly + e, e};
front() = Surface In BoundingBox {-e, -e, lz - e, lx + e, ly + e, lz + e};
If (periodic)
  Periodic Surface {right()} = {left()} Translate {lx, 0, 0};
  Periodic Surface {top()} = {bottom()} Translate {0, ly, 0};
  Periodic Surface {front()} = {back()} Translate {0, 0, lz};
EndIf
Physical Surface("left") = left();
Physical Surface("right") = right();
Physical Surface("bottom") = bottom();
Physical Surface("top") = top();
Physical Surface("back") = back();
Physical Surface("front") = front();
Physical Volume("fluid") = {1};
Mesh.CharacteristicLengthMin = 1 / n;
Mesh.CharacteristicLengthMax = 1 / n;
Mesh.Algorithm3D = algorithm;
Mesh.Optimize = optimise;
