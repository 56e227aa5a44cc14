"""python -m mvs.imaging: the command `mvs-image`."""

import sys

from .command import main

if __name__ == "__main__":
    sys.exit(main())
