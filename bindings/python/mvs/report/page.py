"""The report as one self-contained HTML file."""

from __future__ import annotations

import html
from datetime import datetime, timezone
from string import Template

import mvs

from . import cost, leak
from .cases import Case
from .gallery import CAPTIONS, Picture
from .markup import figure
from .table import as_html

PAGE = Template("""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Mitral valve closure: libmvs report</title>
<style>
  body { font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 78rem; margin: 2rem auto;
         padding: 0 1rem; }
  h1 { font-weight: 600; margin-bottom: 0 } h2 { margin-top: 2.5rem; font-weight: 600 }
  .sub { color: #666; margin-top: .2rem }
  .warning { border-left: 5px solid #c8553d; background: #fbf1ee; padding: .7rem 1rem }
  .cards, .row { display: grid; gap: 1rem; grid-template-columns: repeat($columns, 1fr) }
  .card { border: 1px solid #ddd; border-radius: 8px; padding: .8rem 1rem }
  .card b { font-size: 1.25rem } .sealed { color: #1b6f5a } .leaks { color: #b3261e }
  figure { margin: 0 } figure img { width: 100%; height: auto } figcaption { color: #444 }
  .row figcaption { text-align: center; font-weight: 600 }
  table { border-collapse: collapse; font-size: .92rem; width: 100% }
  th, td { padding: .25rem .6rem; border-bottom: 1px solid #e5e5e5; text-align: right;
           font-variant-numeric: tabular-nums }
  tr > th:first-child { text-align: left; font-weight: 500 }
  td.words { text-align: left; color: #555 }
  code { font-size: .85rem; overflow-wrap: anywhere }
</style>
</head>
<body>
<h1>A mitral valve closes</h1>
<p class="sub">libmvs $version, $date</p>
<p class="warning"><strong>Planning and research tool, not a cleared medical device.</strong>
Nothing here may be used to decide on the treatment of a patient.</p>
<div class="cards">$cards</div>
$comparison
<h2>Pictures</h2>
$pictures
<h2>Figures</h2>
<p>All valves are closed under the stated pressure. Leaflets coapt where they face each other
within the contact thickness; definitions: libmvs/measure/DEFINITIONS.md. The figures of the
literature are widely quoted ranges for orientation, not limits of this model.</p>
$table
<h2>Where it leaks</h2>
$leak
<h2>Cost of the repair</h2>
$cost
$study
<h2>Settings</h2>
$settings
</body>
</html>
""")


def build(cases: list[Case], pictures: list[Picture], study: str = "") -> str:
    """The page of some valves and their pictures; `study`: more chapters, in HTML."""
    return PAGE.substitute(
        columns=min(len(cases), 3),
        version=f"{mvs.__version__} ({', '.join(mvs.features)})",
        date=datetime.now(timezone.utc).strftime("%Y-%m-%d %H:%M UTC"),
        cards="".join(_card(case) for case in cases),
        comparison=_comparison(cases),
        pictures="".join(_row(name, cases, pictures) for name in CAPTIONS),
        table=as_html(cases),
        leak=leak.as_html(cases),
        cost=cost.as_html(cases),
        study=study,
        settings=_settings(cases),
    )


def _card(case: Case) -> str:
    kind = "sealed" if case.verdict == "sealed" else "leaks"
    return (
        f'<div class="card"><strong>{html.escape(case.title)}</strong><br>'
        f'<b class="{kind}">{html.escape(case.verdict)}</b><br>{html.escape(case.note)}<br>'
        f"Closed in {case.stats.wall_s:.2f} s, {case.stats.iterations} iterations.</div>\n"
    )


def _comparison(cases: list[Case]) -> str:
    if len(cases) < 2:
        return ""
    first, lines = cases[0], []
    for other in cases[1:]:
        found = first.closed.compare(other.closed)
        lines.append(
            f"{html.escape(other.title)}: RMS {found.surface_rms_registered * 1e3:.2f} mm, "
            f"largest {found.surface_max_registered * 1e3:.2f} mm"
        )
    return (
        f"<p>Distance of the closed surfaces from that of “{html.escape(first.title)}” "
        f"(symmetric, after rigid registration): {'; '.join(lines)}.</p>"
    )


def _row(name: str, cases: list[Case], pictures: list[Picture]) -> str:
    titles = {case.key: case.title for case in cases}
    caption = CAPTIONS[name]
    figures = "".join(figure(shown.png, titles[shown.case], f"{titles[shown.case]}. {caption}")
                      for shown in pictures if shown.name == name)
    return f'<h3>{html.escape(caption)}</h3>\n<div class="row">{figures}</div>' if figures else ""


def _tissues(closed: mvs.Snapshot) -> str:
    """The distinct laws of the leaflets in words."""
    laws: dict[str, None] = {}
    for number, row in zip(closed.leaflet_law, closed.leaflet_constants):
        law = mvs.leaflet_law(int(number))
        values = ", ".join(
            f"{c.key} {value / 1e3 if c.unit == 'Pa' else value:g}{' kPa' if c.unit else ''}"
            for c, value in zip(law.constants, row[1:])
        )
        laws[f"{law.name}, {row[0] * 1e3:g} mm thick, {values}"] = None
    return "; ".join(laws)


def _settings(cases: list[Case]) -> str:
    items = []
    for case in cases:
        closed = case.closed
        density, thickness, stiffness, bending = closed.valve_constants
        items.append(
            f"<li><strong>{html.escape(case.title)}</strong>: {_tissues(closed)}; chordae "
            f"{closed.chord_young.mean() / 1e6:g} MPa, mean cross-section "
            f"{closed.chord_area.mean() * 1e6:.2f} mm²; density {density:g} kg/m³; contact "
            f"thickness {thickness * 1e3:g} mm, contact stiffness {stiffness / 1e3:g} kPa; bending "
            f"scale {bending:g}; snapshot <code>{closed.hash}</code></li>\n"
        )
    return (
        f"<ul>\n{''.join(items)}</ul>\n<p>Solver: projected Newton on the potential. Pictures: "
        "an interpolating subdivision refines the sheets, which are as thick as the contact "
        "thickness; the strip of atrial wall and the papillary muscles are for orientation. All "
        "figures come from the mesh.</p>"
    )
