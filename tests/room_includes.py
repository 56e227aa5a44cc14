"""Each room names in libmvs/CMakeLists.txt exactly the rooms whose headers its files include.

The compiler finds the headers of a room that only another listed room names, so it cannot tell. Also
checks that a room names only rooms declared before it: two rooms that name each other would compile.
Prints one line for each fault; the exit code is 1 if there is one.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ROOM = re.compile(r"^\s*mvs_room\((\w+)\s+(\$\{\w+\}[^\s)]*)([^)]*)\)", re.MULTILINE)
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.MULTILINE)
FOLDERS = {"${room}": ROOT / "libmvs", "${PROJECT_SOURCE_DIR}": ROOT}
SUFFIXES = {".h", ".cpp", ".def", ".inc"}


def rooms(text: str) -> dict[str, tuple[str, list[str]]]:
    """Returns (folder, listed rooms) of each room, in the order of the CMake file."""
    return {name: (folder, listed.split()) for name, folder, listed in ROOM.findall(text)}


def included(files: dict[str, str]) -> dict[str, str]:
    """Returns the first folder of each include, with one file that has it."""
    return {path.split("/")[0]: name for name, text in files.items() for path in INCLUDE.findall(text)}


def faults_of(room: str, listed: list[str], uses: dict[str, str], before: list[str]) -> list[str]:
    """One sentence for each fault; `before` are the rooms declared before this one."""
    return ([f"{uses[other]} includes {other}, which libmvs/CMakeLists.txt does not list for {room}"
             for other in sorted(set(uses) - set(listed) - {room})]
            + [f"libmvs/CMakeLists.txt lists {other} for {room}, which no file of {room} includes"
               for other in listed if other not in uses]
            + [f"libmvs/CMakeLists.txt lists {other} for {room}, but does not declare it before {room}"
               for other in listed if other not in before])


def must_find_faults() -> None:
    declared = rooms("  mvs_room(b ${room}/b base\n    a)\nmvs_room(base ${room}/base)\n")
    assert declared == {"b": ("${room}/b", ["base", "a"]), "base": ("${room}/base", [])}, declared
    uses = included({"x.cpp": '#include <c/c.h>\n#include "a/a.h"\n  # include "b/b.h"\n// #include "d/d.h"\n'})
    assert uses == {"a": "x.cpp", "b": "x.cpp"}, uses
    assert not faults_of("b", ["a"], uses, ["a"])
    for listed, before in ([], ["a"]), (["a", "c"], ["a", "c"]), (["a"], []):
        assert len(faults_of("b", listed, uses, before)) == 1, (listed, before)


def main() -> int:
    must_find_faults()
    declared = rooms((ROOT / "libmvs/CMakeLists.txt").read_text(encoding="utf-8"))
    found, before, count = [], [], 0
    for room, (place, listed) in declared.items():
        base, _, rest = place.partition("/")
        folder = FOLDERS[base] / rest
        files = {str(path.relative_to(ROOT)): path.read_text(encoding="utf-8")
                 for path in sorted(folder.rglob("*")) if path.suffix in SUFFIXES}
        found += faults_of(room, listed, included(files), before)
        before.append(room)
        count += len(files)
    folders = {path.name for path in (ROOT / "libmvs").iterdir() if path.is_dir()} | {"formats"}
    found += [f"libmvs/CMakeLists.txt declares no room {name}" for name in sorted(folders - set(declared))]
    print(*found, sep="\n", end="\n" if found else "")
    print(f"{count} files in {len(declared)} rooms, {len(found)} faults")
    return 1 if found or count < 400 else 0


if __name__ == "__main__":
    sys.exit(main())
