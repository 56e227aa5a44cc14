"""The tables that `verification --tables DIR` wrote: studies and their rows."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Row:
    """One number beside its exact value; NaN where a table has nothing."""

    case: str
    x: float
    level: float
    value: float
    exact: float
    error: float
    order: float


@dataclass(frozen=True)
class Study:
    """A table's entry in studies.csv, and its rows."""

    about: dict[str, str]
    rows: list[Row]

    def __getattr__(self, key: str) -> str:
        try:
            return self.about[key]
        except KeyError:
            raise AttributeError(key) from None

    def series(self) -> dict[tuple[str, float], list[Row]]:
        """Rows of one case at one x, coarse to fine."""
        found: dict[tuple[str, float], list[Row]] = {}
        for row in self.rows:
            found.setdefault((row.case, row.x), []).append(row)
        return found

    def curves(self) -> dict[str, list[Row]]:
        """The rows of a case by x."""
        found: dict[str, list[Row]] = {}
        for row in self.rows:
            found.setdefault(row.case, []).append(row)
        return {case: sorted(rows, key=lambda row: row.x) for case, rows in found.items()}


Studies = dict[str, Study]


def number(text: str) -> float:
    """The number of a cell; NaN for an empty one."""
    return float(text) if text else math.nan


def read(folder: Path) -> Studies:
    """The studies of a folder in the order of studies.csv."""
    studies: Studies = {}
    with (folder / "studies.csv").open(newline="", encoding="utf-8") as index:
        for about in csv.DictReader(index):
            with (folder / f"{about['name']}.csv").open(newline="", encoding="utf-8") as table:
                rows = [Row(line["case"], *(number(line[key]) for key in
                            ("x", "level", "value", "exact", "relative_error", "observed_order")))
                        for line in csv.DictReader(table)]
            studies[about["name"]] = Study(about, rows)
    return studies
