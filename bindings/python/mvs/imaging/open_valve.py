"""Whether leaflets in an image are an open valve: two rims, the right size, holes filled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mvs import ArgumentError, FindingSource
from .findings import finding
from .labels import Leaflets
from .mesh import areas, edges_with_triangles, loop_length, loops_by_length, spanned
from .spurs import cut_bridges, cut_spurs
from .tissue_sheet import LabelSettings


LONG_HOLE_SHARE, LONG_HOLE_AREA, OTHER_LEAFLET = 0.4, 40e-6, 0.1
"""Constants of libmvs/patient/surface/holes.cpp and holes.h, which fill holes of a longer rim: its share of the longest one, the
m2 that it spans, and the share of it with the label of the other leaflet."""

def check_open_valve(found: Leaflets, settings: LabelSettings = LabelSettings()) -> None:
    """Fills small holes and cuts narrow bridges between the leaflets; ArgumentError unless the rest is an open valve,
    a ring of tissue with two rims.

    Longer holes that are narrow and lie in one leaflet are left to the build, which fills them as well.
    """
    sheet = found.sheet
    total = float(areas(sheet.points, sheet.triangles).sum())
    if total < 3e-4 or total > 5e-3:
        raise ArgumentError(
            _cut_before(found) + f"the leaflets have {total * 1e4:.1f} cm2 (those of a mitral valve have 6 to 30): there is "
            "no whole valve in the image, or its spacing is wrong", "image")
    cut_spurs(found)
    loops, length, rims = _rims(found, settings)
    while len(rims) > 2 and _is_orifice(found, loops[rims[2]]):
        if not cut_bridges(found, loops[rims[1]], loops[rims[2]]):
            break
        loops, length, rims = _rims(found, settings)
    sheet = found.sheet
    small = [k for k in range(2, len(loops)) if length[k] <= np.pi * settings.hole]
    if len(loops) < 2 or length[1] <= np.pi * settings.hole:
        raise ArgumentError(
            _cut_before(found) + "the leaflets have one rim and no orifice: the valve is closed in this image, the label covers "
            "the orifice, or a leaflet is missing. Give the image of the open valve with both leaflets, and "
            "the closed one by --loaded",
            "image")
    if len(rims) > 2:
        centre = sheet.points[loops[rims[2]]].mean(axis=0) * 1e3
        raise ArgumentError(
            _cut_before(found) + f"the leaflets have {len(rims)} rims, {', '.join(f'{1e3 * length[k]:.0f}' for k in rims)} "
            "mm long: an open valve has two, annulus and free edge. The third surrounds a hole, or the "
            f"label joins the leaflets, near ({centre[0]:.0f}, {centre[1]:.0f}, {centre[2]:.0f}) mm in "
            "LPS: mend the segmentation there, or allow larger holes by --hole", "image")
    for k in small:
        fill_hole(found, loops[k])
    holes = [length[k] for k in small if length[k] > 2e-3]
    if holes:
        found.findings.append(finding(
            "holes", FindingSource.GUESSED, 0.8,
            f"{len(holes)} holes with rims up to {1e3 * holes[0]:.1f} mm long were filled", holes, "m"))


def _cut_before(found: Leaflets) -> str:
    """The finding that the border of the image cuts the leaflets, before the sentence of a refusal."""
    cut = next((one.sentence for one in found.findings if one.name == "cut_by_border"), None)
    return f"{cut}. As they are, " if cut else ""


def _rims(found: Leaflets, settings: LabelSettings) -> tuple[list[NDArray[np.int64]], list[float], list[int]]:
    """The boundary loops, longest first, their lengths, and which of them are no holes that can be filled."""
    loops = loops_by_length(found.sheet)
    length = [loop_length(found.sheet.points, loop) for loop in loops]
    return loops, length, [k for k in range(len(loops)) if k < 2 or length[k] > np.pi * settings.hole
                           and not _is_long_hole(found, loops[k], length[k], length[0])]


def _is_long_hole(found: Leaflets, loop: NDArray[np.int64], length: float, longest: float) -> bool:
    """Whether a loop is narrow and lies in one leaflet: labels lose stretches above a strand of tissue."""
    return bool(length < LONG_HOLE_SHARE * longest and spanned(found.sheet.points, loop) < LONG_HOLE_AREA
                and not _faces_other_leaflet(found, loop))


def _is_orifice(found: Leaflets, loop: NDArray[np.int64]) -> bool:
    """Whether a loop is a part of the orifice, which the labels bridge: wide, with both leaflets along it."""
    return bool(spanned(found.sheet.points, loop) >= LONG_HOLE_AREA and _faces_other_leaflet(found, loop))


def _faces_other_leaflet(found: Leaflets, loop: NDArray[np.int64]) -> bool:
    """Whether both leaflets have a part of a loop, as they have of the orifice."""
    at_rim = np.isin(found.sheet.triangles, loop).sum(axis=1) >= 2
    label = np.bincount(found.leaflet[at_rim], minlength=3)[1:]
    return bool(label.min() > OTHER_LEAFLET * label.sum())


def fill_hole(found: Leaflets, loop: NDArray[np.int64]) -> None:
    """Closes a hole by triangles to the middle of its rim, of the leaflet that is most of the rim."""
    sheet = found.sheet
    middle = len(sheet.points)
    sheet.points = np.vstack([sheet.points, sheet.points[loop].mean(axis=0)])
    for name, value in sheet.values.items():
        sheet.values[name] = np.append(value, value[loop].mean())
    after = np.roll(loop, -1)
    # against the edge of the triangle beside, so that both wind alike
    edges = edges_with_triangles(sheet.triangles)[0]
    if not (edges == [loop[0], after[0]]).all(axis=1).any():
        loop, after = after, loop
    fan = np.column_stack([after, loop, np.full(len(loop), middle)])
    beside = found.leaflet[np.isin(sheet.triangles, loop).any(axis=1)]
    label = np.bincount(beside, minlength=3).argmax()
    sheet.triangles = np.vstack([sheet.triangles, fan])
    found.leaflet = np.append(found.leaflet, np.full(len(fan), label, np.uint32))
