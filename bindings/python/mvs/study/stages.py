"""Closes a valve in its healthy, diseased and repaired stages."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from .. import SYSTOLE_PA, Part, PartKind, Simulator, Snapshot, Stats
from .anatomy import Anatomy
from .plans import Plan, Treatment

POSTERIOR_HEIGHT_M = 12e-3


@dataclass(frozen=True)
class Stage:
    """A valve closed at 120 mmHg.

    number: number of the plan; 0 for the healthy valve
    """

    number: int
    state: str
    note: str
    closed: Snapshot
    stats: Stats

    @property
    def title(self) -> str:
        """Number and state of the valve."""
        return f"Valve {self.number}, {self.state}" if self.number else self.state


def healthy_valve(vertices: int = 425) -> Snapshot:
    """The founding valve of the study, open.

    Its posterior leaflet is 12 mm tall, the lower end of the normal 12 to 14 mm. With the default
    of 13 mm the coaptation is so large that shortening any chord by 30 % opens less than 2 mm2.
    """
    with Simulator() as sim:
        sim.generate(
            shape="founding", vertices=vertices, posterior_height=POSTERIOR_HEIGHT_M
        )
        return sim.snapshot()


def run(healthy: Snapshot, plans: Sequence[Plan]) -> Iterator[Stage]:
    """Yields the healthy valve, then the diseased and the repaired valve of each plan.

    Each closure starts from the previous shape: the disease from the healthy closed valve, the
    repair from the diseased one.
    """
    anatomy = Anatomy(healthy)
    with Simulator() as sim:
        sim.restore(healthy)
        first = _close(sim, 0, "healthy", "")
        yield first
        for plan in plans:
            sim.restore(first.closed)
            yield _sicken(sim, plan, anatomy)
            yield _repair(sim, plan, anatomy)


def _close(sim: Simulator, number: int, state: str, note: str) -> Stage:
    sim.set_load(SYSTOLE_PA)
    stats = sim.settle()
    return Stage(number, state, note, sim.snapshot(), stats)


def _sicken(sim: Simulator, plan: Plan, anatomy: Anatomy) -> Stage:
    disease, chord = plan.disease, _diseased_chord(plan, anatomy)
    sim.apply("annulus_scale", factor=disease.annulus)
    sim.apply("chord_length", chord=chord, factor=disease.chord)
    note = f"annulus {disease.annulus - 1:+.0%}, chord {chord.name} {disease.chord - 1:+.0%}"
    return _close(sim, plan.number, "diseased", note)


def _repair(sim: Simulator, plan: Plan, anatomy: Anatomy) -> Stage:
    repair, chord = plan.repair, _diseased_chord(plan, anatomy)
    sim.apply("annulus_scale", factor=repair.annulus / plan.disease.annulus)
    if repair.treatment == Treatment.RESTORE:
        length = float(anatomy.snapshot.chord_rest_length[chord.index])
        sim.apply("chord_length", chord=chord, length=length)
    elif repair.treatment == Treatment.REPLACE:
        sim.apply("chord_remove", chord=chord)
    added = _new_chords(plan, anatomy)
    for head, vertex in added:
        # without a length the new chord is as taut as its neighbours
        sim.apply("chord_add", head=head, site=vertex)
    note = (
        f"annulus to {repair.annulus:.0%} of the healthy one, chord {chord.name} "
        f"{repair.treatment.value}, new from {', '.join(head.name for head, _ in added)}"
    )
    return _close(sim, plan.number, "repaired", note)


def _diseased_chord(plan: Plan, anatomy: Anatomy) -> Part:
    return anatomy.part(PartKind.CHORD, anatomy.chord_at(plan.disease.site).row)


def _new_chords(plan: Plan, anatomy: Anatomy) -> list[tuple[Part, int]]:
    """Head and vertex of each chord added by a repair."""
    ends = []
    if plan.repair.treatment == Treatment.REPLACE:
        old = anatomy.chord_at(plan.disease.site)
        head = int(anatomy.snapshot.chord_nodes[old.row, 0])
        ends = [(head, vertex) for vertex in old.vertices]
    for site in plan.repair.add:
        vertex = anatomy.vertex_at(site)
        ends.append((anatomy.nearest_head(vertex, site.across), vertex))
    return [(anatomy.head_of(head), vertex) for head, vertex in ends]
