"""A valve from grey volumes: leaflets built as from a surface, with the chordae that are seen."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
from numpy.typing import NDArray

import mvs
from mvs.mesh import edges_of, shortest_paths
from ..console import Console
from ..findings import finding
from ..labels import Leaflets, report_thickness
from ..mesh import Sheet
from ..open_valve import check_open_valve
from ..pipeline import Pipeline, Run
from ..valve import ImageValve, build, distance_from_image, scanned, usable_cores
from .chords import ChordNetwork
from .fitted import with_fitted_lengths
from .lengths import with_loaded_lengths
from .loaded import Closure, Loaded, loaded_of, settled, with_loaded_boundary
from .muscles import muscle_groups
from .stages import PIPELINE
from .tissue import with_tissue_of_image
from .unseen import with_unseen_chords

if TYPE_CHECKING:
    from mvs.editing import _FilledValve

Points = NDArray[np.float64]
MARGINAL, BASAL = 2.5e-3, 4e-3
"""m: insertions this near to the free edge are marginal, this near to the annulus basal"""
BARE_EDGE = 12e-3
"""m: chordae insert every 3 to 5 mm along the free edge; where none does over a longer stretch than this, images or the
valve lack some."""
LENGTH_ERROR, SINGLE_ERROR = 0.1, 0.1
"""Errors of all lengths together and of one beside the others, shares: of chordae in phantoms with voxels
of 0.2 to 0.3 mm the mean is 2 to 11 % off (tests/validation/phantoms.py)"""


def valve_of_volumes(image: Any, loaded: Optional[Any], landmarks: Mapping[str, Any],
                     loaded_landmarks: Mapping[str, Any], register: Optional[str], console: Console,
                     name: str = "valve", pipeline: Pipeline = PIPELINE, **options: Any) -> ImageValve:
    """Builds and closes the valve in a micro-CT-like volume; chordae are those in the image.

    loaded: the same valve under load: positions of annulus and heads, lengths of chordae
    """
    run = pipeline.run({"image": image, "tips": landmarks.get("papillary_tips")},
                       progress=console.stage)
    leaflets = leaflets_of_run(run)
    network: ChordNetwork = run["chords"]
    given = dict(landmarks)
    if given.get("papillary_tips") is None and network.heads:
        heads = network.nodes[:network.heads]
        group = muscle_groups(heads)
        given["papillary_tips"] = np.array([heads[group == k].mean(axis=0) for k in np.unique(group)])
    other: Optional[Loaded] = None
    if loaded is not None:
        other = loaded_of(loaded, image, landmarks, loaded_landmarks, register, pipeline, console,
                          run)
    console.stage("building and closing the valve")
    # closures with chordae that are not the patient's show nothing of the leak: they took most of the time
    made = build(leaflets, given, None, name, lambda done, _: console.share(done),
                 findings=tuple(other.findings if other else ()), leak=not network.heads, **options)
    if network.heads:
        made = with_chords(made, network, other, console, "leaflet" in options, options.get("thickness_error"))
        made.findings += _unused(options)
    made.image = scanned(image)
    if other is not None and loaded is not None:
        made.loaded, made.loaded_image = other.surface, scanned(loaded, other.motion)
        made.findings += (distance_from_image(made.closed, other.surface),)
    made.stages = run.table()
    return made


def leaflets_of_run(run: Run) -> Leaflets:
    """The leaflets of a segmentation; ArgumentError unless they are an open valve."""
    sheet = run["sheet"]
    leaflets = Leaflets(sheet, np.zeros(len(sheet.triangles), np.uint32), [])
    tissue = run["tissue"]
    leaflets.findings.append(finding(
        "segmentation", mvs.FindingSource.MEASURED, 0.7,
        f"{tissue}; {run['thick']}; {run['muscles']}; chordae: {run['chords']}"))
    check_open_valve(leaflets)
    report_thickness(sheet, leaflets.findings)
    return leaflets


def with_chords(made: ImageValve, network: ChordNetwork, loaded: Optional[Loaded], console: Console,
                tissue_known: bool = False, thickness_error: Optional[float] = None) -> ImageValve:
    """The valve with the chordae of the image in the place of assumed ones, closed again.

    thickness_error: m, for the interval of leaks; None: the thickness is exact
    """
    valve = mvs.valve_of(made.opened)
    vertex, moved = _vertices_of(made.opened, network)
    _set_chords(valve, made.opened, network, vertex)
    found = [_chord_finding(network, moved, bare_edge(made.opened, vertex), loaded is not None)]
    if loaded is not None:
        found += with_loaded_boundary(valve, network, loaded)
    laws: list[mvs.LeafletLaw] = []
    if loaded is None or tissue_known:
        console.stage("closing the valve with the chordae of the image")
        closure = settled(valve, console)
    else:
        tissue, closure, laws = with_tissue_of_image(valve, loaded.surface, console)
        found.append(tissue)
    if loaded is not None and closure[2].converged:
        console.stage("lengths of chordae under load")
        closure, measured = with_loaded_lengths(valve, closure[1], network, loaded, console)
        closure, fitted = _with_unseen_and_fitted(valve, made.opened, closure, laws, loaded.surface, console)
        measured += fitted
        replaced = {one.name for one in measured}
        found = [one for one in found if one.name not in replaced] + measured
    opened, closed, stats = closure
    console.stage("leak over the errors of the lengths")
    found += _leaks(opened, console, thickness_error)
    assumed = ("chordae", "leak", "leak_interval", "leak_at_rest", "leak_limits", "edge_error", "edge_lost",
               "thickness_error", "papillary_tips")
    kept = [one for one in made.findings if one.name not in assumed]
    return dataclasses.replace(made, opened=opened, closed=closed, converged=stats.converged,
                               findings=(*kept, *found))


def _with_unseen_and_fitted(valve: _FilledValve, normal: mvs.Snapshot, closure: Closure, laws: list[mvs.LeafletLaw],
                            loaded: Sheet, console: Console) -> tuple[Closure, list[mvs.Finding]]:
    """Adds chordae that are not seen, and fits the lengths of all. Where no fit is nearer to the loaded image, those seen are
    fitted alone, and the nearer valve is taken.
    """
    seen = dataclasses.replace(valve)
    unseen = with_unseen_chords(valve, normal, closure[1], loaded)
    if not unseen:
        return with_fitted_lengths(valve, closure, laws, loaded, console)
    console.stage("closing the valve with chordae that are not seen")
    filled, fitted = with_fitted_lengths(valve, settled(valve, console), laws, loaded, console)
    if len(fitted[0].values):
        return filled, unseen + fitted
    bare, of_bare = with_fitted_lengths(seen, closure, laws, loaded, console)
    away = [float(distance_from_image(one[1], loaded).values[0]) for one in (bare, filled)]
    return (bare, of_bare) if away[0] < away[1] else (filled, unseen + fitted)


UNUSED = {"edge_error": "--edge-error", "edge_lost": "--edge-lost", "chords": "--chords",
          "coaptation_length": "--coaptation-length", "closed_error": "--closed-error"}
"""Options of a build without use where chordae are those of the image"""


def _unused(options: Mapping[str, Any]) -> tuple[mvs.Finding, ...]:
    """A doubtful finding on options that change nothing."""
    given = [option for name, option in UNUSED.items() if name in options]
    if not given:
        return ()
    return (dataclasses.replace(finding(
        "unused_options", mvs.FindingSource.GIVEN, 1.0,
        f"{', '.join(given)} {'has' if len(given) == 1 else 'have'} no effect here: the chordae are those of the image, "
        "and the interval of leaks is that of their lengths and of the thickness"), doubtful=True),)


def _leaks(opened: mvs.Snapshot, console: Console, thickness_error: Optional[float]) -> tuple[mvs.Finding, ...]:
    """Findings `leak`, `leak_interval` and `leak_limits` over the errors of the lengths."""
    with mvs.Simulator(workers=usable_cores()) as sim:
        sim.restore(opened)
        return sim.find_leak_interval(lengths=LENGTH_ERROR, single=SINGLE_ERROR, thickness=thickness_error,
                                      progress=lambda done, _: console.share(done))


def _vertices_of(opened: mvs.Snapshot, network: ChordNetwork) -> tuple[NDArray[np.int64], Points]:
    """A leaflet vertex of its own for each insertion, the nearest ones in all (linear assignment)."""
    from ..needs import need

    kinds = np.asarray(opened.node_kind)
    free = np.flatnonzero(kinds == mvs.NodeKind.LEAFLET)
    ends = network.nodes[network.heads + network.branches:]
    away = np.linalg.norm(ends[:, None] - np.asarray(opened.node_rest)[free][None], axis=2)
    rows, columns = need("scipy.optimize").linear_sum_assignment(away)
    return free[columns[np.argsort(rows)]], away[rows, columns]


def _set_chords(valve: _FilledValve, opened: mvs.Snapshot, network: ChordNetwork,
                vertex: NDArray[np.int64]) -> None:
    kinds = np.asarray(opened.node_kind)
    count = int((kinds <= mvs.NodeKind.ANNULUS).sum())
    first = network.heads + network.branches
    inner = network.nodes[:first]
    valve.nodes = np.vstack([valve.nodes[:count], inner])
    place = np.concatenate([count + np.arange(first), vertex])
    ends = place[network.segments]
    rest = network.length.copy()
    for k, ((_, b), line) in enumerate(zip(network.segments, network.lines)):
        if b >= first:
            # the end moves to the vertex: the length changes as seen from 3 mm before it
            near = line[max(0, len(line) - 1 - int(3e-3 / max(rest[k] / len(line), 1e-6)))]
            rest[k] += float(np.linalg.norm(valve.nodes[place[b]] - near)
                             - np.linalg.norm(line[-1] - near))
    chords = len(ends)
    valve.chord_nodes = ends.astype(np.uint32)
    valve.chord_rest_length = rest
    valve.chord_area = np.pi / 4 * network.diameter ** 2
    valve.chord_kind = _kinds(opened, network, vertex, first)
    valve.chord_young = np.full(chords, np.median(valve.chord_young))
    valve.chord_law = np.full(chords, valve.chord_law[0], np.uint32)
    valve.chord_constants = np.tile(valve.chord_constants[0], (chords, 1))
    valve.head_nodes = (count + np.arange(network.heads)).astype(np.uint32)
    for field in ("chord_id", "chord_names", "head_id", "head_names", "node_origin", "nodes_loaded",
                  "nodes_open", "nodes_now"):
        setattr(valve, field, None)


def _kinds(opened: mvs.Snapshot, network: ChordNetwork, vertex: NDArray[np.int64],
           first: int) -> NDArray[np.uint32]:
    """Kind of each segment by the distance of its insertion from free edge and annulus."""
    points = np.asarray(opened.node_rest)
    edges = edges_of(np.asarray(opened.triangle_nodes, np.int64))
    to_edge, _ = shortest_paths(points, edges, np.asarray(opened.free_edge_nodes, np.int64))
    to_annulus, _ = shortest_paths(points, edges, np.asarray(opened.annulus_nodes, np.int64))
    kinds = []
    for _, b in network.segments:
        if b < first:
            kinds.append(mvs.ChordKind.TRUNK)
            continue
        node = vertex[b - first]
        kinds.append(mvs.ChordKind.MARGINAL if to_edge[node] < MARGINAL else
                     mvs.ChordKind.BASAL if to_annulus[node] < BASAL else mvs.ChordKind.ROUGH_ZONE)
    return np.array(kinds, np.uint32)


def bare_edge(opened: mvs.Snapshot, vertex: NDArray[np.int64]) -> float:
    """The longest stretch of the free edge, m, without insertions (leaflet vertices) within BASAL of it."""
    edge = np.asarray(opened.node_rest)[np.asarray(opened.free_edge_nodes, np.int64)]
    at = np.append(0.0, np.cumsum(np.linalg.norm(np.roll(edge, -1, axis=0) - edge, axis=1)))
    away = np.linalg.norm(np.asarray(opened.node_rest)[vertex][:, None] - edge[None], axis=2)
    places = np.sort(at[away.argmin(axis=1)[away.min(axis=1) < BASAL]])
    if not len(places):
        return float(at[-1])
    return float(np.diff(np.append(places, places[0] + at[-1])).max())


def _chord_finding(network: ChordNetwork, moved: Points, bare: float, is_loaded: bool) -> mvs.Finding:
    lacks = bare > BARE_EDGE
    return finding(
        "chordae", mvs.FindingSource.MEASURED, 0.3 if lacks else 0.7,
        f"{network}; their ends moved by {1e3 * np.median(moved):.2f} mm in the median, at most "
        f"{1e3 * moved.max():.2f} mm, to vertices of the mesh; rest lengths are the lengths in the open "
        "image, slack arcs included"
        + (f"; along {1e3 * bare:.0f} mm of the free edge none is seen" if lacks else "")
        + (": if the valve has chordae there, it leaks too much; give the loaded image, whose leaflets tell the lengths of "
           "chordae that are not seen" if lacks and not is_loaded else ""),
        network.length, "m")
