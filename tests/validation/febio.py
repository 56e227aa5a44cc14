"""A valve closed by FEBio 4.11, closed by libmvs on the same mesh, and what makes them differ.

The case (made for this project; its file says everything) has 416 quadrilateral shells of 1 mm, 80
tension-only chordae and 120 mmHg. Run it to print the tables and to write the pictures:

    python tests/validation/febio.py [--data FILE] [--out DIR] [--paths N] [--shell]

Each row of the table changes one thing of the first: the same law as FEBio's as a membrane, quads
cut along their first diagonal, chordae without smoothing, contact from 1 mm on, bending of a 1 mm
sheet, mid-surface where FEBio's mesh is, closed from the open shape. The second table does so
beside a sheet 60 times stiffer in bending, which has one closed shape only, so that nothing is due
to a fold. --shell asks FEBio's shape itself, with a shell of our own (shell.py; needs scipy, 1 min
of CPU), whether it is at rest.
"""

from __future__ import annotations

import argparse
import json
import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Optional

import mvs
import numpy as np

FILE = Path("febio") / "V1_healthy_468.json"
HALF_THICKNESS = 0.5e-3
"""m: from FEBio's mesh, the atrial face, to the middle of its shell"""

CHORD_AREA = np.pi / 4 * 1e-6  # m2; with 40 MPa, EA = 31.416 N
SMOOTHING = 0.02e-3  # m
TAIL = 0.5e-3  # m: how far below its rest length a smoothed chord is followed: 0.3 mN


@dataclass(frozen=True)
class Choice:
    """One way to express the case."""

    title: str
    law: mvs.LeafletLaw = mvs.LeafletLaw.BILINEAR
    split: str = "first"
    smoothed_chords: bool = False
    contact_thickness: float = 1e-3
    contact_stiffness: Optional[float] = None
    bending: float = 1.0
    behind: float = 0.0
    from_theirs: bool = False


BASE = Choice("bilinear membrane")
BENDING = tuple(
    replace(BASE, title=f"bending x {factor:g}" if factor else "no bending", bending=factor)
    for factor in (0.0, 4.0, 30.0, 60.0, 100.0, 136.0)
)
STIFF = BENDING[3]


def one_by_one(base: Choice) -> tuple[Choice, ...]:
    """The base, and one thing changed at a time; titles say which."""
    return (
        base,
        replace(base, title="springs", law=mvs.LeafletLaw.SPRING),
        replace(base, title="quads cut along the other diagonal", split="second"),
        replace(base, title="quads cut in four", split="four"),
        replace(base, title="chordae smoothed over 0.02 mm", smoothed_chords=True),
        replace(base, title="contact 0.6 mm", contact_thickness=0.6e-3),
        replace(base, title="contact 1.15 mm", contact_thickness=1.15e-3),
        replace(base, title="contact 1.3 mm", contact_thickness=1.3e-3),
        # -B'(d / r) = p / kappa (libmvs/energy/README.md) at d = 1.15 mm under 120 mmHg
        replace(base, title="contact 2 mm: gap 1.15 mm", contact_thickness=2e-3),
        replace(base, title="contact 1.3 mm, 370 kPa: gap 1.15 mm", contact_thickness=1.3e-3,
                contact_stiffness=370e3),
        replace(base, title="contact 3.7 mm: gap 1.15 + 2 x 0.5 mm", contact_thickness=3.75e-3),
        replace(base, title="mid-surface 0.5 mm behind the mesh", behind=HALF_THICKNESS),
        replace(base, title="closed from FEBio's shape", from_theirs=True),
    )


def data_file() -> Path:
    """Where the data of the case are searched for."""
    default = Path(__file__).resolve().parents[3] / "shared" / "data"
    return Path(os.environ.get("MVS_TEST_DATA", default)) / FILE


class Theirs:
    """The file: FEBio's mesh, chordae and result, in m and N; the last two nodes are the heads."""

    def __init__(self, path: Path) -> None:
        data = json.loads(path.read_text())
        self.opened = np.array(data["vertices_open"]) * 1e-3
        self.closed = np.array(data["vertices_closed"]) * 1e-3
        self.quads = np.array(data["quads"])
        self.annulus = np.array(data["annulus"], dtype=np.uint32)
        self.heads = np.array(data["papillary"], dtype=np.uint32)
        chords = data["chords"]
        self.chords = np.array([[c["papillary"], c["leaflet"]] for c in chords], dtype=np.uint32)
        self.rest_length = np.array([c["rest_length"] for c in chords]) * 1e-3
        self.chord_force = np.array(data["chord_force_N"])
        self.title = f"FEBio: {data['solver_cpu_s']:.0f} s, {data['newton_iterations']} iterations"

    def behind(self, nodes: np.ndarray, distance: float) -> np.ndarray:
        """Nodes moved off the surface, away from the atrium."""
        return nodes - distance * normals(nodes, self.quads)


def normals(nodes: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """Unit normals at the nodes (n, 3), zero off the sheet; the quads are wound to the atrium."""
    sums = np.zeros_like(nodes)
    corners = nodes[quads]
    for k in range(4):
        ahead, behind = corners[:, (k + 1) % 4], corners[:, k - 1]
        np.add.at(sums, quads[:, k], np.cross(ahead - corners[:, k], behind - corners[:, k]))
    length = np.linalg.norm(sums, axis=1, keepdims=True)
    return sums / np.where(length > 0, length, 1)


def split(quads: np.ndarray, how: str, nodes: int) -> np.ndarray:
    """Triangles of the quads; "four" needs a node in the middle of each, after the others."""
    if how == "four":
        middle = np.arange(nodes, nodes + len(quads))
        sides = [np.column_stack([quads[:, k - 1], quads[:, k], middle]) for k in range(4)]
        return np.concatenate(sides).astype(np.uint32)
    corners = ([0, 1, 2], [0, 2, 3]) if how == "first" else ([0, 1, 3], [1, 2, 3])
    return np.concatenate([quads[:, c] for c in corners]).astype(np.uint32)


def with_middles(nodes: np.ndarray, theirs: Theirs, choice: Choice) -> np.ndarray:
    """The nodes, moved behind the mesh where the choice says so, and the middles of the quads."""
    moved = theirs.behind(nodes, choice.behind)
    if choice.split != "four":
        return moved
    return np.concatenate([moved, moved[theirs.quads].mean(axis=1)])


def smooth_curves(length: np.ndarray) -> list[mvs.Curve]:
    """FEBio's tension (EA / L0) (u + sqrt(u^2 + s^2)) / 2 as a table for each rest length L0.

    One is needed for each: s is a length, so in strain the curve is s / L0 wide.
    """
    u = np.concatenate([np.linspace(-TAIL, -0.1e-3, 9), np.linspace(-0.08e-3, 0.08e-3, 65),
                        np.linspace(0.1e-3, 2e-3, 20)])
    curves = []
    for k, rest in enumerate(length):
        start = rest - TAIL
        stress = 40e6 * (u + np.sqrt(u * u + SMOOTHING**2)) / 2 / rest
        stress[0] = 0
        curves.append(mvs.Curve(f"chord {k}", np.column_stack([(u + TAIL) / start, stress])))
    return curves


def read(theirs: Theirs, choice: Choice) -> mvs.Valve:
    """The case as a valve, open."""
    rest, loaded = (with_middles(n, theirs, choice) for n in (theirs.opened, theirs.closed))
    # a chord that ends behind the mesh is as slack or taut in FEBio's shape as it is there
    ends = [n[theirs.chords[:, 0]] - n[theirs.chords[:, 1]] for n in (loaded, theirs.closed)]
    length = theirs.rest_length + np.linalg.norm(ends[0], axis=1) - np.linalg.norm(ends[1], axis=1)
    valve = mvs.Valve(
        name="febio",
        nodes=rest,
        nodes_loaded=loaded,
        triangles=split(theirs.quads, choice.split, len(theirs.opened)),
        annulus=theirs.annulus,
        leaflets=[mvs.Leaflet("M", law=choice.law)],
        chord_nodes=theirs.chords,
        chord_rest_length=length,
        head_nodes=theirs.heads,
        contact_thickness=choice.contact_thickness,
        contact_stiffness=choice.contact_stiffness,
        bending_scale=choice.bending,
    )
    if choice.smoothed_chords:
        valve.curves = smooth_curves(length)
        valve.chord_rest_length = length - TAIL
        valve.chord_law = np.full(len(length), mvs.ChordLaw.TABLE, dtype=np.uint32)
        valve.chord_constants = np.zeros((len(length), 6))
        valve.chord_constants[:, 0] = np.arange(len(length))
    return valve


@dataclass
class Result:
    """A closure and how far it is from FEBio's."""

    choice: Choice
    stats: mvs.Stats
    opened: mvs.Snapshot
    closed: mvs.Snapshot
    target: mvs.Snapshot
    comparison: mvs.Comparison

    def nodes(self, closed: mvs.Snapshot) -> np.ndarray:
        """Distances from FEBio's nodes, m; midpoints of quads are not nodes of FEBio's."""
        mine, goal = closed.node_position, self.target.node_position
        on_sheet = np.unique(self.target.chord_nodes[:, 0]).min()  # the heads come after the mesh
        return np.linalg.norm(mine[:on_sheet] - goal[:on_sheet], axis=1)


def close(theirs: Theirs, choice: Choice = BASE) -> Result:
    """Closes the case at 120 mmHg."""
    valve = read(theirs, choice)
    shape = with_middles(theirs.closed, theirs, choice)
    with mvs.Simulator() as sim:
        valve.nodes_now = shape
        sim.set_valve(valve)
        target = sim.snapshot()
        valve.nodes_now = shape if choice.from_theirs else None
        sim.set_valve(valve)
        opened = sim.snapshot()
        sim.set_load(mvs.SYSTOLE_PA)
        stats = sim.settle()
        closed = sim.snapshot()
    return Result(choice, stats, opened, closed, target, closed.compare(target))


def row(result: Result) -> str:
    """The figures of one closure, in mm."""
    found, apart = result.comparison, result.nodes(result.closed)
    return (
        f"{result.choice.title:38} {'yes' if result.stats.converged else 'NO':>4} "
        f"{result.stats.iterations:5d} {result.closed.measures.intersections:5d} "
        f"{found.surface_rms * 1e3:8.2f} {found.surface_max * 1e3:6.2f} "
        f"{np.sqrt((apart**2).mean()) * 1e3:8.2f} {apart.max() * 1e3:6.2f} "
        f"{result.closed.chord_tension.sum():8.2f}"
    )


HEAD = (
    f"{'':38} {'rest':>4} {'iter.':>5} {'cross':>5} {'surf.RMS':>8} {'max':>6} {'node RMS':>8} "
    f"{'max':>6} {'chords N':>8}"
)


def spread_of(result: Result, paths: int) -> str:
    """The same errors over the closures along several paths: how much of them is fold."""
    ensemble = result.opened.ensemble(mvs.SYSTOLE_PA, members=paths)
    at_rest = [k for k, path in enumerate(ensemble.members) if path.converged]
    errors = [ensemble.snapshot(k).compare(result.target) for k in at_rest]
    figures = [f"{each.surface_rms * 1e3:.2f}" for each in errors]
    orders = [ensemble.members[k].order.name.lower().replace("_", " ") for k in at_rest]
    return (
        f"{result.choice.title}: surface RMS by path, mm: "
        + ", ".join(f"{figure} ({order})" for figure, order in zip(figures, orders))
        + f"; {ensemble.summary.equilibria} equilibria, nodes apart by "
        f"{ensemble.summary.node_max * 1e3:.2f} mm at most"
    )


def signed_distance(result: Result) -> np.ndarray:
    """How far each node lies from FEBio's surface, mm, positive on its atrial side."""
    import pyvista

    def surface(snapshot: mvs.Snapshot) -> pyvista.PolyData:
        return pyvista.PolyData.from_regular_faces(
            snapshot.node_position * 1e3, snapshot.triangle_nodes.astype(np.int64)
        )

    mine = surface(result.closed).compute_implicit_distance(surface(result.target))
    return np.asarray(mine["implicit_distance"])


def draw(results: list[Result], folder: Path) -> None:
    """Signed distances from FEBio's surface on the closed valves, and central cross-sections."""
    import matplotlib
    from mvs.drawing.geometry import Drawing
    from mvs.drawing.maps import section_plot
    from mvs.drawing.pictures import (
        colour_bar,
        picture,
        place_image,
        scale_bar,
        to_png,
        view_from_atrium,
    )
    from mvs.drawing.scene import Colours, Scene

    folder.mkdir(parents=True, exist_ok=True)
    target, view = Drawing(results[0].target), view_from_atrium(46)
    (folder / "febio-theirs.png").write_bytes(picture(target, view, closed=True))
    for result in results:
        name = result.choice.title.replace(" ", "-").replace(",", "")
        drawing = Drawing(result.closed)
        section = section_plot(Drawing(result.target), drawing, "FEBio")
        (folder / f"febio-{name}-section.png").write_bytes(section)
        colours = Colours(signed_distance(result), -3.0, 3.0, matplotlib.colormaps["RdBu_r"])
        scene = Scene(drawing)
        scene.add_leaflets(colours)
        scene.add_annulus()
        scene.add_wall()
        figure = matplotlib.pyplot.figure(figsize=(8, 7))
        place_image(figure.add_axes((0, 0.1, 1, 0.9)), scene.render(view), view)
        scale_bar(figure.axes[0])
        colour_bar(figure, figure.add_axes((0.25, 0.085, 0.5, 0.022)), colours,
                   "distance from FEBio's surface, mm (red: towards the atrium)", "both")
        (folder / f"febio-{name}-map.png").write_bytes(to_png(figure))


def main() -> None:
    """Closes the case in every way, prints the tables and writes the pictures."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, default=data_file(), metavar="FILE")
    parser.add_argument("--out", type=Path, default=Path("out/febio"), metavar="DIR")
    parser.add_argument("--paths", type=int, default=6, metavar="N",
                        help="closures over which the errors are spread; 0: none [6]")
    parser.add_argument("--shell", action="store_true", help="ask a shell of our own; needs scipy")
    arguments = parser.parse_args()
    theirs = Theirs(arguments.data)
    print(f"{theirs.title}; its chordae carry {theirs.chord_force.sum():.2f} N")
    results = []
    for choices in (one_by_one(BASE), BENDING, one_by_one(STIFF)[1:]):
        print("\n" + HEAD)
        for choice in choices:
            results.append(close(theirs, choice))
            print(row(results[-1]), flush=True)
    springs = replace(BASE, title="springs", law=mvs.LeafletLaw.SPRING)
    shown = [result for result in results if result.choice in (BASE, STIFF, springs)]
    if arguments.paths > 1:
        print()
        for result in shown:
            print(spread_of(result, arguments.paths), flush=True)
    draw(shown, arguments.out)
    if arguments.shell:
        import shell

        print("\n" + shell.table(theirs))


if __name__ == "__main__":
    main()
