"""No test in C++ compares with doctest::Approx but through tests/about.h.

doctest's Approx adds 1 to the factor of epsilon, so that numbers in metres would always agree.
Prints every line that uses it and exits 1.
"""

import sys
from pathlib import Path

TESTS = Path(__file__).resolve().parent
ALLOWED = TESTS / "about.h"


def uses(text: str) -> list[int]:
    """The lines that use doctest::Approx, from 1."""
    return [number for number, line in enumerate(text.splitlines(), 1) if "doctest::Approx" in line]


if __name__ == "__main__":
    assert uses("CHECK(1 == 1);\nCHECK(x == doctest::Approx(2));") == [2]
    files = sorted(path for path in TESTS.rglob("*") if path.suffix in (".cpp", ".h") and path != ALLOWED)
    if not files:
        sys.exit("no files found")
    found = [f"{path.relative_to(TESTS)}:{number}" for path in files for number in uses(path.read_text())]
    for place in found:
        print(f"{place}: doctest::Approx is not relative; use about() of tests/about.h")
    print(f"{len(files)} files")
    sys.exit(1 if found else 0)
