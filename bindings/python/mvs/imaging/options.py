"""The options of `mvs-image build`: their help, and their ranges in mm, which are those of a build."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from mvs import LeafletLaw
from .findings import RANGES

LANDMARKS = {"annulus": "points or a curve along the annulus; tissue beyond it is cut off",
             "commissures": "the two commissures",
             "anterior": "a point of the anterior leaflet", "tips": "tips of the papillary muscles"}
VALVE_ENDINGS = (".h5", ".vtkhdf", ".obj", ".vtp", ".vtm", ".feb")
WIDEST_HOLE = 30.0
"""mm: a larger opening is the orifice of the valve"""


def add_build(commands: Any) -> argparse.ArgumentParser:
    """Adds the command `build` to the subparsers of a parser."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "build", help="builds a valve from an image of open leaflets, and closes it",
        description="Lengths in mm. Images: NRRD, NIfTI, MetaImage, a folder of DICOM files. A label "
        "map or .seg.nrrd has the leaflets as labels; a grey volume is segmented as a micro-CT.")
    add = parser.add_argument
    add("image", type=Path, help="the open valve")
    add("-o", "--output", type=Path, required=True, help=f"file for the valve: {', '.join(VALVE_ENDINGS)}")
    add("--loaded", type=Path, metavar="IMAGE", help="the valve closed under load")
    add("--report", type=Path, metavar="HTML", help="a page with pictures and tables")
    add("--plan", type=Path, metavar="JSON", help="operations on the valve: the report shows it repaired")
    add("--findings", type=Path, metavar="JSON", help="[VALVE.import.json beside the output]")
    add("--with", type=Path, dest="known", metavar="JSON",
        help="findings of an earlier run, edited: what is given, guessed or assumed is used")
    add("--json", action="store_true", help="print one JSON object")
    add("--quiet", action="store_true", help="no progress on stderr")
    _add_labels(parser)
    points = parser.add_argument_group("landmarks: .mrk.json, .fcsv, .csv, .vtk, .vtp").add_argument
    for part, words in LANDMARKS.items():
        points(f"--{part}", type=Path, metavar="FILE", help=words)
    for part, words in LANDMARKS.items():
        points(f"--loaded-{part}", type=Path, metavar="FILE", help=f"{words}, in the loaded image")
    points("--frame", choices=("LPS", "RAS"), help="of landmark files that do not state it")
    parser.add_argument_group("loaded image").add_argument(
        "--register", choices=("none", "landmarks", "image"), default=None,
        help="to the open image: none: both have the same frame; landmarks: by those of both images; "
        "image: by grey values [none; image for grey volumes]")
    build = parser.add_argument_group("valve").add_argument
    build("--edge", type=_length("edge"), metavar="MM", help="of the triangles, 0.2 to 5 [1,000 vertices]")
    build("--chords", type=_chords, metavar="N", help="chord segments where none are seen, about, 20 to 400 [100]")
    build("--leaflet", metavar="LAW", type=_law,
          help=f"tissue of the leaflets: {', '.join(LAWS)} [bilinear; that which is nearest to the loaded image]")
    build("--thickness", type=_length("thickness"), metavar="MM",
          help="of the leaflets, 0.1 to 5 [measured; normal tissue where labels are narrow]")
    build("--coaptation-length", type=_length("coaptation_length"), metavar="MM",
          help="overlap in the middle for which rest lengths are chosen, 1 to 20 [8]")
    return parser


def _add_labels(parser: argparse.ArgumentParser) -> None:
    labels = parser.add_argument_group("labels").add_argument
    for leaflet in ("anterior", "posterior"):
        labels(f"--{leaflet}-label", metavar="NAME", help=f"segment of the {leaflet} leaflet [by name]")
    labels("--leaflet-label", metavar="NAME", help="one segment that holds both leaflets")
    labels("--hole", type=_hole, metavar="MM", help="diameter of the largest hole that is filled, 0 to 30 [7]")
    labels("--edge-error", type=_error("edge_error"), metavar="MM",
           help="how far the free edge may lie farther out or in: widens the interval of leaks, 0 (exact) to 5 [half "
           "a voxel]")
    labels("--edge-lost", type=_error("edge_lost"), metavar="MM",
           help="tissue that the labels may lack at the free edge: widens the interval of leaks, 0 (none) to 5 [two "
           "voxels, at least 1.4]")
    labels("--thickness-error", type=_error("thickness_error"), metavar="MM",
           help="by how much the leaflets may be thicker or thinner: widens the interval of leaks, 0 (exact) to 2 "
           "[where the thickness is assumed, 0.25 mm; where it is measured, half a voxel]")
    labels("--closed-error", type=_error("closed_error"), metavar="MM",
           help="standard deviation of places of the leaflets of --loaded: their gaps widen the interval of leaks from 3.6 "
           "times as much of width on, of tissue thicker than twice as much, or 1, from as much more, "
           "0 (exact) to 5 [0.5, as of networks]")


LAWS = tuple(law.name.lower() for law in LeafletLaw)


def _law(text: str) -> str:
    if text not in LAWS:
        raise argparse.ArgumentTypeError(f"{text}: is no tissue; known ones are {', '.join(LAWS)}")
    return text


def _number(text: str, least: float, most: float, unit: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not least <= number <= most:
        raise argparse.ArgumentTypeError(f"{text}: a number of {least:g} to {most:g}{unit} is needed")
    return number


def _length(name: str) -> Callable[[str], float]:
    """Reads an input of a build in mm, within its range."""
    least, most = (1e3 * end for end in RANGES[name])
    return lambda text: _number(text, least, most, " mm")


def _error(name: str) -> Callable[[str], float]:
    """Reads an error in mm; 0 is the least one that a build takes, which adds nothing."""
    least, most = (1e3 * end for end in RANGES[name])
    return lambda text: max(least, _number(text, 0.0, most, " mm"))


def _hole(text: str) -> float:
    return _number(text, 0.0, WIDEST_HOLE, " mm")


def _chords(text: str) -> int:
    number = _number(text, *RANGES["chords"], "")
    if number != int(number):
        raise argparse.ArgumentTypeError(f"{text}: a whole number is needed")
    return int(number)
