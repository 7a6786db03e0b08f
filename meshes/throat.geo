// A plane channel of height 1 along x with a smooth throat, n cells across: gmsh -2. Patches inlet, outlet, wall.
// The height is 1 - (1 - throat) (1 + cos(pi s)) / 2 over -1 < s < 1, where s is (x - length / 2) / half.
// simplex 1: triangles, by gmsh's algorithm 1 MeshAdapt, 5 Delaunay or 6 Frontal-Delaunay.
DefineConstant[
  n = {20, Name "n"},
  throat = {0.4, Name "throat"},
  half = {1, Name "half"},
  length = {4, Name "length"},
  simplex = {0, Name "simplex"},
  algorithm = {6, Name "algorithm"}
];
parts = 40;  // of the spline
begin = length / 2 - half;
For side In {0 : 1}  // below, above
  first = newp;
  Point(first) = {0, side, 0};
  For i In {0 : parts}
    a = (1 - throat) / 4 * (1 + Cos(Pi * (2 * i / parts - 1)));
    Point(newp) = {begin + 2 * half * i / parts, side + (1 - 2 * side) * a, 0};
  EndFor
  last = newp;
  Point(last) = {length, side, 0};
  k = 3 * side;
  Line(k + 1) = {first, first + 1};
  Spline(k + 2) = {first + 1 : last - 1};
  Line(k + 3) = {last - 1, last};
  corner[] += {first, first + 1, last - 1, last};
EndFor
For i In {0 : 3}
  Line(7 + i) = {corner[i], corner[4 + i]};  // from the wall below to that above
EndFor
For part In {1 : 3}
  Curve Loop(part) = {part, 7 + part, -(3 + part), -(6 + part)};
  Plane Surface(part) = {part};
EndFor
Transfinite Curve {1, 3, 4, 6} = Ceil(n * begin - 1e-9) + 1;
Transfinite Curve {2, 5} = Ceil(2 * n * half - 1e-9) + 1;
Transfinite Curve {7 : 10} = n + 1;
If (simplex)
  Mesh.Algorithm = algorithm;
  Mesh.MeshSizeMin = 1 / n;
  Mesh.MeshSizeMax = 1 / n;
Else
  Transfinite Surface {1 : 3};
  Recombine Surface {1 : 3};
EndIf
Physical Curve("inlet", 1) = {7};
Physical Curve("outlet", 2) = {10};
Physical Curve("wall", 3) = {1 : 6};
Physical Surface("fluid", 4) = {1 : 3};
