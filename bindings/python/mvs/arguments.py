"""TypeErrors of the binding as one sentence: which argument does not fit, and why.

pybind11 reports a call that does not fit with all its signatures. The wrappers made here check the
arguments against the signature only after such an error, so that a call that fits costs nothing.
"""

from __future__ import annotations

import ast
import dataclasses
import functools
import inspect
import operator
import os
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Optional, SupportsIndex

from .words import did_you_mean, shown

_MISFIT = re.compile(r"incompatible (function|constructor) arguments")


@dataclasses.dataclass(frozen=True)
class Parameter:
    """A parameter in a signature of pybind11: "pressure_pa: typing.SupportsFloat = 1.0"."""

    name: str
    type: str
    default: str
    by_keyword: bool

    @property
    def required(self) -> bool:
        """Whether it has no default."""
        return not self.default


def read_signature(text: str) -> list[Parameter]:
    """The parameters, after self, of a signature of pybind11, whose bracket opens first in a text.

    "(self: mvs._core.Simulator, *, solver: str = 'newton') -> object"; the signature of a
    constructor in an error has no self.
    """
    found, by_keyword = [], False
    for part in _split(text[text.index("(") + 1 :]):
        if part in ("", "/") or part.startswith("*"):
            by_keyword = by_keyword or part == "*"
            continue
        name, _, rest = part.partition(": ")
        if name == "self":
            continue
        kind, _, default = rest.partition(" = ")
        found.append(Parameter(name, kind, default, by_keyword))
    return found


def signature_of(documentation: str) -> Optional[inspect.Signature]:
    """The signature in the first line of a docstring of pybind11; None for one with *args."""
    line = documentation.partition("\n")[0]
    if "(self: " not in line or "*args" in line or "**kwargs" in line:
        return None
    made = [inspect.Parameter("self", inspect.Parameter.POSITIONAL_ONLY)]
    for p in read_signature(line):
        default = inspect.Parameter.empty if p.required else _value(p.default)
        named, placed = inspect.Parameter.KEYWORD_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD
        kind = named if p.by_keyword else placed
        made.append(inspect.Parameter(p.name, kind, default=default))
    return inspect.Signature(made)


def _value(text: str) -> Any:
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError):
        return ...


def _split(text: str) -> list[str]:
    """The parts between commas up to the closing bracket, outside of inner brackets and quotes."""
    parts, depth, begin, quote = [], 0, 0, ""
    for k, sign in enumerate(text):
        if quote:
            quote = "" if sign == quote else quote
        elif sign in "'\"":
            quote = sign
        elif sign in "([{":
            depth += 1
        elif sign in ")]}" and depth > 0:
            depth -= 1
        elif sign == "," and depth == 0 or sign == ")":
            parts.append(text[begin:k].strip())
            begin = k + 1
            if sign == ")":
                break
    return parts


def _is_number(value: object) -> bool:
    return not isinstance(value, bool) and (hasattr(value, "__float__") or _is_index(value))


def _is_index(value: object) -> bool:
    try:
        return isinstance(value, SupportsIndex) and operator.index(value) >= 0
    except TypeError:
        return False


def _is_triple(value: object, count: int) -> bool:
    try:
        return len(value) == count and all(map(_is_number, value))  # type: ignore[arg-type,call-overload]  # TypeError: below
    except TypeError:
        return False


def _fits(kind: str, value: object) -> tuple[str, bool]:
    """The words for a type of pybind11, and whether a value is of that type."""
    if value is None and "None" in kind:
        return "", True
    sizes = re.search(r"FixedSize\((\d)\)", kind)
    if sizes:
        return f"{sizes[1]} numbers", _is_triple(value, int(sizes[1]))
    for pattern, words, fits in (
        ("Path|PathLike", "a path", isinstance(value, (str, bytes, os.PathLike))),
        ("Float|float", "a number", _is_number(value)),
        (r"\bint\b|Int|Index", "a non-negative integer", _is_index(value)),
        (r"\bbool\b", "True or False", isinstance(value, bool)),
        (r"\bstr\b", "text", isinstance(value, str)),
        (r"\bbytes\b", "bytes", isinstance(value, bytes)),
    ):
        if re.search(pattern, kind):
            return words, fits
    own = re.search(r"mvs\._core\.(\w+)", kind)
    if own:
        return f"a mvs.{own[1]}", type(value).__name__ == own[1]
    return "", True


def sentence(call: str, text: str, given: Sequence[Any], named: Mapping[str, Any]) -> str:
    """The sentence for a call that did not fit the signature in the error of pybind11."""
    parameters = read_signature(text[text.index("\n    1. ") :])
    names = [p.name for p in parameters]
    places = [p for p in parameters if not p.by_keyword]
    words = f"{call}() takes {', '.join(names) or 'no arguments'}"
    if len(given) > len(places):
        extra = given[len(places)]
        if len(places) < len(parameters):
            first = parameters[len(places)].name
            return f"{call}: {shown(extra)} needs a name, as in {call}({first}=...); {words}"
        return f"{call}: {shown(extra)} is one argument too many; {words}"
    for name in named:
        if name not in names and "**kwargs" not in text:
            near = did_you_mean(name, names) or f"; {words}"
            return f'{call}() has no argument "{name}"{near}'
    values = {**{p.name: value for p, value in zip(places, given)}, **named}
    for p in parameters:
        if p.required and p.name not in values:
            return f"{call}() needs the argument {p.name}; {words}"
        if p.name in named and p in places[: len(given)]:
            return f"{call}: {p.name} is given twice, by its place and by its name"
    for p in parameters:
        if p.name in values:
            wanted, fits = _fits(p.type, values[p.name])
            if not fits:
                wanted += " or None" if "None" in p.type else ""
                return f"{call}: {p.name} has to be {wanted}, not {shown(values[p.name])}"
    large = _too_large(parameters, values)
    if large:
        return f"{call}: {' or '.join(large)} is too large: {', '.join(shown(values[name]) for name in large)}"
    return f"{call}: the arguments {', '.join(map(shown, values.values()))} do not fit; {words}"


def _too_large(parameters: Sequence[Parameter], values: Mapping[str, Any]) -> list[str]:
    """The names of integers that C has no type for, else of those beyond 32 bits, which most arguments have."""
    whole = {p.name: operator.index(values[p.name]) for p in parameters
             if p.name in values and _is_index(values[p.name])}
    for bits in (64, 32):
        found = [name for name, value in whole.items() if value >= 2**bits]
        if found:
            return found
    return []


def with_sentences(method: Callable[..., Any], call: str) -> Callable[..., Any]:
    """A method of the binding whose TypeErrors are sentences."""

    @functools.wraps(method)
    def checked(self: Any, /, *given: Any, **named: Any) -> Any:
        try:
            return method(self, *given, **named)
        except TypeError as error:
            text = str(error)
            if not _MISFIT.search(text):
                raise
        raise TypeError(sentence(call, text, given, named))

    found = signature_of(method.__doc__ or "")
    if found is not None:
        setattr(checked, "__signature__", found)
    return checked


def wrap_methods(kind: type) -> None:
    """Gives the methods of a class of the binding TypeErrors that are sentences."""
    for name, member in list(vars(kind).items()):
        if name == "__init__":
            setattr(kind, name, with_sentences(member, kind.__name__))
        elif not name.startswith("_") and type(member).__name__ == "instancemethod":
            setattr(kind, name, with_sentences(member, name))
