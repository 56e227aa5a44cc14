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
from dataclasses import dataclass, replace
from pathlib import Path

import mvs
import numpy as np
from febio_case import (
    BASE, BENDING, STIFF, Choice, Theirs, data_file, one_by_one, read, with_middles,
)


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
