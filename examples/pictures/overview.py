"""Draws the picture of the README: the shipped valve open and closed, and its leaking variant.

Run: python examples/pictures/overview.py
"""

from pathlib import Path

import mvs
from mvs.report.cases import leaking, shipped
from mvs.drawing.geometry import Drawing
from mvs.drawing.pictures import picture, side_by_side, view_from_atrium

WIDTH_MM = 54


def main() -> None:
    """Writes overview.png beside this file."""
    sound, sick = shipped(mvs.SYSTOLE_PA), leaking(mvs.SYSTOLE_PA)
    shapes = [(sound.opened, False), (sound.closed, True), (sick.closed, True)]
    view = view_from_atrium(WIDTH_MM)
    images = [picture(Drawing(shape), view, closed=shut) for shape, shut in shapes]
    Path(__file__).with_name("overview.png").write_bytes(side_by_side(images))


if __name__ == "__main__":
    main()
