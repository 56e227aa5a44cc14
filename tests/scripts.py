"""Every script says how it is used, and refuses an option that it does not have, before it begins."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# Sourced by the others.
NOT_A_COMMAND = {"setup.sh"}
# A script that began its work would build for minutes.
LONGEST_S = 20


def run(script, *words):
    return subprocess.run([script, *words], capture_output=True, text=True, timeout=LONGEST_S)


def faults_of(script):
    """The faults of one script, as sentences."""
    usage = run(script, "--help")
    if usage.returncode != 0 or "usage: " not in usage.stdout.lower() or script.name not in usage.stdout:
        yield f"{script.name} --help prints no usage: {usage.stdout!r} {usage.stderr!r}"
    refusal = run(script, "--nonsense", "FOLDER")
    if refusal.returncode == 0 or "--nonsense" not in refusal.stderr or refusal.stdout:
        yield f"{script.name} --nonsense is not refused at once: {refusal.stdout!r} {refusal.stderr!r}"


def main():
    scripts = [path for path in sorted((ROOT / "scripts").iterdir()) if path.name not in NOT_A_COMMAND]
    faults = [fault for script in scripts for fault in faults_of(script)]
    print("\n".join(faults) or f"{len(scripts)} scripts say how they are used")
    return 1 if faults or not scripts else 0


if __name__ == "__main__":
    sys.exit(main())
