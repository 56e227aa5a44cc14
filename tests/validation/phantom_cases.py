"""Valves for phantoms.py: half generated, half from geometries that this library's generator did not make.

Each is drawn from a seed: dimensions, dilation of the annulus and lengths of chordae, so that some leak.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path

import kaiser
import mvs
import numpy as np
import surfaces_data

Case = tuple[str, Callable[[], mvs.Snapshot]]


def cases(folder: Path, count: int, seed: int) -> list[Case]:
    """`count` cases: generated, Kaiser's, generated, a real surface, and so on."""
    found: list[Case] = []
    for k in range(count):
        random = np.random.default_rng([seed, k])
        makers = (generated, on_ct_annulus, generated, on_real_surface)
        maker = makers[k % 4]
        name = ("generated", "Kaiser", "generated", "real surface")[k % 4]
        found.append((f"{k + 1} {name}", lambda m=maker, r=random: m(folder, r)))
    return found


def generated(_folder: Path, random: np.random.Generator) -> mvs.Snapshot:
    """A parametric valve of random dimensions; half of them with a dilated annulus."""
    dilated = random.uniform(1.0, 1.2) if random.random() < 0.5 else 1.0
    with mvs.Simulator() as sim:
        sim.generate(
            annulus_ap=random.uniform(23e-3, 29e-3), annulus_cc=random.uniform(31e-3, 39e-3),
            anterior_height=random.uniform(22e-3, 26e-3),
            posterior_height=random.uniform(12e-3, 15e-3),
            papillary_depth=random.uniform(21e-3, 26e-3), thickness=random.uniform(0.7e-3, 1.1e-3),
            annulus_scale=dilated,
        )
        return _with_chord_lengths(sim, random)


def on_ct_annulus(folder: Path, random: np.random.Generator) -> mvs.Snapshot:
    """Kaiser's valve on a real annulus with real heads, sheared and scaled by up to 8 %.

    Its fibres are strained in the shape taken as rest; its annulus and heads move as in that model.
    """
    valve, _ = kaiser.read(folder / kaiser.FILE)
    change = np.eye(3) + random.uniform(-0.08, 0.08, size=(3, 3))
    nodes = np.asarray(valve.nodes)
    chords = np.asarray(valve.chord_nodes)
    moved = nodes @ change.T
    scale = np.linalg.norm(moved[chords[:, 0]] - moved[chords[:, 1]], axis=1) / np.linalg.norm(
        nodes[chords[:, 0]] - nodes[chords[:, 1]], axis=1
    )
    valve.nodes = np.ascontiguousarray(moved)
    valve.nodes_loaded = np.ascontiguousarray(np.asarray(valve.nodes_loaded) @ change.T)
    valve.chord_rest_length = np.ascontiguousarray(valve.chord_rest_length * scale)
    valve.leaflets = [dataclasses.replace(leaf, thickness=0.8e-3) for leaf in valve.leaflets]
    with mvs.Simulator(log=lambda *_: None) as sim:
        sim.set_valve(valve)
        return _with_chord_lengths(sim, random)


def on_real_surface(folder: Path, random: np.random.Generator) -> mvs.Snapshot:
    """The real open valve from 3D ultrasound; chordae by normal anatomy, then made longer or shorter."""
    surface = surfaces_data.read_stl(folder / "real_mitral" / "open_1146.stl")
    with mvs.Simulator(log=lambda *_: None) as sim:
        sim.build_valve(**surface, thickness=random.uniform(0.7e-3, 1.0e-3))
        return _with_chord_lengths(sim, random)


def _with_chord_lengths(sim: mvs.Simulator, random: np.random.Generator) -> mvs.Snapshot:
    """Rest lengths of all chordae times 0.97 to 1.03, and of one half by up to 6 % more."""
    valve = mvs.valve_of(sim.snapshot())
    ends = valve.nodes[np.asarray(valve.chord_nodes)[:, 1]]
    side = (ends - ends.mean(axis=0)) @ sim.snapshot().frame.axes[1] > 0
    factor = random.uniform(0.97, 1.03) * np.where(side, random.uniform(1.0, 1.06), 1.0)
    valve.chord_rest_length = np.ascontiguousarray(valve.chord_rest_length * factor)
    valve.nodes_now = None
    sim.set_valve(valve)
    return sim.snapshot()
