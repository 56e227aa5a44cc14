"""python -m mvs.imaging.phantom: the command `phantom` alone."""

import argparse
import sys

from .command import add_to


def main() -> int:
    """Parses the arguments as those of the command `phantom`, and runs it."""
    parser = argparse.ArgumentParser(prog="python -m mvs.imaging")
    add_to(parser.add_subparsers(required=True))
    arguments = parser.parse_args(["phantom", *sys.argv[1:]])
    return int(arguments.run(arguments))


if __name__ == "__main__":
    sys.exit(main())
