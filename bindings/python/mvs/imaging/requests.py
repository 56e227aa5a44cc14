"""Reads the files that a call of `mvs-image` names, and builds the valve."""

from __future__ import annotations

import argparse
from typing import Any, Optional

import numpy as np

import mvs
from .console import Console, silenced
from .findings import CLOSED, LAW, LENGTHS, finding, keep_doubts, known_values, read_rows, with_limits
from .grid import spacing_of
from .labels import leaflets_in
from .landmark_names import misnamed
from .landmarks import anterior_on_label, check_counts, named_part, read_part
from .leaflet_segments import choose_segments
from .loaded import Motion, closed_surface, motion_of_landmarks
from .mesh import Sheet
from .names import ANTERIOR, POSTERIOR, UNKNOWN
from .needs import need
from .open_valve import check_open_valve
from .reading import MOST_LABELS, LabelMap, is_label_map, is_probability, labels_of, read_labels, read_volume
from .thick_tissue import RESOLVED, assumed_thickness
from .tissue_sheet import LabelSettings
from .valve import ImageValve, build, scanned

PARTS = {"annulus": "annulus", "commissures": "commissures", "anterior": "anterior",
         "tips": "papillary_tips"}


def valve_of_request(chosen: argparse.Namespace, console: Console) -> ImageValve:
    """The valve that the arguments of `mvs-image build` ask for."""
    rows = read_rows(chosen.known) if chosen.known else []
    made = _valve_of_request(chosen, known_values(chosen.known, rows), console)
    given = {*_options(chosen), *(part for option, part in PARTS.items() if getattr(chosen, option)),
             *((LAW,) if chosen.leaflet else ())}
    made.findings = with_limits(keep_doubts([row for row in rows if row["name"] not in given], made.findings))
    made.findings += misnamed_in_files(chosen, made.findings)
    return made


def misnamed_in_files(chosen: argparse.Namespace, findings: tuple[mvs.Finding, ...]) -> tuple[mvs.Finding, ...]:
    """Findings about the names of commissures and papillary tips in the files of the open image."""
    found: tuple[mvs.Finding, ...] = ()
    for option in ("commissures", "tips"):
        path = getattr(chosen, option)
        if path:
            found += misnamed(path, *named_part(path, PARTS[option], chosen.frame), findings)
    return found


def _valve_of_request(chosen: argparse.Namespace, landmarks: dict[str, Any], console: Console) -> ImageValve:
    """The same with the values of `--with` as far as no option gives them."""
    lengths = {name: landmarks.pop(name) for name in LENGTHS if name in landmarks}
    under_load = {name: landmarks.pop(name) for name in CLOSED if name in landmarks}
    law = {"leaflet": landmarks.pop(LAW)} if LAW in landmarks else {}
    landmarks.update(_landmarks(chosen, ""))
    options = {**lengths, **law, **_options(chosen)}
    own = _landmarks(chosen, "loaded_")
    _check_landmarks(landmarks, own)
    console.stage("reading images")
    image = _image(chosen.image, chosen)
    loaded = _image(chosen.loaded, chosen) if chosen.loaded else None
    if not isinstance(image, LabelMap):
        from .microct.valve import valve_of_volumes

        _check_grey(chosen, loaded)
        return valve_of_volumes(image, loaded, landmarks, own, chosen.register, console, name=chosen.image.stem,
                                **options)
    if loaded is not None and not isinstance(loaded, LabelMap):
        raise mvs.ArgumentError("the open image is a label map and the loaded one a grey volume: give "
                                "the labels of the loaded leaflets", "loaded")
    return _valve_of_labels(chosen, image, loaded, landmarks, own, {**under_load, **options}, console)


def _valve_of_labels(chosen: argparse.Namespace, image: LabelMap, loaded: Optional[LabelMap],
                     landmarks: dict[str, Any], own: dict[str, Any], options: dict[str, Any],
                     console: Console) -> ImageValve:
    """own: the landmarks of the loaded image."""
    settings = LabelSettings() if chosen.hole is None else LabelSettings(hole=chosen.hole * 1e-3)
    segments = _segments(chosen)
    motion, how = motion_between(chosen.register or "none", landmarks, own)
    if loaded is not None:
        choose_segments(loaded, segments, "loaded image")  # refused before the work on the open one
    leaflets = leaflets_in(image, segments, settings,
                           lambda step: console.stage(f"open leaflets: {step}"))
    console.stage("open leaflets: rims and holes")
    check_open_valve(leaflets, settings)
    voxel = spacing_of(image.image)
    assumed = {**edge_of_labels(voxel), **thickness_of_labels(leaflets.sheet, voxel)}
    if "thickness" in options:  # given: nothing is known of its error
        assumed.pop("thickness_error")
    assumed = {name: value for name, value in assumed.items() if name not in options}
    options.update({name: float(one.values[0]) for name, one in assumed.items()})
    surface: Optional[Sheet] = None
    found: list[mvs.Finding] = []
    if landmarks.get("anterior") is not None:
        sheet = leaflets.sheet
        found += anterior_on_label(landmarks["anterior"], sheet.points[sheet.triangles].mean(axis=1), leaflets.leaflet)
    if loaded is not None:
        surface, of_surface = closed_surface(loaded, segments, settings,
                                             lambda step: console.stage(f"closed leaflets: {step}"))
        surface.points = motion(surface.points)
        found += [*of_surface, how]
        for part, name in (("annulus", "closed_annulus"), ("papillary_tips", "closed_tips")):
            if part in own:
                options[name] = np.ascontiguousarray(motion(np.atleast_2d(own[part])))
    console.stage("building and closing the valve")
    made = build(leaflets, landmarks, surface, chosen.image.name.split(".")[0],
                 lambda done, _: console.share(done), findings=tuple(found), **options)
    made.findings = tuple(assumed.get(one.name, one) for one in made.findings)
    if chosen.report:
        made.image = scanned(image)
        made.loaded_image = scanned(loaded, motion) if loaded is not None else None
    return made


LEAST_LOST = 1.4e-3
"""m: of tissue that labels of networks may lack at the free edge, however fine their voxels are. At the
published errors of a network (0.45 mm in the mean) the true free edges of three phantoms lie 1.1 to
1.5 mm RMS from those of the labels, mostly farther out."""


def edge_of_labels(voxel: float) -> dict[str, mvs.Finding]:
    """Findings on the free edge of labels, by option of a build: an error of half a voxel either way,
    and two voxels of missing tissue, but not less than networks leave out."""
    lost = min(max(2 * voxel, LEAST_LOST), 5e-3)
    return {
        "edge_error": finding(
            "edge_error", mvs.FindingSource.ASSUMED, 0.5,
            f"the free edge may lie {voxel * 5e2:.2f} mm farther out or in, half a voxel; the interval of "
            "leaks allows for it; give --edge-error if the labels are better or worse",
            [voxel / 2], "m"),
        "edge_lost": finding(
            "edge_lost", mvs.FindingSource.ASSUMED, 0.3,
            f"up to {lost * 1e3:.2f} mm of tissue may be missing at the free edge, as in the labels of "
            "networks (two voxels, at least 1.4 mm); the interval of leaks allows for it; give --edge-lost "
            "if the labels are better or worse", [lost], "m"),
    }


NORMAL_RANGE = 0.25e-3
"""m: normal leaflets have 0.6 to 1.1 mm"""


def thickness_of_labels(sheet: Sheet, voxel: float) -> dict[str, mvs.Finding]:
    """The thickness by option of a build: normal tissue where labels are too narrow to measure it, else
    only the error of the measured one, half a voxel and at most a quarter of it."""
    width = float(np.median(sheet.values["thickness"]))
    assumed = assumed_thickness(width, voxel)
    if assumed is None:
        error = min(voxel / 2, width / 4)
        return {"thickness_error": finding(
            "thickness_error", mvs.FindingSource.ASSUMED, 0.5,
            f"the leaflets may be {error * 1e3:.2f} mm thicker or thinner than their labels; the interval "
            "of leaks allows for it; give --thickness-error if the labels are better or worse", [error],
            "m")}
    return {
        "thickness": finding(
            "thickness", mvs.FindingSource.ASSUMED, 0.4,
            f"{assumed * 1e3:.2f} mm everywhere, as of normal leaflets: the labels are "
            f"{width * 1e3:.2f} mm wide, {np.floor(100 * width / voxel) / 100:.2f} voxels and less than {RESOLVED:g}, and such "
            "labels are as wide on thinner tissue; give --thickness if it is known", [assumed], "m"),
        "thickness_error": finding(
            "thickness_error", mvs.FindingSource.ASSUMED, 0.4,
            f"the leaflets may be {NORMAL_RANGE * 1e3:.2f} mm thicker or thinner; the interval of leaks "
            "allows for it; give --thickness-error if more or less is known", [NORMAL_RANGE], "m"),
    }


def motion_between(how: str, landmarks: dict[str, Any],
                   loaded: dict[str, Any]) -> tuple[Motion, mvs.Finding]:
    """The rigid motion from the loaded frame to the open one, by landmarks of both or none."""
    if how == "none":
        return Motion.none(), finding(
            "registration", mvs.FindingSource.ASSUMED, 0.5,
            "open and loaded image are taken to be in one frame, as phases of one acquisition are; "
            "else give --register landmarks")
    if how == "image":
        raise mvs.ArgumentError("--register image needs grey volumes: label maps move with the "
                                "leaflets. Use --register landmarks", "register")
    common = [part for part in PARTS.values()
              if part in landmarks and part in loaded
              and len(np.atleast_2d(landmarks[part])) == len(np.atleast_2d(loaded[part]))]
    if not common:
        raise mvs.ArgumentError("--register landmarks needs the same landmarks of both images, such as "
                                "--annulus and --loaded-annulus", "register")
    start = np.vstack([np.atleast_2d(loaded[part]) for part in common])
    end = np.vstack([np.atleast_2d(landmarks[part]) for part in common])
    motion, rms = motion_of_landmarks(start, end)
    if rms > 8e-3:
        raise mvs.ArgumentError(
            f"the landmarks of both images ({', '.join(common)}) differ by {rms * 1e3:.0f} mm RMS after "
            "the best rigid motion: they are of another patient, or in another order", "register")
    return motion, finding(
        "registration", mvs.FindingSource.MEASURED, 0.8,
        f"the loaded image was moved to the open one by {len(start)} landmarks ({', '.join(common)}); "
        f"{rms * 1e3:.1f} mm RMS remain, which include the motion of the annulus",
        [*motion.turn.ravel(), *motion.shift])


SEGMENT_OPTIONS = ("anterior_label", "posterior_label", "leaflet_label")


def _image(path: Any, chosen: argparse.Namespace) -> Any:
    """A label map, also wherever options name its segments, or a grey volume."""
    if str(path).lower().endswith((".seg.nrrd", ".seg.nhdr")):
        with silenced():
            return read_labels(path)
    with silenced():
        volume = read_volume(path)
    if is_label_map(volume):
        return labels_of(volume, path=str(path))
    if is_probability(need("SimpleITK").GetArrayViewFromImage(volume)):
        raise mvs.ArgumentError(f"{path}: is a map of probabilities, 0 to 1: threshold it at 0.5 to labels first, one for "
                                "each leaflet; if it is a grey volume, multiply its values by 1000", "image")
    named = [option for option in SEGMENT_OPTIONS if getattr(chosen, option) is not None]
    if named:
        option = f"--{named[0].replace('_', '-')}"
        raise mvs.ArgumentError(f"{path}: is a grey volume, and {option} names a segment of a label map (at most "
                                f"{MOST_LABELS} whole numbers): give the label map, or leave {option} out", "labels")
    return volume


def _check_grey(chosen: argparse.Namespace, loaded: Any) -> None:
    """Refuses options and a loaded image that do not apply to a grey volume of the open valve."""
    if chosen.hole is not None:
        raise mvs.ArgumentError(f"{chosen.image}: is a grey volume, and --hole is about holes in labels: leave it out, or "
                                "give a label map", "hole")
    if isinstance(loaded, LabelMap):
        raise mvs.ArgumentError("the open image is a grey volume and the loaded one a label map: give two grey volumes, or "
                                "the labels of both", "loaded")


def _landmarks(chosen: argparse.Namespace, prefix: str) -> dict[str, Any]:
    return {part: read_part(getattr(chosen, prefix + option), part, chosen.frame)
            for option, part in PARTS.items() if getattr(chosen, prefix + option)}


def _check_landmarks(landmarks: dict[str, Any], loaded: dict[str, Any]) -> None:
    """Refuses faulty numbers of points before images are read."""
    check_counts(landmarks)
    check_counts(loaded, "loaded ")
    tips = [len(np.atleast_2d(part["papillary_tips"])) for part in (landmarks, loaded) if "papillary_tips" in part]
    if len(tips) == 2 and tips[0] != tips[1]:
        raise mvs.ArgumentError(f"--tips has {tips[0]} points and --loaded-tips has {tips[1]}: give the same tips in the same "
                                "order", "papillary_tips")


def _segments(chosen: argparse.Namespace) -> Optional[dict[str, int]]:
    given = {chosen.anterior_label: ANTERIOR, chosen.posterior_label: POSTERIOR,
             chosen.leaflet_label: UNKNOWN}
    return {name: label for name, label in given.items() if name is not None} or None


def _options(chosen: argparse.Namespace) -> dict[str, Any]:
    lengths = {"edge": chosen.edge, "thickness": chosen.thickness,
               "coaptation_length": chosen.coaptation_length,
               "edge_error": chosen.edge_error, "edge_lost": chosen.edge_lost,
               "thickness_error": chosen.thickness_error, "closed_error": chosen.closed_error}
    options: dict[str, Any] = {name: value * 1e-3 for name, value in lengths.items()
                               if value is not None}
    options.update({name: getattr(chosen, name) for name in ("chords", "leaflet")
                    if getattr(chosen, name) is not None})
    return options
