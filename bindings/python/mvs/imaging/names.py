"""The leaflet that the name of a segment means, in English, Latin and its daughters, and German."""

from __future__ import annotations

import re
import unicodedata
from typing import Optional

UNKNOWN, ANTERIOR, POSTERIOR = 0, 1, 2

WORDS = {ANTERIOR: ("a", "ant", "aml", "amvl", "a1", "a2", "a3"), POSTERIOR: ("p", "post", "pml", "pmvl", "p1", "p2", "p3")}
"""Whole words; A1 to P3 are the scallops of Carpentier"""
BEGINNINGS = {ANTERIOR: ("anterior", "anterieur", "vorder", "vorn"), POSTERIOR: ("posterior", "posterieur", "hinter", "hinten")}
BOTH = ("leaflet", "valve", "valva", "mitral", "mv", "segel", "feuillet")
OTHER_PARTS = ("papill", "annul", "anneau", "muscl", "muskel", "pilier", "chord", "cord", "sehn", "tendon", "ventric", "kammer",
               "atri", "oreillette", "vorhof", "aort", "commiss", "kommiss", "wall", "wand", "paroi", "sept", "arter", "coron",
               "descend", "vein", "vena", "tricusp", "trikusp", "pulmon", "fascic")
"""Beginnings of the names of other parts: "anterior papillary muscle", "left anterior descending", "Hinterwand\""""


def leaflet_of(name: str) -> Optional[int]:
    """The leaflet that the name of a segment means; 0: leaflets without distinction; None: neither."""
    words = words_of(name)
    if any(word.startswith(OTHER_PARTS) or word.endswith(("wand", "wall", "muskel")) for word in words):
        return None
    meant = {label for label in WORDS
             if any(word in WORDS[label] or word.startswith(BEGINNINGS[label]) for word in words)}
    if len(meant) == 1:
        return meant.pop()
    return UNKNOWN if meant or any(word.startswith(BOTH) for word in words) else None


def words_of(name: str) -> list[str]:
    """The words of a name in lower case, without accents and punctuation; "AnteriorLeaflet" has two."""
    apart = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name)
    plain = "".join(c for c in unicodedata.normalize("NFKD", apart.lower()) if not unicodedata.combining(c))
    return [word for word in re.split(r"[\W_]+", plain) if word]
