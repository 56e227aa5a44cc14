"""The stubs match the module."""

import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import mvs
import pytest

LONG = pytest.mark.skipif(not os.environ.get("MVS_TEST_LONG"), reason="MVS_TEST_LONG is not set")


def test_stubs_match_the_module(tmp_path):
    # set_valve, check_valve and __exit__ take *args at run time, and the stubs name them; classes
    # of an extension have another metaclass, and only a Simulator creates a Snapshot
    allowed = tmp_path / "allowed.txt"
    allowed.write_text(
        "\n".join(
            [
                r"mvs\._core\.check_valve",
                r"mvs\._core\.Simulator\.set_valve",
                r"mvs\._core\.(Device|Simulator)\.__exit__",
                r"mvs\._core\.(Device|Ensemble|Simulator|Snapshot|SurfaceFile)",
                r"mvs\._core\.(Ensemble|Snapshot)\.__init__",
                "",
            ]
        )
    )
    found = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "--allowlist", str(allowed), "--concise",
         "--ignore-unused-allowlist", "mvs._core", "mvs.arrays", "mvs.editing", "mvs.errors",
         "mvs.haptics", "mvs.kinds", "mvs.measures", "mvs.outcomes", "mvs.plans", "mvs.values"],
        capture_output=True,
        text=True,
    )
    assert found.returncode == 0, found.stdout + found.stderr


def test_the_arrays_of_a_copied_valve_are_not_optional(tmp_path):
    program = tmp_path / "program.py"
    program.write_text(
        "import mvs\n\n\ndef edit(closed: mvs.Snapshot) -> mvs.Valve:\n"
        "    valve = mvs.valve_of(closed)\n    valve.chord_rest_length[3] *= 1.25\n"
        "    valve.nodes_now = None\n    return valve\n"
    )
    found = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--follow-imports=silent", str(program)],
        capture_output=True, text=True, cwd=tmp_path,
        env={**os.environ, "MYPYPATH": str(Path(mvs.__file__).parents[1])},
    )
    assert found.returncode == 0, found.stdout + found.stderr


@LONG  # 20 s without a cache, 45 s beside other work
def test_the_package_has_no_error_of_type():
    from conftest import ROOT

    for package in ("matplotlib", "pyvista", "SimpleITK"):
        if importlib.util.find_spec(package) is None:
            pytest.skip(f"{package} is absent: mypy would not know its types")
    found = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--config-file", str(ROOT / "pyproject.toml"),
         "--cache-dir", os.devnull, "mvs"],
        capture_output=True, text=True, cwd=ROOT / "bindings" / "python",
    )
    assert found.returncode == 0, found.stdout + found.stderr


def test_the_version_is_that_of_the_header():
    from conftest import ROOT

    header = (ROOT / "include" / "mvs" / "base.h").read_text()
    numbers = [
        re.search(rf"MVS_VERSION_{name} (\d+)", header).group(1)
        for name in ("MAJOR", "MINOR", "PATCH")
    ]
    assert mvs.__version__ == ".".join(numbers)
    assert "eigen" in mvs.features


def test_everything_public_is_documented():
    for name in mvs.__all__:
        thing = getattr(mvs, name)
        if callable(thing):
            assert thing.__doc__, name
    for kind in (mvs.Device, mvs.Snapshot, mvs.Simulator, mvs.Ensemble):
        for name, member in vars(kind).items():
            if not name.startswith("_"):
                assert member.__doc__, f"{kind.__name__}.{name}"
