// A box lx x ly x lz with one corner at the origin; lz = 0: a rectangle, meshed with gmsh -2.
// nx, ny, nz cells (by default n per unit length); simplex 1: triangles or tets, 0: quads or hexes.
// Patches left, right (x), bottom, top (y), back, front (z).
DefineConstant[
  n = {16, Name "n"},
  lx = {1, Name "lx"},
  ly = {1, Name "ly"},
  lz = {1, Name "lz"},
  nx = {Ceil(n * lx - 1e-9), Name "nx"},
  ny = {Ceil(n * ly - 1e-9), Name "ny"},
  nz = {Ceil(n * lz - 1e-9), Name "nz"},
  simplex = {0, Name "simplex"}
];
Point(1) = {0, 0, 0};
Point(2) = {lx, 0, 0};
Point(3) = {lx, ly, 0};
Point(4) = {0, ly, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = nx + 1;
Transfinite Curve {2, 4} = ny + 1;
// In 2-D free triangles; in 3-D structured ones, so that opposite sides match.
If (!simplex || lz > 0)
  Transfinite Surface {1};
EndIf
If (!simplex)
  Recombine Surface {1};
EndIf
If (lz > 0)
  If (simplex)
    side[] = Extrude {0, 0, lz} { Surface{1}; Layers{nz}; };
  Else
    side[] = Extrude {0, 0, lz} { Surface{1}; Layers{nz}; Recombine; };
  EndIf
  Physical Surface("left", 1) = {side[5]};
  Physical Surface("right", 2) = {side[3]};
  Physical Surface("bottom", 3) = {side[2]};
  Physical Surface("top", 4) = {side[4]};
  Physical Surface("back", 5) = {1};
  Physical Surface("front", 6) = {side[0]};
  Physical Volume("fluid", 7) = {side[1]};
Else
  Physical Curve("left", 1) = {4};
  Physical Curve("right", 2) = {2};
  Physical Curve("bottom", 3) = {1};
  Physical Curve("top", 4) = {3};
  Physical Surface("fluid", 7) = {1};
EndIf
