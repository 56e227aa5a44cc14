"""Instructions of a fixed piece of work beside those of the last commit that counted them.

    python3 tests/bench/instructions.py              counts, prints, compares
    python3 tests/bench/instructions.py --update     and writes tests/bench/instructions.csv

Seconds differ from run to run by a factor of two on a busy machine; instructions do not: the same
binary and the same input take the same path, to the bit. bench_work closes, steps, measures, saves
and loads the default valve under valgrind's callgrind, which counts each function with all that it
calls. Exit code 1: a count has grown by more than the tolerance. Another compiler or option gives
other counts, so the table names its compiler; with another compiler growth is only printed.
"""

from __future__ import annotations

import argparse
import csv
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TABLE = HERE / "instructions.csv"

# The same binary repeats to one part in 10,000 (addresses decide how hash tables and allocations
# are laid out); a change by more than 2 % has a cause in the code.
TOLERANCE = 0.02

WORK = {
    "close": "mvs_settle",
    "step": "mvs_step",
    "measure": "mvs_snapshot_measure",
    "save": "mvs_save_file",
    "load": "mvs_load_file",
    "of these: gradients": "mvs::core::TotalEnergy::gradient(",
    "of these: Hessians": "mvs::core::TotalEnergy::hessian(",
    "of these: broad phase": "mvs::core::BroadPhase::build(",
    "of these: narrow phase": "mvs::core::ContactTerm::collect(",
    "of these: chordae": "mvs::core::CableTerm::",
    "of these: membrane": "mvs::core::MembraneTerm::",
}
"""A counted piece of work, and the function (or the start of the functions) that does it."""


def counts(valgrind: str, program: Path) -> dict[str, int]:
    """Instructions of each piece of the work."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "callgrind.out"
        subprocess.run([valgrind, "--tool=callgrind", f"--callgrind-out-file={out}", program,
                        Path(folder) / "valve.obj"], check=True, stderr=subprocess.DEVNULL)
        told = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", out],
                              check=True, capture_output=True, text=True).stdout
    found = dict.fromkeys(WORK, 0)
    for line in told.splitlines():
        entry = re.match(r"\s*([\d,]+) \(.*?\)\s+\S*?:(\S.*?)(?: \[[^\]]*\])?$", line)
        for name, function in WORK.items() if entry else ():
            if re.match(re.escape(function) + ("" if function.endswith(("(", ":")) else r"$"),
                        entry.group(2)):
                found[name] += int(entry.group(1).replace(",", ""))
    return found


def compiler(build: Path) -> str:
    """The compiler of a build tree and its version."""
    cache = (build / "CMakeCache.txt").read_text()
    path = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.M).group(1)
    version = subprocess.run([path, "--version"], check=True, capture_output=True, text=True)
    return version.stdout.splitlines()[0].replace(",", ";")


def read_table() -> dict[str, dict[str, str]]:
    """Returns the checked-in counts."""
    if not TABLE.exists():
        return {}
    with TABLE.open(newline="") as file:
        return {row["work"]: row for row in csv.DictReader(file)}


def write_table(found: dict[str, int], made_by: str) -> None:
    """Writes the counts to check in."""
    with TABLE.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("work", "instructions", "compiler"))
        writer.writerows((name, count, made_by) for name, count in found.items())


def compare(found: dict[str, int], made_by: str) -> list[str]:
    """Prints the table and returns the names of the counts that have grown."""
    before, grown = read_table(), []
    print(f"{'work':<24} {'instructions':>15} {'before':>15} {'ratio':>8}")
    for name, count in found.items():
        old = int(before[name]["instructions"]) if name in before else 0
        ratio = count / old if old else float("nan")
        print(f"{name:<24} {count:15,} {old:15,} {ratio:8.4f}")
        if old and ratio > 1 + TOLERANCE:
            grown.append(name)
    others = {row["compiler"] for row in before.values()} - {made_by}
    if others:
        print(f"counted before with {', '.join(others)}, now with {made_by}: not comparable")
        return []
    return grown


def main() -> int:
    """Counts and compares."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release", metavar="DIR")
    parser.add_argument("--update", action="store_true", help="write the counts to the table")
    arguments = parser.parse_args()
    valgrind = shutil.which("valgrind")
    if valgrind is None:
        print("valgrind is not installed (apt-get install valgrind): nothing is counted")
        return 0
    program = arguments.build / "bin" / "bench_work"
    if not program.exists():
        sys.exit(f"{program} is not built: cmake --build --preset release --target bench_work")
    made_by = compiler(arguments.build)
    found = counts(valgrind, program)
    grown = compare(found, made_by)
    if arguments.update:
        write_table(found, made_by)
        return 0
    if grown:
        print(f"grown by more than {TOLERANCE:.0%}: {', '.join(grown)}")
    return 1 if grown else 0


if __name__ == "__main__":
    sys.exit(main())
