"""Rest lengths at which the slack chordae of a closed valve are taut at almost no tension.

A slack chord between points that do not move with it becomes taut at its length. A branch point
whose chordae are all slack hangs somewhere: its chordae become taut together where it is in equilibrium,
under any positive tensions. Taken is the point with the least sum of (d / L)^POWER over its chordae, d their
lengths there and L their rest lengths: about the first at which they pull if all become shorter by one
factor, and the gradient of that sum is the balance of tensions.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .. import _core

Array = NDArray[np.float64]

STRAIN = 1e-5
"""Largest strain of a chord that becomes taut. Its leaflet gives way, a hundred times softer, so that some 1e-6 N of
3e-4 N are left: still above the tension below which a sensitivity takes a branch point as slack."""
IDLE = 1e-4
"""N, a tension below which a chord is taken as slack."""
POWER = 6
SWEEPS = 40


def just_taut(closed: _core.Snapshot, trees: bool = True) -> tuple[Array, Array]:
    """Rest lengths (c,) of all chordae, those of taut ones as they are, and positions (n, 3) of all nodes.
    trees: False: chordae of branch points that hang slack stay slack."""
    x = np.array(closed.node_position)
    ends = np.array(closed.chord_nodes, np.int64)
    rest = np.array(closed.chord_rest_length)
    slack = np.array(closed.chord_tension) < IDLE
    strain = np.full(len(rest), STRAIN)
    idle = _idle_nodes(closed, ends, slack)
    at = idle[ends].any(axis=1)
    if at.any() and not trees:
        slack = slack & ~at
    elif at.any():
        pull = _balanced(x, ends[at], rest[at], idle)
        stretched = pull / (np.array(closed.chord_young) * np.array(closed.chord_area))[at]
        # a tenth of it at least, which the solution above rounding needs
        strain[at] = np.clip(STRAIN * stretched / stretched.max(), 0.1 * STRAIN, STRAIN)
    length = np.linalg.norm(x[ends[:, 1]] - x[ends[:, 0]], axis=1)
    return np.where(slack, length / (1 + strain), rest), x


def _idle_nodes(closed: _core.Snapshot, ends: NDArray[np.int64], slack: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Branch points of which no chord pulls."""
    idle = np.zeros(len(closed.node_position), bool)
    idle[ends.ravel()] = True
    idle[np.asarray(closed.triangle_nodes).ravel()] = False
    idle[np.asarray(closed.head_nodes)] = False
    idle[ends[~slack].ravel()] = False
    return idle


def _balanced(x: Array, ends: NDArray[np.int64], rest: Array, idle: NDArray[np.bool_]) -> Array:
    """Moves the idle points of x to the least sum, by damped reweighted least squares. Returns the tension
    of each chord, up to a factor."""
    nodes = np.flatnonzero(idle & np.isin(np.arange(len(x)), ends))
    row = np.full(len(x), -1)
    row[nodes] = np.arange(len(nodes))
    weight = rest**-2.0
    for sweep in range(SWEEPS):
        matrix, right = np.zeros((len(nodes), len(nodes))), np.zeros((len(nodes), 3))
        for (a, b), w in zip(ends, weight):
            for i, j in ((a, b), (b, a)):
                if row[i] < 0:
                    continue
                matrix[row[i], row[i]] += w
                if row[j] < 0:
                    right[row[i]] += w * x[j]
                else:
                    matrix[row[i], row[j]] -= w
        found = np.linalg.solve(matrix, right)
        x[nodes] = found if sweep == 0 else x[nodes] + (found - x[nodes]) / (POWER - 1)
        ratio = np.linalg.norm(x[ends[:, 1]] - x[ends[:, 0]], axis=1) / rest
        weight = (ratio / ratio.max()) ** (POWER - 2) / rest**2
    return np.asarray(weight * ratio * rest)
