#!/usr/bin/env python3
"""Decides the rules of the house over a source tree: check.py ROOT prints one line per violation.

Floors: a module of libfsi includes only lower floors; siblings never include each other.
"""
import os
import re
import subprocess
import sys

FLOORS = {
    "core": 0, "geometry": 1, "shapes": 1, "mesh": 1, "field": 2, "operators": 3, "vof": 4,
    "solid": 4, "flow": 4, "analysis": 4, "io": 4, "solver": 5, "run": 6,
}
# Where PETSc may be called.
PETSC_HOMES = ("libfsi/core/", "libfsi/mesh/plex", "libfsi/mesh/halo",
               "libfsi/operators/linear_system", "libfsi/io/")
PETSC_CALL = re.compile(r"\b(?:Petsc|KSP|PC|Mat|Vec|DM|IS)(?!Call)[A-Z]\w*\s*\(")
PETSC_CASTS = ("PetscInt", "PetscReal", "PetscScalar", "PetscErrorCode", "PetscBool",
               "PetscCheck", "PetscFunctionReturn", "PetscObjectComm")
# A code is checked when it goes through one of these, is returned, compared or kept; a destructor
# may discard it, and says so by the cast.
PETSC_CHECKED = re.compile(
    r"FSI_PETSC\s*\(|PetscCall\w*\s*\(|static_cast<void>\s*\(|\breturn\b|\b(?:if|while)\s*\(\s*$"
    r"|[^=!<>]=\s*$")
MAX_LINES = {"file": 400, "function": 60, "driver": 60}
TEXT = (".cpp", ".hpp", ".py", ".txt", ".cmake", ".md", ".yaml", ".yml", ".geo", ".json", ".cff",
        ".sh", "")
MACHINE_PATH = re.compile(r"(?<![\w.~}$])/(?:work|root|home|farm|tmp)\b")
LEFT_OPEN = re.compile(r"\b(?:TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK)\b")


def blank(match):
    """Spaces in place of a comment or string, with its line breaks kept."""
    return re.sub(r"[^\n]", " ", match.group(0))


def strip_comments(text):
    keep_strings = re.compile(r'("(?:\\.|[^"\\\n])*")|(//[^\n]*|/\*.*?\*/)', re.S)
    return keep_strings.sub(lambda m: m.group(1) or blank(m), text)


def strip_code(text):
    """C++ without comments, string and character contents; line numbers are kept."""
    raw = re.compile(r'R"(\w*)\(.*?\)\1"', re.S)
    text = raw.sub(blank, text)
    text = strip_comments(text)
    return re.sub(r'"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'', blank, text)


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def module_of(path):
    """The module of libfsi a file belongs to, or None."""
    parts = path.split("/")
    return parts[1] if parts[0] == "libfsi" and len(parts) > 2 else None


def check_includes(path, text, exists):
    module = module_of(path)
    for match in re.finditer(r'^\s*#\s*include\s+"([^"]+)"', strip_comments(text), re.M):
        target, line = match.group(1), line_of(text, match.start())
        if not exists(target):
            yield line, f'include "{target}" is not a path of the repository'
            continue
        if path.startswith("drivers/") and target != "libfsi/fsi.hpp":
            yield line, f'a driver includes libfsi/fsi.hpp only, not "{target}"'
        other = module_of(target)
        if module is None or other == module:
            continue
        if other is None:
            yield line, f'{module} includes "{target}", which is above it'
        elif FLOORS.get(other, 9) >= FLOORS.get(module, 9):
            how = "a sibling of" if FLOORS.get(other) == FLOORS.get(module) else "above"
            yield line, f'{module} includes "{target}": {other} is {how} {module}'


def check_petsc(path, code, text):
    """`code` without comments and strings, `text` whole. `// NOLINT: reason` lets a call pass."""
    lines = text.split("\n")
    at_home = path.startswith(PETSC_HOMES)
    if not at_home:
        for match in re.finditer(r"^\s*#\s*include\s+<petsc\w*\.h>", code, re.M):
            yield line_of(text, match.start()), "PETSc header outside its homes"
    for match in PETSC_CALL.finditer(code):
        name = match.group(0)[:-1].strip()
        if name in PETSC_CASTS or code[:match.start()].endswith("::"):
            continue
        line = line_of(code, match.start())
        if not at_home:
            yield line, f"PETSc call {name} outside its homes"
            continue
        start = max(code.rfind(c, 0, match.start()) for c in ";{}") + 1
        if "NOLINT: " in lines[line - 1]:
            continue
        if not PETSC_CHECKED.search(code[start:match.start()]):
            yield line, f"the code of {name} is not checked: FSI_PETSC({name}(...))"


def check_functions(code):
    """Blocks at namespace or class scope that are neither: functions."""
    code = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blank, code, flags=re.M)
    stack, start, depth = [], 0, 0  # of blocks (kind, start of its head, depth), of parentheses
    for match in re.finditer(r"[;{}()]", code):
        position, char = match.start(), match.group(0)
        if char in "()":
            depth += 1 if char == "(" else -1
            continue
        if char == "{":
            head = code[start:position].strip()
            scope = re.search(r"\b(?:namespace|class|struct|union|enum|extern)\b[^()=]*$", head)
            outer = all(kind == "scope" for kind, _, _ in stack)
            kind = "inner" if depth else "scope" if scope else "function" if outer else "block"
            stack.append((kind, start, depth))
            depth = 0
        elif char == "}" and stack:
            kind, begin, depth = stack.pop()
            if kind == "function":
                yield from check_length(code, begin, position)
            if kind == "inner":
                start = begin
                continue
        start = position + 1


def check_length(code, begin, end):
    """A function whose head begins after `begin` and whose last brace is at `end`."""
    text = code[begin:end].lstrip()
    length = text.count("\n") + 1
    if length > MAX_LINES["function"]:
        name = re.search(r"([\w:~]+)\s*\(", text)
        yield line_of(code, end) - length + 1, (
            f"function {name.group(1) if name else '?'} has {length} lines, "
            f"more than {MAX_LINES['function']}")


def check_classes(code):
    bases = re.compile(r"(?<!enum )\b(?:class|struct)\s+\w+(?:\s+final)?\s*:(?!:)\s*([^{;]+)\{")
    for match in bases.finditer(code):
        if not re.search(r"std::\w*(?:error|exception)\b|\bError\b|\.\.\.", match.group(1)):
            yield line_of(code, match.start()), f"inheritance from {match.group(1).strip()}"
    for pattern, what in ((r"\bnew\b", "new"), (r"(?<!= )\bdelete\b", "delete"),
                          (r"\bvirtual\b", "virtual"), (r"\bget_\w+\s*\(", "a name with get_"),
                          (r"(?<![A-Z]_)\bneighbor", "neighbor for neighbour"),
                          (r"(?m)^\s*using\s+namespace\b(?!.*\bfsi;)", "using namespace")):
        for match in re.finditer(pattern, code):
            yield line_of(code, match.start()), f"{what} is not used here"


def check_cpp(path, text, exists):
    code = strip_code(text)
    yield from check_includes(path, text, exists)
    if path.startswith(("libfsi/", "drivers/")):
        yield from check_petsc(path, code, text)
        yield from check_functions(code)
        yield from check_classes(code)
    elif path.startswith("tests/"):
        yield from check_functions(code)
    if path.endswith(".hpp") and "#pragma once" not in text:
        yield 1, "a header without #pragma once"


def check_text(path, text):
    limit = "driver" if path.startswith("drivers/") and path.endswith(".cpp") else "file"
    count = text.count("\n")
    source = path.endswith((".cpp", ".hpp", ".py", ".cmake")) or path.endswith("CMakeLists.txt")
    if source and count > MAX_LINES[limit]:
        yield 1, f"{count} lines, more than {MAX_LINES[limit]}"
    for pattern, what in ((MACHINE_PATH, "a path of one machine"), (LEFT_OPEN, "left open")):
        for match in pattern.finditer(text):
            yield line_of(text, match.start()), f"{what}: {match.group(0)}"


def check_keys(text, references):
    """Works cited by a key (a name and two digits in brackets) are listed in doc/references.md."""
    for match in re.finditer(r"\[([A-Z][A-Za-z]+\d\d)\]", text):
        if f"| {match.group(1)} |" not in references:
            yield line_of(text, match.start()), f"{match.group(0)} is not in doc/references.md"


def check_sources(path, read, files):
    """The explicit source list of a module: sorted, and all that lies there."""
    folder = os.path.dirname(path)
    listed = re.findall(r"[\w/]+\.cpp\b", re.sub(r"#[^\n]*", "", read(path)))
    present = [f[len(folder) + 1:] for f in files
               if f.startswith(folder + "/") and f.endswith(".cpp")]
    for name in sorted(set(present) - set(listed)):
        yield 1, f"{name} is not in the list of sources"
    if listed != sorted(listed):
        yield 1, "the list of sources is not sorted"


def tree(root):
    """Files under version control; without git, all but build folders."""
    try:
        found = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard"],
                               capture_output=True, text=True, check=True).stdout.split("\n")
        return sorted(f for f in found if f and os.path.isfile(os.path.join(root, f)))
    except (OSError, subprocess.CalledProcessError):
        pass
    found = []
    for folder, names, files in os.walk(root):
        names[:] = [n for n in names
                    if not n.startswith("build") and n not in (".git", "out", "__pycache__")]
        found += [os.path.relpath(os.path.join(folder, f), root) for f in files]
    return sorted(found)


def violations(root):
    """All violations in the tree as (path, line, what)."""
    files = tree(root)
    known = set(files)

    def read(path):
        with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
            return file.read()

    references = read("doc/references.md") if "doc/references.md" in known else ""
    for path in files:
        if os.path.splitext(path)[1] not in TEXT:
            continue
        text = read(path)
        found = list(check_text(path, text)) + list(check_keys(text, references))
        if path.endswith((".cpp", ".hpp")):
            found += check_cpp(path, text, known.__contains__)
        if module_of(path) in FLOORS and path.endswith("/CMakeLists.txt"):
            found += check_sources(path, read, files)
        for line, what in sorted(found):
            yield path, line, what


def main():
    found = list(violations(sys.argv[1]))
    for path, line, what in found:
        print(f"{path}:{line}: {what}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
