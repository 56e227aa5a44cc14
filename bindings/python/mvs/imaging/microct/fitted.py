"""Rest lengths with which the closed valve meets the leaflets in the loaded image.

Lengths that were measured in both images leave errors: chordae that no image shows, ways that were paired
wrongly, ends that lie off by a voxel. The leaflets under load are known to a fraction of a voxel, and each chord
pulls at its place. So lengths are moved from the measured ones, no farther than the leaflets ask for
(mvs.fit: Gauss-Newton with exact derivatives and normal priors).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import TYPE_CHECKING, Optional

import numpy as np

import mvs
from mvs.laws import leaflet_law_of
from ..console import Console
from ..findings import finding
from ..mesh import Sheet
from ..valve import distance_from_image
from .loaded import Closure, settled
from .tissue import tissue_finding, with_law

if TYPE_CHECKING:
    from mvs.editing import _FilledValve

LENGTH_PRIOR = mvs.Prior(0.1, 3.0)
"""Standard deviation of a measured length, share: with 0.2 four phantoms closed 0.01 to 0.06 mm nearer, and a fit took
up to twice as long (tests/validation/README.md)."""
NOISE = 0.5e-3
"""m, between the simulated leaflets and those in the image: the model lacks the patient's tissue, thickness and some
chordae; the mid-surface in the image is 0.1 mm off."""
CLOSURES = 10
"""At most, of one fit; twice as many closed four valves with known lengths at most 0.02 mm nearer."""
TISSUES = 3
"""Laws that are fitted: nearest before the fit is not nearest after it, as lengths stand in for a tissue."""
FIT_RESIDUAL = 1e-4
"""N: the closures of a fit rest as well as those of the library by default."""
LESS = 0.95
"""A fit is taken if the valve, closed from open, lies nearer to the image by this factor."""
ROUNDS = 3
SAME_FOLD = 1.05
"""A fitted valve can close from open in another fold than the fit followed, farther away: it is fitted again from there,
`ROUNDS` times in all."""


@dataclasses.dataclass(frozen=True)
class Fitted:
    """A valve with fitted lengths, closed from open. Distances from the loaded image, m RMS: of this closure, and
    of that which the fit followed (`along`)."""

    valve: _FilledValve
    closure: Closure
    distance: float
    along: float


def with_fitted_lengths(valve: _FilledValve, closure: Closure, laws: Sequence[mvs.LeafletLaw], loaded: Sheet,
                        console: Console) -> tuple[Closure, list[mvs.Finding]]:
    """Sets the rest lengths of a valve, and the law of its leaflets, to those that close it nearest to the
    loaded image.

    closure: of the valve as it is; laws: those to try, none: its own
    """
    before = _distance(closure[1], loaded)
    fits: dict[mvs.LeafletLaw, Fitted] = {}
    own = _law_of(valve)
    for law in list(laws[:TISSUES]) or [own]:
        console.stage(f"fitting the lengths of chordae with the tissue {law.name.lower()}")
        changed = dataclasses.replace(valve, leaflets=valve.leaflets if law == own else with_law(valve.leaflets, law))
        fit = _fitted(changed, closure if law == own else None, loaded, console)
        if fit is not None:
            fits[law] = fit
    best = min(fits.values(), key=lambda fit: fit.distance, default=None)
    for _ in range(ROUNDS - 1):
        if best is None or best.distance < SAME_FOLD * best.along:
            break
        console.stage("fitting the lengths of chordae again, as the valve closes from open in another fold")
        fit = _fitted(dataclasses.replace(best.valve), best.closure, loaded, console)
        if fit is None or fit.distance > LESS * best.distance:
            break
        best = fits[_law_of(best.valve)] = fit
    if best is None or (closure[2].converged and best.distance > LESS * before):
        return closure, [finding(
            "fitted_chordae", mvs.FindingSource.MEASURED, 0.3,
            "other lengths of chordae do not close the valve nearer to the loaded image than "
            f"{before * 1e3:.2f} mm RMS: they stay as measured")]
    change = np.asarray(best.valve.chord_rest_length) / np.asarray(valve.chord_rest_length) - 1
    valve.leaflets, valve.chord_rest_length = best.valve.leaflets, best.valve.chord_rest_length
    found = [finding(
        "fitted_chordae", mvs.FindingSource.MEASURED, 0.7,
        f"rest lengths of segments were changed by {100 * np.sqrt(np.mean(change ** 2)):.1f} % RMS, at most "
        f"{100 * np.abs(change).max():.0f} %, so that the closed leaflets lie {best.distance * 1e3:.2f} mm RMS "
        f"from those in the loaded image instead of {before * 1e3:.2f} mm; they stand in for chordae that the "
        "images do not show", change)]
    if len(laws) > 1:
        found.append(tissue_finding({law: fit.distance for law, fit in fits.items()}))
    return best.closure, found


def _fitted(valve: _FilledValve, closure: Optional[Closure], loaded: Sheet, console: Console) -> Optional[Fitted]:
    """None if the valve does not come to rest without crossings, or nothing can be fitted.

    closure: of the valve as it is, where it is known
    """
    try:
        _, closed, stats = closure or settled(valve, console)
        if not stats.converged:
            return None
        fit = mvs.fit(closed, (loaded.points, loaded.triangles), noise=NOISE,
                      priors={"chords": LENGTH_PRIOR}, residual=FIT_RESIDUAL, most=CLOSURES)
        valve.chord_rest_length = np.array(fit.closed.chord_rest_length)
        # from open, as every later closure: the fit followed one fold
        closure = settled(valve, console)
    except mvs.Error:
        return None
    if not closure[2].converged or closure[1].measures.intersections:
        return None
    return Fitted(valve, closure, _distance(closure[1], loaded), _distance(fit.closed, loaded))


def _law_of(valve: _FilledValve) -> mvs.LeafletLaw:
    return mvs.LeafletLaw(leaflet_law_of(valve.leaflets[0].law))


def _distance(closed: mvs.Snapshot, loaded: Sheet) -> float:
    return float(distance_from_image(closed, loaded).values[0])
