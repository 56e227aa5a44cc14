"""Is FEBio's closed shape at rest, and for which shell? A solid shell of our own asks it.

FEBio's shells have nodes on two faces, so that their thickness changes evenly through it: under
bending, where one face wants to thicken and the other to thin, an almost incompressible tissue
(bulk modulus 20 MPa beside a shear modulus of 37 kPa) cannot follow, and the shell is as stiff in
bending as its bulk modulus says. This is the thickness locking of six-parameter shells (Buechter,
Ramm and Roehl, Int. J. Numer. Methods Eng. 37, 1994), (K + 4 G / 3) (1 - nu^2) / E = 136 times too
stiff here. Let the volume change only as a mean over each element (the mean dilatation of
Nagtegaal, Parks and Rice, 1974), and the locking is gone.

The test: nodes of FEBio's shape that touch another leaflet stay where they are, and all others
find their rest under the same pressure, chordae and tissue. Where they stay, it was at rest.
Nothing of libmvs is used. Energies in J, lengths in m; the minimiser works in mm and mJ.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize

THICKNESS = 1e-3
C, A, IC, S = 18.49e3, 3146e3, 3.1611, 0.006  # the law of the file
BULK = 20e6  # Pa
PRESSURE = 15998.7  # Pa
TOUCHING = 1.6e-3  # m; FEBio's gap at rest is about 1.15 mm
ELSEWHERE = 6e-3  # m apart at rest: another piece of sheet


@dataclass
class Shell:
    """Bricks of 8 nodes with 2 x 2 x 2 points; the back nodes follow those of the mesh."""

    corners: np.ndarray  # (q, 8)
    slopes: np.ndarray  # (q, 8 points, 8 nodes, 3): shape functions by rest position
    volume: np.ndarray  # (q, 8 points), m3
    locked: bool

    def energy(self, nodes: np.ndarray) -> tuple[float, np.ndarray]:
        """Energy and its gradient (n, 3); infinite where a brick is turned inside out."""
        f = np.einsum("qai,qpaj->qpij", nodes[self.corners], self.slopes)
        j = np.linalg.det(f)
        if (j <= 0).any():
            return np.inf, np.zeros_like(nodes)
        inverse = np.linalg.inv(f).transpose(0, 1, 3, 2)
        scale = j ** (-2 / 3)
        i1 = (f**2).sum(axis=(2, 3))
        w, w1 = self._law(i1 * scale)
        total = self.volume.sum(axis=1, keepdims=True)
        dilated = j if self.locked else (self.volume * j).sum(axis=1, keepdims=True) / total
        share = self.volume if self.locked else total
        energy = (self.volume * w).sum() + (share * BULK / 2 * np.log(dilated) ** 2).sum()
        pressure = BULK * np.log(dilated) / dilated * j
        shear = (2 * w1 * scale)[..., None, None] * (f - i1[..., None, None] / 3 * inverse)
        stress = shear + pressure[..., None, None] * inverse
        force = np.einsum("qpij,qpaj,qp->qai", stress, self.slopes, self.volume)
        gradient = np.zeros_like(nodes)
        np.add.at(gradient, self.corners.ravel(), force.reshape(-1, 3))
        return float(energy), gradient

    @staticmethod
    def _law(i1: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        def integral(x: np.ndarray) -> np.ndarray:
            root = np.sqrt(x * x + S * S)
            return (x * x + x * root + S * S * np.log(x + root)) / 4

        x = i1 - IC
        w = C * (i1 - 3) + A * (integral(x) - integral(np.array(3 - IC)))
        return w, C + A / 2 * (x + np.sqrt(x * x + S * S))


def shell_of(rest: np.ndarray, quads: np.ndarray, locked: bool) -> Shell:
    """The shell of a mesh; rest (2 n, 3): its nodes, then those of the back."""
    corners = np.concatenate([quads, quads + len(rest) // 2], axis=1)
    at = 1 / np.sqrt(3)
    slopes, volume = [], []
    for x in (-at, at):
        for y in (-at, at):
            for z in (-at, at):
                flat = np.array([(1 - x) * (1 - y), (1 + x) * (1 - y), (1 + x) * (1 + y),
                                 (1 - x) * (1 + y)]) / 4
                dx = np.array([-(1 - y), 1 - y, 1 + y, -(1 + y)]) / 4
                dy = np.array([-(1 - x), -(1 + x), 1 + x, 1 - x]) / 4
                here = np.concatenate([
                    np.column_stack([dx * (1 + z) / 2, dy * (1 + z) / 2, flat / 2]),
                    np.column_stack([dx * (1 - z) / 2, dy * (1 - z) / 2, -flat / 2]),
                ])
                jacobian = np.einsum("qai,aj->qij", rest[corners], here)
                slopes.append(np.einsum("aj,qji->qai", here, np.linalg.inv(jacobian)))
                volume.append(np.abs(np.linalg.det(jacobian)))
    return Shell(corners, np.stack(slopes, 1), np.stack(volume, 1), locked)


class Case:
    """FEBio's shape with the nodes that touch another leaflet, and the annulus, held."""

    def __init__(self, theirs) -> None:
        from febio_case import normals

        self.theirs, self.count = theirs, len(theirs.opened) - len(theirs.heads)
        self.shape = theirs.closed[: self.count]
        opened = theirs.opened[: self.count]
        back = opened - THICKNESS * normals(theirs.opened, theirs.quads)[: self.count]
        self.rest = np.concatenate([opened, back])
        self.back = self.shape - THICKNESS * normals(theirs.closed, theirs.quads)[: self.count]
        held = self._touching()
        held[theirs.annulus] = True
        self.free = np.flatnonzero(~held)
        self.held = int(held.sum()) - len(theirs.annulus)

    def _touching(self) -> np.ndarray:
        weights = np.array([[a * b, (1 - a) * b, (1 - a) * (1 - b), a * (1 - b)]
                            for a in np.linspace(0, 1, 7) for b in np.linspace(0, 1, 7)])
        points, rest = (
            np.einsum("wk,qkc->wqc", weights, n[self.theirs.quads]).reshape(-1, 3)
            for n in (self.theirs.closed, self.theirs.opened)
        )
        touching = np.zeros(self.count, dtype=bool)
        for k in range(self.count):
            other = np.linalg.norm(rest - self.rest[k], axis=1) > ELSEWHERE
            touching[k] = np.linalg.norm(points[other] - self.shape[k], axis=1).min() < TOUCHING
        return touching

    def chords(self, nodes: np.ndarray) -> tuple[float, np.ndarray]:
        """Energy of the chordae with FEBio's smoothed law, and its gradient."""
        head, leaflet = self.theirs.chords.T
        way = nodes[leaflet] - self.theirs.closed[head]
        length, s = np.linalg.norm(way, axis=1), 0.02e-3
        u = length - self.theirs.rest_length
        root = np.sqrt(u * u + s * s)
        stiffness = 31.416 / self.theirs.rest_length
        gradient = np.zeros_like(nodes)
        np.add.at(gradient, leaflet, (stiffness * (u + root) / 2 / length)[:, None] * way)
        energy = stiffness * (u * u + u * root + s * s * np.arcsinh(u / s)) / 4
        return float(energy.sum()), gradient

    def push(self, nodes: np.ndarray) -> np.ndarray:
        """Forces of the pressure on the nodes of the mesh."""
        corners = nodes[self.theirs.quads]
        area = 0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        force = np.zeros_like(nodes)
        for k in range(4):
            np.add.at(force, self.theirs.quads[:, k], PRESSURE * area / 4)
        return force

    def rest_of(self, locked: bool) -> np.ndarray:
        """Displacements of the free nodes to their rest, m. The pressure is updated three times."""
        shell = shell_of(self.rest, self.theirs.quads, locked)
        nodes, back, free = self.shape.copy(), self.back, len(self.free)
        for _ in range(3):
            push = self.push(nodes)

            def potential(mm: np.ndarray) -> tuple[float, np.ndarray]:
                moved = mm.reshape(-1, 3) * 1e-3
                trial = self.shape.copy()
                trial[self.free] = moved[:free]
                energy, gradient = shell.energy(np.concatenate([trial, moved[free:]]))
                chords, pull = self.chords(trial)
                force = gradient[: self.count] + pull - push
                total = min(energy + chords - (push * trial).sum(), 1e6)
                return total * 1e3, np.concatenate(
                    [force[self.free], gradient[self.count :]]).ravel()

            start = np.concatenate([nodes[self.free], back]).ravel() * 1e3
            options = {"maxiter": 4000, "maxfun": 5000, "maxcor": 60, "ftol": 1e-15, "gtol": 1e-6}
            found = minimize(potential, start, jac=True, method="L-BFGS-B", options=options)
            moved = found.x.reshape(-1, 3) * 1e-3
            nodes[self.free], back = moved[:free], moved[free:]
        return np.linalg.norm(nodes - self.shape, axis=1)[self.free]


def table(theirs) -> str:
    """How far FEBio's shape is from rest for either shell, in mm."""
    case = Case(theirs)
    lines = [f"{len(case.free)} nodes of FEBio's shape let go, {case.held} that touch held, with a "
             "shell of our own; they move, mm:"]
    for locked in (True, False):
        way = case.rest_of(locked) * 1e3
        name = "incompressible at every point" if locked else "in the mean of each element"
        lines.append(f"  {name:30} RMS {np.sqrt((way**2).mean()):.2f}, median "
                     f"{np.median(way):.2f}, max {way.max():.2f}")
    return "\n".join(lines)
