"""Checks tests/README.md against tests/: every test file is listed, every listed file exists.

Also checks the naming scheme (no C or C++ file is called test_*) and that every case that main.cpp
leaves out of short runs exists. Prints one line for each fault; the exit code is 1 if there is one.
"""

import re
import sys
from pathlib import Path

TESTS = Path(__file__).resolve().parent
SUFFIXES = {".c", ".cpp", ".inc", ".py", ".sh", ".cmake"}


def files() -> set[Path]:
    """Every program or script in tests/; headers, data and CMakeLists.txt are no tests."""
    return {path for path in TESTS.rglob("*") if path.is_file() and path.suffix in SUFFIXES}


def patterns() -> list[str]:
    """The backquoted paths of the second column, below the heading "Features"."""
    text = (TESTS / "README.md").read_text(encoding="utf-8").split("## Features", 1)[1]
    rows = [line.split("|") for line in text.splitlines() if line.startswith("|")]
    return [name for row in rows for name in re.findall(r"`([^`]+)`", row[2])]


def matches(pattern: str) -> set[Path]:
    """The files of a pattern; FOLDER/* also covers the folders below."""
    if pattern.endswith("/*"):
        pattern = pattern[:-1] + "**/*"
    return {path for path in TESTS.glob(pattern) if path.is_file()}


def cases_left_out() -> list[str]:
    """The names of the filter in main.cpp, which are separated by commas."""
    text = (TESTS / "main.cpp").read_text(encoding="utf-8")
    names = re.search(r"\*repeated =(.*?);", text, re.DOTALL)
    literals = re.findall(r'"([^"]*)"', names.group(1)) if names else []
    return [name for name in "".join(literals).split(",") if name]


def faults() -> list[str]:
    """One sentence for each fault."""
    found, listed = [], set()
    for pattern in patterns():
        if not matches(pattern):
            found.append(f"tests/README.md names {pattern}, which does not exist")
        listed |= matches(pattern)
    every = files()
    found += [f"{path.relative_to(TESTS)} is not listed in tests/README.md"
              for path in sorted(every - listed)]
    found += [f"{path.relative_to(TESTS)}: C and C++ tests are called <subject>, not test_<subject>"
              for path in sorted(every)
              if path.suffix in {".c", ".cpp"} and path.name.startswith("test_")]
    sources = "".join(path.read_text(encoding="utf-8") for path in every
                      if path.suffix == ".cpp" and path.name != "main.cpp")
    found += [f"main.cpp leaves out the case {name}, which does not exist"
              for name in cases_left_out() if f'"{name}"' not in sources]
    return found


if __name__ == "__main__":
    problems = faults()
    print("\n".join(problems) or "tests/README.md lists every test")
    sys.exit(1 if problems else 0)
