"""The default parametric valve under every tissue: sealed, coaptation, billow, along eight paths.

    python tests/validation/healthy.py --vertices 432 1600 --pressures 100 120 140
"""

from __future__ import annotations

import argparse
import warnings
from dataclasses import dataclass

import mvs

LAWS = ("spring", "bilinear", "may_newman_yin", "fung", "prot", "neo_hookean")
MMHG = mvs.SYSTOLE_PA / 120
# N; the measures below change by less than their last digit down to 1e-6 N
RESIDUAL = 1e-4


@dataclass(frozen=True)
class Paths:
    """The closures of one valve along several paths; lengths in mm, areas in mm2.

    Ranges are over the members at rest.
    """

    vertices: int
    law: str
    pressure_mmhg: float
    members: int
    at_rest: int
    sealed: int
    orifice: float
    coaptation: tuple[float, float]
    billow: float
    depth: tuple[float, float]
    intersections: int

    def row(self) -> str:
        """A row of the table."""
        return (
            f"| {self.vertices} | {self.law} | {self.pressure_mmhg:.0f} | "
            f"{self.sealed} of {self.members} | {self.members - self.at_rest} | {self.orifice:.2f} | "
            f"{self.coaptation[0]:.1f} to {self.coaptation[1]:.1f} | "
            f"{self.depth[0]:.1f} to {self.depth[1]:.1f} | {self.billow:.2f} | "
            f"{self.intersections} |"
        )


HEADER = (
    "| vertices | law | mmHg | sealed paths | not at rest | largest orifice, mm2 | "
    "coaptation at A2-P2, mm | its depth, mm | largest billow, mm | crossings |\n"
    "|---|---|---|---|---|---|---|---|---|---|"
)


def close(vertices: int, law: str, pressure_mmhg: float, members: int = 8, **dimensions) -> Paths:
    """Closes the default valve with a tissue along several paths."""
    with mvs.Simulator() as sim, warnings.catch_warnings():
        warnings.simplefilter("ignore", mvs.ValveWarning)  # short edges of fine meshes
        sim.generate(vertices=vertices, leaflet=law, **dimensions)
        ensemble = sim.snapshot().ensemble(
            pressure_mmhg * MMHG, members=members, residual=RESIDUAL, max_iterations=1000
        )
    found = [
        ensemble.snapshot(k).measures for k in range(members) if ensemble.members[k].converged
    ]
    orifices = [m.regurgitant_orifice_area * 1e6 for m in found]
    heights = [m.coaptation_height * 1e3 for m in found]
    depths = [m.coaptation_depth * 1e3 for m in found]
    return Paths(
        vertices, law, pressure_mmhg, members, len(found), orifices.count(0), max(orifices),
        (min(heights), max(heights)), max(m.billow_height for m in found) * 1e3,
        (min(depths), max(depths)), max(m.intersections for m in found),
    )  # fmt: skip


def main() -> None:
    """Prints the table."""
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--vertices", type=int, nargs="+", default=[432])
    options.add_argument("--laws", nargs="+", choices=LAWS, default=LAWS)
    options.add_argument("--pressures", type=float, nargs="+", default=[100.0, 120.0, 140.0])
    options.add_argument("--members", type=int, default=8)
    given = options.parse_args()
    print(HEADER)
    for vertices in given.vertices:
        for law in given.laws:
            for pressure in given.pressures:
                print(close(vertices, law, pressure, given.members).row(), flush=True)


if __name__ == "__main__":
    main()
