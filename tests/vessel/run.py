#!/usr/bin/python3
"""What a run of one's own says: the lines it opens with, warnings of a solid in distress, its end.

    run.py SOURCE DRIVERS FOLDER
"""
import csv
import os
import re
import subprocess
import sys

CASE = """
mesh: box.msh
patches:
  left: {type: velocity, velocity: [1, 0, 0]}
  right: {type: windkessel, resistance: 0.5, distal_resistance: 2, capacitance: 0.3}
  bottom: {type: wall}
  top: {type: wall}
solid: {shape: sphere, radius: 0.2, center: [0.6, 0.5, 0], shear_modulus: 0.5}
fluid: {viscosity: 0.1}
time: {end: 40}
end_when_empty: true
"""
failures = []


def check(holds, sentence):
    print("ok  " if holds else "FAIL", sentence)
    if not holds:
        failures.append(sentence)


def run(command, folder, **more):
    """Started as a user starts it: what the suite sets for Open MPI as root is taken away."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith("OMPI_ALLOW")}
    return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          cwd=folder, env=environment, **more)


def column(path, name):
    with open(path, encoding="utf-8") as file:
        return [float(row[name]) for row in csv.DictReader(file)]


def gmsh(source, folder, name, n, *settings):
    run(["gmsh", "-2", os.path.join(source, "meshes", name + ".geo"), "-setnumber", "n", str(n),
         *settings, "-o", name + ".msh"], folder, check=True)


def check_opening_lines(drivers, folder):
    vessel = os.path.join(drivers, "fsi-vessel")
    said = run([vessel, "case.yaml", "-output_dir", "out", "-time_end", "0.05"], folder)
    check(said.returncode == 0, "the case runs: " + said.stderr)
    check("fluid: density 1 (not given, the default), viscosity 0.1, kinematic" in said.stdout,
          "it opens with the fluid and what is there by default")
    check(re.search(r"patch right: resistance 0.5, distal resistance 2, capacitance 0.3: .* = 0.6; "
                    r".* = 0.2 of a change", said.stdout), "and with the windkessel and its time")
    check(re.search(r"peak of the flow: patch left at t = 0.*, flow rate 1, Re = 10 .*; U = 1 ", said.stdout) and
          "G* = G / (rho U^2) = 0.5" in said.stdout, "with the peak of the flow and what it makes of G")
    check("the defaults" not in said.stdout, "nothing of the solid is there by default")
    bare = run([vessel, "case.yaml", "-output_dir", "bare", "-time_end", "0.01", "-solid_shape", "cylinder"], folder)
    check("not given, the defaults: -solid_height 0.2" in bare.stdout, "a size by default is told: " + bare.stdout)
    limits = re.search(r"^limits on dt:.*$", said.stdout, re.M).group(0)
    check(limits.count("advective") == 1, "each limit is told once: " + limits)
    again = run([vessel, os.path.join("out", "run.yaml"), "-output_dir", "again"], folder)
    check(again.returncode == 0 and column(os.path.join(folder, "again", "solid.csv"), "x") ==
          column(os.path.join(folder, "out", "solid.csv"), "x"), "run.yaml repeats it: " + again.stderr)
    for options in (["-solid_path", "left,right"], ["-solid_arc_length", "0.2"]):
        alone = run([vessel, "case.yaml", "-output_dir", "out", "-time_end", "0.05", "-solid_shape",
                     "none", *options], folder)
        check(alone.returncode == 0, f"without the solid {options[0]} is left aside: {alone.stderr}")
    help_text = run([vessel, "-help"], folder).stdout
    check("-solids_NAME_shape" in help_text, "-help tells how to have several solids")


def check_meshes(source, drivers, folder):
    """What a mesh of triangles, and a curved plane of symmetry, make a run say."""
    vessel = [os.path.join(drivers, "fsi-vessel"), "case.yaml", "-output_dir", "out", "-time_end", "0.0001"]
    gmsh(source, folder, "box", 12, "-setnumber", "lz", "0", "-setnumber", "simplex", "1")
    said = run(vessel, folder)
    with open(os.path.join(folder, "out", "solid.csv"), encoding="utf-8") as table:
        check("shape_energy" in table.readline() and said.stderr == "",
              "a solid on triangles remembers its shape: " + said.stdout + said.stderr)
    said = run(vessel + ["-solid_radius", "0.08"], folder)
    check("cells through its thickness are too few" in said.stderr, "a thin solid is told: " + said.stderr)
    said = run(vessel + ["-solid_kinematics", "left_cauchy_green"], folder)
    check("left_cauchy_green becomes unstable on triangles" in said.stderr, "a warning: " + said.stderr)
    said = run(vessel + ["-solid_viscosity", "0.51", "-fluid_viscosity", "0.01"], folder)
    check("times the fluid's" not in said.stderr, "triangles bear a very viscous solid: " + said.stderr)
    gmsh(source, folder, "box", 12, "-setnumber", "lz", "0")
    viscous = vessel + ["-solid_viscosity", "0.51", "-fluid_viscosity", "0.01"]
    said = run(viscous, folder)
    check("times the fluid's" not in said.stderr, "and so do quads: " + said.stderr)
    check("with a viscosity ratio of 51 and 4.8 cells through it" in said.stderr,
          "a coarse viscous solid is told: " + said.stderr)
    said = run(viscous + ["-solid_kinematics", "left_cauchy_green"], folder)
    check("51 times the fluid's" in said.stderr and "beyond 50 times" in said.stderr,
          "with left_cauchy_green a warning: " + said.stderr)
    run(["gmsh", "-3", os.path.join(source, "meshes", "cylinder.geo"), "-setnumber", "n", "5", "-setnumber",
         "length", "2", "-o", "round.msh"], folder, check=True)
    round_wall = [os.path.join(drivers, "fsi-vessel"), "-mesh", "round.msh", "-output_dir", "out", "-time_end",
                  "0.0001", "-patches_inlet_type", "pressure", "-patches_outlet_type", "pressure"]
    said = run(round_wall, folder)
    check(said.returncode == 0 and "curved" not in said.stderr, "a round wall is nothing odd: " + said.stderr)
    with open(os.path.join(folder, "late.csv"), "w", encoding="utf-8") as file:
        file.write("t,p\n5,1\n6,2\n")
    said = run(round_wall + ["-patches_inlet_pressure", "late.csv"], folder)
    check(said.returncode == 0 and "its values are 1 during the whole run" in said.stderr,
          "a table of other times is told of: " + said.stderr)
    with open(os.path.join(folder, "short.csv"), "w", encoding="utf-8") as file:
        file.write("t,p\n0,1\n0.00005,2\n")
    said = run(round_wall + ["-patches_inlet_pressure", "short.csv"], folder)
    check(said.returncode == 0 and "its last value 2 holds from then on" in said.stderr,
          "and one that ends before the run: " + said.stderr)
    duct = [os.path.join(drivers, "fsi-vessel"), "-mesh", "duct.msh", "-output_dir", "out", "-time_end", "0.0001",
            "-solid_shape", "sphere", "-solid_radius", "0.2", "-solid_path", "left,right", "-solid_arc_length", "0.5",
            "-patches_left_type", "flow_rate", "-patches_left_flow_rate", "0.25", "-patches_right_type", "pressure"]
    for side in ("bottom", "top", "back", "front"):
        duct += [f"-patches_{side}_type", "symmetry" if side in ("bottom", "back") else "wall"]
    run(["gmsh", "-3", os.path.join(source, "meshes", "box.geo"), "-setnumber", "n", "8", "-o", "duct.msh"], folder,
        check=True)
    said = run(duct, folder)
    place = re.search(r"along it: at \((.*), (.*), (.*)\)", said.stdout)
    check(place and abs(float(place.group(2))) + abs(float(place.group(3))) < 1e-9,
          "in a quarter the centre line is on the planes of symmetry: " + said.stdout + said.stderr)
    check("mean velocity 0.25 and the diameter 2.257" in said.stdout, "and the diameter that of the whole")
    said = run(round_wall + ["-patches_wall_type", "symmetry"], folder)
    check(said.returncode == 0 and 'patch "wall" of type symmetry is curved' in said.stderr,
          "a round plane of symmetry is: " + said.stderr)


def check_end(drivers, folder):
    said = run([os.path.join(drivers, "fsi-vessel"), "case.yaml", "-output_dir", "left"], folder)
    check(said.returncode == 0 and said.stderr.count("fsi: notice: ") == 2 and
          "the rest, " in said.stderr and "volume_out" in said.stderr,
          "a solid that leaves is told at its begin and end: " + said.stderr)
    end = re.search(r"complete at t = (\S+) after", said.stdout)
    check(end and float(end.group(1)) < 2, "and the run ends with it")


def titles(source, folder, *words):
    """{picture: what stands above its panels} as examples/draw.py draws a run."""
    sys.path.insert(0, os.path.join(source, "examples"))
    import draw
    found = {}

    def keep(figure, path, _):
        title = figure._suptitle.get_text() if figure._suptitle else ""
        found[os.path.basename(path)] = " | ".join(
            [title] + [axes.get_title(loc="left") for axes in figure.axes])
        return path
    draw.style.save, sys.argv = keep, ["draw.py", folder, "--renderer", "plain", *words]
    draw.main()
    return found


def check_pictures(source, drivers, folder):
    vessel = [os.path.join(drivers, "fsi-vessel"), "case.yaml"]
    run(vessel + ["-output_dir", "drawn", "-end_when_empty", "false", "-time_end", "0.6",
                  "-output_interval", "0.1"], folder, check=True)
    told = titles(source, os.path.join(folder, "drawn"))
    check("none is left at t = 0.5" in told.get("interface.png", ""),
          f"the interface is drawn as long as there is one: {told}")
    check("flow rate of each opening" in told["series.png"] and
          "mean pressure of each opening" in told["series.png"], "openings have their panels")
    run(vessel + ["-mesh", "box3.msh", "-output_dir", "deep", "-patches_back_type", "symmetry",
                  "-patches_front_type", "symmetry", "-solid_center", "0.6,0.5,0.4", "-time_end", "0.02",
                  "-output_interval", "0.02"], folder, check=True)
    for words, plane in (((), "z = 0.4"), (("--plane", "x"), "x = 0.6"), (("--plane", "y"), "y = 0.5")):
        told = titles(source, os.path.join(folder, "deep"), *words)["flow.png"]
        level = re.search(f"t = 0   plane {plane[:4]}(\\S+)", told)
        check(level and abs(float(level.group(1)) - float(plane[4:])) < 0.03,
              f"the plane goes through the solid, {plane}: {told}")
    from fsi import best_normal
    ways = {"x": [0, 2], "y": [0, 0.1], "z": [0, 3]}
    check(best_normal(ways) == "y" and best_normal({**ways, "z": [0, 0.2]}) == "z",
          "a solid that goes along z is seen from where it moves least")


def check_warnings(source, drivers, folder):
    """A disc so soft that the lid draws it into threads, on one rank and, as root may, on two."""
    case = [os.path.join(drivers, "fsi-cavity"), os.path.join(source, "examples", "cavity_disc.yaml"),
            "-mesh", "cavity.msh", "-output_interval", "0", "-time_end"]
    launcher = [os.path.join(drivers, "fsi-mpiexec"), "--oversubscribe", "--bind-to", "none", "-n", "2"]
    for ranks, start in ((1, []), (2, launcher)):
        out = f"soft{ranks}"
        said = run(start + case + ["6", "-solid_shear_modulus", "0.0005", "-output_dir", out], folder)
        check(said.returncode == 0, f"exit code 0 on {ranks} ranks: {said.stderr}")
        for words in ("pieces of at least 1 %", "the smallest eigenvalue of B in the solid is 0.0",
                      "strain and shape no longer belong to each other"):
            check(len(re.findall(f"fsi: warning: at t = .*{words}", said.stderr)) == 1,
                  f"one warning on {ranks} ranks: {words}")
        path = os.path.join(folder, out, "solid.csv")
        pieces, least = column(path, "pieces"), column(path, "min_eig_B")
        check(pieces[0] == 1 and max(pieces) > 1 and min(least) < 0.05, "solid.csv shows why")
    said = run(case + ["1", "-output_dir", "sound"], folder)
    check(said.returncode == 0 and said.stderr == "", "no word of a sound one " + said.stderr)
    check(set(column(os.path.join(folder, "sound", "solid.csv"), "pieces")) == {1},
          "which is in one piece")


def main():
    source, drivers, folder = (os.path.abspath(word) for word in sys.argv[1:4])
    os.makedirs(folder, exist_ok=True)
    gmsh(source, folder, "box", 12, "-setnumber", "lz", "0")
    gmsh(source, folder, "cavity", 16)
    run(["gmsh", "-3", os.path.join(source, "meshes", "box.geo"), "-setnumber", "n", "8", "-o", "box3.msh"],
        folder, check=True)
    with open(os.path.join(folder, "case.yaml"), "w", encoding="utf-8") as file:
        file.write(CASE)
    check_opening_lines(drivers, folder)
    check_meshes(source, drivers, folder)
    check_end(drivers, folder)
    check_pictures(source, drivers, folder)
    check_warnings(source, drivers, folder)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
