"""A site on a leaflet, and its forms as text and as a tuple."""

from __future__ import annotations

import dataclasses
from typing import Any, Optional, Union

from .errors import ArgumentError


@dataclasses.dataclass(frozen=True)
class Site:
    """A site on a leaflet: a node, a point of a triangle, or a point of a scallop.

    node: index
    triangle: index; ``barycentric`` are its coordinates, with sum 1
    scallop: name or id; ``along``: 0 at its end towards the negative CC axis, 1 at the other;
        ``height``: 0 at the annulus, 1 at the free edge
    """

    node: Optional[int] = None
    triangle: Optional[int] = None
    barycentric: tuple[float, ...] = ()
    scallop: Union[str, int, None] = None
    along: float = 0.5
    height: float = 1.0

    def __repr__(self) -> str:
        if self.node is not None:
            return f"mvs.Site(node={self.node})"
        if self.triangle is not None:
            return f"mvs.Site(triangle={self.triangle}, barycentric={self.barycentric})"
        return f"mvs.Site(scallop={self.scallop!r}, along={self.along}, height={self.height})"

    def __post_init__(self) -> None:
        given = [x is not None for x in (self.node, self.triangle, self.scallop)]
        if sum(given) != 1 or (self.triangle is not None) != (len(self.barycentric) == 3):
            raise ArgumentError(
                "a site is a node, or a triangle with three barycentric coordinates, or a scallop",
                "site",
            )


def site_of_text(text: str) -> Site:
    """Reads the command's text: P2:0.5:0.9, node:17, or triangle:12:0.3:0.3:0.4."""
    first, *rest = text.split(":")
    if first == "node" and len(rest) == 1:
        return Site(node=int(rest[0]))
    if first == "triangle" and len(rest) == 4:
        return Site(triangle=int(rest[0]), barycentric=tuple(map(float, rest[1:])))
    along, height = map(float, rest)
    return Site(scallop=first, along=along, height=height)


def site_of_tuple(first: Any, *rest: Any) -> Site:
    """Reads (scallop, along, height) or (triangle, (u, v, w))."""
    if len(rest) == 1:
        return Site(triangle=first, barycentric=tuple(rest[0]))
    along, height = rest
    return Site(scallop=first, along=along, height=height)
