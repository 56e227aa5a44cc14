"""The same valve in other engines: their CPU time, and the distance of their closures from ours.

    python tests/bench/peers.py --install --engines mujoco,newton,pybullet     # once, needs PyPI
    python tests/bench/peers.py [--engines libmvs,numpy,mujoco,...] [--vertices N] [--limit S]
                                [--only WORD] [--febio BINARY] [--out DIR]

One run, one row after the other, each engine in a process and a virtual environment of its own
(OUT/ENGINE), on one thread if it has such a setting. The valve is the shipped one with its springs
(tests/bench/peers/valve.py says what the engines read). Times are CPU seconds of closing, without
set-up. Distances are node to node from our own closure at rest, from the nearest one where several
paths end in several shapes. tests/bench/PEERS.md says how each engine expresses the valve, what it
cannot, and what was tuned. Writes OUT/peers.csv.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import resource
import subprocess
import sys
import venv
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterator, Optional

HERE = Path(__file__).resolve().parent / "peers"
sys.path.insert(0, str(HERE))

import export  # noqa: E402
import mvs  # noqa: E402
import numpy as np  # noqa: E402
from goal import Goal, close, opened_valve  # noqa: E402

PACKAGES = {"mujoco": ["mujoco"], "newton": ["newton"], "pybullet": ["pybullet"]}
"""packages that pip installs for an engine; NumPy is a dependency of each"""

COLUMNS = ("engine", "case", "verdict", "steps", "setup_cpu_s", "cpu_s", "near_own_end_s",
           "node_rms_mm", "node_median_mm", "node_max_mm", "surface_rms_mm", "crossings",
           "force_median_N", "force_max_N", "speed_m_s", "law", "version", "settings")

SHOWN = COLUMNS[:15]


@dataclass(frozen=True)
class Case:
    """An engine with settings, and how much of the law it can express."""

    engine: str
    name: str
    script: str
    settings: str
    law: str


SAME = "the same; contact with the nearest point"
CASES = (
    Case("numpy", "founding method", "engine_explicit.py", "dt=8e-6 damping=500", SAME),
    Case("numpy", "dynamic relaxation", "engine_relaxation.py", "", SAME),
    Case("numpy", "L-BFGS (SciPy)", "engine_lbfgs.py", "", SAME),
    Case("mujoco", "tendons", "engine_mujoco.py", "sheet=tendons dt=5e-5 damping=500",
         "springs and chordae the same"),
    Case("mujoco", "tendons, IPC", "engine_mujoco.py",
         "sheet=tendons contact=ipc dt=5e-5 damping=500", "springs and chordae the same"),
    Case("mujoco", "flex", "engine_mujoco.py", "sheet=flex dt=5e-4 young=3e5",
         "linear membrane; chordae the same"),
    Case("mujoco", "flex, IPC", "engine_mujoco.py", "sheet=flex contact=ipc dt=1e-3 young=3e5",
         "linear membrane; chordae the same"),
    Case("newton", "VBD, springs", "engine_newton.py", "solver=vbd dt=5e-5 damping=500",
         "springs and chordae the same, switched"),
    Case("newton", "VBD, triangles", "engine_newton.py",
         "solver=vbd sheet=triangles dt=5e-5 damping=500",
         "linear membrane; chordae the same, switched"),
    Case("newton", "XPBD", "engine_newton.py", "solver=xpbd dt=5e-5 damping=500",
         "springs and chordae the same, switched; no self-contact"),
    Case("pybullet", "mass-spring", "engine_pybullet.py", "",
         "one linear stiffness for all edges; chordae and pressure from outside"),
)


def libmvs_rows(goals: dict[str, Goal]) -> Iterator[dict[str, Any]]:
    """Newton to both tolerances on springs and membrane, and the founding method on springs."""
    runs = [(law, "newton", tolerance) for law in goals for tolerance in (1e-3, 1e-5)]
    runs.append(("spring", "implicit", 1e-3))
    runs.append(("spring", "explicit", 1e-3))
    for law, solver, tolerance in runs:
        goal = goals[law]
        row = {"engine": "libmvs", "case": f"{solver}, {law}, {tolerance:g} N",
               "law": "the same" if law == "spring" else "membrane, and from its own closure",
               "version": f"libmvs {mvs.__version__}", "settings": "defaults"}
        try:
            closed, stats, seconds = close(goal.opened, goal.pressure, solver=solver,
                                           residual=tolerance)
        except mvs.DivergedError:
            yield row | {"verdict": "exploded"}
            continue
        yield row | {"verdict": "rest" if stats.converged else "limit", "steps": stats.iterations,
                     "cpu_s": seconds, "setup_cpu_s": 0.0} | goal.figures(closed)


def python_of(engine: str, out: Path) -> Path:
    """The interpreter that an engine runs in: the present one for NumPy."""
    if engine not in PACKAGES:
        return Path(sys.executable)
    return out / engine / ("Scripts" if os.name == "nt" else "bin") / "python"


def install(engine: str, out: Path) -> None:
    """Makes the environment of an engine and installs it from PyPI."""
    venv.create(out / engine, with_pip=True)
    python = python_of(engine, out)
    subprocess.run([python, "-m", "pip", "install", "-q", "numpy", *PACKAGES[engine]], check=True)


def run(case: Case, goal: Goal, valve: Path, out: Path, limit: float) -> dict[str, Any]:
    """One engine's row."""
    row = {"engine": case.engine, "case": case.name, "law": case.law}
    python = python_of(case.engine, out)
    if not python.exists():
        return row | {"verdict": "not installed"}
    trace = out / f"{case.engine}-{case.name.replace(' ', '-').replace(',', '')}.npz"
    for old in (trace, Path(f"{trace}.json")):
        old.unlink(missing_ok=True)
    command = [str(python), str(HERE / case.script), str(valve), str(trace),
               *case.settings.split(), f"limit={limit}"]
    alone = {f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "MKL")}
    told = subprocess.run(command, capture_output=True, text=True, cwd=out, env=os.environ | alone,
                          preexec_fn=lambda: resource.setrlimit(
                              resource.RLIMIT_CPU, (int(20 * limit) + 900,) * 2))
    if told.returncode or not trace.exists():
        why = (told.stderr.strip() or f"exit code {told.returncode}").splitlines()[-1]
        print(f"{case.engine}, {case.name}: {why}", file=sys.stderr)
        return row | {"verdict": "failed", "settings": why}
    return row | read_trace(trace, goal)


def read_trace(trace: Path, goal: Goal) -> dict[str, Any]:
    """The row of a trace: its last shape compared, and the time from which it stays near."""
    with np.load(trace) as data:
        cpu, shapes, speeds = data["cpu"], data["shapes"], data["speeds"]
    told = json.loads(Path(f"{trace}.json").read_text(encoding="utf-8"))
    row = {"verdict": told["verdict"], "steps": told["steps"], "setup_cpu_s": told["setup_cpu_s"],
           "cpu_s": float(cpu[-1]), "version": told["version"],
           "settings": " ".join(f"{k}={v}" for k, v in told["settings"].items())}
    if told["verdict"] == "exploded":
        return row
    off = np.linalg.norm(shapes - shapes[-1], axis=2)[:, goal.sheet]
    far = np.flatnonzero(np.sqrt((off**2).mean(axis=1)) > 0.25e-3)
    row["near_own_end_s"] = float(cpu[far[-1] + 1]) if len(far) else 0.0
    if np.isfinite(speeds[-1]):
        row["speed_m_s"] = float(speeds[-1])
    return row | goal.judge(shapes[-1])


def febio(binary: Optional[str], goal: Goal, out: Path) -> dict[str, Any]:
    """FEBio on our export of the membrane valve, compared by the nodes in its log file."""
    row = {"engine": "febio", "case": "our export", "law": "shells, from our membrane"}
    if not binary:
        return row | {"verdict": "not given"}
    case = out / "valve.feb"
    goal.opened.save(case)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    told = subprocess.run([binary, "-i", case.name, "-silent"], cwd=out, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    row |= {"verdict": "rest" if told.returncode == 0 else "failed", "cpu_s": spent}
    shape = logged_nodes(out / "closed.csv", len(goal.opened.node_rest))
    return row if shape is None else row | goal.judge(shape)


def logged_nodes(path: Path, nodes: int) -> Optional[np.ndarray]:
    """The last block of a node log of FEBio, `id,x,y,z` in mm, as positions in m."""
    if not path.exists():
        return None
    lines = [line for line in path.read_text(encoding="utf-8").splitlines()
             if line and not line.startswith("*")]
    if len(lines) < nodes:
        return None
    return np.array([[float(v) for v in line.split(",")[1:4]] for line in lines[-nodes:]]) * 1e-3


def show(row: dict[str, Any]) -> str:
    """A row for the terminal."""
    cells = []
    for name in SHOWN:
        value = row.get(name, "")
        width = 26 if name == "case" else 14
        cells.append(f"{value:{width}.3g}" if isinstance(value, float) else f"{value:>{width}}")
    return " ".join(cells)


def write(rows: list[dict[str, Any]], path: Path) -> None:
    """The table."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({k: f"{v:.4g}" if isinstance(v, float) else v for k, v in row.items()})


def measure(options: argparse.Namespace) -> list[dict[str, Any]]:
    """Yields every requested row, printed as soon as it is complete."""
    engines, rows = options.engines.split(","), []
    goals = {law: Goal(opened_valve(options.vertices, law), mvs.SYSTOLE_PA, options.paths)
             for law in ("spring", "bilinear") if law == "spring" or "libmvs" in engines}
    goal, valve = goals["spring"], options.out / "valve.npz"
    export.arrays(goal.opened, goal.pressure).save(str(valve))
    print(f"{goal.sheet.sum()} vertices; our own shapes at rest along {options.paths} paths: "
          f"{len(goal.shapes)}, apart by {goal.spread_mm():.3f} mm at most\n"
          + " ".join(f"{name:>{26 if name == 'case' else 14}}" for name in SHOWN))

    def keep(row: dict[str, Any]) -> None:
        rows.append(row)
        print(show(row), flush=True)
        write(rows, options.out / "peers.csv")

    if "libmvs" in engines:
        for row in libmvs_rows(goals):
            keep(row)
    for case in CASES:
        if case.engine in engines and options.only in case.name:
            keep(run(case, goal, valve, options.out, options.limit))
    if "febio" in engines or options.febio:
        keep(febio(options.febio, goals.get("bilinear", goal), options.out))
    return rows


def main() -> None:
    """Installs the requested engines, or measures."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--engines", default="libmvs,numpy,mujoco,newton,pybullet,febio",
                        metavar="NAMES")
    parser.add_argument("--install", action="store_true", help="install them, and measure nothing")
    parser.add_argument("--only", default="", metavar="WORD", help="cases with this in their name")
    parser.add_argument("--vertices", type=int, metavar="N")
    parser.add_argument("--paths", type=int, default=4, metavar="N",
                        help="closures of ours that count as right [4]")
    parser.add_argument("--limit", type=float, default=20.0, metavar="S",
                        help="CPU seconds after which an engine is cut off [20]")
    parser.add_argument("--febio", metavar="BINARY")
    parser.add_argument("--out", type=Path, default=Path("out/peers"), metavar="DIR")
    options = parser.parse_args()
    known = {"libmvs", "numpy", "febio", *PACKAGES}
    if unknown := set(options.engines.split(",")) - known:
        parser.error(f"no engine {', '.join(unknown)}; there are {', '.join(sorted(known))}")
    options.out = options.out.resolve()
    options.out.mkdir(parents=True, exist_ok=True)
    if options.install:
        for engine in options.engines.split(","):
            if engine in PACKAGES:
                install(engine, options.out)
        return
    measure(options)


if __name__ == "__main__":
    main()
