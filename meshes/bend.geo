// A vessel of diameter 1: from the origin 1 along x, a quarter turn of radius `turn`, 1 along y; n
// cells per diameter. simplex 1: tets, algorithm 1: Delaunay, 10: HXT; optimise 0: as they come.
// simplex 0: hexes of an O-grid. Patches inlet (x = 0), outlet, wall.
DefineConstant[
  n = {12, Name "n"},
  turn = {1.5, Name "turn"},
  simplex = {1, Name "simplex"},
  algorithm = {1, Name "algorithm"},
  optimise = {1, Name "optimise"}
];
If (simplex)
  SetFactory("OpenCASCADE");
  Point(1) = {0, 0, 0};
  Point(2) = {1, 0, 0};
  Point(3) = {1, turn, 0};
  Point(4) = {1 + turn, turn, 0};
  Point(5) = {1 + turn, turn + 1, 0};
  Line(1) = {1, 2};
  Circle(2) = {2, 3, 4};
  Line(3) = {4, 5};
  Wire(1) = {1, 2, 3};
  Disk(100) = {0, 0, 0, 0.5};
  Rotate {{0, 1, 0}, {0, 0, 0}, Pi / 2} { Surface{100}; }
  vessel() = Extrude { Surface{100}; } Using Wire {1};
  Delete { Surface{100}; }
  e = 1e-3;
  inlet() = Surface In BoundingBox {-e, -1, -1, e, 1, 1};
  outlet() = Surface In BoundingBox {turn, turn + 1 - e, -1, turn + 2, turn + 1 + e, 1};
  wall() = Surface{:};
  wall() -= inlet();
  wall() -= outlet();
  Mesh.CharacteristicLengthMin = 1 / n;
  Mesh.CharacteristicLengthMax = 1 / n;
  Mesh.Algorithm3D = algorithm;
  Mesh.Optimize = optimise;
Else
  m = Ceil(n / 4 - 1e-9);
  R = 0.5;
  core = 0.27;
  axis = newp;
  Point(axis) = {0, 0, 0};
  For k In {0 : 3}
    a = Pi / 4 + k * Pi / 2;
    outer[k] = newp;
    Point(outer[k]) = {0, R * Cos(a), R * Sin(a)};
    inner[k] = newp;
    Point(inner[k]) = {0, core * Cos(a), core * Sin(a)};
    // the core's sides are arcs about a point on the other side
    behind[k] = newp;
    Point(behind[k]) = {0, -0.35 * Cos(a + Pi / 4), -0.35 * Sin(a + Pi / 4)};
  EndFor
  For k In {0 : 3}
    arc[k] = newl;
    Circle(arc[k]) = {outer[k], axis, outer[(k + 1) % 4]};
    side[k] = newl;
    Circle(side[k]) = {inner[k], behind[k], inner[(k + 1) % 4]};
    ray[k] = newl;
    Line(ray[k]) = {inner[k], outer[k]};
  EndFor
  Transfinite Curve {arc[], side[]} = 2 * m + 1;
  Transfinite Curve {ray[]} = m + 1;
  section[] = {};
  For k In {0 : 3}
    loop = newll;
    Curve Loop(loop) = {ray[k], arc[k], -ray[(k + 1) % 4], -side[k]};
    face = news;
    Plane Surface(face) = {loop};
    Transfinite Surface {face};
    section[] += {face};
  EndFor
  loop = newll;
  Curve Loop(loop) = {side[]};
  face = news;
  Plane Surface(face) = {loop};
  Transfinite Surface {face};
  section[] += {face};
  Recombine Surface {section[]};
  inlet[] = section[];
  wall[] = {};
  vessel[] = {};
  For sweep In {0 : 2}
    next[] = {};
    For i In {0 : 4}
      If (sweep == 0)
        swept[] = Extrude {1, 0, 0} { Surface{section[i]}; Layers{n}; Recombine; };
      ElseIf (sweep == 1)
        swept[] = Extrude {{0, 0, 1}, {1, turn, 0}, Pi / 2} { Surface{section[i]}; Layers{Ceil(n * turn * Pi / 2)}; Recombine; };
      Else
        swept[] = Extrude {0, 1, 0} { Surface{section[i]}; Layers{n}; Recombine; };
      EndIf
      next[] += {swept[0]};
      vessel[] += {swept[1]};
      If (i < 4)
        wall[] += {swept[3]};
      EndIf
    EndFor
    section[] = next[];
  EndFor
  outlet[] = section[];
EndIf
Physical Surface("inlet") = inlet[];
Physical Surface("outlet") = outlet[];
Physical Surface("wall") = wall[];
Physical Volume("fluid") = vessel[];
