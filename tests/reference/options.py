#!/usr/bin/python3
"""doc/reference/options.md, made from what the drivers' -help prints.

    options.py DRIVERS DOCUMENT            writes it
    options.py DRIVERS DOCUMENT --check    compares; exit code 1 and the lines that differ
"""
import difflib
import os
import re
import subprocess
import sys

DRIVERS = ("fsi-vessel", "fsi-pipe", "fsi-cavity", "fsi-shear", "fsi-stenosis", "fsi-advect")
COMMANDS = (("fsi-mesh check", ["check", "in.msh"]), ("fsi-mesh convert", ["convert", "in.msh", "out.h5"]))
# Title, names that begin so, a sentence before the table.
GROUPS = (
    ("Mesh", ("mesh", "petscpartitioner_type"), "What the flow happens in, and how ranks share it."),
    ("Flow", ("fluid_", "flow_convection", "gravity"), "The fluid and its equation."),
    ("Solid", ("solid_",), "The solid at the start, its material and how its deformation is tracked. "
     "Density and viscosity of the solid are those of the fluid where they are not given. "
     "A shape takes its own sizes alone: an option of another shape is refused. "
     "`-solid_axis x,y,z` gives the axis of revolution in place of `-solid_angle`. "
     "Of several solids each has a name and all of these options under it: `-solids_NAME_shape`, "
     "`-solids_NAME_shear_modulus`. In a case file that is a block, "
     "`solids: {left: {shape: sphere, ...}, right: {...}}`. "
     "An option that two of them could take is refused: `-solids_ring_minor_radius` of a torus `ring` beside a "
     "sphere `ring_minor`. "
     "With the shape none the other options of a solid are left aside."),
    ("Time", ("time_",), "The end of the run and the length of its steps. "
     "Of these `fsi-advect` heeds `-time_end` and `-time_courant`. A flow from rest\n"
     "begins with ten steps in which its Courant number grows to `-time_courant` "
     "([limits](../theory/time_step.md#limits-of-the-step))."),
    ("Output", ("output_", "sample_", "checkpoint_", "restart", "end_when_empty", "max_wall_time"),
     "What a run writes, how often, and when it stops. [files.md](files.md) describes the files."),
)
PATCHES = ("Patches of fsi-vessel", "patches_", "NAME stands for the name of a patch of the mesh. "
           "Every patch needs a type, but for those called wall or symmetry. "
           "An option of a patch that the mesh does not have, or that its type does not take, is refused. "
           "So is one that two patches could take: `-patches_lid_wall_velocity` of a wall `lid` beside a patch "
           "`lid_wall`. "
           "Options without a default must be given where the type takes them; a velocity needs "
           "`-patches_NAME_velocity` or its file. "
           "The meaning begins with the types of patch that take the option. "
           "[The howto](../howto/vessel.md) shows them in use.")
HEAD = """# Options

This page is generated from what the drivers print with `-help`; do not edit it by hand:

```
/usr/bin/python3 tests/reference/options.py build/drivers doc/reference/options.md
```

An option stands in the case file without its dash, where nested keys join with an underscore.
On the command line it stands with its dash, and the command line wins.
A quantity may be in any consistent system of units; the column *unit* tells its dimension.
*All* drivers are those that run a case: {all}.
Options of PETSc, such as `-p_ksp_monitor`, are taken as well; [the howto](../howto/sweep.md) shows some.
"""


class Option:
    """One option of one program, as -help tells it."""

    def __init__(self, name, meaning, line):
        self.name = name
        unit = re.search(r" \[([^\[\]]+)\]$", meaning)
        self.unit = unit.group(1) if unit else ""
        self.meaning = meaning[:unit.start()] if unit else meaning
        values, self.default = re.match(r"(?:(.*); )?default (.*)$", line).groups()
        self.values = values or ""

    def what(self):
        """All but the default, which may be a driver's own."""
        return self.name, self.meaning, self.unit, self.values


def options_of(program, words=()):
    """The options that a program lists with -help, in its order."""
    said = subprocess.run([program, *words, "-help"], stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, check=True).stdout
    found = re.findall(r"^  -(\S+) +(\S.*)\n {20,}(\S.*)$", said.split("\n-----")[0], re.M)
    if not found:
        sys.exit(f"{program} -help lists no options:\n{said}")
    return [Option(*parts) for parts in found]


def cell(text):
    return text.replace("|", "\\|")


def table(rows, last=None):
    """Rows (option, default, drivers) as a table."""
    lines = ["| option | default | unit | values | meaning |" + (" drivers |" if last else ""),
             "|---|---|---|---|---|" + ("---|" if last else "")]
    for option, default, drivers in rows:
        items = [f"`-{option.name}`", default, option.unit, option.values, option.meaning]
        lines.append("| " + " | ".join(map(cell, items + ([drivers] if last else []))) + " |")
    return "\n".join(lines) + "\n"


def default_of(by_driver):
    """The default, and where drivers differ whose it is."""
    default = {driver: option.default for driver, option in by_driver.items()}
    names = {driver.removeprefix("fsi-"): value for driver, value in default.items()}
    if len(names) > 1 and all(value == "out/" + driver for driver, value in names.items()):
        return "out/ and the driver's name without fsi-"
    groups = {}
    for driver, value in default.items():
        groups.setdefault(value, []).append(driver)
    if len(groups) == 1:
        return next(iter(groups))
    return "; ".join(f"{value} ({', '.join(drivers)})" for value, drivers in groups.items())


def collect(listed):
    """{name: {driver: option}}; drivers that share a name must tell the same of it."""
    names = {}
    for driver, options in listed.items():
        for option in options:
            names.setdefault(option.name, {})[driver] = option
    for name, by_driver in names.items():
        if len({option.what() for option in by_driver.values()}) > 1:
            sys.exit(f"drivers tell different things of -{name}: {', '.join(by_driver)}")
    return names


def row(by_driver):
    drivers = list(by_driver)
    where = "all" if len(drivers) == len(DRIVERS) else ", ".join(drivers)
    return next(iter(by_driver.values())), default_of(by_driver), where


def document(folder):
    listed = {driver: options_of(os.path.join(folder, driver)) for driver in DRIVERS}
    names = collect(listed)
    parts = [HEAD.format(all=", ".join(DRIVERS))]

    def section(title, sentence, rows, last=True):
        parts.append(f"## {title}\n\n{sentence}\n\n" + table(rows, last))

    left = dict(names)
    for title, prefixes, sentence in GROUPS:
        mine = [name for name in left if name.startswith(prefixes)]
        section(title, sentence, [row(left.pop(name)) for name in mine])
    mine = [name for name in left if name.startswith(PATCHES[1])]
    section(PATCHES[0], PATCHES[2], [row(left.pop(name)) for name in mine], False)
    section("Of one driver", "What the driver of one scene asks for. `fsi-pipe` needs a mesh with a period parallel to x; "
            "for others take `fsi-vessel`.",
            [row(by_driver) for by_driver in left.values()])
    for title, words in COMMANDS:
        options = options_of(os.path.join(folder, "fsi-mesh"), words)
        section(title, f"`{title} {' '.join(words[1:])}` takes these.",
                [(option, option.default, "") for option in options], False)
    return "\n".join(parts)


def main():
    folder, path = sys.argv[1:3]
    text = document(folder)
    if "--check" not in sys.argv[3:]:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return 0
    with open(path, encoding="utf-8") as file:
        there = file.read()
    if there == text:
        return 0
    sys.stdout.writelines(difflib.unified_diff(there.splitlines(True), text.splitlines(True), path,
                                               "what -help prints"))
    print(f"{path} is not what the drivers print: {sys.argv[0]} {folder} {path} writes it")
    return 1


if __name__ == "__main__":
    sys.exit(main())
