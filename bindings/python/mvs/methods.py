"""Methods of Simulator and Snapshot that are written in Python: texts, copies, tables, pictures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, Literal, Union

from . import _core
from .arguments import wrap_methods
from .drawing import snapshots
from .errors import ArgumentError, Error
from .kinds import MMHG
from .sensitivities import sensitivity, simulator_sensitivity
from .tables import chords, orifice_parts, regions, to_dataframe
from .values import Measures
from .words import did_you_mean, listed, shown

Form = Literal["obj", "h5"]

MOST_VERTICES = 20000
"""Leaflet vertices up to which a text measures the leak: it takes less than a second."""


def attach() -> None:
    """Adds the methods to the classes of the binding, and sentences to their TypeErrors."""
    for kind in (_core.Simulator, _core.Snapshot, _core.Ensemble, _core.Device):
        wrap_methods(kind)
    for name, method in (
        ("__repr__", snapshot_text),
        ("__reduce__", reduced),
        ("__copy__", copied),
        ("__deepcopy__", deeply_copied),
        ("_repr_html_", snapshots.repr_html),
        ("measure", measure),
        ("chords", chords),
        ("regions", regions),
        ("orifice_parts", orifice_parts),
        ("plot", snapshots.plot),
        ("sensitivity", sensitivity),
        ("to_dataframe", to_dataframe),
        ("to_pyvista", snapshots.to_pyvista),
    ):
        setattr(_core.Snapshot, name, method)
    setattr(_core.Simulator, "__repr__", simulator_text)
    setattr(_core.Simulator, "settle_slices", settle_slices)
    setattr(_core.Simulator, "sensitivity", simulator_sensitivity)


def words_of(snapshot: _core.Snapshot) -> str:
    """Size, load, rest and leak of a valve in a few words."""
    kinds = snapshot.node_kind
    vertices = int((kinds <= 1).sum())
    words = f"{vertices} vertices, {len(snapshot.chord_kind)} chordae"
    pressure = snapshot.load_case.pressure
    if pressure == 0:
        return f"{words}, no load"
    words += f", {pressure / MMHG:.4g} mmHg"
    if not snapshot.at_rest:
        return f"{words}, not at rest"
    words += ", at rest"
    if vertices > MOST_VERTICES:
        return words
    found = measure(snapshot, ("crossings", "orifice"))
    if found.intersections:
        pairs = found.intersections
        return f"{words}, leaflets cross ({pairs} pairs of triangles): its measures do not count"
    area = found.regurgitant_orifice_area
    return f"{words}, leaks {area * 1e6:.1f} mm2" if area > 0 else f"{words}, no leak"


def snapshot_text(self: _core.Snapshot) -> str:
    return f'<mvs.Snapshot "{self.name}": {words_of(self)}>'


def simulator_text(self: _core.Simulator) -> str:
    try:
        snapshot = self.snapshot()
    except Error as error:
        return f"<mvs.Simulator: {error}>"
    return f'<mvs.Simulator "{snapshot.name}": {words_of(snapshot)}>'


def settle_slices(
    self: _core.Simulator, seconds: float = 0.05, **options: Any
) -> Iterator[float]:
    """Settles in slices, for a program that has to answer in between (a window, asyncio).

    Gives the completed share, in (0, 1], after each slice of `seconds`; at 1 the valve is settled,
    with the bits of one call. Until then it is as before. An iteration is not divided: on large
    valves a slice takes longer. Leaving the loop cancels.

        for share in sim.settle_slices():
            bar.update(share)

    options: those of settle, without `progress`.
    """
    self.begin_settle(**options)
    share = 0.0
    try:
        while share < 1:
            share = self.advance_settle(seconds)
            yield share
    finally:
        if share < 1:
            self.cancel_settle()


def measure(
    self: _core.Snapshot, groups: Union[None, str, Iterable[str]] = None
) -> Measures:
    """The measures of the valve (mvs.Measures) of some groups, with the same bits as ``measures``.

    The numbers of the other groups are NaN, their counts 0, and computing them takes no time.

        closed.measure("coaptation").coaptation_area
        closed.measure(groups=["orifice", "tenting"])

    groups: "crossings", "orifice" (the longest), "coaptation", "tenting" (with billow), "annulus",
        "chords", "leaflets" (strain, stress, area), or several of them; None: all
    """
    known = _core.measure_groups()
    words = list(known) if groups is None else [groups] if isinstance(groups, str) else groups
    bits = 0
    for word in words:
        if not isinstance(word, str) or word not in known:
            near = did_you_mean(word, known) if isinstance(word, str) else ""
            raise ArgumentError(
                f"groups: some of {listed(known)} are needed, not {shown(word)}{near}", "groups"
            )
        bits |= known[word]
    return self._measure(bits)


def reduced(self: _core.Snapshot) -> tuple[Any, ...]:
    form: Form = "h5" if "hdf5" in _core.features().split() else "obj"
    return snapshot_of_bytes, (self.to_bytes(format=form), form)


def snapshot_of_bytes(data: bytes, form: Form) -> _core.Snapshot:
    """The snapshot that ``Snapshot.to_bytes(format=form)`` wrote, bit for bit."""
    with _core.Simulator(log=lambda level, text: None) as sim:
        sim.load_bytes(data, format=form)
        return sim.snapshot()


def copied(self: _core.Snapshot) -> _core.Snapshot:
    """A snapshot is immutable: its copy is itself."""
    return self


def deeply_copied(self: _core.Snapshot, memo: object) -> _core.Snapshot:
    """As copied()."""
    return self
