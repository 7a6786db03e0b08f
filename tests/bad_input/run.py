#!/usr/bin/python3
"""Bad input must end a run before its first step: exit code 2 and one sentence that names the culprit.

    run.py options|mesh|vessel EVERY DRIVERS FOLDER MESHES RANKS [MPIEXEC...]

Every case is a driver, its arguments and what the sentence must hold; MPIEXEC... runs it on RANKS. EVERY: 1 for
all cases, 3 for the first of every three.
"""
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import cases  # noqa: E402


def gmsh(geometry, target, dimension, **numbers):
    settings = [word for name, value in numbers.items()
                for word in ("-setnumber", name, str(value))]
    subprocess.run(["gmsh", f"-{dimension}", geometry, *settings, "-format", "msh2", "-o", target],
                   check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)


def good_meshes(meshes, folder):
    """The small meshes that the cases use whole or damaged, as ascii gmsh 2.2."""
    made = {}
    for name, (geometry, dimension, numbers) in cases.MESHES.items():
        made[name] = os.path.join(folder, name + ".msh")
        gmsh(os.path.join(meshes, geometry + ".geo"), made[name], dimension, **numbers)
    return made


def judge(case, command, folder):
    """The sentence of a case and what is wrong with its outcome; nothing where it is as it must be."""
    result = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                            cwd=folder, errors="replace")
    said = [line for line in result.stderr.splitlines() if line.startswith("fsi: error: ")]
    wrong = []
    if result.returncode != 2:
        wrong.append(f"exit code {result.returncode}, not 2")
    if len(said) != 1:
        wrong.append(f"{len(said)} sentences, not one")
    sentence = " ".join(said)
    wrong += [f'"{fragment}" is not in the sentence'
              for fragment in case.fragments if fragment not in sentence]
    if "step " in result.stdout:
        wrong.append("a step was taken")
    if "PETSC ERROR" in result.stderr:
        wrong.append("PETSc's own report was printed")
    return sentence or result.stderr[-500:], wrong


def main():
    kind, every, ranks = sys.argv[1], int(sys.argv[2]), sys.argv[6]
    drivers, folder, meshes = (os.path.abspath(word) for word in sys.argv[3:6])
    folder = os.path.join(folder, f"{kind}-{ranks}-{every}")
    os.makedirs(folder, exist_ok=True)
    launcher = sys.argv[7:] + [ranks] if ranks != "1" else []
    made = good_meshes(meshes, folder)
    todo = []
    for case in cases.CASES[kind][::every]:
        own = os.path.join(folder, case.name.replace(" ", "-").replace("/", "-"))
        os.makedirs(own, exist_ok=True)
        driver = os.path.join(drivers, case.driver)
        todo.append((case, launcher + [driver] + case.arguments(made, own), own))
    # mpiexec sleeps for a second once a rank has ended with an error: several cases at a time
    with ThreadPoolExecutor(1 if ranks == "1" else 4) as pool:
        outcomes = list(pool.map(lambda one: judge(*one), todo))
    failures = 0
    for (case, *_), (sentence, wrong) in zip(todo, outcomes):
        failures += bool(wrong)
        print(f"{'FAIL' if wrong else 'ok  '} {case.name}: {sentence}")
        for what in wrong:
            print(f"     {what}")
    print(f"{len(todo)} cases on {ranks} ranks, {failures} not as they must be")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
