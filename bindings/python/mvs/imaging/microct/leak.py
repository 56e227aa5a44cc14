"""The leak of a valve over the errors of the lengths of its chordae, which the image shows in part.

As the interval of leaks of a build (libmvs/patient/fit/leak_interval.h): closures from open with all
lengths shorter and longer and, unless all of them are sealed, with random lengths; the range of their
leaks, wider by a quarter on both sides and by what meshes of one valve differ by.
"""

from __future__ import annotations

from typing import Optional

import numpy as np
from numpy.typing import NDArray

import mvs
from ..findings import finding
from .loaded import Closure, settled

ALL, SINGLE = 0.1, 0.1
"""Errors of all lengths together and of one beside the others, shares: of chordae in phantoms with voxels
of 0.2 to 0.3 mm the mean is 2 to 11 % off (tests/validation/phantoms.py)"""
DRAWS, SEED = 6, 22
WIDENING, SEALED = 0.25, 0.5e-6
"""Share of the range; m2, by which meshes of one valve differ: a valve with less is sealed"""


def leak_over_lengths(valve: mvs.Valve, closure: Closure) -> list[mvs.Finding]:
    """Findings `leak` and `leak_interval` of a valve; `closure`: with its lengths as they are."""
    lengths = np.array(valve.chord_rest_length)
    _, closed, stats = closure
    middle = closed.measures.regurgitant_orifice_area
    leaks = [middle] if stats.converged else []
    factors = [1 - ALL, 1 + ALL]
    ends = [_leak(valve, lengths * factor) for factor in factors]
    leaks += [leak for leak in ends if leak is not None]
    sealed = len(leaks) == 3 and max(leaks) < SEALED
    random = np.random.default_rng(SEED)
    draws = 0
    while not sealed and draws < DRAWS:
        factor = 1 + random.uniform(-ALL, ALL)
        drawn = _leak(valve, lengths * factor * (1 + random.uniform(-SINGLE, SINGLE, len(lengths))))
        leaks += [] if drawn is None else [drawn]
        draws += 1
    if not leaks:
        leaks = [middle]
    more = SEALED + (0 if sealed else WIDENING * (max(leaks) - min(leaks)))
    interval = max(0.0, min(leaks) - more), max(leaks) + more
    shown = [_mm2(ends[0]), _mm2(middle if stats.converged else None), _mm2(ends[1])]
    sure = 0.5 if len(leaks) == 3 + draws else 0.25
    return [
        finding("leak", mvs.FindingSource.MEASURED, sure,
                f"regurgitant orifice at 120 mmHg with chordae of {100 * factors[0]:.0f}, 100 and "
                f"{100 * factors[1]:.0f} % of their lengths: {shown[0]}, {shown[1]} and {shown[2]}",
                [value for value in (ends[0], middle, ends[1]) if value is not None], "m2"),
        finding("leak_interval", mvs.FindingSource.MEASURED, sure,
                f"{interval[0] * 1e6:.1f} to {interval[1] * 1e6:.1f} mm2 for lengths of chordae within that range"
                + (": sealed with all of them" if sealed else
                   f" and each {100 * SINGLE:.0f} % beside the others; {draws} closures with random ones are among "
                   "them"), interval, "m2"),
    ]


def _leak(valve: mvs.Valve, lengths: NDArray[np.float64]) -> Optional[float]:
    """The regurgitant orifice with other lengths, m2; None if the valve does not come to rest."""
    kept = valve.chord_rest_length
    valve.chord_rest_length = lengths
    try:
        _, closed, stats = settled(valve)
    except mvs.Error:
        return None
    finally:
        valve.chord_rest_length = kept
    return closed.measures.regurgitant_orifice_area if stats.converged else None


def _mm2(leak: Optional[float]) -> str:
    return "not at rest" if leak is None else f"{leak * 1e6:.1f} mm2"
