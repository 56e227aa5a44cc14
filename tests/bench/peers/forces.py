"""The law of the valve written plainly in NumPy: energies and forces of every term.

The same law as libmvs's springs (libmvs/energy/README.md), except contact: here a vertex feels the
nearest facing point of the other sheet only, not the sum over all of it.
"""

from __future__ import annotations

import numpy as np
from contact import Contact
from scipy.sparse import csr_array
from valve import Valve


def scatter(columns: np.ndarray, nodes: int) -> csr_array:
    """The matrix that adds the value of each row of `columns`, in turn, to its nodes."""
    flat = columns.T.ravel()
    return csr_array((np.ones(len(flat)), (flat, np.arange(len(flat)))), shape=(nodes, len(flat)))


class Cables:
    """Forces along straight lines: springs of the sheet, chordae."""

    def __init__(self, ends: np.ndarray, nodes: int) -> None:
        self.a, self.b = ends[:, 0], ends[:, 1]
        ones = np.ones(len(ends))
        row = np.arange(len(ends))
        self.difference = csr_array(
            (np.concatenate([ones, -ones]),
             (np.concatenate([row, row]), np.concatenate([self.b, self.a]))),
            shape=(len(ends), nodes))
        self.add = self.difference.T.tocsr()

    def lengths(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Vectors from the first ends to the second ones, and their lengths."""
        d = self.difference @ x
        return d, np.sqrt((d * d).sum(axis=1))


class Law:
    """All terms: `forces` are the true ones, `energy` a potential of them at a frozen free edge."""

    def __init__(self, valve: Valve, contact: str = "barrier") -> None:
        n = len(valve.nodes)
        self.valve, self.free = valve, ~valve.fixed
        self.sheet, self.cords = Cables(valve.springs, n), Cables(valve.chords, n)
        self.to_corners = scatter(valve.triangles, n)
        self.to_hinges = scatter(valve.hinges, n)
        self.rest_angle = self._angles(valve.nodes)[0]
        self.contact = Contact(valve, contact) if contact != "none" else None
        self.rim = self._free_edges()

    def _free_edges(self) -> np.ndarray:
        """Edges of one triangle whose ends are not both held, in the order of that triangle."""
        t = self.valve.triangles.astype(np.int64)
        edges = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
        key = edges.min(axis=1) * len(self.valve.nodes) + edges.max(axis=1)
        _, first, count = np.unique(key, return_index=True, return_counts=True)
        rim = edges[first[count == 1]]
        return rim[~self.valve.fixed[rim].all(axis=1)]

    def pressure_forces(self, x: np.ndarray) -> np.ndarray:
        """A third of p A n on each corner, n the normal as it is now."""
        a, b, c = (x[self.valve.triangles[:, k]] for k in range(3))
        third = np.cross(b - a, c - a) * (float(self.valve.pressure[0]) / 6)
        return self.to_corners @ np.concatenate([third, third, third])

    def chord_forces(self, x: np.ndarray) -> np.ndarray:
        """Tension only."""
        d, length = self.cords.lengths(x)
        strain = np.maximum(length / self.valve.chord_length - 1, 0)
        return -(self.cords.add @ (d * (self.valve.chord_stiffness * strain / length)[:, None]))

    def spring_forces(self, x: np.ndarray) -> np.ndarray:
        """Bilinear, in tension and in compression alike."""
        d, length = self.sheet.lengths(x)
        low, high, kink = self.valve.spring_law
        strain = length / self.valve.spring_length - 1
        stress = low * strain + (high - low) * np.maximum(strain - kink, 0)
        tension = stress * self.valve.spring_volume / self.valve.spring_length
        return -(self.sheet.add @ (d * (tension / length)[:, None]))

    def _angles(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Hinge angles and their derivatives by the four nodes, one node after the other."""
        x0, x1, x2, x3 = (x[self.valve.hinges[:, k]] for k in range(4))
        e = x1 - x0
        length = np.sqrt((e * e).sum(axis=1))
        n1, n2 = np.cross(e, x2 - x0), np.cross(x3 - x0, e)
        angle = np.arctan2((np.cross(n1, n2) * e).sum(axis=1) / length, (n1 * n2).sum(axis=1))
        m1 = n1 / (n1 * n1).sum(axis=1)[:, None]
        m2 = n2 / (n2 * n2).sum(axis=1)[:, None]
        s2 = ((x2 - x0) * e).sum(axis=1) / length
        s3 = ((x3 - x0) * e).sum(axis=1) / length
        slope = np.concatenate([(length - s2)[:, None] * m1 + (length - s3)[:, None] * m2,
                                s2[:, None] * m1 + s3[:, None] * m2,
                                -length[:, None] * m1, -length[:, None] * m2])
        return angle, slope

    def bending(self, x: np.ndarray) -> tuple[float, np.ndarray]:
        """Energy and forces of the hinges."""
        angle, slope = self._angles(x)
        bent = np.remainder(angle - self.rest_angle + np.pi, 2 * np.pi) - np.pi
        moment = self.valve.hinge_stiffness * bent
        energy = 0.5 * float((moment * bent).sum())
        return energy, -(self.to_hinges @ (np.tile(moment, 4)[:, None] * slope))

    def forces(self, x: np.ndarray) -> np.ndarray:
        """Out-of-balance forces, zero on fixed nodes."""
        f = self.spring_forces(x) + self.chord_forces(x) + self.pressure_forces(x)
        f += self.bending(x)[1]
        if self.contact:
            f += self.contact.evaluate(x)[1]
        f[~self.free] = 0
        return f

    def frozen_rim(self, x: np.ndarray) -> np.ndarray:
        """The follower force less the gradient of p V: it has no potential (physics/pressure.h)."""
        a, b = x[self.rim[:, 0]], x[self.rim[:, 1]]
        turn = np.cross(a, b) * (float(self.valve.pressure[0]) / 6)
        extra = np.zeros_like(x)
        np.add.at(extra, self.rim.T.ravel(), np.concatenate([turn, turn]))
        return extra

    def energy(self, x: np.ndarray, frozen: np.ndarray) -> tuple[float, np.ndarray]:
        """Potential with the part of the pressure at the free edge held at `frozen`; its forces."""
        v = self.valve
        strain = self.sheet.lengths(x)[1] / v.spring_length - 1
        low, high, kink = v.spring_law
        beyond = np.maximum(strain - kink, 0)
        total = 0.5 * float((v.spring_volume * (low * strain**2 + (high - low) * beyond**2)).sum())
        stretch = np.maximum(self.cords.lengths(x)[1] / v.chord_length - 1, 0)
        total += 0.5 * float((v.chord_stiffness * v.chord_length * stretch**2).sum())
        a, b, c = (x[v.triangles[:, k]] for k in range(3))
        total -= float(v.pressure[0]) / 6 * float((a * np.cross(b, c)).sum())
        total -= float((frozen * x).sum())
        total += self.bending(x)[0]
        if self.contact:
            total += self.contact.evaluate(x)[0]
        return total, self.forces(x) - self.frozen_rim(x) + frozen
