// The unit square: patches top (the lid) and wall.
// n cells per side; simplex 1: triangles, 0: quads. algorithm: gmsh's for triangles, 1 MeshAdapt,
// 5 Delaunay, 6 Frontal-Delaunay.
DefineConstant[
  n = {32, Name "n"},
  simplex = {0, Name "simplex"},
  algorithm = {6, Name "algorithm"}
];
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 2, 3, 4} = n + 1;
If (simplex)
  Mesh.Algorithm = algorithm;
Else
  Transfinite Surface {1};
  Recombine Surface {1};
EndIf
Physical Curve("top", 1) = {3};
Physical Curve("wall", 2) = {1, 2, 4};
Physical Surface("fluid", 3) = {1};
