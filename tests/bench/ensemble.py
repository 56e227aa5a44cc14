"""The table of libmvs/ensemble/README.md: distances between the closures of some valves.

Usage: MVS_COMMAND=build/release/bin/mvs python3 tests/bench/ensemble.py [MEMBERS]    [8]
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

MVS = os.environ["MVS_COMMAND"]

LEAKING = ["--annulus-scale", "1.15", "--chord-factor", "A2/7=1.25"]
REDUNDANT = ["--anterior-height", "28", "--posterior-height", "18", "--commissure-height", "10"]
VALVES = {
    "shipped": [],
    "leaking: annulus 15 % dilated, chord A2/7 25 % longer": LEAKING,
    "leaflets half as thick, 0.5 mm": ["--thickness", "0.5"],
    "leaking, 0.5 mm": [*LEAKING, "--thickness", "0.5"],
    "redundant leaflets, 28 and 18 mm high": REDUNDANT,
    "redundant, 0.5 mm": [*REDUNDANT, "--thickness", "0.5"],
    "shipped, 1,700 vertices": ["--vertices", "1700"],
    "leaking, 1,700": [*LEAKING, "--vertices", "1700"],
    "redundant, 0.5 mm, 1,700": [*REDUNDANT, "--thickness", "0.5", "--vertices", "1700"],
}
FIGURES = ("regurgitant_orifice_area_mm2", "coaptation_area_mm2", "coaptation_height_mm",
           "max_chord_tension_N", "max_leaflet_stress_kPa")


def run(*arguments, cwd):
    done = subprocess.run([MVS, *map(str, arguments), "--json"], cwd=cwd, capture_output=True,
                          text=True, check=True)
    return json.loads(done.stdout)


def figure(found, key):
    """Value of the plain closure (minimum to maximum over the members)."""
    value, over = found["measures"][key], found["ensemble"]["measures"][key]
    if value is None:
        return "none"
    digits = 0 if value >= 100 else 2
    return f"{value:.{digits}f} ({over['min']:.{digits}f} to {over['max']:.{digits}f})"


def row(title, found):
    ensemble = found["ensemble"]
    energies = {}
    for closure in ensemble["closures"]:
        if closure["converged"]:
            energies.setdefault(closure["equilibrium"], closure["energy_J"] * 1e3)
    seconds = sum(closure["wall_s"] for closure in ensemble["closures"])
    cells = [title, f"{ensemble['converged']} of {ensemble['members']}", ensemble["equilibria"],
             ", ".join(f"{e:.3f}" for e in energies.values()),
             f"{ensemble['node_rms_mm']:.3f} / {ensemble['node_max_mm']:.2f}",
             f"{ensemble['surface_rms_mm']:.3f} / {ensemble['surface_max_mm']:.2f}",
             *(figure(found, key) for key in FIGURES), f"{seconds:.1f}"]
    return "| " + " | ".join(map(str, cells)) + " |"


def main():
    members = sys.argv[1] if len(sys.argv) > 1 else "8"
    heads = ["valve", "members at rest", "equilibria", "their energies, mJ",
             "between members, node RMS / max, mm", "from member 0, surface RMS / max, mm",
             "orifice, mm2", "coaptation area, mm2", "coaptation height, mm", "chord tension, N",
             "leaflet stress, kPa", "s"]
    print("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads))
    with tempfile.TemporaryDirectory() as folder:
        for title, options in VALVES.items():
            run("generate", "--shape", "founding", "-o", "valve.obj", *options, cwd=folder)
            print(row(title, run("close", "valve.obj", "--members", members, cwd=folder)), flush=True)


if __name__ == "__main__":
    MVS = str(pathlib.Path(MVS).resolve())
    main()
