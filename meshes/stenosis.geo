// A pipe of diameter 1 along x, centre line y = z = 0.5, length 6, that narrows to diameter 0.5:
// R(x) = 0.5 - 0.125 (1 + cos(2 pi (x - 3) / throat)) for |x - 3| < throat / 2.
// Patches inlet (x = 0), outlet (x = 6), wall. n cells per diameter, along the axis 1 / n long.
// Hexes of an O-grid (n a multiple of 4); simplex 1: tets. Every node of the wall lies on it.
// half 1: only z > 0.5, patch symmetry on the plane z = 0.5.
DefineConstant[
  n = {16, Name "n"},
  throat = {6, Name "throat"},
  half = {0, Name "half"},
  simplex = {0, Name "simplex"}
];
length = 6;
symmetry[] = {};

If (simplex)
  SetFactory("OpenCASCADE");
  // The half section in the plane z = 0.5, turned about the axis.
  N = 240;
  profile[] = {};
  For i In {0 : N}
    x = 3 + throat * (i / N - 0.5);
    p = newp;
    Point(p) = {x, 1 - 0.125 * (1 + Cos(2 * Pi * (x - 3) / throat)), 0.5};
    profile[] += {p};
  EndFor
  a = newp;
  Point(a) = {0, 0.5, 0.5};
  b = newp;
  Point(b) = {length, 0.5, 0.5};
  first = profile[0];
  last = profile[N];
  edges[] = {};
  c = newl;
  Spline(c) = {profile[]};
  edges[] += {c};
  If (throat < length - 1e-9)
    first = newp;
    Point(first) = {0, 1, 0.5};
    last = newp;
    Point(last) = {length, 1, 0.5};
    c = newl;
    Line(c) = {profile[N], last};
    edges[] += {c};
  EndIf
  c = newl;
  Line(c) = {last, b};
  edges[] += {c};
  c = newl;
  Line(c) = {b, a};
  edges[] += {c};
  c = newl;
  Line(c) = {a, first};
  edges[] += {c};
  If (throat < length - 1e-9)
    c = newl;
    Line(c) = {first, profile[0]};
    edges[] += {c};
  EndIf
  loop = newll;
  Curve Loop(loop) = {edges[]};
  section = news;
  Plane Surface(section) = {loop};
  half1[] = Extrude {{1, 0, 0}, {0, 0.5, 0.5}, Pi} { Surface{section}; };
  eps = 1e-3;
  If (half)
    symmetry[] = Surface In BoundingBox {-eps, -1, 0.5 - eps, length + eps, 2, 0.5 + eps};
  Else
    half2[] = Extrude {{1, 0, 0}, {0, 0.5, 0.5}, -Pi} { Surface{section}; };
    whole[] = BooleanUnion{ Volume{half1[1]}; Delete; }{ Volume{half2[1]}; Delete; };
  EndIf
  inlet[] = Surface In BoundingBox {-eps, -1, -1, eps, 2, 2};
  outlet[] = Surface In BoundingBox {length - eps, -1, -1, length + eps, 2, 2};
  tube[] = Surface{:};
  tube[] -= {inlet[], outlet[], symmetry[]};
  fluid[] = Volume{:};
  Mesh.CharacteristicLengthMax = 1 / n;
  Mesh.CharacteristicLengthMin = 1 / n;
Else
  // One slab of cells after the other: a station of the section at every x where the radius changes.
  straight = (length - throat) / 2;
  steps = Ceil(n * throat - 1e-9);
  x[] = {};
  If (straight > 1e-9)
    x[] += {0};
  EndIf
  For i In {0 : steps}
    x[] += {straight + i * throat / steps};
  EndFor
  If (straight > 1e-9)
    x[] += {length};
  EndIf
  m = Ceil(n / 4 - 1e-9);
  // The core of the O-grid, as parts of the radius: corners at rc, mids of its sides at rm.
  rc = 0.68;
  rm = 0.56;
  c = (rc * rc - rm * rm) / (Sqrt(2) * rc - 2 * rm);
  // Rays at these angles from y towards z, cells of the sides from each to the next, and the
  // direction in which the side of the core lies.
  If (half)
    angle[] = {0, Pi / 4, 3 * Pi / 4, Pi};
    core[] = {rm, rc, rc, rm};
    cells[] = {m, 2 * m, m};
    out[] = {0, Pi / 2, Pi};
  Else
    angle[] = {Pi / 4, 3 * Pi / 4, 5 * Pi / 4, 7 * Pi / 4};
    core[] = {rc, rc, rc, rc};
    cells[] = {2 * m, 2 * m, 2 * m, 2 * m};
    out[] = {Pi / 2, Pi, 3 * Pi / 2, 2 * Pi};
  EndIf
  sides = half ? 3 : 4;
  inlet[] = {};
  outlet[] = {};
  tube[] = {};
  fluid[] = {};
  For i In {0 : #x[] - 1}
    R = 0.5;
    If (Fabs(x[i] - 3) < throat / 2)
      R = 0.5 - 0.125 * (1 + Cos(2 * Pi * (x[i] - 3) / throat));
    EndIf
    centre = newp;
    Point(centre) = {x[i], 0.5, 0.5};
    For k In {0 : 3}
      pw[k] = newp;
      Point(pw[k]) = {x[i], 0.5 + R * Cos(angle[k]), 0.5 + R * Sin(angle[k])};
      pc[k] = newp;
      Point(pc[k]) = {x[i], 0.5 + core[k] * R * Cos(angle[k]), 0.5 + core[k] * R * Sin(angle[k])};
    EndFor
    For k In {0 : sides - 1}
      hub[k] = newp;
      Point(hub[k]) = {x[i], 0.5 + c * R * Cos(out[k]), 0.5 + c * R * Sin(out[k])};
    EndFor
    pw[4] = pw[0];
    pc[4] = pc[0];
    For k In {0 : sides - 1}
      arc[k] = newl;
      Circle(arc[k]) = {pw[k], centre, pw[k + 1]};
      side[k] = newl;
      Circle(side[k]) = {pc[k], hub[k], pc[k + 1]};
      Transfinite Curve {arc[k], side[k]} = cells[k] + 1;
    EndFor
    For k In {0 : 3}
      ray[k] = newl;
      Line(ray[k]) = {pc[k], pw[k]};
      Transfinite Curve {ray[k]} = m + 1;
    EndFor
    ray[4] = ray[0];
    // The core is closed by its fourth side, or by the plane of symmetry.
    If (half)
      side[3] = newl;
      Line(side[3]) = {pc[3], pc[0]};
      Transfinite Curve {side[3]} = 2 * m + 1;
    EndIf
    For k In {0 : sides - 1}
      loop = newll;
      Curve Loop(loop) = {ray[k], arc[k], -ray[k + 1], -side[k]};
      face[k] = news;
      Plane Surface(face[k]) = {loop};
    EndFor
    loop = newll;
    Curve Loop(loop) = {side[0], side[1], side[2], side[3]};
    face[sides] = news;
    Plane Surface(face[sides]) = {loop};
    Transfinite Surface {face[]};
    Recombine Surface {face[]};
    If (i == 0)
      inlet[] = face[];
    EndIf
    If (i == #x[] - 1)
      outlet[] = face[];
    EndIf
    If (i > 0)
      layers = Round(n * (x[i] - x[i - 1]));
      layers = layers < 1 ? 1 : layers;
      For k In {0 : 3}
        along_w[k] = newl;
        Line(along_w[k]) = {old_pw[k], pw[k]};
        along_c[k] = newl;
        Line(along_c[k]) = {old_pc[k], pc[k]};
        Transfinite Curve {along_w[k], along_c[k]} = layers + 1;
      EndFor
      along_w[4] = along_w[0];
      along_c[4] = along_c[0];
      For k In {0 : sides - 1}
        loop = newll;
        Curve Loop(loop) = {old_arc[k], along_w[k + 1], -arc[k], -along_w[k]};
        outer[k] = news;
        Surface(outer[k]) = {loop};
      EndFor
      For k In {0 : 3}
        loop = newll;
        Curve Loop(loop) = {old_side[k], along_c[k + 1], -side[k], -along_c[k]};
        inner[k] = news;
        Surface(inner[k]) = {loop};
        loop = newll;
        Curve Loop(loop) = {old_ray[k], along_w[k], -ray[k], -along_c[k]};
        between[k] = news;
        Surface(between[k]) = {loop};
      EndFor
      between[4] = between[0];
      Transfinite Surface {outer[], inner[], between[{0 : 3}]};
      Recombine Surface {outer[], inner[], between[{0 : 3}]};
      For k In {0 : sides - 1}
        loop = newsl;
        Surface Loop(loop) = {old_face[k], face[k], outer[k], inner[k], between[k], between[k + 1]};
        block[k] = newv;
        Volume(block[k]) = {loop};
      EndFor
      loop = newsl;
      Surface Loop(loop) = {old_face[sides], face[sides], inner[]};
      block[sides] = newv;
      Volume(block[sides]) = {loop};
      Transfinite Volume {block[]};
      tube[] += {outer[]};
      If (half)
        symmetry[] += {inner[3], between[0], between[3]};
      EndIf
      fluid[] += {block[]};
    EndIf
    old_pw[] = pw[];
    old_pc[] = pc[];
    old_arc[] = arc[];
    old_side[] = side[];
    old_ray[] = ray[];
    old_face[] = face[];
  EndFor
EndIf
Physical Surface("inlet", 1) = {inlet[]};
Physical Surface("outlet", 2) = {outlet[]};
Physical Surface("wall", 3) = {tube[]};
If (half)
  Physical Surface("symmetry", 4) = {symmetry[]};
EndIf
Physical Volume("fluid", 5) = {fluid[]};
