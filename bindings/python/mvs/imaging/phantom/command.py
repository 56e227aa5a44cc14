"""The command `phantom`: makes a phantom of a valve and writes its files."""

from __future__ import annotations

import argparse
import dataclasses
import json
import sys
from pathlib import Path
from typing import Any, Optional

from ... import _core
from ..._core import Simulator, Snapshot
from ...errors import ArgumentError, Error
from ...kinds import LeafletLaw
from .files import label_errors_of, save
from .volumes import Phantom, Volume, make
from .settings import LABEL_ERRORS, PRESETS, Settings
from .truth import MM, Progress

LENGTHS = (
    "annulus_ap", "annulus_cc", "saddle_height", "anterior_height", "posterior_height",
    "commissure_height", "thickness", "papillary_depth", "papillary_separation",
    "indentation_depth", "coaptation_depth",
)
FACTORS = ("annulus_contraction", "annulus_scale", "chord_slack")
"""Dimensions of Simulator.generate: lengths, in mm here, and factors."""


def add_to(commands: Any) -> argparse.ArgumentParser:
    """Adds the command `phantom` to the subparsers of a parser; `run(arguments)` runs it."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "phantom", help="makes test volumes of a valve that is known",
        description="Makes volumes, labels and landmarks of a valve, open and closed under "
        "pressure, and writes them to a folder; the truth to DIR/truth. Lengths in mm.",
    )
    _add_arguments(parser)
    parser.set_defaults(run=run)
    return parser


def run(arguments: argparse.Namespace) -> int:
    """Makes the phantom of parsed arguments; returns the exit code: 0, or 1 with a sentence."""
    try:
        made = make(
            _valve(arguments), settings_of(arguments), loaded=not arguments.open_only,
            progress=_progress(arguments),
        )
        files = save(made, arguments.out)
    except (Error, OSError) as error:
        print(f"phantom: {error}", file=sys.stderr)
        return 1
    facts = facts_of(made)
    if arguments.json:
        print(json.dumps({"folder": str(arguments.out), "files": len(files), **facts}))
    else:
        print(_as_text(made, arguments.out, len(files)))
    return 0


def settings_of(arguments: argparse.Namespace) -> Settings:
    """The settings of parsed arguments; ArgumentError with a sentence if they make no sense."""
    direct = (
        "spacing", "margin", "noise", "bias", "drop_out", "tilt", "landmark_error", "seed", "pose",
        "pressure", "law", "vertices", "thickness_variation", "chord_shape", "misplaced",
        "chord_diameter", "head_spread",
    )
    changes = {
        name: getattr(arguments, name) for name in direct if getattr(arguments, name) is not None
    }
    if arguments.blur is not None:
        blur = tuple(arguments.blur)
        if len(blur) > 2:
            raise ArgumentError(f"--blur takes one or two widths, not {len(blur)}", "blur")
        changes["blur"] = blur * 2 if len(blur) == 1 else blur
    usual = PRESETS[arguments.kind]()
    kinds, mean, hd95 = _kinds(arguments.label_errors), arguments.label_mean, arguments.label_hd95
    changes["labels"] = dataclasses.replace(
        usual.labels,
        kinds=usual.labels.kinds if kinds is None else kinds,
        mean=usual.labels.mean if mean is None else mean,
        hd95=usual.labels.hd95 if hd95 is None else hd95,
    )
    return dataclasses.replace(usual, **changes)


def facts_of(made: Phantom) -> dict[str, object]:
    """Sizes of the volumes, measured errors of the labels and the true leak."""
    facts: dict[str, object] = {}
    for name, volume in (("open", made.opened), ("loaded", made.loaded)):
        if volume is not None:
            facts[name] = {
                "size": list(volume.image.GetSize()), "spacing_mm": volume.image.GetSpacing()[0],
                "label_errors": label_errors_of(volume),
            }
    if made.truth.closed is not None:
        leak = made.truth.closed.measures.regurgitant_orifice_area
        facts["regurgitant_orifice_mm2"] = leak * MM**2
    return facts


def _add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("-o", "--out", type=Path, required=True, metavar="DIR", help="folder, created if missing")
    add("--kind", choices=tuple(PRESETS), default="micro-ct", help="of image [micro-ct]")
    add("--valve", type=Path, metavar="FILE",
        help=".obj, .h5 or .inp; without it a parametric valve, by the options below")
    add("--seed", type=int, metavar="N", help="of all that is random [0]")
    add("--pose", action="store_const", const=True, help="turn and move the valve at random")
    add("--open-only", action="store_true", help="no loaded volume")
    add("--json", action="store_true", help="print one JSON object")
    add("--quiet", action="store_true", help="no progress on stderr")
    image = parser.add_argument_group("image").add_argument
    image("--spacing", type=float, metavar="MM", help="of the voxels [0.15; ultrasound 0.7]")
    image("--margin", type=float, metavar="MM", help="around the leaflets [3; ultrasound 6]")
    image("--blur", type=float, nargs="+", metavar="MM",
          help="FWHM of the PSF, or axial and lateral [0.2; ultrasound 0.9 1.8]")
    image("--noise", type=float, metavar="X",
          help="standard deviation over contrast [0.06; ultrasound 0.02]")
    image("--bias", type=float, metavar="X", help="change of brightness [0.1; ultrasound 0.15]")
    image("--drop-out", type=float, metavar="X", help="0 to 1, ultrasound only [0.8]")
    image("--tilt", type=float, metavar="DEG", help="of the volume, at most [0; ultrasound 20]")
    image("--misplaced", type=float, metavar="X",
          help="degrees and mm between open and loaded volume [4; ultrasound 0]")
    labels = parser.add_argument_group("labels and landmarks").add_argument
    labels("--label-errors", metavar="KINDS",
           help=f"none, all, or some of {','.join(LABEL_ERRORS)} [none; ultrasound all]")
    labels("--label-mean", type=float, metavar="MM", help="mean surface distance [0.45]")
    labels("--label-hd95", type=float, metavar="MM", help="95 %% Hausdorff distance [3.6]")
    labels("--landmark-error", type=float, metavar="MM",
           help="standard deviation of coordinates [0; ultrasound 0.5]")
    truth = parser.add_argument_group("the true valve").add_argument
    truth("--law", choices=[law.name.lower() for law in LeafletLaw], metavar="LAW",
          help="tissue of its leaflets [may_newman_yin]")
    truth("--vertices", type=int, metavar="N", help="refine to at least so many [1600]")
    truth("--pressure", type=float, metavar="MMHG", help="that closes it [120]")
    truth("--thickness-variation", type=float, metavar="X", help="relative [0.15]")
    truth("--chord-diameter", type=float, metavar="X", help="factor on diameters of chordae [0.6]")
    truth("--head-spread", type=float, metavar="MM",
          help="radius over which the chordae of a head are spread [2.5]")
    truth("--chord-shape", choices=("arc", "straight"), help="of slack chordae [arc]")
    shape = parser.add_argument_group("parametric valve, as of `mvs generate`").add_argument
    shape("--shape", choices=("healthy", "founding"), help="[healthy]")
    for name in LENGTHS:
        shape(f"--{name.replace('_', '-')}", type=float, metavar="MM")
    for name in FACTORS:
        shape(f"--{name.replace('_', '-')}", type=float, metavar="X")


def _kinds(text: Optional[str]) -> Optional[tuple[str, ...]]:
    if text is None:
        return None
    return {"none": (), "all": LABEL_ERRORS}.get(text, tuple(text.split(",")))


def _valve(arguments: argparse.Namespace) -> Snapshot:
    """The valve of a file, or a parametric one."""
    given = {n: getattr(arguments, n) for n in (*LENGTHS, *FACTORS) if getattr(arguments, n) is not None}
    with Simulator() as sim:
        if arguments.valve is not None:
            if given or arguments.shape:
                raise ArgumentError("--valve: dimensions and --shape are for a parametric valve", "valve")
            sim.load(arguments.valve)
        else:
            scaled = {n: v / MM if n in LENGTHS else v for n, v in given.items()}
            sim.generate(shape=arguments.shape, **scaled)
        return sim.snapshot()


def _progress(arguments: argparse.Namespace) -> Progress:
    """Prints each stage on stderr, on a terminal with the share that is done."""
    if arguments.quiet:
        return None
    shown = {"stage": ""}

    def report(stage: str, share: float) -> None:
        if sys.stderr.isatty():
            end = "\n" if share >= 1 else ""
            print(f"\r{stage}: {100 * share:3.0f} %", end=end, file=sys.stderr, flush=True)
        elif stage != shown["stage"]:
            print(stage, file=sys.stderr, flush=True)
        shown["stage"] = stage

    return report


def _as_text(made: Phantom, folder: Path, files: int) -> str:
    lines = [f"{folder}: {files} files, libmvs {_core.version()}"]
    for name, volume in (("open", made.opened), ("loaded", made.loaded)):
        if volume is not None:
            lines += _volume_text(name, volume, made.settings)
    if made.truth.closed is not None:
        leak = made.truth.closed.measures.regurgitant_orifice_area * MM**2
        lines.append(f"the true valve leaks through {leak:.1f} mm2")
    return "\n".join(lines)


def _volume_text(name: str, volume: Volume, settings: Settings) -> list[str]:
    size = " x ".join(str(n) for n in volume.image.GetSize())
    lines = [f"{name}: {size} voxels of {settings.spacing:g} mm; {', '.join(volume.label_names)}"]
    if volume.flaws is None:
        return lines
    for row in volume.flaws.statistics:
        lines.append(f"  labels, {row.name}: mean {row.mean:.2f} mm, 95 % Hausdorff {row.hd95:.2f} mm, "
                     f"Dice {row.dice:.2f}")
    wanted, found = settings.labels, volume.flaws.statistics[-1]
    lines.append(f"  asked for: mean {wanted.mean:g} mm, 95 % Hausdorff {wanted.hd95:g} mm; "
                 f"made by displacements of {volume.flaws.amplitude:.2f} mm, other errors x "
                 f"{volume.flaws.factor:.2f}")
    if not volume.flaws.reached(wanted):
        lines.append(f"  NOT reached with these kinds of errors: mean {found.mean:.2f} mm, 95 % "
                     f"Hausdorff {found.hd95:.2f} mm")
    return lines
