"""Figures of recovered phantoms: a row for each case, their table, how many leaks the intervals contain."""

from __future__ import annotations

import dataclasses

import numpy as np


@dataclasses.dataclass
class Row:
    """The figures of one case; nan: not measured."""

    name: str
    refused: str = ""
    mid_rms: float = np.nan
    thickness: float = np.nan
    chords: float = np.nan
    lengths: float = np.nan
    closed_rms: float = np.nan
    law_rms: float = np.nan
    leak: float = np.nan
    low: float = np.nan
    high: float = np.nan
    unfitted: float = np.nan
    cpu_phantom: float = np.nan
    cpu_recovery: float = np.nan


HEADINGS = {
    "mid_rms": "mid-surface RMS, mm", "thickness": "thickness error, %",
    "chords": "both ends right, %", "lengths": "length error, %",
    "closed_rms": "closed RMS, mm", "law_rms": "closed RMS by the law alone, mm", "leak": "true leak, mm2", "low": "from", "high": "to",
    "unfitted": "interval unfitted, mm2", "cpu_phantom": "CPU phantom, s",
    "cpu_recovery": "CPU recovery, s",
}


def table(rows: list[Row], spacing: float) -> str:
    """A Markdown table of the rows, with medians and counts."""
    keys = [k for k in HEADINGS if any(np.isfinite(getattr(r, k)) for r in rows)]
    lines = ["| case | " + " | ".join(HEADINGS[k] for k in keys) + " |", "|---" * (len(keys) + 1) + "|"]
    for row in rows:
        values = ["" if np.isnan(getattr(row, k)) else f"{getattr(row, k):.2f}" for k in keys]
        lines.append(f"| {row.name} | " + " | ".join(values) + " |" +
                     (f" refused: {row.refused}" if row.refused else ""))
    done = [r for r in rows if not r.refused]
    if done:
        medians = [f"{np.nanmedian([getattr(r, k) for r in done]):.2f}" for k in keys]
        lines.append("| median | " + " | ".join(medians) + " |")
    if not any(np.isfinite(r.low) for r in done):
        return "\n".join(lines)
    lines += ["", f"{len(done)} of {len(rows)} recovered; voxels of {spacing:g} mm; {coverage(done)}"]
    return "\n".join(lines)


def is_inside(row: Row) -> bool:
    """Whether the interval contains the true leak; leaks are equal to 0.1 mm2."""
    return row.low - 0.1 <= row.leak <= row.high + 0.1


def coverage(rows: list[Row]) -> str:
    """How many intervals contain the true leak, and how wide they are, in words."""
    held = sum(map(is_inside, rows))
    return (f"true leak inside of the reported interval in {held} of {len(rows)}; median interval "
            f"{np.median([r.high - r.low for r in rows]) if rows else np.nan:.1f} mm2")
