"""Tables of results: rows in order, units of the columns, and a data frame on request."""

from __future__ import annotations

import dataclasses
import html
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, Union, overload

from ._core import Snapshot
from .errors import ArgumentError
from .kinds import ChordKind, NodeKind, PartKind
from .values import Measures, definition_of, unit_of
from .words import listed

Row = Mapping[str, Any]


class Table(Sequence[Row]):
    """Rows as dictionaries, in order: ``table[0]["tension"]``, ``table["tension"]``, iteration.

    columns: their names
    units: the unit of each column, "" without one
    """

    def __init__(self, rows: Iterable[Row], units: Mapping[str, str]) -> None:
        self._rows = tuple(rows)
        self.units = dict(units)

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns, in order."""
        return tuple(self.units)

    def __len__(self) -> int:
        return len(self._rows)

    @overload
    def __getitem__(self, which: int) -> Row: ...
    @overload
    def __getitem__(self, which: slice) -> Table: ...
    @overload
    def __getitem__(self, which: str) -> list[Any]: ...
    def __getitem__(self, which: Union[int, slice, str]) -> Union[Row, Table, list[Any]]:
        if isinstance(which, str):
            if which not in self.units:
                raise KeyError(f'no column "{which}"; there are {", ".join(self.units)}')
            return [row[which] for row in self._rows]
        if isinstance(which, slice):
            return Table(self._rows[which], self.units)
        return self._rows[which]

    def __iter__(self) -> Iterator[Row]:
        return iter(self._rows)

    def sorted(self, column: str, reverse: bool = False) -> Table:
        """The rows sorted by a column; rows with equal values keep their order.

        Rows without a value (NaN) come last, also with `reverse`.
        """
        values = self[column]
        known = [row for row, value in zip(self._rows, values) if value == value]
        unknown = [row for row, value in zip(self._rows, values) if value != value]
        known.sort(key=lambda row: row[column], reverse=reverse)
        return Table(known + unknown, self.units)

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame; ``attrs["units"]`` has the units (extra ``tables``)."""
        frame = _pandas().DataFrame(list(self._rows), columns=list(self.units))
        frame.attrs["units"] = dict(self.units)
        return frame

    def __repr__(self) -> str:
        lines = [self._heads(), *(self._cells(row) for row in self._rows[:60])]
        widths = [max(len(line[k]) for line in lines) for k in range(len(self.units))]
        text = "\n".join(
            "  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip()
            for line in lines
        )
        more = len(self) - 60
        return f"{text}\n... and {more} more rows" if more > 0 else text

    def _repr_html_(self) -> str:
        def row_of(cells: Sequence[str], tag: str) -> str:
            inside = "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells)
            return f"<tr>{inside}</tr>"

        rows = "\n".join(row_of(self._cells(row), "td") for row in self._rows)
        return f"<table>{row_of(self._heads(), 'th')}\n{rows}</table>"

    def _heads(self) -> list[str]:
        return [f"{name}, {unit}" if unit else name for name, unit in self.units.items()]

    def _cells(self, row: Row) -> list[str]:
        values = (row[name] for name in self.units)
        return [f"{v:.4g}" if isinstance(v, float) else str(v) for v in values]


def _pandas() -> Any:
    try:
        import pandas
    except ImportError as error:
        raise ImportError("to_dataframe needs pandas: pip install 'libmvs[tables]'") from error
    return pandas


CHORD_UNITS = {
    "name": "", "kind": "", "head": "", "site": "", "length": "m", "rest_length": "m",
    "strain": "", "tension": "N", "flag": "",
}


def chords(self: Snapshot) -> Table:
    """The chordae as a table (mvs.Table), a row per segment in the order of the arrays.

    The same rows as those of the command `mvs chords`. name, kind ("rough zone"), head (names of the
    papillary heads above it, joined by "+"; "" without one), site (scallops in which it, or its
    branches, end, joined by "+"), length and rest_length in m, strain (negative when slack), tension
    in N, flag ("over strain", "over tension": beyond the limits of mvs.chord_limits; "slack").
    """
    return Table((_chord_row(*chord) for chord in self._chords()), CHORD_UNITS)


def _chord_row(
    name: str, kind: int, heads: str, scallops: str, flags: int, *numbers: float
) -> dict[str, Any]:
    length, rest_length, strain, tension = numbers
    words = [word for bit, word in ((1, "over strain"), (2, "over tension")) if flags & bit]
    return {
        "name": name,
        "kind": ChordKind(kind).name.lower().replace("_", " "),
        "head": heads,
        "site": scallops,
        "length": length,
        "rest_length": rest_length,
        "strain": strain,
        "tension": tension,
        "flag": ", ".join([*words, *(["slack"] if tension == 0 else [])]),
    }


REGION_UNITS = {
    "name": "", "kind": "", "coaptation_area": "m2", "coaptation_length_mean": "m",
    "coaptation_length_min": "m", "orifice_area": "m2", "gap": "m", "billow_height": "m",
    "billow_volume": "m3", "tenting_height": "m", "tenting_volume": "m3",
}
PART_UNITS = {
    "anterior": "", "posterior": "", "commissures": "", "triangles": "", "area": "m2", "gap": "m",
    "x": "m", "y": "m", "z": "m", "jet_x": "", "jet_y": "", "jet_z": "",
}


def regions(self: Snapshot) -> Table:
    """Where the valve leaks: the scallops, then the commissures, as a table (mvs.Table).

    The same rows as those of the command `mvs leak`, in SI units. name ("A2"; "A1-P1" for the
    commissure of these scallops), kind ("scallop", "commissure"), coaptation area of one side, mean and
    least coaptation length, the part of the regurgitant orifice beside the region and the widest
    gap in it, height and volume of billow and tenting. Areas and volumes of the scallops add up to the
    measures; a commissure overlaps its scallops. Definitions: libmvs/measure/DEFINITIONS.md.
    """
    kinds = {1: "scallop", 2: "commissure"}
    return Table((dict(zip(REGION_UNITS, (name, kinds[kind], *numbers)))
                  for name, kind, *numbers in self._regions()), REGION_UNITS)


def orifice_parts(self: Snapshot) -> Table:
    """The connected parts of the regurgitant orifice as a table (mvs.Table), the largest first.

    anterior, posterior: scallops beside the part, joined by "+"; commissures: the same, or "";
    triangles: how many of orifice_triangles (orifice_part has the row of each); area in m2, widest gap
    and centroid (x, y, z) in m; unit direction of the jet, into the atrium. No rows for a sealed valve.
    """
    return Table((dict(zip(PART_UNITS, row)) for row in self._orifice_parts()), PART_UNITS)


NODE_UNITS = {
    "x": "m", "y": "m", "z": "m", "kind": "", "fx": "N", "fy": "N", "fz": "N", "coaptation": "m",
}
TRIANGLE_UNITS = {
    "leaflet": "", "scallop": "", "thickness": "m", "stretch_1": "", "stretch_2": "",
    "stress_1": "Pa", "stress_2": "Pa", "coapted": "",
}


def _nodes(snapshot: Snapshot) -> Table:
    columns = [*snapshot.node_position.T.tolist(),
               [NodeKind(int(k)).name.lower() for k in snapshot.node_kind],
               *snapshot.node_force.T.tolist(), snapshot.node_coaptation.tolist()]
    return Table((dict(zip(NODE_UNITS, row)) for row in zip(*columns)), NODE_UNITS)


def _triangles(snapshot: Snapshot) -> Table:
    leaflets = [part.name for part in snapshot.parts if part.kind == PartKind.LEAFLET]
    scallops = [part.name for part in snapshot.parts if part.kind == PartKind.SCALLOP]
    columns = [[leaflets[k] for k in snapshot.triangle_leaflet],
               [scallops[k] for k in snapshot.triangle_scallop],
               snapshot.triangle_thickness.tolist(), *snapshot.triangle_stretch.T.tolist(),
               *snapshot.triangle_stress.T.tolist(), snapshot.triangle_coapted.tolist()]
    return Table((dict(zip(TRIANGLE_UNITS, row)) for row in zip(*columns)), TRIANGLE_UNITS)


def _number(value: Union[bool, int, float]) -> Union[int, float]:
    """A number, so that a column of them is one of numbers: 1 for True."""
    return int(value) if isinstance(value, bool) else value


def _measures(snapshot: Snapshot) -> Table:
    measures = snapshot.measures
    return Table(
        (
            {"measure": field.name, "value": _number(getattr(measures, field.name)),
             "unit": unit_of(Measures, field.name),
             "definition": definition_of(Measures, field.name)}
            for field in dataclasses.fields(Measures)
        ),
        {"measure": "", "value": "", "unit": "", "definition": ""},
    )


_TABLES = {
    "measures": _measures, "chords": chords, "nodes": _nodes, "triangles": _triangles,
    "regions": regions, "orifice_parts": orifice_parts,
}


def to_dataframe(self: Snapshot, what: str = "measures") -> Any:
    """A pandas.DataFrame of this snapshot in SI units (extra ``tables``).

    what: "measures" (value, unit and definition of each), "chords" (as chords()), "nodes" or
        "triangles" (the arrays), "regions" or "orifice_parts" (as those methods); ``attrs["units"]`` of the frame has the units of the columns
    """
    if what not in _TABLES:
        raise ArgumentError(f'what: one of {listed(_TABLES)} is needed, not "{what}"', "what")
    return _TABLES[what](self).to_dataframe()
