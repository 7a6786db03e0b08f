#!/usr/bin/python3
"""Writes the man page of a program, from what it prints with -help.

    man.py PAGE PROGRAM VERSION EXIT_CODES [COMMAND...]

EXIT_CODES is doc/reference/exit_codes.md, whose first table tells the codes. A COMMAND is the name of one of
the program's commands with its operands, in one word: "check in.msh".
"""
import os
import re
import subprocess
import sys

OPTION = re.compile(r"^  -(\S+) +(\S.*)\n {20,}(\S.*)$", re.M)
FILES = """.TP
.B run.yaml
every option as resolved; repeats the run
.TP
.BR solid.csv ", " flow.csv
a row at every sample interval
.TP
.B summary.json
how the run ended, and its figures"""


def roff(text):
    """Text as roff takes it: no line of it is a request, and a dash is one."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.M)


def told(program, words=()):
    """What the program prints with -help, without the part of PETSc."""
    said = subprocess.run([program, *words, "-help"], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=True).stdout
    return said.split("\n-----")[0]


def purpose(text):
    """What stands behind the name in the first line."""
    return text.split("\n")[0].partition(": ")[2]


def options(text):
    """The options as tagged paragraphs."""
    parts = []
    for name, meaning, values in OPTION.findall(text):
        parts.append(f".TP\n.BI {roff('-' + name)} \" VALUE\"\n{roff(meaning)}\n.br\n{roff(values)}")
    return "\n".join(parts)


def exit_codes(path):
    with open(path, encoding="utf-8") as file:
        table = re.findall(r"^\| (\d+) \| (.*?) \|", file.read().split("\n## ")[0], re.M)
    return "\n".join(f".TP\n.B {code}\n{roff(meaning.replace('`', ''))}" for code, meaning in table)


def of_run(program, name):
    """Synopsis, description and options of a program that runs a case."""
    text = told(program)
    synopsis = f".B {name}\n[\\fICASE.yaml\\fR] [\\fB\\-OPTION\\fR \\fIVALUE\\fR ...]"
    about = ("Keys of the case file join with an underscore, and the command line wins. "
             "Solvers take PETSc's options, such as -p_ksp_monitor. "
             "The option -help lists all of this, and -version tells version and commit. "
             "Several ranks are started by mpiexec or fsi-mpiexec.")
    return purpose(text), synopsis, roff(about), options(text) + "\n.SH FILES\n" + FILES


def of_commands(program, name, commands):
    """The same of a program of several commands."""
    synopsis, about, parts = [], [], []
    for command in commands:
        words = command.split()
        text = told(program, words)
        synopsis.append(f".B {name} {words[0]}\n\\fI{roff(' '.join(words[1:]))}\\fR [\\fB\\-OPTION\\fR \\fIVALUE\\fR ...]")
        about.append(f".TP\n.B {words[0]}\n{roff(purpose(text))}")
        parts.append(f".SS Of {words[0]}\n{options(text)}")
    return "looks at meshes and converts them", "\n.br\n".join(synopsis), "\n".join(about), "\n".join(parts)


def main():
    page, program, version, codes, *commands = sys.argv[1:]
    name = os.path.basename(program)
    what, synopsis, about, listed = of_commands(program, name, commands) if commands else of_run(program, name)
    text = (f'.TH {name.upper()} 1 "" "libfsi {version}" "libfsi"\n.SH NAME\n{roff(name)} \\- {roff(what)}\n'
            f".SH SYNOPSIS\n{synopsis}\n.SH DESCRIPTION\n{about}\n.SH OPTIONS\n{listed}\n"
            f".SH EXIT STATUS\n{exit_codes(codes)}\n"
            ".SH SEE ALSO\n.BR fsi\\-mpiexec (1),\n.BR gmsh (1),\n.BR mpiexec (1)\n")
    with open(page, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
