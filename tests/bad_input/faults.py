"""Ways to damage a gmsh 2.2 ascii file: each takes the text and gives the damaged text."""
import math


def sections(text):
    """The file as {name: lines between $name and $Endname}, in order."""
    found, name = {}, None
    for line in text.splitlines():
        if line.startswith("$End"):
            name = None
        elif line.startswith("$"):
            name = line[1:]
            found[name] = []
        else:
            found[name].append(line)
    return found


def joined(parts):
    return "".join(f"${name}\n" + "".join(line + "\n" for line in lines) + f"$End{name}\n"
                   for name, lines in parts.items())


def empty(_):
    return ""


def garbage(_):
    return "once upon a time there was a mesh\n" * 20


def truncated(text):
    return text[:int(0.6 * len(text))]


def oldest(_):
    return "$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n0\n$ENDELM\n"


def version(number):
    def damage(text):
        return text.replace("2.2 0 8", f"{number} 0 8", 1)
    return damage


def node(row, axis, value):
    """One coordinate of a node set to a value."""
    def damage(text):
        parts = sections(text)
        words = parts["Nodes"][1 + row].split()
        words[1 + axis] = value
        parts["Nodes"][1 + row] = " ".join(words)
        return joined(parts)
    return damage


def elements(change, cells=True, dim=2):
    """The element lines of the cells (of the boundary) given to `change`, which edits the list."""
    kinds = {2: ("2", "3"), 3: ("4", "5", "6", "7")}[dim if cells else dim - 1] \
        if dim - (not cells) > 1 else ("1",)

    def damage(text):
        parts = sections(text)
        lines = [line.split() for line in parts["Elements"][1:]]
        chosen = [words for words in lines if words[1] in kinds]
        rest = [words for words in lines if words[1] not in kinds]
        chosen = change(chosen)
        parts["Elements"] = [str(len(rest) + len(chosen))] + [" ".join(w) for w in rest + chosen]
        return joined(parts)
    return damage


def corners(words):
    """Where the corners of an element line begin."""
    return 3 + int(words[2])


def unknown_node(chosen):
    chosen[0][-1] = "999999"
    return chosen


def inverted(chosen):
    """Bottom and top of a hex or prism change places."""
    first = corners(chosen[0])
    middle = (first + len(chosen[0])) // 2
    chosen[0][first:] = chosen[0][middle:] + chosen[0][first:middle]
    return chosen


def tangled(chosen):
    """Two corners of a quad swapped: its edges cross."""
    chosen[0][-1], chosen[0][-2] = chosen[0][-2], chosen[0][-1]
    return chosen


def repeated_node(chosen):
    chosen[0][-1] = chosen[0][-2]
    return chosen


def duplicate(chosen):
    return chosen + [["999999"] + chosen[0][1:]]


def non_manifold(chosen):
    """A third cell on the first edge: a triangle over to a far corner."""
    first = corners(chosen[0])
    far = next(w for w in chosen[-1][corners(chosen[-1]):] if w not in chosen[0][first:])
    return chosen + [["999999", "2"] + chosen[0][2:first] + chosen[0][first:first + 2] + [far]]


def folded(text):
    """A copy of the first cell of a 2-D mesh, with its far nodes elsewhere, on the same side of an edge."""
    parts = sections(text)
    words = next(line.split() for line in parts["Elements"][1:] if line.split()[1] == "3")
    first, nodes = corners(words), {line.split()[0]: line.split()[1:] for line in parts["Nodes"][1:]}
    a, b, c, d = words[first:]
    middle = [sum(float(nodes[n][k]) for n in (a, b, c, d)) / 4 for k in range(3)]
    for number, far in (("999998", c), ("999999", d)):
        inner = [(x + float(y)) / 2 for x, y in zip(middle, nodes[far])]
        parts["Nodes"].append(" ".join([number, *map(str, inner)]))
    parts["Nodes"][0] = str(len(parts["Nodes"]) - 1)
    parts["Elements"].append(" ".join(["999999", *words[1:first], a, b, "999998", "999999"]))
    parts["Elements"][0] = str(len(parts["Elements"]) - 1)
    return joined(parts)


def collapsed(text):
    """The second node of the first quad moved onto the first."""
    parts = sections(text)
    words = next(line.split() for line in parts["Elements"][1:] if line.split()[1] == "3")
    a, b = words[corners(words):][:2]
    place = next(line.split()[1:] for line in parts["Nodes"][1:] if line.split()[0] == a)
    parts["Nodes"][1:] = [" ".join([b, *place]) if line.split()[0] == b else line
                          for line in parts["Nodes"][1:]]
    return joined(parts)


def announced(section, count):
    """A section whose head claims that many items."""
    def damage(text):
        parts = sections(text)
        parts[section][0] = count
        return joined(parts)
    return damage


def dropped(chosen):
    return chosen[1:]


def without(name):
    """A section left out."""
    def damage(text):
        parts = sections(text)
        del parts[name]
        return joined(parts)
    return damage


def partitioned(text):
    """With the entities of a mesh that gmsh divided."""
    return text.replace("$Nodes", "$PartitionedEntities\n0\n$EndPartitionedEntities\n$Nodes", 1)


def renamed(old, new):
    def damage(text):
        return text.replace(f'"{old}"', f'"{new}"')
    return damage


def turned(degrees, about):
    """The mesh turned about the axis x (0), y (1) or z (2)."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    first, second = (about + 1) % 3, (about + 2) % 3

    def damage(text):
        parts = sections(text)
        for row, line in enumerate(parts["Nodes"][1:], 1):
            number, *x = line.split()
            x = [float(word) for word in x]
            x[first], x[second] = c * x[first] - s * x[second], s * x[first] + c * x[second]
            parts["Nodes"][row] = " ".join([number, *map(repr, x)])
        return joined(parts)
    return damage
