"""The closed valve in the loaded image: its surface, and its place in the frame of the open image."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from mvs import ArgumentError, Finding, FindingSource
from .findings import finding
from .grid import Floats, Points, spacing_of
from .leaflet_segments import choose_segments, report_segments
from .mesh import Sheet, areas, largest_piece
from .names import ANTERIOR, POSTERIOR
from .needs import need
from .reading import LabelMap
from .spurs import without_spurs
from .tissue_sheet import LabelSettings, Tell, fitted_sheet, grid_step, silent, tissue_on_grid


@dataclasses.dataclass(frozen=True, eq=False)
class Motion:
    """A rigid motion x -> turn @ x + shift, m, LPS."""

    turn: Floats
    shift: Points

    def __call__(self, points: Points) -> Points:
        return np.asarray(points @ self.turn.T + self.shift)

    @staticmethod
    def none() -> "Motion":
        return Motion(np.eye(3), np.zeros(3))


def motion_of_landmarks(start: Points, end: Points) -> tuple[Motion, float]:
    """The rigid motion of least squares between paired points (Kabsch 1976), and its RMS error, m."""
    if start.shape != end.shape or len(start) < 3:
        raise ArgumentError("a registration by landmarks needs the same three or more points, in the "
                            "same order, in both images", "landmarks")
    a, b = start - start.mean(axis=0), end - end.mean(axis=0)
    left, _, right = np.linalg.svd(a.T @ b)
    sign = np.diag([1, 1, np.sign(np.linalg.det(right.T @ left.T))])
    turn = right.T @ sign @ left.T
    motion = Motion(turn, end.mean(axis=0) - turn @ start.mean(axis=0))
    return motion, float(np.sqrt(((motion(start) - end) ** 2).sum(axis=1).mean()))


def motion_of_images(moving: Any, fixed: Any) -> tuple[Motion, Finding]:
    """Rigid registration of two grey volumes: Mattes mutual information, three resolutions, from the
    position in which the centres of their tissue coincide.

    Random samples of a fixed seed: the same images give the same motion.
    """
    sitk = need("SimpleITK")
    # of the tissue, not of all grey values: those of the background would make it the centre of the volume
    start = sitk.CenteredTransformInitializer(
        _tissue_in(fixed), _tissue_in(moving), sitk.Euler3DTransform(),
        sitk.CenteredTransformInitializerFilter.MOMENTS)
    method = sitk.ImageRegistrationMethod()
    method.SetMetricAsMattesMutualInformation(32)
    method.SetMetricSamplingStrategy(method.RANDOM)
    method.SetMetricSamplingPercentage(min(1.0, 2e5 / np.prod(fixed.GetSize())), 1)
    method.SetInterpolator(sitk.sitkLinear)
    method.SetOptimizerAsRegularStepGradientDescent(1.0, 1e-4, 200)
    method.SetOptimizerScalesFromPhysicalShift()
    method.SetShrinkFactorsPerLevel([4, 2, 1])
    method.SetSmoothingSigmasPerLevel([2, 1, 0])
    method.SetInitialTransform(start, inPlace=False)
    found = sitk.Euler3DTransform(sitk.CompositeTransform(method.Execute(fixed, moving)).GetBackTransform())
    turn = np.array(found.GetMatrix()).reshape(3, 3)
    centre, shift = np.array(found.GetCenter()), np.array(found.GetTranslation())
    # the transform goes from the fixed image to the moving one
    offset = (centre + shift - turn @ centre) * 1e-3
    motion = Motion(turn.T, -turn.T @ offset)
    angle = np.degrees(np.arccos(np.clip((np.trace(turn) - 1) / 2, -1, 1)))
    return motion, finding(
        "registration", FindingSource.MEASURED, 0.6,
        f"the loaded image was turned by {angle:.1f} degrees and its middle moved by "
        f"{np.linalg.norm(shift):.1f} mm to fit the open one (mutual information); give landmarks of "
        "both images if this is wrong", [*motion.turn.ravel(), *motion.shift])


def _tissue_in(image: Any) -> Any:
    """1 where an image is brighter than Otsu's threshold, else 0."""
    sitk = need("SimpleITK")
    return sitk.Cast(sitk.OtsuThreshold(image, 0, 1), sitk.sitkFloat32)


def closed_surface(labels: LabelMap, chosen: Optional[Mapping[str, int]] = None,
                   settings: LabelSettings = LabelSettings(),
                   tell: Tell = silent) -> tuple[Sheet, list[Finding]]:
    """The mid-surfaces of the closed leaflets, each by itself, as one triangle surface.

    Leaflets that touch share no gap: each needs a label of its own. With one label for both, the
    surface runs through the middle of the tissue, right only where one leaflet is.
    """
    segments = choose_segments(labels, chosen, "loaded image")
    sheets: list[Sheet] = []
    findings = report_segments(labels, segments, bool(chosen), "closed_segments")
    groups: list[tuple[str, list[str]]] = []
    if set(segments.values()) >= {ANTERIOR, POSTERIOR}:
        for label, word in ((ANTERIOR, "anterior"), (POSTERIOR, "posterior")):
            groups.append((word, [name for name, k in segments.items() if k == label]))
    else:
        groups.append(("", list(segments)))
        findings.append(finding(
            "closed_labels", FindingSource.ASSUMED, 0.3,
            "the loaded image has one label for both leaflets: where they touch, their middle is taken "
            "for both. Label the leaflets one by one"))
    for word, names in groups:
        mask = np.any([labels.masks[name] for name in names], axis=0)
        if not mask.any():
            raise ArgumentError(f"the {word} leaflet is missing in the loaded image", "loaded")
        named = f"{word} leaflet: " if word else ""
        sheet = _largest_sheet(labels.image, mask, settings, lambda step: tell(named + step))
        sheets.append(without_spurs(sheet, f"{word} leaflet" if word else "leaflets", findings))
    points = np.vstack([sheet.points for sheet in sheets])
    first = np.cumsum([0, *(len(sheet.points) for sheet in sheets)])
    triangles = np.vstack([sheet.triangles + k for sheet, k in zip(sheets, first)])
    leaflet = np.concatenate([np.full(len(s.triangles), k, np.uint32) for s, k in
                              zip(sheets, (ANTERIOR, POSTERIOR) if len(sheets) == 2 else (0,))])
    surface = Sheet(points, triangles, {"thickness": np.concatenate(
        [sheet.values["thickness"] for sheet in sheets])})
    area = [float(areas(points, triangles[leaflet == k]).sum()) for k in np.unique(leaflet)]
    findings.append(finding(
        "closed_surface", FindingSource.MEASURED, 0.7,
        "the closed leaflets in the loaded image have "
        + " and ".join(f"{1e4 * a:.1f} cm2" for a in area), area, "m2"))
    return surface, findings


def _largest_sheet(image: Any, mask: NDArray[np.bool_], settings: LabelSettings, tell: Tell) -> Sheet:
    voxel = spacing_of(image)
    grid, tissue = tissue_on_grid(image, mask, grid_step(image, mask))
    return largest_piece(fitted_sheet(grid, tissue, voxel, settings, tell))[0]
