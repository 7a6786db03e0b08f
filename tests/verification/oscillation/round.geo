// A disc of radius 3 about the origin: quads, uniform ones of side 1/n in the square |x|, |y| < 1.5;
// simplex 1: triangles with about as many cells. Patch wall.
DefineConstant[
  n = {8, Name "cells per unit length"},
  simplex = {0, Name "simplex"}
];
b = 1.5;
c = 3 * Sqrt(0.5);
h = 1.52 / n;
Point(1) = {-b, -b, 0};
Point(2) = {b, -b, 0};
Point(3) = {b, b, 0};
Point(4) = {-b, b, 0};
Point(5) = {-c, -c, 0};
Point(6) = {c, -c, 0};
Point(7) = {c, c, 0};
Point(8) = {-c, c, 0};
Point(9) = {0, 0, 0};
Circle(15) = {5, 9, 6};
Circle(16) = {6, 9, 7};
Circle(17) = {7, 9, 8};
Circle(18) = {8, 9, 5};
If (simplex)
  Curve Loop(1) = {15, 16, 17, 18};
  Plane Surface(1) = {1};
  Mesh.MeshSizeExtendFromBoundary = 0;
  Mesh.MeshSizeFromPoints = 0;
  Mesh.MeshSizeMin = h;
  Mesh.MeshSizeMax = h;
  Mesh.Algorithm = 5;
  Physical Surface("fluid") = {1};
Else
  Line(1) = {1, 2};
  Line(2) = {2, 3};
  Line(3) = {3, 4};
  Line(4) = {4, 1};
  Line(21) = {1, 5};
  Line(22) = {2, 6};
  Line(23) = {3, 7};
  Line(24) = {4, 8};
  Curve Loop(1) = {1, 2, 3, 4};
  Curve Loop(2) = {1, 22, -15, -21};
  Curve Loop(3) = {2, 23, -16, -22};
  Curve Loop(4) = {3, 24, -17, -23};
  Curve Loop(5) = {4, 21, -18, -24};
  For s In {1:5}
    Plane Surface(s) = {s};
  EndFor
  Transfinite Curve {1, 2, 3, 4, 15, 16, 17, 18} = Round(2 * b * n) + 1;
  Transfinite Curve {21, 22, 23, 24} = Round(1.5 * n) + 1;
  Transfinite Surface {1, 2, 3, 4, 5};
  Recombine Surface {1, 2, 3, 4, 5};
  Physical Surface("fluid") = {1, 2, 3, 4, 5};
EndIf
Physical Curve("wall") = {15, 16, 17, 18};
