#!/usr/bin/python3
"""examples/paper: its smallest parts on coarse meshes, then figures and claims of what there is.

    paper.py SOURCE DRIVERS FOLDER
"""
import os
import shutil
import subprocess
import sys

failures = []


def check(holds, sentence):
    print("ok  " if holds else "FAIL", sentence)
    if not holds:
        failures.append(sentence)


def main():
    source, drivers, folder = sys.argv[1:4]
    out = os.path.join(os.path.abspath(folder), "paper")
    shutil.rmtree(out, ignore_errors=True)
    here = os.path.join(source, "examples", "paper")
    sys.path.insert(0, here)
    import claims
    import study
    study.PRESETS["tiny"] = study.Preset((8, 12), (16, 24), 8, 8)
    sys.argv = ["run", os.path.abspath(drivers), "", "tiny", "flow", "disc", "figures", "claims", "-o", out,
                "-j", "2"]
    code = study.main()
    check(code == 0, f"flow, disc, figures and claims: exit code {code}")
    with open(os.path.join(out, "claims.md"), encoding="utf-8") as file:
        rows = [line.split("|")[1:-1] for line in file.read().splitlines()[2:]]
    told = {row[0].strip(): row[3].strip() for row in rows}
    check(len(rows) == len(claims.CLAIMS), f"{len(rows)} claims")
    check(told["2"] == "yes" and told["3"] != "open", f"those of figures 2 and 3 are judged: {told}")
    check(told["10A"] == "open" and told["11"] == "open", "those without runs are open")
    for number in ("02", "03"):
        path = os.path.join(out, "figures", f"fig{number}.png")
        check(os.path.exists(path) and os.path.getsize(path) > 10000, f"figure {number} is drawn")
    bad = subprocess.run([sys.executable, os.path.join(here, "study.py"), drivers, out, "huge"],
                         capture_output=True, text=True, check=False)
    check(bad.returncode == 2 and '"huge"' in bad.stderr and "coarse, medium, paper" in bad.stderr,
          f"an unknown preset is refused: {bad.stderr}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
