// A plane channel of height 1 along x, n cells across: gmsh -2. Patches inlet, outlet, wall; the first
// two match.
// simplex 1: triangles, by gmsh's algorithm 1 MeshAdapt, 5 Delaunay or 6 Frontal-Delaunay.
DefineConstant[
  n = {32, Name "n"},
  length = {4, Name "length"},
  simplex = {0, Name "simplex"},
  algorithm = {6, Name "algorithm"}
];
Point(1) = {0, 0, 0};
Point(2) = {length, 0, 0};
Point(3) = {length, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = Ceil(n * length - 1e-9) + 1;
Transfinite Curve {2, 4} = n + 1;
If (simplex)
  Mesh.Algorithm = algorithm;
Else
  Transfinite Surface {1};
  Recombine Surface {1};
EndIf
Physical Curve("inlet", 1) = {4};
Physical Curve("outlet", 2) = {2};
Physical Curve("wall", 3) = {1, 3};
Physical Surface("fluid", 4) = {1};
