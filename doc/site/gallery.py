"""The gallery of cases, from the heads of examples/*.yaml and the pictures in doc/gallery."""
import glob
import os
import re

FIELDS = ("driver", "mesh", "time", "teaches")


def cases(source):
    """(name, what it is, fields of its head) of each case."""
    for path in sorted(glob.glob(os.path.join(source, "examples", "*.yaml"))):
        name = os.path.splitext(os.path.basename(path))[0]
        with open(path, encoding="utf-8") as file:
            lines = file.read().split("\n")
        head = []
        for line in lines:
            if not line.startswith("#"):
                break
            head.append(line.lstrip("# ").rstrip())
        fields = dict(re.match(r"(\w+): +(.*)", line).groups() for line in head
                      if re.match(rf"(?:{'|'.join(FIELDS)}): ", line))
        about = []
        for line in head:
            if not line or re.match(r"\w+: ", line):
                break
            about.append(line)
        yield name, " ".join(about), fields


def page(source):
    """The page; a case without its fields is an error that names it."""
    parts = ["# Gallery\n\nEvery case runs and draws with one command. "
             "The times are those of one core, mesh included.\n"]
    for name, about, fields in cases(source):
        missing = [field for field in FIELDS if field not in fields]
        if missing:
            raise SystemExit(f"examples/{name}.yaml: its head lacks {', '.join(missing)}")
        parts.append(f"## {name}\n\n{about}\n")
        if os.path.exists(os.path.join(source, "doc", "gallery", name + ".png")):
            parts.append(f"![{about}](gallery/{name}.png)\n")
        parts.append(f"```\nexamples/run {name}\n```\n")
        parts.append(f"| | |\n|---|---|\n| takes | {fields['time']} |\n| shows | {fields['teaches']} |\n"
                     f"| driver | `{fields['driver']}` |\n| case | [{name}.yaml](../examples/{name}.yaml) |\n")
    return "\n".join(parts)
