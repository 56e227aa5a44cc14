"""No folder of the repository holds more than 40 files: a reader finds a file by reading the list.

Files in folders below it do not count, nor do those that git ignores. Prints every folder above the
limit and exits 1.
"""

import subprocess
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LIMIT = 40


def files() -> list[Path]:
    """Every file that git knows; in an unpacked archive, which has no git, every file."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True)
    if listed.returncode == 0 and listed.stdout:
        return [Path(name) for name in listed.stdout.split("\0") if name]
    return [path.relative_to(ROOT) for path in ROOT.rglob("*") if path.is_file()]


def above_limit(paths: list[Path], limit: int) -> list[tuple[Path, int]]:
    """Returns (folder, files in it) of every folder above the limit."""
    return [(folder, count) for folder, count in Counter(path.parent for path in paths).items() if count > limit]


if __name__ == "__main__":
    assert above_limit([Path("a/b"), Path("a/c"), Path("a/d/e")], 1) == [(Path("a"), 2)]
    every = files()
    if not every:
        sys.exit("no files found")
    large = above_limit(every, LIMIT)
    for folder, count in sorted(large):
        print(f"{folder}: {count} files, {LIMIT} allowed")
    print(f"{len(every)} files in {len({path.parent for path in every})} folders")
    sys.exit(1 if large else 0)
