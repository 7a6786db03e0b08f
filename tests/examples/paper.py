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


def check_halves(study, drivers, out):
    """The rings of all tilts for a short time: half of them, on a mesh that goes along, drawn as whole ones."""
    import measures
    shutil.rmtree(out, ignore_errors=True)
    study.PRESETS["halves"] = preset = study.Preset((8,), (16,), 12, 12, fine=1.6, guide=8)
    study.PIPE, every = ("tilt",), study.sweeps

    def short(of):
        for sweep in every(of):
            sweep.options += ("-time_end", "0.3", "-output_interval", "0.1")
            yield sweep
    study.sweeps = short
    sys.argv = ["run", drivers, "", "halves", "pipe", "figures", "-o", out, "-j", "2"]
    code = study.main()
    check(code == 0, f"half of the rings: exit code {code}")
    run = measures.Runs(preset, out).tilt(45)
    solid, snapshot = run.tables["solid"], run.snapshot(-1)
    low, high = snapshot.mesh.low[2], snapshot.mesh.high[2]
    check(abs(low) < 1e-9 and abs(high - 1) < 1e-9, f"both sides of the pipe, z = {low:g} to {high:g}")
    whole = 2 * 3.14159**2 * 0.3 * 0.1**2
    check(abs(solid["volume"][-1] / whole - 1) < 0.02 and
          abs(snapshot.volume_of_solid() / whole - 1) < 0.02, "the volume of a whole ring")
    check(abs(solid["ux"][0] - 0.5) < 1e-6 and abs(solid["x"][-1] - 1) < 0.05 and
          float(run.options["flow_frame_velocity"]) > 0.4, "the mesh goes along; velocities are those in the pipe")
    other = measures.Runs(study.Preset((8,), (16,), 16, 12), out)
    try:
        other.tilt(45)
        check(False, "runs of another mesh count as not there")
    except measures.Missing:
        check(True, "runs of another mesh count as not there")
    for number in ("04", "05", "06", "07", "09"):
        path = os.path.join(out, "figures", f"fig{number}.png")
        check(os.path.exists(path) and os.path.getsize(path) > 10000, f"figure {number} is drawn")


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
    check_halves(study, os.path.abspath(drivers), out + "_halves")
    bad = subprocess.run([sys.executable, os.path.join(here, "study.py"), drivers, out, "huge"],
                         capture_output=True, text=True, check=False)
    check(bad.returncode == 2 and '"huge"' in bad.stderr and "coarse, medium, paper" in bad.stderr,
          f"an unknown preset is refused: {bad.stderr}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
