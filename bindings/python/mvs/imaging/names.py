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


OTHER_WORDS = ("lv", "rv", "la", "ra", "tv", "av", "pm", "apm", "ppm", "alpm", "pmpm")
"""Whole words: chambers, other valves, papillary muscles"""
JOINED = re.compile(r"[+&]|\b(?:plus|and|with|without|incl|including|near|und|mit|ohne|et|avec|sans)\b", re.IGNORECASE)
"""Words before the other contents of a leaflet's segment: "Anterior leaflet + septum\""""
BY_PLACE = ((r"\baort\w* (?=(?:mitral\w* )?(?:leaflet|segel|feuillet)\b)|\baortique$", "anterior "),
            (r"\bmural\w* (?=(?:mitral\w* )?(?:leaflet|segel|feuillet)\b)|\bmural$", "posterior "))
"""Leaflets by the tissue that they face: the aortic leaflet is the anterior one, the mural leaflet the posterior one"""


def leaflet_of(name: str) -> Optional[int]:
    """The leaflet that the name of a segment means; 0: leaflets without distinction; None: neither."""
    words = _by_direction(words_of(name))
    if _mean_other_part(words, name):
        first = JOINED.split(name)[0]
        words = _by_direction(words_of(first))
        if _mean_other_part(words, first) or not any(word.startswith(BOTH) for word in words) or not _directions(words):
            return None
    meant = _directions(words)
    if len(meant) == 1:
        return meant.pop()
    return UNKNOWN if meant or any(word.startswith(BOTH) for word in words) else None


def _directions(words: list[str]) -> set[int]:
    return {label for label in WORDS
            if any(word in WORDS[label] or word.startswith(BEGINNINGS[label]) for word in words)}


def _mean_other_part(words: list[str], name: str) -> bool:
    if any(word.startswith(OTHER_PARTS) or word.endswith(("wand", "wall", "muskel")) for word in words):
        return True
    # "la" is an article too: "valva anterior de la mitral"
    article = not re.search(r"(?<![A-Za-z])LA(?![A-Za-z])", name) and any(word.startswith(BOTH) for word in words)
    return any(word in OTHER_WORDS and not (word == "la" and article) for word in words)


def _by_direction(words: list[str]) -> list[str]:
    """The words with those of BY_PLACE as directions; leaflets of the aortic valve are left or right ones."""
    text = " ".join(words)
    if any(word.startswith(BOTH) for word in words) and not {"left", "right", "non"} & set(words):
        for pattern, direction in BY_PLACE:
            text = re.sub(pattern, direction, text) if "valve" not in words else text
    return text.split()


def words_of(name: str) -> list[str]:
    """The words of a name in lower case, without accents and punctuation; "AnteriorLeaflet" has two."""
    apart = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name)
    plain = "".join(c for c in unicodedata.normalize("NFKD", apart.lower()) if not unicodedata.combining(c))
    return [word for word in re.split(r"[\W_]+", plain) if word]
