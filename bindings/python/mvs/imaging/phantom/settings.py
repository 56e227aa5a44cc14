"""The settings of a phantom, their presets and their checks. Lengths in mm: they describe images."""

from __future__ import annotations

import dataclasses
import math
from typing import Annotated

from ...describe import with_field_help
from ...errors import ArgumentError

LABEL_ERRORS = ("displacement", "spurs", "holes", "eaten", "swapped")
"""The kinds of errors of labels, in the order in which they are made."""

MAX_VOXELS = 150_000_000
"""The largest volume: 530 voxels in each direction, about 3 GB of memory while it is made."""


@with_field_help
@dataclasses.dataclass(frozen=True)
class LabelErrors:
    """Errors that are put into the labels of leaflets, as segmentation networks make them.

    Sizes are searched until mean and hd95 are those that are asked for. The defaults are those of a
    network on 3D ultrasound (Munafo et al. 2023, arXiv 2302.10634: 0.43 to 0.47 mm and 3.57 mm).
    """

    kinds: Annotated[tuple[str, ...], "1", "some of LABEL_ERRORS; none: the labels are exact"] = ()
    mean: Annotated[float, "mm", "mean symmetric surface distance of a leaflet's label"] = 0.45
    hd95: Annotated[float, "mm", "95 % Hausdorff distance of a leaflet's label"] = 3.6
    wavelength: Annotated[float, "mm", "of the displacement of boundaries"] = 8.0


@with_field_help
@dataclasses.dataclass(frozen=True)
class Settings:
    """How a phantom is made from a valve; micro_ct() and ultrasound() have the usual values."""

    kind: Annotated[str, "1", '"micro-ct" or "ultrasound"']
    spacing: Annotated[float, "mm", "of the voxels, equal in all directions"]
    margin: Annotated[float, "mm", "of the volume around the leaflets and tips"]
    blur: Annotated[tuple[float, float], "mm", "FWHM of the PSF: axial, lateral"]
    noise: Annotated[float, "1", "standard deviation of the noise over the contrast of tissue"]
    bias: Annotated[float, "1", "largest relative change of brightness over the volume"]
    drop_out: Annotated[float, "1", "0 to 1: loss of signal where leaflets are along the beam"]
    tilt: Annotated[float, "degrees", "largest tilt of the volume's axes; 0: axes of the patient"]
    chords_seen: Annotated[bool, "1", "labels of chordae, papillary muscles and the annulus wall"]
    label_width: Annotated[float, "voxels", "least thickness of a leaflet in the labels"]
    landmark_error: Annotated[float, "mm", "standard deviation of each landmark's coordinates"]
    labels: Annotated[LabelErrors, "1", "errors of the labels of leaflets"]
    seed: Annotated[int, "1", "of everything that is random"] = 0
    pose: Annotated[bool, "1", "turn and move the valve at random, as a patient lies"] = False
    pressure: Annotated[float, "mmHg", "that closes the valve in the loaded volume"] = 120.0
    law: Annotated[str, "1", "tissue of the true leaflets, a name of mvs.LeafletLaw"] = (
        "may_newman_yin"
    )
    vertices: Annotated[int, "1", "least number of vertices of the true leaflets"] = 1600
    thickness_variation: Annotated[float, "1", "smooth relative variation of thickness"] = 0.15
    chord_diameter: Annotated[float, "1", "factor on the diameters of the valve's chordae"] = 0.6
    head_spread: Annotated[float, "mm", "radius over which the chordae of a head are spread"] = 2.5
    chord_shape: Annotated[str, "1", '"arc": slack chordae are arcs of their rest length; "straight"'] = "arc"
    muscle_radius: Annotated[tuple[float, float], "mm", "of papillary muscles: tip, base"] = (1.5, 4.0)
    muscle_length: Annotated[float, "mm", "of papillary muscles"] = 10.0
    misplaced: Annotated[float, "degrees and mm", "motion of the patient between both volumes"] = 0.0
    wall_radius: Annotated[float, "mm", "of the annulus wall, a tube outside of the annulus"] = 1.5
    max_voxels: Annotated[int, "1", "refuse larger volumes"] = MAX_VOXELS

    def __post_init__(self) -> None:
        _check(self)


def micro_ct(**changes: object) -> Settings:
    """Settings of a micro-CT-like volume of an excised valve: 0.15 mm, all parts visible."""
    usual = Settings(
        kind="micro-ct", spacing=0.15, margin=3.0, blur=(0.2, 0.2), noise=0.06, bias=0.1,
        drop_out=0.0, tilt=0.0, chords_seen=True, label_width=0.0, landmark_error=0.0,
        labels=LabelErrors(), misplaced=4.0,
    )
    return _changed(usual, changes)


def ultrasound(**changes: object) -> Settings:
    """Settings of a 3D-ultrasound-like volume: 0.7 mm, speckle, drop-out, labels of a network."""
    usual = Settings(
        kind="ultrasound", spacing=0.7, margin=6.0, blur=(0.9, 1.8), noise=0.02, bias=0.15,
        drop_out=0.8, tilt=20.0, chords_seen=False, label_width=1.75, landmark_error=0.5,
        labels=LabelErrors(kinds=LABEL_ERRORS),
    )
    return _changed(usual, changes)


def _changed(usual: Settings, changes: dict[str, object]) -> Settings:
    return dataclasses.replace(usual, **changes)  # type: ignore[arg-type]  # refuses other names; _check values


PRESETS = {"micro-ct": micro_ct, "ultrasound": ultrasound}


def _check(settings: Settings) -> None:
    """Refuses values that no phantom can have, each with a sentence."""
    from ...kinds import LeafletLaw

    if settings.kind not in PRESETS:
        _refuse("kind", f"{settings.kind!r} is no kind of image: give micro-ct or ultrasound")
    _within("spacing", settings.spacing, 0.02, 3.0, "mm")
    _within("margin", settings.margin, 0.0, 50.0, "mm")
    for width in settings.blur:
        _within("blur", width, 0.0, 10.0, "mm")
    _within("noise", settings.noise, 0.0, 5.0, "of the contrast of tissue")
    _within("bias", settings.bias, 0.0, 0.9, "")
    _within("drop_out", settings.drop_out, 0.0, 1.0, "")
    _within("tilt", settings.tilt, 0.0, 90.0, "degrees")
    _within("label_width", settings.label_width, 0.0, 10.0, "voxels")
    _within("misplaced", settings.misplaced, 0.0, 30.0, "degrees and mm")
    _within("landmark_error", settings.landmark_error, 0.0, 10.0, "mm")
    _within("pressure", settings.pressure, 1.0, 300.0, "mmHg")
    _within("vertices", settings.vertices, 0, 50_000, "")
    _within("thickness_variation", settings.thickness_variation, 0.0, 0.5, "")
    for radius in (*settings.muscle_radius, settings.wall_radius):
        _within("radius", radius, 0.2, 10.0, "mm")
    if settings.muscle_radius[1] - settings.muscle_radius[0] >= settings.muscle_length:
        _refuse("muscle_length", "muscle_length must exceed the difference of the muscle_radius")
    _within("muscle_length", settings.muscle_length, 1.0, 60.0, "mm")
    _within("chord_diameter", settings.chord_diameter, 0.1, 5.0, "")
    _within("head_spread", settings.head_spread, 0.0, 10.0, "mm")
    if settings.chord_shape not in ("arc", "straight"):
        _refuse("chord_shape", f"{settings.chord_shape!r} is not 'arc' or 'straight'")
    if settings.law.upper() not in LeafletLaw.__members__:
        names = ", ".join(LeafletLaw.__members__).lower()
        _refuse("law", f"{settings.law!r} is no leaflet law: give one of {names}")
    if settings.seed < 0:
        _refuse("seed", f"seed must be 0 or more, it is {settings.seed}")
    _check_label_errors(settings.labels)


def _check_label_errors(errors: LabelErrors) -> None:
    for kind in errors.kinds:
        if kind not in LABEL_ERRORS:
            known = ", ".join(LABEL_ERRORS)
            _refuse("labels", f"{kind!r} is no error of labels: give some of {known}")
    _within("labels.mean", errors.mean, 0.0, 3.0, "mm")
    _within("labels.hd95", errors.hd95, 0.0, 15.0, "mm")
    _within("labels.wavelength", errors.wavelength, 2.0, 50.0, "mm")


def _within(name: str, value: float, low: float, high: float, unit: str) -> None:
    if not (math.isfinite(value) and low <= value <= high):
        end = f" {unit}" if unit else ""
        _refuse(name, f"{name} is {value:g}{end}; it must be between {low:g} and {high:g}{end}")


def _refuse(part: str, sentence: str) -> None:
    raise ArgumentError(sentence, part)


def as_dictionary(settings: Settings) -> dict[str, object]:
    """The settings for a JSON file."""
    return dataclasses.asdict(settings)
