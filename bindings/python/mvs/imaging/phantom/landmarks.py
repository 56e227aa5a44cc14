"""Landmarks of a valve in mm, LPS: annulus, commissures, anterior point, tips of papillary muscles."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..._core import Snapshot
from .anatomy import Anatomy
from .settings import Settings
from .truth import MM

Points = NDArray[np.float64]


@dataclasses.dataclass(frozen=True)
class LandmarkSet:
    """Points (k, 3) in mm, with names; closed: they are a closed curve in order."""

    points: Points
    names: tuple[str, ...]
    closed: bool = False


def landmarks_of(
    snapshot: Snapshot, anatomy: Anatomy, settings: Settings, stage: int
) -> dict[str, LandmarkSet]:
    """The landmarks by name, displaced by the settings' landmark_error, as an observer places them.

    stage: 0 open, 1 loaded: each has its own errors
    """
    nodes = MM * np.asarray(snapshot.node_position)
    loop = nodes[np.asarray(snapshot.annulus_nodes)]
    ends = commissure_nodes(snapshot)
    x = (nodes[ends] - nodes[ends].mean(axis=0)) @ snapshot.frame.axes[1] if ends else np.zeros(0)
    order = np.argsort(-x)  # the anatomical frame's CC axis points to the posteromedial commissure
    named = {
        "annulus": LandmarkSet(_every(loop, 24), (), True),
        "commissures": LandmarkSet(
            nodes[np.array(ends, dtype=int)[order]].reshape(-1, 3),
            ("posteromedial", "anterolateral")[: len(ends)] if len(ends) <= 2 else
            tuple(f"commissure {k + 1}" for k in range(len(ends))),
        ),
        "anterior": LandmarkSet(_anterior(snapshot, nodes)[None], ("anterior",)),
        "tips": LandmarkSet(anatomy.tips, tuple(f"PM{k + 1}" for k in range(len(anatomy.tips)))),
    }
    random = np.random.default_rng([settings.seed, 3, stage])
    for name, landmark in named.items():
        error = settings.landmark_error * random.normal(size=landmark.points.shape)
        named[name] = dataclasses.replace(landmark, points=landmark.points + error)
    return named


def commissure_nodes(snapshot: Snapshot) -> list[int]:
    """The nodes of the annulus at which two leaflets meet, in the order of the annulus."""
    leaflets: dict[int, set[int]] = {}
    for nodes, leaflet in zip(
        np.asarray(snapshot.triangle_nodes).tolist(), np.asarray(snapshot.triangle_leaflet).tolist()
    ):
        for n in nodes:
            leaflets.setdefault(n, set()).add(leaflet)
    return [int(n) for n in snapshot.annulus_nodes if len(leaflets[int(n)]) > 1]


def write_landmarks(path: Path, landmarks: LandmarkSet) -> None:
    """Writes a .mrk.json of 3D Slicer, LPS and mm stated, positions to 1 um."""
    points = [
        {"id": str(k + 1), "label": landmarks.names[k] if landmarks.names else f"{k + 1}",
         "position": [round(float(v), 3) for v in point], "positionStatus": "defined"}
        for k, point in enumerate(landmarks.points)
    ]
    markup = {
        "type": "ClosedCurve" if landmarks.closed else "Fiducial",
        "coordinateSystem": "LPS", "coordinateUnits": "mm", "controlPoints": points,
    }
    schema = (
        "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/"
        "Schema/markups-schema-v1.0.3.json#"
    )
    path.write_text(json.dumps({"@schema": schema, "markups": [markup]}, indent=1) + "\n")


def _every(loop: Points, count: int) -> Points:
    """About `count` points of a loop, at equal distances along it."""
    closed = np.vstack([loop, loop[:1]])
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    at = np.linspace(0, along[-1], count, endpoint=False)
    return np.stack([np.interp(at, along, closed[:, k]) for k in range(3)], axis=1)


def _anterior(snapshot: Snapshot, nodes: Points) -> Points:
    """The centroid of the anterior leaflet's triangles, the first leaflet's if none is named A."""
    names = [p.name.upper() for p in snapshot.parts if p.kind.name == "LEAFLET"]
    which = next((k for k, name in enumerate(names) if name.startswith("A")), 0)
    own = np.asarray(snapshot.triangle_nodes)[np.asarray(snapshot.triangle_leaflet) == which]
    centres = nodes[own].mean(axis=1)
    middle = centres.mean(axis=0)
    return np.asarray(centres[np.argmin(((centres - middle) ** 2).sum(axis=1))])
