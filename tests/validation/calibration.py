"""Whether the intervals of mvs.fit hold the truth as often as they say: simulation-based calibration.

    python tests/validation/calibration.py                       # 16 cases, 20 s of CPU
    python tests/validation/calibration.py --cases 400           # two processes
    python tests/validation/calibration.py --truth law mesh --cases 24 [--refit]  # of another model

A case draws the rest lengths of all chordae from the prior of the fit (3 %, within 3 standard deviations)
and the size of the annulus from 1.15 to 1.3, closes that valve, adds noise to every leaflet node, fits the
lengths from the prior's mean, and ranks the truth among draws from the posterior (Talts et al., arXiv
1804.06788): the mean length of each zone of chordae and of one chord among 39 draws, leak and coaptation
of the truth among those of 19 draws that are closed. If the posterior is right all ranks are equally
likely, and 90 % of them lie in the middle.

Truths: `matched`, the model that is fitted; `law`, leaflets of another law (Fung); `mesh`, twice as many
nodes, other chordae and another law, given as a closed surface with noisy nodes. The fit of the others
knows nothing of this, unless it is repeated with the noise that its residuals show (--refit). Zones of a
mesh are compared by their mean relative lengths.

The exit code is 1 if a matched quantity is held less or more often than chance allows at 90 %: its count
outside of the central 99.9 % of the binomial distribution.
"""

from __future__ import annotations

import argparse
import concurrent.futures
import dataclasses
import os
import sys
import time
import warnings
from typing import Optional

# before numpy: threads of BLAS take more CPU than they save for matrices of this size
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import mvs  # noqa: E402
import numpy as np  # noqa: E402

REACH, LEVEL = 3.0, 0.9
DRAWS, CLOSED = 39, 19
"""Numbers of drawn and of closed parameters: 90 % of the ranks are a whole number in both."""
SHOWN = 50
"""Cases after which the table so far is printed."""
REST = 1e-6
"""N"""
MEASURES = {"leak": "regurgitant_orifice_area", "coaptation": "coaptation_area"}


def closed_valve(valve: mvs.Valve) -> Optional[mvs.Snapshot]:
    """The valve at systolic pressure; None if it does not come to rest."""
    with mvs.Simulator(log=lambda level, text: None) as sim:
        sim.set_valve(valve)
        sim.set_load(mvs.SYSTOLE_PA)
        return sim.snapshot() if sim.settle(residual=REST).converged else None


def generated(vertices: int, scale: float, law: Optional[str]) -> Optional[mvs.Snapshot]:
    """The closed valve of the prior's mean."""
    with mvs.Simulator(log=lambda level, text: None) as sim:
        sim.generate(vertices=vertices, annulus_scale=scale)
        valve = mvs.valve_of(sim.snapshot())
    if law is not None:
        valve.leaflets = [dataclasses.replace(leaf, law=law, constants=()) for leaf in valve.leaflets]
    return closed_valve(valve)


def zones(closed: mvs.Snapshot) -> dict[str, list[int]]:
    """Rows of the chordae of each leaflet and kind."""
    found: dict[str, list[int]] = {}
    for row, chord in enumerate(closed.chords()):
        found.setdefault(f"{chord['site'][:1]} {chord['kind']}", []).append(row)
    return found


def drawn_lengths(random: np.random.Generator, count: int) -> np.ndarray:
    """Lengths in standard deviations of the prior, within its bounds."""
    z = random.normal(size=count)
    while (np.abs(z) > REACH).any():
        z = np.where(np.abs(z) > REACH, random.normal(size=count), z)
    return z


@dataclasses.dataclass
class Case:
    """Ranks of the truth by quantity, from 0 to 1, what the fit left, and the CPU of its parts."""

    ranks: dict[str, tuple[int, int]]
    chi_square: float
    seconds: float


def rank(truth: float, drawn: np.ndarray) -> tuple[int, int]:
    """How many draws are below, and how many there are."""
    return int((drawn < truth).sum()), len(drawn)


def tried(job: tuple[int, str, int, float, float, bool]) -> Optional[Case]:
    """run_case, or None where the fit ends with an error: one case does not end the others."""
    try:
        return run_case(job)
    except (mvs.DivergedError, mvs.StateError) as error:
        print(f"seed {job[0]}: {error}", file=sys.stderr, flush=True)
        return None


def run_case(job: tuple[int, str, int, float, float, bool]) -> Optional[Case]:
    """One truth, its fit, and its ranks; None if truth or start do not come to rest."""
    seed, kind, vertices, noise, prior, refit = job
    warnings.simplefilter("ignore")
    random = np.random.default_rng(seed)
    scale = random.uniform(1.15, 1.3)
    start = generated(vertices, scale, None)
    of_truth = start
    if kind != "matched":
        of_truth = generated(vertices * (2 if kind == "mesh" else 1), scale, "fung")
    if start is None or of_truth is None:
        return None
    z = drawn_lengths(random, len(of_truth.chord_rest_length))
    valve = mvs.valve_of(of_truth)
    valve.chord_rest_length = valve.chord_rest_length * (1 + prior * z)
    truth = closed_valve(valve)
    if truth is None:
        return None
    begun = time.process_time()
    nodes = np.unique(truth.triangle_nodes)
    places = np.array(truth.node_position)
    places[nodes] += noise * random.normal(size=(len(nodes), 3))
    data = (places, truth.triangle_nodes) if kind == "mesh" else mvs.Points(nodes, places[nodes])
    found = mvs.fit(start, data, noise=noise, priors={"chords": mvs.Prior(prior, REACH)})
    chi = float(np.mean((found.residuals_after / noise) ** 2))
    if refit:
        found = mvs.fit(start, data, noise=noise * max(1.0, np.sqrt(chi)),
                        priors={"chords": mvs.Prior(prior, REACH)})
    drawn = found.sample(DRAWS, seed)
    ranks = rank_lengths(start, of_truth, z, drawn, random)
    closed = list(found.closures_of(drawn[:: DRAWS // CLOSED][:CLOSED]))
    for name, field in MEASURES.items():
        values = np.array([getattr(valve.measures, field) for valve in closed])
        ranks[name] = rank(getattr(truth.measures, field), values)
    return Case(ranks, chi, time.process_time() - begun)


def rank_lengths(start: mvs.Snapshot, of_truth: mvs.Snapshot, z: np.ndarray, drawn: np.ndarray,
                 random: np.random.Generator) -> dict[str, tuple[int, int]]:
    """Ranks of the mean of each zone, and of one chord if both valves have the same."""
    mine, theirs = zones(start), zones(of_truth)
    ranks = {name: rank(z[theirs[name]].mean(), drawn[:, rows].mean(axis=1))
             for name, rows in mine.items() if name in theirs}
    if len(z) == drawn.shape[1]:
        one = int(random.integers(len(z)))
        ranks["one chord"] = rank(z[one], drawn[:, one])
    return ranks


def is_held(below: int, count: int) -> bool:
    """Whether the truth is in the central 90 % of the ranks."""
    out = (1 - LEVEL) / 2 * (count + 1)
    return out <= below <= count - out


def binomial_range(count: int, share: float, level: float) -> tuple[int, int]:
    """The central counts of a binomial distribution that have this probability."""
    from scipy.stats import binom

    low, high = binom.interval(level, count, share)
    return int(low), int(high)


def table_of(cases: list[Case]) -> list[tuple[str, int, int, np.ndarray]]:
    """Quantity, held, cases, histogram of the ranks in ten bins."""
    rows = []
    for name in cases[0].ranks:
        ranks = [case.ranks[name] for case in cases if name in case.ranks and case.ranks[name][1] > 0]
        places = [(below + 0.5) / (count + 1) for below, count in ranks]
        rows.append((name, sum(is_held(*r) for r in ranks), len(ranks),
                     np.histogram(places, 10, (0, 1))[0]))
    return rows


def report(kind: str, cases: list[Case], asked: int) -> bool:
    """Prints the table; whether all counts are within chance."""
    print(f"\n{kind}: {len(cases)} of {asked} truths were fitted; mean squared residual over noise "
          f"{np.mean([c.chi_square for c in cases]):.3f}; {np.mean([c.seconds for c in cases]):.1f} s of CPU "
          "a case\n\n| quantity | held | 95 % of a count by chance | ranks, tenths |\n|---|---|---|---|")
    right = True
    for name, held, count, histogram in table_of(cases):
        low, high = binomial_range(count, LEVEL, 0.95)
        least, most = binomial_range(count, LEVEL, 0.999)
        right = right and least <= held <= most
        mark = "" if low <= held <= high else " *"
        print(f"| {name} | {held} of {count} ({100 * held / count:.1f} %){mark} | {low} to {high} | "
              f"{' '.join(map(str, histogram))} |", flush=True)
    return right


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cases", type=int, default=16)
    parser.add_argument("--truth", nargs="+", default=["matched"], choices=["matched", "law", "mesh"])
    parser.add_argument("--noise", type=float, default=0.3, help="mm")
    parser.add_argument("--prior", type=float, default=3, help="%% of the rest lengths")
    parser.add_argument("--vertices", type=int, default=200)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--refit", action="store_true",
                        help="fit again with the noise that the residuals show, if it is larger")
    parser.add_argument("--first", type=int, default=0, help="first seed")
    options = parser.parse_args()
    right = True
    for kind in options.truth:
        jobs = [(options.first + k, kind, options.vertices, 1e-3 * options.noise, 1e-2 * options.prior, options.refit)
                for k in range(options.cases)]
        cases: list[Case] = []
        with concurrent.futures.ProcessPoolExecutor(options.processes) as pool:
            for number, case in enumerate(pool.map(tried, jobs), 1):
                cases += [] if case is None else [case]
                if number % SHOWN == 0 and number < len(jobs):
                    report(kind, cases, number)
        right = (report(kind, cases, options.cases) or kind != "matched") and right
    sys.exit(0 if right else 1)


if __name__ == "__main__":
    main()
