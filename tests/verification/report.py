#!/usr/bin/env python3
"""The verification suite as a page: each table that `verification --tables DIR` wrote, with pictures.

    report.py TABLES OUT      writes OUT/verification.html and OUT/verification-*.png

Needs matplotlib; no display. Nothing of libmvs is imported: the numbers are those of the tables.
"""

from __future__ import annotations

import base64
import html
import math
import sys
from collections.abc import Iterable
from pathlib import Path

from report_pictures import PICTURES
from report_tables import Studies, Study, number, read

PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>libmvs: verification</title>
<style>
  body {{ font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 78rem; margin: 2rem auto;
         padding: 0 1rem; }}
  h1 {{ font-weight: 600; margin-bottom: 0 }} h2 {{ margin-top: 2.5rem; font-weight: 600 }}
  figure {{ margin: 0 0 1.5rem }} figure img {{ width: 100%; height: auto }}
  figcaption {{ color: #444 }}
  table {{ border-collapse: collapse; font-size: .88rem; width: 100% }}
  th, td {{ padding: .2rem .6rem; border-bottom: 1px solid #e5e5e5; text-align: right;
           font-variant-numeric: tabular-nums; vertical-align: top }}
  th:first-child, td.words {{ text-align: left; font-weight: 500 }}
  td.words {{ font-weight: 400; color: #444 }}
  .holds {{ color: #1b6f5a }} .fails {{ color: #b3261e; font-weight: 700 }}
  details {{ margin: .6rem 0 }} summary {{ cursor: pointer; font-weight: 600 }}
</style>
</head>
<body>
<h1>Verification</h1>
<p>Numbers of libmvs beside closed forms and independent solutions, printed from scratch by
<code>verification --tables</code>. An error is relative to the exact value (or to what its table
names); the order is that of the two finest levels. “Reported” asks nothing: it shows a limit of the
model as it is.</p>
{pictures}
<h2>Every study</h2>
{summary}
<h2>Every table</h2>
{tables}
</body>
</html>
"""


def _cell(value: float) -> str:
    return "" if math.isnan(value) else f"{value:.6g}"


def _summary(studies: Studies) -> str:
    head = ("study", "source", "expected", "largest error", "allowed", "order", "verdict")
    lines = ["<tr>" + "".join(f"<th>{name}</th>" for name in head) + "</tr>"]
    for s in studies.values():
        least, most = number(s.order_least), number(s.order_most)
        order = "" if math.isnan(least) else f"{least:.2f}"
        if order and f"{most:.2f}" != order:
            order += f" to {most:.2f}"
        allowed = number(s.tolerance)
        lines.append(
            f"<tr><th><a href='#{s.name}'>{html.escape(s.title)}</a></th>"
            f"<td class=words>{html.escape(s.source)}</td>"
            f"<td class=words>{html.escape(s.expects)}</td><td>{number(s.worst_error):.2g}</td>"
            f"<td>{f'{allowed:g}' if allowed > 0 else ''}</td><td>{order}</td>"
            f"<td class={s.verdict}>{s.verdict}</td></tr>")
    return "<table>\n" + "\n".join(lines) + "\n</table>"


LONG = 200
"""rows of a table that is shown by its worst ones"""


def _table(s: Study) -> str:
    columns = [("case", lambda r: html.escape(r.case))]
    if s.x:
        columns.append((s.x, lambda r: _cell(r.x)))
    if s.level:
        columns.append((s.level, lambda r: _cell(r.level)))
    columns += [("value", lambda r: _cell(r.value)), ("exact", lambda r: _cell(r.exact)),
                ("relative error", lambda r: f"{r.error:.2g}"),
                ("order", lambda r: "" if math.isnan(r.order) else f"{r.order:.2f}")]
    head = "".join(f"<th>{html.escape(name)}</th>" for name, _ in columns)
    lines = [f"<tr>{head}</tr>"]
    rows, note = s.rows, ""
    if len(rows) > LONG:
        rows = [max(of_case, key=lambda row: row.error) for of_case in s.curves().values()]
        note = f"; here the worst of each case, all of them in {s.name}.csv"
    for row in rows:
        first, *rest = (show(row) for _, show in columns)
        lines.append(f"<tr><th>{first}</th>" + "".join(f"<td>{cell}</td>" for cell in rest)
                     + "</tr>")
    return (f"<details id='{s.name}'><summary>{html.escape(s.title)} ({len(s.rows)} rows; "
            f"{html.escape(s.quantity)}{note})</summary>\n<table>\n" + "\n".join(lines)
            + "\n</table>\n</details>")


def page(studies: Studies, pictures: Iterable[tuple[str, str, bytes]]) -> str:
    """The page as one HTML text that needs nothing else."""
    figures = "".join(
        f'<figure><img alt="{html.escape(caption, quote=True)}" '
        f'src="data:image/png;base64,{base64.b64encode(png).decode()}">'
        f"<figcaption>{html.escape(caption)}</figcaption></figure>\n"
        for _, caption, png in pictures)
    return PAGE.format(pictures=figures, summary=_summary(studies),
                       tables="\n".join(_table(s) for s in studies.values()))


def main() -> int:
    """Reads the tables and writes page and pictures; 1 with a sentence on stderr."""
    if len(sys.argv) != 3:
        print("usage: report.py TABLES OUT", file=sys.stderr)
        return 1
    try:
        studies, out = read(Path(sys.argv[1])), Path(sys.argv[2])
        out.mkdir(parents=True, exist_ok=True)
        made = []
        for name, caption, draw, needs in PICTURES:
            if any(need not in studies for need in needs):
                print(f"report.py: no picture of {name}, for its tables were skipped",
                      file=sys.stderr)
                continue
            made.append((name, caption, draw(studies)))
            (out / f"verification-{name}.png").write_bytes(made[-1][2])
        (out / "verification.html").write_text(page(studies, made), encoding="utf-8")
    except OSError as error:
        print(f"report.py: {error}", file=sys.stderr)
        return 1
    print(f"wrote {out / 'verification.html'}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
