"""Valves that time_error.py closes: how each is made at each level, and the references for its closed shape."""

from __future__ import annotations

import sys
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Callable, Optional

import mvs

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "validation"))
import convergence  # noqa: E402
import febio_case as febio  # noqa: E402

ELEMENTS = ("spring", "bilinear")


@dataclass
class Subject:
    """A valve, how it is made at each level, and the reference for its closed shape."""

    name: str
    elements: tuple[str, ...]
    prepare: Callable[[str, int], Callable[[mvs.Simulator], None]]
    levels: int
    pressure_pa: float
    finest: dict[str, mvs.Snapshot]
    other: Optional[mvs.Snapshot]


def refined(
    make: Callable[[mvs.Simulator], None], law: str, level: int
) -> Callable[[mvs.Simulator], None]:
    """Prepares a valve, its law and its level."""

    def prepare(sim: mvs.Simulator) -> None:
        make(sim)
        if law != "spring":
            sim.set_leaflet(law=law)
        sim.refine(level)

    return prepare


def finest_of(make: Callable[[mvs.Simulator], None], levels: int,
              elements: tuple[str, ...] = ELEMENTS) -> dict[str, mvs.Snapshot]:
    """The closed finest level of each element: one finer than those that are timed."""
    found = {}
    for law in elements:
        closed = convergence.close_levels(refined(make, law, 0), levels + 1)
        if not closed[-1].stats.converged:
            print(f"the finest level of {law} is not at rest: {closed[-1].stats.residual:.1e} N")
        found[law] = closed[-1].closed
    return found


def shipped(levels: int) -> Subject:
    """The founding valve: 432 vertices, and refined."""
    def make(sim: mvs.Simulator) -> None:
        sim.generate(shape="founding")

    finest = finest_of(make, levels)
    return Subject("shipped", ELEMENTS, lambda law, k: refined(make, law, k), levels,
                   mvs.SYSTOLE_PA, finest, finest["bilinear"])


def healthy(levels: int) -> Subject:
    """The default parametric valve, a membrane: 432 vertices, and refined."""
    def make(sim: mvs.Simulator) -> None:
        sim.generate()

    finest = finest_of(make, levels, ("bilinear",))
    return Subject("healthy", ("bilinear",), lambda law, k: refined(make, law, k), levels,
                   mvs.SYSTOLE_PA, finest, finest["bilinear"])


def febio_case(levels: int) -> Subject:
    """The case that FEBio closed (tests/validation/febio.py): 468 vertices, and refined."""
    theirs = febio.Theirs(febio.data_file())
    springs = replace(febio.BASE, law=mvs.LeafletLaw.SPRING)

    def make(sim: mvs.Simulator) -> None:
        sim.set_valve(febio.read(theirs, springs))

    with mvs.Simulator() as sim:
        valve = febio.read(theirs, springs)
        valve.nodes_now = theirs.closed
        sim.set_valve(valve)
        other = sim.snapshot()
    return Subject("febio", ELEMENTS, lambda law, k: refined(make, law, k), levels,
                   mvs.SYSTOLE_PA, finest_of(make, levels), other)


TEXAS_VERTICES = (800, 1500, 4000, None)


def texas_case(levels: int) -> Subject:
    """The Texas valve (tests/validation/texas.py), coarsened, with its own law; and Abaqus's."""
    import texas

    folder = texas.data_folder()

    def prepare(law: str, level: int) -> Callable[[mvs.Simulator], None]:
        return lambda sim: sim.restore(texas.open_valve(folder, TEXAS_VERTICES[level]))

    with mvs.Simulator() as sim:
        frame = texas.read_frame(folder)
        valve = mvs.valve_of(texas.open_valve(folder))
        valve.nodes_now = valve.nodes.copy()
        valve.nodes_now[: len(frame.points)] = frame.points
        sim.set_valve(valve)
        other = sim.snapshot()
    return Subject("texas", ("fung",), prepare, min(levels + 1, len(TEXAS_VERTICES)),
                   texas.PRESSURE, {}, other)


# levels that are timed, without --long; FEBio's case folds in many ways and takes longer
LEVELS = {"shipped": 2, "healthy": 1, "febio": 1, "texas": 1}
SUBJECTS = {"shipped": shipped, "healthy": healthy, "febio": febio_case, "texas": texas_case}
