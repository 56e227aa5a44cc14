"""READMEs name files that exist, and the README of a room names every file of the room.

A name is a word in backquotes or the target of a link that ends like a source or data file or with
"/". It is a path from the README's folder, the root, libmvs/ or include/, the end of a path below the
README's folder, or the end of one path only. Prints one line for each fault; the exit code is 1 if
there is one.
"""

import re
import sys
from pathlib import Path, PurePosixPath

from folder_sizes import ROOT, files

DOCUMENTS = {"README.md", "FORMAT.md", "CONTRIBUTING.md"}
ENDING = r"(?:/|\.(?:h|cpp|c|py|md|ts|mjs|csv|json))"
# A name that begins with a dot is an ending, one beside * or <> a pattern.
NAME = re.compile(rf"(?<![\w./*<>{{}}~$:@-])(?:\.\.?/)*\w[\w./-]*?{ENDING}(?![\w./*<>{{}}-])")
LINK = re.compile(r"\]\((?![a-z]+:)([^)\s#]+)[^)\s]*\)")
# Capitals that stand for any name: `ops/NAME.cpp`.
ANY_NAME = re.compile(r"(?:^|/)(?:NAME|DIR|VALVE|N)(?=[./]|$)")

NOT_HERE = {
    # the recipes of CONTRIBUTING.md add these files
    "CONTRIBUTING.md": {
        "libmvs/energy/link.h", "link.cpp", "libmvs/surgery/ops/chord_stiffen.cpp",
        "tests/surgery/chord_stiffen.cpp", "libmvs/measure/annulus/height_ratio.h", "formats/stl/stl.cpp",
        "tests/formats/test_stl.cpp"},
    "haptic_drivers/README.md": {"mine.c"},  # the reader's own driver
    "haptic_drivers/hand/README.md": {"CPhantomDevices.cpp", "CDeltaDevices.cpp"},  # of CHAI3D
    "bindings/js/README.md": {"dist/index.mjs", "dist/browser.mjs", "dist/types/"},  # of the npm package
    # written by commands and programs
    "bindings/python/mvs/imaging/README.md": {"repair.json"},
    "bindings/python/mvs/imaging/phantom/README.md": {
        "open_annulus.mrk.json", "phantom.json", "truth/", "truth.json"},
    "examples/README.md": {"phantom.json"},
    "examples/planner/README.md": {"plan.json", "session.json"},
    "tests/verification/README.md": {"studies.csv"},
}

# Files that the README of their room does not name, with the reason.
UNNAMED: dict[str, set[str]] = {}


class Tree:
    """The files of the repository and their folders, whose names end with "/"."""

    def __init__(self, paths: list[str]):
        folders = {parent.as_posix() + "/" for path in paths for parent in PurePosixPath(path).parents}
        self.paths = {*paths, *folders}
        self.by_last: dict[str, list[str]] = {}
        for path in self.paths:
            self.by_last.setdefault(PurePosixPath(path).name, []).append(path)

    def has(self, name: str, folder: str) -> bool:
        """Whether a README in `folder` ("" for the root, else with "/") may use this name."""
        for start in (folder, "", "libmvs/", "include/"):
            path = plain(start + name)
            if path in self.paths or path + "/" in self.paths:
                return True
        ends = [path for path in self.by_last.get(PurePosixPath(name).name, [])
                if path.endswith("/" + name)]
        return len(ends) == 1 or any(path.startswith(folder) for path in ends if folder)


def plain(path: str) -> str:
    """A path without "." and ".."; the same if it leads out of the repository."""
    parts: list[str] = []
    for part in path.rstrip("/").split("/"):
        if part == ".." and parts:
            parts.pop()
        elif part != ".":
            parts.append(part)
    return "/".join(parts) + ("/" if path.endswith("/") else "")


def code_of(text: str) -> list[str]:
    return re.findall(r"`([^`\n]+)`", text)


def names_in(text: str) -> list[str]:
    """The names of files and folders of a README."""
    return [name for code in code_of(text) for name in NAME.findall(code)] + LINK.findall(text)


def missing(document: str, text: str, tree: Tree) -> list[str]:
    """The names in a README that no file has."""
    folder = document[: document.rfind("/") + 1]
    return [name for name in names_in(text) if not tree.has(name, folder) and not ANY_NAME.search(name)
            and name not in NOT_HERE.get(document, set())]


def unnamed(room: str, text: str, paths: list[str]) -> list[str]:
    """The C++ files of a room whose names, without their endings, are not in code in its README."""
    words = {word for code in code_of(text) for word in re.findall(r"\w+", code)}
    return sorted({path.rsplit(".", 1)[0] for path in paths
                   if path.startswith(room + "/") and path.endswith((".h", ".cpp", ".def"))
                   and PurePosixPath(path).stem not in words | UNNAMED.get(room, set())})


def must_find_faults() -> None:
    paths = ["a/README.md", "a/b/x.cpp", "a/b/y.h", "c/z.h", "d/z.h", "libmvs/e/f.h"]
    tree = Tree(paths)
    good = ("`b/x.cpp` `x.cpp`, `y.h` [c](../c/z.h#top) `e/f.h` `b/` `f.h` `NAME.cpp` `.h` `b/*.cpp` "
            "[w](https://w/q.h)")
    assert not (wrong := missing("a/README.md", good, tree)), wrong
    bad = missing("a/README.md", "`b/z.h`, `z.h` `g/` [w](w.md) `run x.py --all`", tree)
    assert bad == ["b/z.h", "z.h", "g/", "x.py", "w.md"], bad
    assert unnamed("a", "x `y.h`, `.cpp`", paths) == ["a/b/x"]


def main() -> int:
    must_find_faults()
    paths = [path.as_posix() for path in files()]
    tree, found, count = Tree(paths), [], 0
    texts = {path: (ROOT / path).read_text(encoding="utf-8") for path in paths
             if PurePosixPath(path).name in DOCUMENTS}
    for document, text in texts.items():
        count += len(names_in(text))
        found += [f"{document} names {name}, which does not exist" for name in missing(document, text, tree)]
        room = document[: document.rfind("/")] if "/" in document else ""
        if document.endswith("/README.md") and (room == "formats" or room.startswith("libmvs/")):
            found += [f"{document} does not name {path}" for path in unnamed(room, text, paths)]
        unused = NOT_HERE.get(document, set()) - set(names_in(text))
        found += [f"readme_names.py excepts {name} in {document}, which does not name it"
                  for name in sorted(unused)]
    print(*found, sep="\n", end="\n" if found else "")
    print(f"{count} names in {len(texts)} documents, {len(found)} faults")
    return 1 if found or count < 1000 else 0


if __name__ == "__main__":
    sys.exit(main())
