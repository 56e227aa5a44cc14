"""Words of error sentences: near names and lists."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


def did_you_mean(word: str, names: Iterable[str]) -> str:
    """"; did you mean "chord_rest_length"?" if a name is near, else the empty text."""
    near = difflib.get_close_matches(word, list(names), n=3, cutoff=0.6)
    return f"; did you mean {' or '.join(map(repr, near))}?" if near else ""


def listed(names: Iterable[str]) -> str:
    """Quoted names, separated by commas."""
    return ", ".join(f'"{name}"' for name in names)


def shown(value: object) -> str:
    """A value in an error sentence: its text if that is short, and its type."""
    text = repr(value)
    kind = type(value).__name__
    return f"{text} ({kind})" if len(text) <= 40 and "\n" not in text else f"a {kind}"
