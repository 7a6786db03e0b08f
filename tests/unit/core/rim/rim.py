"""How a program ends, seen from outside: exit code, and one sentence or none.

    rim.py PROGRAM FOLDER RANKS [MPIEXEC...]
"""
import os
import subprocess
import sys

YAML = {
    "good.yaml": "value: 7\n",
    "nested.yml": "# a comment\nvalue:\n  # another\n  colour: 1\n",
    "twice.yaml": "mode: complete\nvalue: 1\nvalue: 2\n",
    "at_12:30.yaml": "value: 1\nvalue: 2\n",
    "joined.yaml": "a:\n  b: 1\na_b: 2\n",
    "braces.yaml": "{value: 1, value: 2}\n",
    "braces_good.yaml": "{value: 7, mode: complete}\n",
    "broken.yaml": "value: [1, 2\n mode: }",
    "empty.yaml": "",
    "words": "# a comment\n-value 7\n",
    "bad_words": "value 7\n",
}
# Arguments, exit code, what the sentence (or, with code 0, the output) must hold.
CASES = [
    ("", 0, "value 1"),
    ("-value 3", 0, "value 3"),
    ("good.yaml", 0, "value 7"),
    ("good.yaml -value 3", 0, "value 3"),
    ("-help", 0, "value > 0; default 1"),
    ("good.yaml -help", 0, "value > 0; default 1"),
    ("-mode interrupted", 5, ""),
    ("-mode again -value 3", 0, "value 9"),
    ("-mode again -restart_again true", 2, "-restart_again is set by the program itself"),
    ("-mode signal", 5, ""),
    ("-mode input", 2, "all ranks alike"),
    ("-mode numerics", 3, "all ranks alike"),
    ("-mode io", 4, "all ranks alike"),
    ("-mode internal", 70, "all ranks alike"),
    ("-mode memory", 70, "out of memory"),
    ("-mode alone-input", 2, "one rank alone"),
    ("-mode alone-numerics", 3, "one rank alone"),
    ("-mode alone-io", 4, "one rank alone"),
    ("-mode petsc", 2, "nonsense"),
    ("-mode petsc-call", 70, "PetscOptionsSetValue"),
    ("-value -1", 2, '-value: "-1"'),
    ("-value 1 -value 2", 2, "-value is given twice"),
    ("-value 1 2", 2, '"2" belongs to no option'),
    ("2", 2, '"2" belongs to no option'),
    ("-valeu 1", 2, "nearest is -value"),
    ("nowhere.yaml", 2, '"nowhere.yaml" cannot be opened'),
    ("broken.yaml", 2, "not valid YAML"),
    ("twice.yaml", 2, "gives value twice"),
    ("joined.yaml", 2, "gives a_b twice"),
    ("braces.yaml", 2, "gives value twice"),
    ("braces_good.yaml", 0, "value 7"),
    ("-version", 0, ", commit "),
    ("good.yaml -mode input -version", 0, "rim "),
    ("nested.yml", 2, "-value_colour"),
    ("empty.yaml", 2, "is empty"),
    ("-options_file_yaml nowhere.yaml", 2, '"nowhere.yaml" cannot be opened'),
    ("-options_file_yaml twice.yaml", 2, '"twice.yaml" gives value twice'),
    ("-options_file words", 0, "value 7"),
    ("-options_file good.yaml", 0, "value 7"),
    ("good.yaml -options_file words", 0, "value 7"),
    ("good.yaml -options_file nowhere", 2, '"nowhere" cannot be opened'),
    ("good.yaml -options_file twice.yaml", 2, '"twice.yaml" gives value twice'),
    ("at_12:30.yaml", 2, "gives value twice"),
    ("-options_file twice.yaml:yaml", 2, '"twice.yaml" gives value twice'),
    ("-options_file good.yaml:yaml", 0, "value 7"),
    ("-options_file nowhere", 2, '"nowhere" cannot be opened'),
    ("-options_file bad_words", 2, '"bad_words"'),
    ("good.yaml -options_file", 2, "-options_file needs the name of a file"),
    ("-value 1 -Value 2", 2, "-Value is given twice on the command line, first as -value"),
    ("-value 1 --value 2", 2, "--value is given twice"),
    ("-Value 3", 0, "value 3"),
]


def faults(result, code, fragment):
    said = [line for line in result.stderr.splitlines() if line.startswith("fsi: error: ")]
    if result.returncode != code:
        yield f"exit code {result.returncode}, not {code}"
    if len(said) != (1 if code not in (0, 5) else 0):
        yield f"{len(said)} sentences"
    if fragment not in (" ".join(said) if code else result.stdout):
        yield f'"{fragment}" is not there'
    if "PETSC ERROR" in result.stderr:
        yield "PETSc's own report was printed"


def main():
    program, folder, ranks = os.path.abspath(sys.argv[1]), sys.argv[2], sys.argv[3]
    folder = os.path.join(folder, ranks)
    os.makedirs(folder, exist_ok=True)
    for name, text in YAML.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    # One rank runs without mpiexec, which would hide that code.
    launcher = sys.argv[4:] + [ranks] if ranks != "1" else []
    failures = 0
    # On several ranks each start takes a second or two: every way to end, and every third of the rest.
    cases = [case for i, case in enumerate(CASES) if ranks == "1" or "-mode" in case[0] or i % 3 == 0]
    for arguments, code, fragment in cases:
        result = subprocess.run(launcher + [program] + arguments.split(), cwd=folder, text=True,
                                stdin=subprocess.DEVNULL, capture_output=True)
        for fault in faults(result, code, fragment):
            failures += 1
            print(f"{arguments}: {fault}\n{result.stdout}{result.stderr}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
