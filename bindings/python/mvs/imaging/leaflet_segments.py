"""The segments of a label map that are the leaflets: as they are given, or by their names."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from typing import Optional

from mvs import ArgumentError, Finding, FindingSource
from .findings import finding
from .names import ANTERIOR, POSTERIOR, UNKNOWN, leaflet_of
from .reading import LabelMap


def other_leaflet(label: int) -> int:
    """The label of the leaflet opposite to one."""
    return POSTERIOR if label == ANTERIOR else ANTERIOR


def choose_segments(labels: LabelMap, chosen: Optional[Mapping[str, int]] = None,
                    image: str = "image") -> dict[str, int]:
    """The leaflet of each segment that is a part of the leaflets.

    chosen: leaflet by name of segment, as the caller knows it, the other leaflet by name where it holds one only;
        else by the names, or, if no name means a leaflet and there is one segment, that one. ArgumentError
        names the segments otherwise
    """
    known = ", ".join(f'"{name}"' for name in labels.masks) or "none"
    if chosen:
        lost = [name for name in chosen if name not in labels.masks]
        if lost:
            raise ArgumentError(f'there is no segment "{lost[0]}"; the {image} has: {known}', "labels")
        return _with_other_leaflet(labels, chosen, known, image)
    filled = [name for name, mask in labels.masks.items() if mask.any()]
    if not filled:
        raise ArgumentError(f"the {image} has no valve in it: every voxel is background. Give the label map of the leaflets", "labels")
    found = {name: leaflet_of(name) for name in filled}
    meant = {name: label for name, label in found.items() if label is not None}
    if not meant and len(filled) == 1:
        return {filled[0]: UNKNOWN}
    if not meant:
        raise ArgumentError(
            f"no name of a segment means a leaflet (the {image} has: {known}): say which ones are, "
            "with --anterior-label and --posterior-label, or --leaflet-label", "labels")
    got = set(meant.values())
    if got in ({ANTERIOR}, {POSTERIOR}):
        missing = "posterior" if got == {ANTERIOR} else "anterior"
        empty = [name for name in labels.masks
                 if name not in filled and leaflet_of(name) == other_leaflet(max(got))]
        raise ArgumentError(
            (f'one leaflet is missing: in the {image} the segment "{empty[0]}" has no voxels. ' if empty else
             f"one leaflet is missing: the {image} has {known}, and no segment of the {missing} leaflet. ")
            + "A valve needs both; if one segment holds both leaflets, say --leaflet-label", "labels")
    return meant


def _with_other_leaflet(labels: LabelMap, chosen: Mapping[str, int], known: str, image: str) -> dict[str, int]:
    """The chosen segments, and where they are of one leaflet those whose names mean the other."""
    got = set(chosen.values())
    if got not in ({ANTERIOR}, {POSTERIOR}):
        return dict(chosen)
    label = other_leaflet(max(got))
    word, given = ("anterior", "posterior") if label == ANTERIOR else ("posterior", "anterior")
    found = {name: label for name, mask in labels.masks.items()
             if name not in chosen and mask.any() and leaflet_of(name) == label}
    if not found:
        raise ArgumentError(
            f"the {given} leaflet alone is given, and no name of another segment means the {word} one (the {image} has: "
            f"{known}): give --{word}-label as well, or --leaflet-label if one segment holds both leaflets", "labels")
    return {**chosen, **found}


def report_segments(labels: LabelMap, segments: Mapping[str, int], given: bool, name: str = "segments") -> list[Finding]:
    """A finding that names the segments of each leaflet and those that are left out; none for one segment.

    Doubtful where several segments do not part the leaflets: their borders are not used.
    """
    left = [one for one, mask in labels.masks.items() if one not in segments and mask.any()]
    if len(segments) + len(left) < 2:
        return []
    parts = [f"{words} {in_quotes(names)}" for label, words in
             ((ANTERIOR, "the anterior leaflet is"), (POSTERIOR, "the posterior leaflet is"), (UNKNOWN, "leaflets are"))
             if (names := [one for one, meant in segments.items() if meant == label])]
    parts += [f"{in_quotes(left)} {'is' if len(left) == 1 else 'are'} left out"] if left else []
    merged = len(segments) > 1 and not set(segments.values()) >= {ANTERIOR, POSTERIOR}
    if merged:
        parts.append("their names do not say which leaflet each is, so they are merged and parted by shape: give "
                     "--anterior-label and --posterior-label")
    found = finding(name, FindingSource.GIVEN if given else FindingSource.GUESSED, 1.0 if given else 0.4 if merged else 0.8,
                    "; ".join(parts))
    return [dataclasses.replace(found, doubtful=merged and not given)]


def in_quotes(names: Iterable[str]) -> str:
    """The names in quotes, with commas between them."""
    return ", ".join(f'"{name}"' for name in names)
