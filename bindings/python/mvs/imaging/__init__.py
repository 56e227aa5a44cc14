"""Volumes, label maps and landmarks of patients: from an image to a valve (extra "imaging").

    labels = mvs.imaging.read_labels("open.seg.nrrd")
    leaflets = mvs.imaging.leaflets_in(labels)
    made = mvs.imaging.build(leaflets, {"papillary_tips": tips})

Volumes are SimpleITK.Image in LPS and mm; points, surfaces and everything else in m. `import mvs` does
not import this package.
"""

from .labels import Leaflets, leaflets_in
from .landmarks import read_part
from .loaded import Motion, closed_surface, motion_of_images, motion_of_landmarks
from .mesh import Sheet
from .open_valve import check_open_valve
from .pipeline import Pipeline, Run
from .reading import LabelMap, labels_of, read_labels, read_volume
from .sheet import SheetSettings, mid_surface
from .tissue_sheet import LabelSettings, sheet_of_image
from .valve import ImageValve, build

__all__ = [
    "ImageValve", "LabelMap", "LabelSettings", "Leaflets", "Motion", "Pipeline", "Run", "Sheet", "SheetSettings",
    "build", "check_open_valve", "closed_surface", "labels_of", "leaflets_in", "mid_surface",
    "motion_of_images", "motion_of_landmarks", "read_labels", "read_part", "read_volume", "sheet_of_image",
]
