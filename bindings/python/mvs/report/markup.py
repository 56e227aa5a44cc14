"""Pieces of HTML that the chapters of the report share."""

from __future__ import annotations

import base64
import html
from collections.abc import Iterable


def figure(png: bytes, caption: str, words: str = "") -> str:
    """A picture inside the page with a caption; `words` describes it, else the caption does."""
    data = base64.b64encode(png).decode()
    caption = html.escape(caption, quote=True)
    described = html.escape(words, quote=True) if words else caption
    return (f'<figure><img alt="{described}" src="data:image/png;base64,{data}">'
            f"<figcaption>{caption}</figcaption></figure>\n")


def table(rows: Iterable[str]) -> str:
    """A table of rows of HTML."""
    return "<table>\n" + "\n".join(rows) + "\n</table>"


def cells(values: Iterable[object]) -> str:
    """Cells of one row; the values are HTML or numbers."""
    return "".join(f"<td>{value}</td>" for value in values)


def heads(titles: Iterable[str]) -> str:
    """Cells of a heading row; the titles are HTML."""
    return "".join(f"<th>{title}</th>" for title in titles)
