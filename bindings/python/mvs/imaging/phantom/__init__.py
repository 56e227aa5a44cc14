"""Phantom volumes: images, labels and landmarks of a valve that is known, to test a recovery.

    from mvs.imaging import phantom

    made = phantom.make(opened, phantom.micro_ct(seed=1))   # a mvs.Snapshot or mvs.Valve
    made.opened.image, made.loaded.labels                   # SimpleITK.Image, LPS, mm
    phantom.save(made, "case1")                             # the truth in case1/truth

Needs SimpleITK and SciPy. `python -m mvs.imaging.phantom --help` is the command.
"""

from .files import save
from .volumes import Phantom, Volume, make
from .settings import LABEL_ERRORS, PRESETS, LabelErrors, Settings, micro_ct, ultrasound

__all__ = [
    "LABEL_ERRORS",
    "PRESETS",
    "LabelErrors",
    "Phantom",
    "Settings",
    "Volume",
    "make",
    "micro_ct",
    "save",
    "ultrasound",
]
