"""Pictures of one snapshot: Snapshot.plot, to_pyvista and the view in a notebook."""

from __future__ import annotations

import base64
import dataclasses
import html
import os
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from ..errors import ArgumentError
from ..words import listed

if TYPE_CHECKING:
    from .._core import Snapshot

VIEWS = ("atrium", "oblique", "chords", "coaptation", "strain")
"""Views of Snapshot.plot."""


@dataclasses.dataclass(frozen=True)
class Picture:
    """A picture as PNG bytes; a notebook shows it, ``save`` writes it."""

    png: bytes = dataclasses.field(repr=False)

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes the picture as a PNG file."""
        with open(path, "wb") as file:
            file.write(self.png)

    def _repr_png_(self) -> bytes:
        return self.png


def need(call: str) -> None:
    """Raises ImportError with the remedy unless the packages of pictures are there."""
    try:
        import matplotlib  # noqa: F401
        import pyvista  # noqa: F401
    except ImportError as error:
        raise ImportError(
            f"{call} needs pyvista and matplotlib: pip install 'libmvs[report]'"
        ) from error


def plot(self: Snapshot, view: str = "atrium") -> Picture:
    """A picture (mvs.drawing.snapshots.Picture), shown in a notebook; extra ``report``.

    view: "atrium" (the surgeon's view, an orifice in red), "oblique", "chords" (from the ventricle,
        coloured by tension), "coaptation" (gap to the facing leaflet) or "strain"
    """
    if view not in VIEWS:
        raise ArgumentError(f'view: one of {listed(VIEWS)} is needed, not "{view}"', "view")
    need("plot")
    from .geometry import Drawing
    from .maps import coaptation_map, strain_map
    from .pictures import picture, view_from_atrium, view_from_ventricle, view_oblique

    drawing = Drawing(self)
    width = float(np.ptp(drawing.annulus[:, 0]))
    loaded = self.load_case.pressure != 0
    if view == "coaptation":
        return Picture(coaptation_map(drawing, width + 14))
    if view == "strain":
        strain = float(np.percentile(self.triangle_stretch[:, 0], 99) - 1) * 100
        return Picture(strain_map(drawing, width + 14, max(5.0, 5 * np.ceil(strain / 5))))
    if view == "chords":
        tension = float(np.percentile(self.chord_tension, 98)) if len(self.chord_tension) else 0.0
        most = max(0.2, 0.2 * np.ceil(tension / 0.2))
        seen = view_from_ventricle(width + 24)
        return Picture(picture(drawing, seen, closed=loaded, tension=most))
    seen = view_from_atrium(width + 14) if view == "atrium" else view_oblique(width + 24)
    return Picture(picture(drawing, seen, closed=loaded))


def to_pyvista(self: Snapshot) -> Any:
    """The valve as a pyvista.MultiBlock in m: "leaflets", "chords", and "orifice" if open.

    The field UNITS of each block is "m" (files .vtp have "mm"). Point k of "leaflets" and "chords" is node k of the snapshot. Needs the extra ``report``.
    leaflets: a surface; per point kind, force (N), coaptation (m, NaN without a facing leaflet);
        per triangle leaflet, scallop, thickness (m), stretch_1, stretch_2, stress_1, stress_2 (Pa)
    chords: lines; per line kind, strain, tension (N), flags, rest_length (m)
    """
    need("to_pyvista")
    import pyvista

    gap = self.node_coaptation
    points = np.array(self.node_position)
    leaflets = pyvista.PolyData.from_regular_faces(points, self.triangle_nodes.astype(int))
    leaflets.point_data.update({
        "kind": np.array(self.node_kind), "force": np.array(self.node_force),
        "coaptation": np.where(np.isfinite(gap), gap, np.nan),
    })
    leaflets.cell_data.update({
        "leaflet": np.array(self.triangle_leaflet), "scallop": np.array(self.triangle_scallop),
        "thickness": np.array(self.triangle_thickness),
        "stretch_1": self.triangle_stretch[:, 0].copy(),
        "stretch_2": self.triangle_stretch[:, 1].copy(),
        "stress_1": self.triangle_stress[:, 0].copy(),
        "stress_2": self.triangle_stress[:, 1].copy(),
    })
    blocks = {"leaflets": leaflets, "chords": _lines(pyvista, self, points)}
    if len(self.orifice_triangles):
        blocks["orifice"] = pyvista.PolyData.from_regular_faces(
            np.array(self.orifice_vertices), self.orifice_triangles.astype(int)
        )
    for block in blocks.values():
        block.field_data["UNITS"] = ["m"]
    return pyvista.MultiBlock(blocks)


def _lines(pyvista: Any, snapshot: Snapshot, points: Any) -> Any:
    ends = snapshot.chord_nodes.astype(np.int64)
    lines = np.column_stack([np.full(len(ends), 2), ends]).ravel()
    chords = pyvista.PolyData(points, lines=lines) if len(ends) else pyvista.PolyData()
    chords.cell_data.update({
        "kind": np.array(snapshot.chord_kind), "strain": np.array(snapshot.chord_strain),
        "tension": np.array(snapshot.chord_tension), "flags": np.array(snapshot.chord_flags),
        "rest_length": np.array(snapshot.chord_rest_length),
    } if len(ends) else {})
    return chords


def repr_html(self: Snapshot) -> str:
    """The view in a notebook: the line of repr() and the picture from the atrium."""
    line = f"<p><code>{html.escape(repr(self))}</code></p>"
    try:
        png = plot(self).png
    except ImportError as error:
        return f"{line}<p>{html.escape(str(error))}</p>"
    except Exception as error:  # a failing driver of the graphics must not hide the valve
        return f"{line}<p>no picture: {html.escape(str(error))}</p>"
    data = base64.b64encode(png).decode("ascii")
    return f'{line}<img alt="valve from the atrium" width="480" src="data:image/png;base64,{data}">'
