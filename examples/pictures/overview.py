"""Makes the picture of the README: the shipped valve open, closed, and leaking when its annulus is
dilated by 40 %. Run: python examples/pictures/overview.py"""

from pathlib import Path

import mvs
from mvs.report.geometry import Drawing
from mvs.report.pictures import picture, side_by_side, view_from_atrium

WIDTH_MM = 60
LEAKS = 1.4


def closed(**dimensions: float) -> mvs.Snapshot:
    """A parametric valve under 120 mmHg."""
    with mvs.Simulator() as sim:
        sim.generate(**dimensions)
        sim.set_load(mvs.SYSTOLE_PA)
        if not sim.settle().converged:
            raise SystemExit("the valve did not settle")
        return sim.snapshot()


def main() -> None:
    """Writes overview.png beside this file."""
    with mvs.Simulator() as sim:
        sim.generate()
        opened = sim.snapshot()
    shapes = [(opened, False), (closed(), True), (closed(annulus_scale=LEAKS), True)]
    view = view_from_atrium(WIDTH_MM)
    images = [picture(Drawing(shape), view, closed=shut) for shape, shut in shapes]
    Path(__file__).with_name("overview.png").write_bytes(side_by_side(images))


if __name__ == "__main__":
    main()
