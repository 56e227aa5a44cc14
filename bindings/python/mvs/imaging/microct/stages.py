"""The stages of the segmentation of a micro-CT-like volume, in order.

tissue: share of tissue; thick: muscles and wall; leaflets: flat tissue; sheet: their mid-surface;
muscles: which thick parts are papillary muscles; paths, chords: chordae. Given: "image"; "loaded": True under load;
"tips" (k, 3) m, if they are known.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..mesh import Sheet, areas, largest_piece, pieces
from ..needs import need
from ..pipeline import Pipeline
from ..sheet import SheetSettings, mid_surface
from .chords import chords_of
from .graph import muscles_of, paths_of
from .segment import EVERYWHERE, large_pieces, leaflets_of, thick_parts, tissue_of


def sheet_of(results: Mapping[str, Any]) -> Sheet:
    """The mid-surface of the leaflets: one piece, under load all large ones."""
    tissue = results["tissue"]
    near = need("scipy.ndimage").binary_dilation(results["leaflets"].mask, EVERYWHERE)
    share = tissue.share * near
    step = tissue.grid.step
    sheet = mid_surface(tissue.grid, share, SheetSettings(blur=max(0.4e-3, 1.5 * step),
                                                          smoothing=max(0.4e-3, 2 * step)))
    if not results.get("loaded"):
        return largest_piece(sheet)[0]
    piece = pieces(sheet.triangles, len(sheet.points))
    return sheet.part(np.isin(piece, large_pieces(np.bincount(piece, areas(sheet.points, sheet.triangles)))))


PIPELINE = Pipeline((
    ("tissue", tissue_of), ("thick", thick_parts), ("leaflets", leaflets_of), ("sheet", sheet_of),
    ("muscles", muscles_of), ("paths", paths_of), ("chords", chords_of),
))
