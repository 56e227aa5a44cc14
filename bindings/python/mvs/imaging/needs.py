"""Imports the packages of the extra "imaging", or names the extra that is missing."""

from __future__ import annotations

import importlib
from types import ModuleType

EXTRA = {
    "SimpleITK": "SimpleITK",
    "skimage": "scikit-image",
    "scipy": "SciPy",
    "pyvista": "PyVista",
    "slicerio": "slicerio",
    "matplotlib": "Matplotlib",
}


def need(name: str) -> ModuleType:
    """The module `name`, such as "scipy.ndimage"; ImportError names the extra if it is absent."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        package = EXTRA.get(name.split(".")[0], name)
        raise ImportError(_missing(package)) from error


def in_words(error: Exception) -> str:
    """The sentence of an error; where a package of the extra is missing, how to install it."""
    package = EXTRA.get(str(getattr(error, "name", "")).split(".")[0])
    return _missing(package) if package else str(error)


def _missing(package: str) -> str:
    return (f"mvs.imaging needs {package}: pip install 'libmvs[imaging]' or, beside a checkout, pip install "
            + " ".join(EXTRA.values()))
