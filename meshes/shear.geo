// A box of side H about the origin, for a particle of radius 1 there: dim 2, a square, with gmsh -2;
// dim 3, a cube, with gmsh -3. n cells per radius within `core` of the origin; farther out a cell is
// `growth` times as wide as the one before. simplex 1: triangles or tets, 0: quads or hexes.
// half 1 (hexes): only z > 0, with the plane z = 0 as patch back.
// Patches left, right (x), bottom, top (y), in 3-D back, front (z); opposite sides match.
DefineConstant[
  n = {16, Name "n"},
  H = {20, Name "H"},
  dim = {2, Name "dim"},
  core = {1.75, Name "core"},
  growth = {1.15, Name "growth"},
  half = {0, Name "half"},
  simplex = {0, Name "simplex"}
];
h = 1 / n;
a = H / 2;
left[] = {};
right[] = {};
bottom[] = {};
top[] = {};
back[] = {};
front[] = {};
fluid[] = {};

If (simplex)
  // Edges of length h within the core; outside they grow by log(growth) a unit of length.
  outer = h + Log(growth) * (a - core);
  m = Ceil(H / outer - 1e-9);
  For k In {0 : dim - 2}
    z = (dim == 2) ? 0 : (2 * k - 1) * a;
    Point(4 * k + 1) = {-a, -a, z};
    Point(4 * k + 2) = {a, -a, z};
    Point(4 * k + 3) = {a, a, z};
    Point(4 * k + 4) = {-a, a, z};
    Line(4 * k + 1) = {4 * k + 1, 4 * k + 2};
    Line(4 * k + 2) = {4 * k + 2, 4 * k + 3};
    Line(4 * k + 3) = {4 * k + 4, 4 * k + 3};
    Line(4 * k + 4) = {4 * k + 1, 4 * k + 4};
    Curve Loop(k + 1) = {4 * k + 1, 4 * k + 2, -(4 * k + 3), -(4 * k + 4)};
    Plane Surface(k + 1) = {k + 1};
  EndFor
  If (dim == 2)
    left[] = {4};
    right[] = {2};
    bottom[] = {1};
    top[] = {3};
    fluid[] = {1};
  Else
    For k In {1 : 4}
      Line(8 + k) = {k, 4 + k};
    EndFor
    Curve Loop(3) = {4, 12, -8, -9};
    Curve Loop(4) = {2, 11, -6, -10};
    Curve Loop(5) = {1, 10, -5, -9};
    Curve Loop(6) = {3, 11, -7, -12};
    For k In {3 : 6}
      Plane Surface(k) = {k};
    EndFor
    // The same corners in the same order, so that opposite sides are divided alike.
    Transfinite Surface {1} = {1, 2, 3, 4};
    Transfinite Surface {2} = {5, 6, 7, 8};
    Transfinite Surface {3} = {1, 4, 8, 5};
    Transfinite Surface {4} = {2, 3, 7, 6};
    Transfinite Surface {5} = {1, 2, 6, 5};
    Transfinite Surface {6} = {4, 3, 7, 8};
    Surface Loop(1) = {1 : 6};
    Volume(1) = {1};
    back[] = {1};
    front[] = {2};
    left[] = {3};
    right[] = {4};
    bottom[] = {5};
    top[] = {6};
    fluid[] = {1};
  EndIf
  Transfinite Curve "*" = m + 1;
  Field[1] = MathEval;
  Field[1].F = Sprintf("%g + %g * 0.5 * (Sqrt(x*x+y*y+z*z) - %g + Abs(Sqrt(x*x+y*y+z*z) - %g))", h,
                       Log(growth), core, core);
  Background Field = 1;
  Mesh.CharacteristicLengthFromPoints = 0;
  Mesh.CharacteristicLengthExtendFromBoundary = 0;
  Mesh.Algorithm = 6;
  Mesh.Algorithm3D = 10;
Else
  // Widths of the layers from -a to a, as parts of H.
  inner = 2 * Ceil(core * n - 1e-9);
  rest = a - inner / 2 * h;
  m = (rest > 0) ? Ceil(Log(1 + rest * (growth - 1) / (h * growth)) / Log(growth) - 1e-9) : 0;
  sum = 0;
  For k In {1 : m}
    sum += growth^k;
  EndFor
  ones[] = {};
  ends[] = {};
  x = 0;
  For k In {1 : 2 * m + inner}
    i = (k <= m) ? m + 1 - k : k - m - inner;
    x += (i > 0) ? rest * growth^i / sum : h;
    ones[] += {1};
    ends[] += {x / H};
  EndFor
  // Along z all layers, or those beyond the middle.
  depth = half ? a : H;
  layers[] = {};
  tops[] = {};
  For k In {(half ? m + inner / 2 : 0) : 2 * m + inner - 1}
    layers[] += {1};
    tops[] += {half ? 2 * ends[k] - 1 : ends[k]};
  EndFor
  Point(1) = {-a, -a, (dim == 3 && !half) ? -a : 0};
  row[] = Extrude {H, 0, 0} { Point{1}; Layers{ones[], ends[]}; };
  area[] = Extrude {0, H, 0} { Curve{row[1]}; Layers{ones[], ends[]}; Recombine; };
  bottom[] = {row[1]};
  top[] = {area[0]};
  fluid[] = {area[1]};
  left[] = {area[3]};
  right[] = {area[2]};
  If (dim == 3)
    block[] = Extrude {0, 0, depth} { Surface{area[1]}; Layers{layers[], tops[]}; Recombine; };
    back[] = {area[1]};
    front[] = {block[0]};
    fluid[] = {block[1]};
    bottom[] = {block[2]};
    right[] = {block[3]};
    top[] = {block[4]};
    left[] = {block[5]};
  EndIf
EndIf
If (dim == 2)
  Physical Curve("left", 1) = {left[]};
  Physical Curve("right", 2) = {right[]};
  Physical Curve("bottom", 3) = {bottom[]};
  Physical Curve("top", 4) = {top[]};
  Physical Surface("fluid", 7) = {fluid[]};
Else
  Physical Surface("left", 1) = {left[]};
  Physical Surface("right", 2) = {right[]};
  Physical Surface("bottom", 3) = {bottom[]};
  Physical Surface("top", 4) = {top[]};
  Physical Surface("back", 5) = {back[]};
  Physical Surface("front", 6) = {front[]};
  Physical Volume("fluid", 7) = {fluid[]};
EndIf
