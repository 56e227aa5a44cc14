"""Gaps that loaded labels show: phantoms of sealed valves and of valves with long chordae in a part of P.

    python tests/validation/shown_gaps.py [--valves N] [--seed N] [--exact-labels] [--closed-error MM]

Each valve is a generated one with its annulus dilated by 1.2. A gap: the chordae that insert on the posterior
leaflet within 9 mm of a place near its middle are three times as long, as if they were torn. The labels
of the open and of the closed valve have the errors of networks (mean 0.45 mm, 95 % Hausdorff 3.6 mm), or none with
--exact-labels. `mvs-image` recovers the valve from their files; the finding `shown_gaps` and the interval are
compared with the true leak.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import mvs
import numpy as np
from mvs.imaging import phantom
from phantom_errors import MM, leak_interval
from phantoms import recover

HALF_WIDTH, LONGER, DILATED = 9e-3, 3.0, 1.2
"""m and factors: of the part whose chordae are longer, of these, of the annulus"""


def valve_of(seed: int, has_gap: bool) -> mvs.Snapshot:
    """A generated valve of random dimensions; `has_gap`: with long chordae in a part of P."""
    random = np.random.default_rng([77, seed])
    with mvs.Simulator(log=lambda *_: None) as sim:
        sim.generate(
            annulus_ap=random.uniform(23e-3, 29e-3), annulus_cc=random.uniform(31e-3, 39e-3),
            anterior_height=random.uniform(22e-3, 26e-3), posterior_height=random.uniform(12e-3, 15e-3),
            papillary_depth=random.uniform(21e-3, 26e-3), annulus_scale=DILATED,
        )
        opened = sim.snapshot()
        if not has_gap:
            return opened
        valve = mvs.valve_of(opened)
        longer = _near_middle_of_p(opened, random.uniform(-5e-3, 5e-3))[np.asarray(valve.chord_nodes)].any(axis=1)
        valve.chord_rest_length = np.asarray(valve.chord_rest_length) * np.where(longer, LONGER, 1.0)
        valve.nodes_now = None
        sim.set_valve(valve)
        return sim.snapshot()


def _near_middle_of_p(valve: mvs.Snapshot, middle: float) -> np.ndarray:
    """Marks the nodes of the posterior leaflet near a place along the line of commissures, m from the centre."""
    names = [part.name for part in valve.parts if part.kind == mvs.PartKind.LEAFLET]
    posterior = np.asarray(valve.triangle_leaflet) == names.index("P")
    marks = np.zeros(len(valve.node_position), bool)
    marks[np.unique(np.asarray(valve.triangle_nodes)[posterior])] = True
    across = (np.asarray(valve.node_position) - valve.frame.origin) @ valve.frame.axes[1]
    return marks & (np.abs(across - middle) < HALF_WIDTH)


def run_case(seed: int, has_gap: bool, exact: bool, options: Sequence[str]) -> tuple[str, bool]:
    """One row of the table, and whether the interval contains the true leak."""
    errors = {"labels": phantom.LabelErrors()} if exact else {}
    made = phantom.make(valve_of(seed, has_gap), phantom.ultrasound(seed=seed, pose=True, **errors))
    leak = made.truth.closed.measures.regurgitant_orifice_area * MM**2
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        phantom.save(made, folder)
        shutil.rmtree(folder / "truth")  # the recovery sees images, labels and landmarks only
        found = recover(folder, "ultrasound", True, *options)
    gaps = next((one for one in found.findings if one.name == "shown_gaps"), None)
    low, high = leak_interval(found)
    inside = low <= leak <= high
    measured = gaps is not None and len(gaps.values)
    shown = f"{gaps.values[0] * MM**2:.1f}" if measured else "not measured"
    doubtful = "yes" if gaps and gaps.doubtful else "no"
    return (f"| {seed} | {'long chordae' if has_gap else 'as generated'} | {leak:.1f} | {shown} | {doubtful} | "
            f"{low:.1f} to {high:.1f} | {'yes' if inside else 'NO'} |"), inside


def main() -> int:
    """Prints the table; the exit code is 1 if an interval misses the true leak."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--valves", type=int, default=4, metavar="N", help="[4], each with and without a gap")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="of the first valve [0]")
    parser.add_argument("--exact-labels", action="store_true", help="labels without errors")
    parser.add_argument("--closed-error", metavar="MM", help="of mvs-image")
    arguments = parser.parse_args()
    options = ("--closed-error", arguments.closed_error) if arguments.closed_error else ()
    print("| seed | chordae | true leak, mm2 | gaps of the labels, mm2 | doubtful | interval, mm2 | inside |")
    print("|---|---|---|---|---|---|---|", flush=True)
    missed = 0
    for seed in range(arguments.seed, arguments.seed + arguments.valves):
        for has_gap in (False, True):
            try:
                row, inside = run_case(seed, has_gap, arguments.exact_labels, options)
            except mvs.Error as error:
                row, inside = f"| {seed} | {'long' if has_gap else 'as generated'} | refused: {error} |", True
            missed += not inside
            print(row, flush=True)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
