"""The command ``mvs`` of a wheel: replaces the running process with the program mvs/bin/mvs.

It is a module beside the package, because importing the package loads NumPy, which takes longer than
closing a valve.
"""

import os
import signal
import sys
from pathlib import Path


def main() -> None:
    """Does not return: input, output, signals and exit code are those of the program."""
    program = Path(__file__).parent / "mvs" / "bin" / "mvs"
    # Python ignores this signal, and the program would inherit that: `mvs chords ... | head`
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    try:
        os.execv(program, ["mvs", *sys.argv[1:]])
    except OSError as error:
        sys.exit(f"mvs: {program} does not start ({error.strerror}): install libmvs again")
