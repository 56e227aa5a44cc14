"""Uses an installed wheel: use.py START, in an empty folder, with nothing installed but the wheel.

Closes the shipped valve from Python and from the command, and passes .h5 files between them; START is
the time when the installation began. The exit code is 1 if something fails.
"""

import json
import os
import signal
import subprocess
import sys
import sysconfig
import time
from pathlib import Path

import mvs


def close_a_valve() -> mvs.Snapshot:
    """The shipped parametric valve under systolic pressure."""
    with mvs.Simulator() as sim:
        sim.generate()
        sim.set_load(mvs.SYSTOLE_PA)
        assert sim.settle().converged
        return sim.snapshot()


COMMAND = Path(sysconfig.get_path("scripts")) / "mvs"
"""The command that pip has put beside this Python."""


def run(*arguments: str) -> str:
    """The output of the command."""
    done = subprocess.run([COMMAND, *arguments], capture_output=True, text=True)
    assert done.returncode == 0, f"mvs {' '.join(arguments)} ends with {done.returncode}: {done.stderr}"
    return done.stdout


def load(path: str) -> mvs.Snapshot:
    with mvs.Simulator() as sim:
        sim.load(path)
        return sim.snapshot()


def files_keep_every_bit(closed: mvs.Snapshot) -> None:
    """Those of the module in the module and in the command, those of the command in the module."""
    closed.save("module.h5")
    assert load("module.h5").hash == closed.hash
    assert json.loads(run("info", "module.h5", "--json"))["hash"] == closed.hash
    run("generate", "-o", "valve.obj")
    told = json.loads(run("close", "valve.obj", "-o", "command.h5", "--json"))
    assert load("command.h5").hash == told["hash"]


def drivers_are_found() -> None:
    found = {driver.name for driver in mvs.haptics.drivers()}
    assert {"hand", "phantom", "replay", "template"} <= found, found
    assert mvs.haptics.list("template"), "the driver template finds no device"
    listed = run("haptics", "list")
    assert all(name in listed for name in found), listed


def command_is_a_program() -> None:
    """Exit codes are the program's, and a closed pipe ends it, which Python by itself ignores."""
    assert subprocess.run([COMMAND, "close"], capture_output=True).returncode == 2
    reader, writer = os.pipe()
    os.close(reader)
    assert subprocess.run([COMMAND, "--help"], stdout=writer).returncode == -signal.SIGPIPE
    os.close(writer)


def gpl_backend_is_absent() -> None:
    assert "cholmod" not in run("--version").lower()
    try:
        mvs.Simulator(backend="cholmod")
    except mvs.Error:
        return
    raise AssertionError("the wheel has the backend CHOLMOD, which is GPL")


if __name__ == "__main__":
    snapshot = close_a_valve()
    print(f"{time.time() - float(sys.argv[1]):.1f} s from the beginning of pip install to the closed valve")
    files_keep_every_bit(snapshot)
    drivers_are_found()
    command_is_a_program()
    gpl_backend_is_absent()
    print("libmvs", mvs.__version__, "closes valves, saves and loads .h5, and finds", len(mvs.haptics.drivers()), "drivers")
