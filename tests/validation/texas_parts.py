"""The parts of the model that `texas_tables.py` changes, one at a time, on the Texas valve."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Callable, Iterator

import mvs
import numpy as np
from texas import MM, AbaqusFrame, Change, split_other_way


def variants(frame: AbaqusFrame) -> Iterator[tuple[str, dict[str, Any]]]:
    """One change of the model: arguments of open_valve and of close."""
    yield "nothing", {}
    yield "mesh: 1,450 vertices", {"vertices": 1450}
    yield "mesh: 1,550 vertices", {"vertices": 1550}
    yield "mesh: quads cut along the other diagonal", {"change_mesh": split_other_way(frame)}
    yield "solver: implicit", {"solver": "implicit"}
    yield "path: 2 increments", {"increments": 2}
    yield "path: 8 increments", {"increments": 8}
    for thickness in (0.16e-3, 0.4e-3, 0.65e-3):
        yield (f"contact thickness {thickness * MM:g} mm (0.234)",
               {"change": setting("contact_thickness", lambda _, t=thickness: t)})
    for factor in (0.25, 4):
        yield (f"contact stiffness x {factor:g}",
               {"change": setting("contact_stiffness", lambda old, f=factor: f * old)})
    for scale in (0.0, 4.0, 10.0):
        yield (f"bending scale {scale:g} (1)",
               {"change": setting("bending_scale", lambda _, s=scale: s)})
    yield "chordae: no slack", {"change": taut}
    yield "chordae: linear, 40 MPa", {"change": linear_chordae}
    yield "leaflets: neo-Hookean, same modulus at rest", {"change": neo_hookean}
    for name, law in (("membrane", mvs.LeafletLaw.BILINEAR), ("springs", mvs.LeafletLaw.SPRING)):
        yield f"leaflets: bilinear {name}, 0.1 and 6 MPa", {"change": lawful(law)}
        yield f"leaflets: bilinear {name}, fitted", {"change": fitted(law)}
    yield "founding model: springs, linear chordae", {"change": founding}


def setting(name: str, value: Callable[[float], float]) -> Change:
    """The valve with another value of one constant."""
    return lambda valve: setattr(valve, name, value(getattr(valve, name)))


def taut(valve: mvs.Valve) -> None:
    """No chord is longer at rest than the distance of its ends."""
    ends = valve.nodes[valve.chord_nodes]
    straight = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    valve.chord_rest_length = np.minimum(valve.chord_rest_length, straight)


def linear_chordae(valve: mvs.Valve) -> None:
    """The founding paper's chordae, of 40 MPa, with the areas of the file."""
    count = len(valve.chord_nodes)
    valve.chord_law = np.full(count, mvs.ChordLaw.LINEAR, dtype=np.uint32)
    valve.chord_young = np.full(count, 40e6)
    valve.chord_constants = None


def neo_hookean(valve: mvs.Valve) -> None:
    """W = mu / 2 (I1 - 3) with mu = C0: the exponential of the file's law adds nothing at rest."""
    valve.leaflets = [
        replace(leaflet, law=mvs.LeafletLaw.NEO_HOOKEAN, constants=leaflet.constants[:1])
        for leaflet in valve.leaflets
    ]


def lawful(law: mvs.LeafletLaw) -> Change:
    """Leaflets of a law with its default constants, which the founding paper has: no tissue's."""

    def change(valve: mvs.Valve) -> None:
        valve.leaflets = [replace(each, law=law, constants=()) for each in valve.leaflets]

    return change


def fitted(law: mvs.LeafletLaw) -> Change:
    """Bilinear leaflets with the tangents of the file's law, pulled one way, at rest and loaded."""
    constants_of = two_lines if law == mvs.LeafletLaw.SPRING else smooth_lines

    def change(valve: mvs.Valve) -> None:
        valve.leaflets = [
            replace(each, law=law, constants=constants_of(*each.constants[:3]))
            for each in valve.leaflets
        ]

    return change


FIT_STRESS = 50e3
"""Pa, nominal: above the median of the closed leaflets, which is 36 kPa (Cauchy)"""


def two_lines(c0: float, c1: float, c2: float) -> tuple[float, ...]:
    """Constants of springs: Young's moduli below and above the kink, Pa, and its strain."""
    stretch, slope = loaded_tangent(c0, c1, c2)
    low = 3 * c0
    return low, slope, (slope * (stretch - 1) - FIT_STRESS) / (slope - low)


def smooth_lines(c0: float, c1: float, c2: float) -> tuple[float, ...]:
    """Constants c, a, Ic, s of the membrane dW/dI1 = c + a max(0, I1 - Ic), default smoothing.

    Pulled one way the nominal stress is 2 g dW/dI1 with g = l - 1/l^2, and dI1/dl = 2 g.
    """
    stretch, slope = loaded_tangent(c0, c1, c2)
    g, of_g = stretch - stretch**-2, 1 + 2 * stretch**-3
    a = (slope - FIT_STRESS * of_g / g) / (4 * g**2)
    c = c0 / 2
    return c, a, stretch**2 + 2 / stretch - (FIT_STRESS / (2 * g) - c) / a, 0.006


def loaded_tangent(c0: float, c1: float, c2: float) -> tuple[float, float]:
    """Stretch of the file's law pulled one way by FIT_STRESS, and the slope there, Pa."""
    stretch = np.linspace(1, 2, 100_001)
    more = stretch**2 + 2 / stretch - 3
    # far beyond that stress exp would leave the numbers
    slope_of_w = c0 / 2 + c1 * c2 * more * np.exp(np.minimum(c2 * more**2, 50))
    nominal = 2 * slope_of_w * (stretch - stretch**-2)
    k = int(np.searchsorted(nominal, FIT_STRESS))
    slope = (nominal[k + 1] - nominal[k - 1]) / (stretch[k + 1] - stretch[k - 1])
    return float(stretch[k]), float(slope)


def founding(valve: mvs.Valve) -> None:
    """Springs and linear chordae, everything else as in the file."""
    lawful(mvs.LeafletLaw.SPRING)(valve)
    linear_chordae(valve)
