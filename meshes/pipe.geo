// A pipe of diameter 1 along x, centre line y = z = 0.5: patches inlet (x = 0), outlet, wall.
// n cells per diameter (hexes: a multiple of 4), length; half 1: only z > 0.5, patch symmetry on the
// plane z = 0.5. Cells: hexes of an O-grid; prism 1: triangles swept along x; simplex 1: tets.
// 0 < fine < length: layers of 1 / n from x = 0 to `fine` alone, and longer by a part `rise` > 0 from
// layer to layer up to the middle of the rest.
DefineConstant[
  n = {16, Name "n"},
  length = {5, Name "length"},
  fine = {0, Name "fine"},
  rise = {0.15, Name "rise"},
  half = {0, Name "half"},
  prism = {0, Name "prism"},
  simplex = {0, Name "simplex"}
];
quadrants = half ? 2 : 4;
graded = (fine > 0 && fine < length && rise > 0) ? 1 : 0;
fine_length = graded ? fine : length;
counts[] = {Ceil(n * fine_length - 1e-9)};
tops[] = {fine_length / length};
If (graded)
  rest = (length - fine) / 2;
  growing = Ceil(Log(1 + rest * n * rise / (1 + rise)) / Log(1 + rise));
  first = rest * rise / ((1 + rise) ^ (growing + 1) - (1 + rise));
  at = fine;
  For k In {1 : 2 * growing}
    at += first * (1 + rise) ^ (k <= growing ? k : 2 * growing + 1 - k);
    counts[] += {1};
    tops[] += {k < 2 * growing ? at / length : 1};
  EndFor
EndIf
m = Ceil(n / 4 - 1e-9);
R = 0.5;

centre = newp;
Point(centre) = {0, 0.5, 0.5, 1 / n};
// wall[k] at k * 45 degrees from y towards z
For k In {0 : 2 * quadrants - (half ? 0 : 1)}
  wall[k] = newp;
  Point(wall[k]) = {0, 0.5 + R * Cos(k * Pi / 4), 0.5 + R * Sin(k * Pi / 4), 1 / n};
EndFor
If (!half)
  wall[8] = wall[0];
EndIf
For k In {0 : 2 * quadrants - 1}
  arc[k] = newl;
  Circle(arc[k]) = {wall[k], centre, wall[k + 1]};
EndFor

If (prism || simplex)
  Transfinite Curve {arc[]} = Round(n * Pi / 8) + 1;
  rim[] = arc[];
  If (half)
    diameter = newl;
    Line(diameter) = {wall[4], wall[0]};
    Transfinite Curve {diameter} = n + 1;
    rim[] += {diameter};
  EndIf
  loop = newll;
  Curve Loop(loop) = {rim[]};
  disk = news;
  Plane Surface(disk) = {loop};
  Mesh.Algorithm = 6;
  If (simplex)
    swept[] = Extrude {length, 0, 0} { Surface{disk}; Layers{counts[], tops[]}; };
  Else
    swept[] = Extrude {length, 0, 0} { Surface{disk}; Layers{counts[], tops[]}; Recombine; };
  EndIf
  inlet[] = {disk};
  outlet[] = {swept[0]};
  fluid[] = {swept[1]};
  tube[] = swept[{2 : 1 + 2 * quadrants}];
  symmetry[] = {};
  If (half)
    symmetry[] = {swept[2 + 2 * quadrants]};
  EndIf
Else
  // The core: corners at radius rc, mids of its sides at rm, sides arcs that cross the axes at right
  // angles. m cells along every line of the section.
  rc = 0.34;
  rm = 0.28;
  c = (rc * rc - rm * rm) / (Sqrt(2) * rc - 2 * rm);
  For k In {0 : 2 * quadrants - (half ? 0 : 1)}
    r = (k % 2) ? rc : rm;
    core[k] = newp;
    Point(core[k]) = {0, 0.5 + r * Cos(k * Pi / 4), 0.5 + r * Sin(k * Pi / 4)};
    ray[k] = newl;
    Line(ray[k]) = {core[k], wall[k]};
  EndFor
  If (!half)
    core[8] = core[0];
    ray[8] = ray[0];
  EndIf
  For k In {0 : 2 * quadrants : 2}
    If (k < 8)
      spoke[k] = newl;
      Line(spoke[k]) = {centre, core[k]};
      hub[k] = newp;
      Point(hub[k]) = {0, 0.5 + c * Cos(k * Pi / 4), 0.5 + c * Sin(k * Pi / 4)};
    Else
      spoke[8] = spoke[0];
      hub[8] = hub[0];
    EndIf
  EndFor
  For k In {0 : 2 * quadrants - 1}
    side[k] = newl;
    Circle(side[k]) = {core[k], hub[(k % 2) ? k + 1 : k], core[k + 1]};
  EndFor
  section[] = {};
  For k In {0 : 2 * quadrants - 1}
    loop = newll;
    Curve Loop(loop) = {ray[k], arc[k], -ray[k + 1], -side[k]};
    block = news;
    Plane Surface(block) = {loop};
    section[] += {block};
  EndFor
  For k In {0 : 2 * quadrants - 2 : 2}
    loop = newll;
    Curve Loop(loop) = {spoke[k], side[k], side[k + 1], -spoke[k + 2]};
    block = news;
    Plane Surface(block) = {loop};
    section[] += {block};
  EndFor
  Transfinite Curve "*" = m + 1;
  Transfinite Surface {section[]};
  Recombine Surface {section[]};
  swept[] = Extrude {length, 0, 0} { Surface{section[]}; Layers{counts[], tops[]}; Recombine; };
  inlet[] = section[];
  outlet[] = {};
  fluid[] = {};
  tube[] = {};
  symmetry[] = {};
  For s In {0 : #section[] - 1}
    outlet[] += {swept[6 * s]};
    fluid[] += {swept[6 * s + 1]};
    If (s < 2 * quadrants)
      tube[] += {swept[6 * s + 3]};
    EndIf
  EndFor
  If (half)
    symmetry[] = {swept[2], swept[6 * 3 + 4], swept[6 * 4 + 2], swept[6 * 5 + 5]};
  EndIf
EndIf
Physical Surface("inlet", 1) = {inlet[]};
Physical Surface("outlet", 2) = {outlet[]};
Physical Surface("wall", 3) = {tube[]};
If (half)
  Physical Surface("symmetry", 4) = {symmetry[]};
EndIf
Physical Volume("fluid", 5) = {fluid[]};
