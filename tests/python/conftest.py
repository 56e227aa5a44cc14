"""Valves shared by the tests; the tests import the installed module."""

import os
import sys
from pathlib import Path

import mvs
import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "validation"))


@pytest.fixture
def sim():
    """A simulator with the shipped valve, open."""
    with mvs.Simulator() as made:
        made.generate(shape="founding")
        yield made


@pytest.fixture(scope="session")
def opened():
    """The shipped valve, open."""
    with mvs.Simulator() as made:
        made.generate(shape="founding")
        return made.snapshot()


@pytest.fixture(scope="session")
def closed():
    """The shipped valve, settled under 120 mmHg; its simulator is closed."""
    with mvs.Simulator() as made:
        made.generate(shape="founding")
        made.set_load(mvs.SYSTOLE_PA)
        assert made.settle().converged
        return made.snapshot()


@pytest.fixture(scope="session")
def real_valves():
    """The folder of real valves; skips the test if it is missing."""
    default = ROOT.parent / "shared" / "data"
    folder = Path(os.environ.get("MVS_TEST_DATA", default))
    if not folder.is_dir():
        pytest.skip(f"no real valves in {folder} (set MVS_TEST_DATA)")
    return folder
