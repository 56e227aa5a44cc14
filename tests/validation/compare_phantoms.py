"""Leak intervals of recovered phantoms under two versions of the library, side by side.

    python tests/validation/phantoms.py --seed N --save before/N.json    # with each version
    python tests/validation/compare_phantoms.py before now

A file of rows or a folder of such files for each version. Cases that both recovered are compared: how many
true leaks lie inside, and the median width. The exit code is 1 if fewer lie inside now.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from phantom_rows import Row, coverage, is_inside


def read_rows(path: Path) -> list[Row]:
    """The rows of a file, or of all files of a folder."""
    files = sorted(path.glob("*.json")) if path.is_dir() else [path]
    return [Row(**row) for file in files for row in json.loads(file.read_text())]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("before", type=Path, help="rows of phantoms.py --save, or a folder of them")
    parser.add_argument("now", type=Path, help="the same, of the other version")
    chosen = parser.parse_args()
    named = {row.name: row for row in read_rows(chosen.before) if not row.refused}
    pairs = [(named[row.name], row) for row in read_rows(chosen.now)
             if not row.refused and row.name in named]
    print("| seed, case | true leak, mm2 | interval before | interval now |\n|---|---|---|---|")
    for before, now in pairs:
        print(f"| {now.name} | {now.leak:.1f} | {before.low:.1f} to {before.high:.1f} "
              f"| {now.low:.1f} to {now.high:.1f} |")
    befores, nows = [b for b, _ in pairs], [n for _, n in pairs]
    print(f"\nbefore: {coverage(befores)}\nnow: {coverage(nows)}")
    return 1 if sum(map(is_inside, nows)) < sum(map(is_inside, befores)) else 0


if __name__ == "__main__":
    sys.exit(main())
