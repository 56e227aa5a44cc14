"""Fits of a closed valve to measured shapes: mvs.fit, its result and its report."""

from .fit import fit
from .parameters import PRIORS, Prior
from .result import Fit, Interval
from .targets import Points

__all__ = ["PRIORS", "Fit", "Interval", "Points", "Prior", "fit"]
