"""A mesh of gmsh's surface and an advancing front's tetrahedra: frontal.py surface.msh volume.msh

`surface.msh` is what `gmsh -2 -format msh22` writes of a closed surface in named groups. The module
netgen.meshing (Debian's package python3-netgen) fills it; gmsh's own frontal algorithm is the same
and stands only in a gmsh that is built with it. --optimise lets it improve the cells.
"""

import argparse

import netgen.meshing as ng


def section(lines, name):
    """The lines between $name and $Endname, without their count."""
    start = lines.index(f"${name}")
    return lines[start + 2 : lines.index(f"$End{name}")]


def read_surface(path):
    """Names as gmsh writes them, points, and triangles as [group, a, b, c] with points from 0."""
    with open(path) as file:
        lines = file.read().split("\n")
    names = section(lines, "PhysicalNames")
    place, points = {}, []
    for line in section(lines, "Nodes"):
        number, *x = line.split()
        place[number] = len(points)
        points.append([float(value) for value in x])
    triangles = []
    for line in section(lines, "Elements"):
        _, kind, tags, group, *rest = line.split()
        if kind == "2":
            triangles.append([int(group)] + [place[p] for p in rest[int(tags) - 1 :]])
    return names, points, triangles


def volume(triangles, points):
    """6 times what the triangles enclose; negative where their normals point inwards."""
    sum = 0
    for _, *corners in triangles:
        a, b, c = (points[p] for p in corners)
        sum += a[0] * (b[1] * c[2] - b[2] * c[1])
        sum += a[1] * (b[2] * c[0] - b[0] * c[2])
        sum += a[2] * (b[0] * c[1] - b[1] * c[0])
    return sum


def fill(points, triangles, optimise):
    """Points and tetrahedra, the surface's points first as they were."""
    mesh = ng.Mesh(dim=3)
    face = mesh.Add(ng.FaceDescriptor(surfnr=1, domin=1, domout=0, bc=1))
    numbers = [mesh.Add(ng.MeshPoint(ng.Pnt(*x))) for x in points]
    outward = volume(triangles, points) > 0
    for _, a, b, c in triangles:
        corners = [a, b, c] if outward else [a, c, b]
        mesh.Add(ng.Element2D(face, [numbers[p] for p in corners]))
    parameters = ng.MeshingParameters(optsteps3d=3 if optimise else 0)
    mesh.GenerateVolumeMesh(parameters)
    cells = [[vertex.nr - 1 for vertex in cell.vertices] for cell in mesh.Elements3D()]
    return [list(point.p) for point in mesh.Points()], cells


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("surface")
    parser.add_argument("volume")
    parser.add_argument("--optimise", action="store_true")
    options = parser.parse_args()
    names, points, triangles = read_surface(options.surface)
    fluid = next(int(name.split()[1]) for name in names if name.startswith("3 "))
    points, cells = fill(points, triangles, options.optimise)
    elements = [(2, group, corners) for group, *corners in triangles]
    elements += [(4, fluid, corners) for corners in cells]
    with open(options.volume, "w") as out:
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", file=out)
        print(len(names), *names, "$EndPhysicalNames\n$Nodes", sep="\n", file=out)
        print(len(points), file=out)
        for i, x in enumerate(points):
            print(i + 1, *(repr(value) for value in x), file=out)
        print(f"$EndNodes\n$Elements\n{len(elements)}", file=out)
        for i, (kind, group, corners) in enumerate(elements):
            print(i + 1, kind, 2, group, group, *(p + 1 for p in corners), file=out)
        print("$EndElements", file=out)


if __name__ == "__main__":
    main()
