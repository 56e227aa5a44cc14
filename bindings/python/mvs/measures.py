"""The measures of a valve and the cost of a repair, in SI units, with unit and definition of each field."""

from __future__ import annotations

import dataclasses
from typing import Annotated, Any

from .describe import with_field_help
from .kinds import SamRisk


@with_field_help
@dataclasses.dataclass(frozen=True)
class Measures:
    """The measures of a valve. Sources: libmvs/measure/DEFINITIONS.md.

    Figures of leaflets that cross (intersections > 0) do not count.
    """

    intersections: Annotated[int, "1", "pairs of triangles that cross (exact test)"]
    regurgitant_orifice_area: Annotated[
        float, "m2", "smallest cross-section joining ventricle and atrium; 0 when sealed"
    ]
    coaptation_area: Annotated[
        float, "m2", "area of one side where leaflets face each other within the contact thickness"
    ]
    coaptation_length_mean: Annotated[float, "m", "mean along the coaptation line"]
    coaptation_length_min: Annotated[
        float, "m", "smallest along the coaptation line but for 5 % at either end"
    ]
    coaptation_length_max: Annotated[
        float, "m", "largest along the coaptation line but for 5 % at either end"
    ]
    coaptation_height: Annotated[
        float, "m", "extent of the coaptation along the valve axis, central AP plane"
    ]
    coaptation_depth: Annotated[
        float, "m", "annulus plane to the highest coapted tissue, central AP plane"
    ]
    tenting_height: Annotated[
        float, "m", "how deep a ball of the contact thickness that rests on the leaflets comes below the annulus plane"
    ]
    tenting_area: Annotated[
        float, "m2", "below the surface spanning the annulus, central AP plane"
    ]
    tenting_volume: Annotated[
        float, "m3", "between leaflets and the surface spanning the annulus, below it"
    ]
    billow_height: Annotated[
        float, "m", "highest leaflet point above the surface spanning the annulus"
    ]
    billow_volume: Annotated[
        float, "m3", "between leaflets and the surface spanning the annulus, above it"
    ]
    annulus_ap: Annotated[float, "m", "anteroposterior (septal-lateral) diameter"]
    annulus_cc: Annotated[float, "m", "intercommissural diameter"]
    annulus_perimeter: Annotated[float, "m", "length of the annulus in space"]
    annulus_area_3d: Annotated[float, "m2", "area of the surface spanning the annulus"]
    annulus_area: Annotated[float, "m2", "area projected on the annulus plane"]
    annulus_saddle_height: Annotated[float, "m", "height of the annulus along the valve axis"]
    annulus_nonplanar_angle: Annotated[float, "rad", "angle between the two halves of the saddle"]
    max_chord_strain: Annotated[float, "1", "largest engineering strain, without sutures; 0 when all are slack"]
    max_chord_tension: Annotated[float, "N", "largest tension of a chord segment, without sutures"]
    max_leaflet_strain: Annotated[float, "1", "largest principal engineering strain"]
    max_leaflet_stress: Annotated[float, "Pa", "largest principal Cauchy stress"]
    leaflet_area: Annotated[float, "m2", "area of both leaflets in the present shape"]
    chords_over_strain: Annotated[int, "1", "chordae strained beyond the limit of their kind"]
    chords_over_tension: Annotated[int, "1", "chordae that carry more than the limit of their kind"]
    at_rest: Annotated[bool, "1", "1: at rest under its load, as a settle or step found it"]
    under_load: Annotated[bool, "1", "1: the pressure closes the valve"]
    leaflet_strain_p50: Annotated[
        float, "1", "largest principal strain that half of the tissue does not exceed, by rest area"
    ]
    leaflet_strain_p95: Annotated[float, "1", "the same for 95 % of the tissue"]
    leaflet_strain_p99: Annotated[
        float, "1", "the same for 99 %: one bad triangle does not change it"
    ]
    leaflet_stress_p50: Annotated[
        float,
        "Pa",
        "largest principal Cauchy stress that half of the tissue does not exceed, by rest area",
    ]
    leaflet_stress_p95: Annotated[float, "Pa", "the same for 95 % of the tissue"]
    leaflet_stress_p99: Annotated[
        float, "Pa", "the same for 99 %: one bad triangle does not change it"
    ]


@with_field_help
@dataclasses.dataclass(frozen=True, eq=False)
class Cost:
    """Cost of a repair. NaN where it is not known. Sources: libmvs/measure/DEFINITIONS.md."""

    opened: Annotated[bool, "1", "1: the open valve came to rest"]
    open_area: Annotated[float, "m2", "smallest cross-section of the valve opened in diastole"]
    gradient: Annotated[
        float, "Pa", "mean pressure drop of the flow through the open area; only with a flow"
    ]
    anterior_height: Annotated[
        float, "m", "tissue from annulus to free edge, unloaded, central AP plane or beside a seam there"
    ]
    posterior_height: Annotated[float, "m", "the same of the posterior leaflet"]
    anterior_length: Annotated[
        float, "m", "from annulus to coaptation along the closed leaflet, in the same way"
    ]
    posterior_length: Annotated[float, "m", "the same of the posterior leaflet"]
    length_ratio: Annotated[float, "1", "anterior over posterior length to coaptation"]
    septal_distance: Annotated[
        float, "m", "in the central AP plane; only with points of the septum"
    ]
    annulus_force_max: Annotated[
        float, "N", "on one node of the annulus; the suture of a ring bears it"
    ]
    annulus_force_sum: Annotated[float, "N", "sum of magnitudes over the nodes of the annulus"]
    sam_risk: Annotated[
        SamRisk,
        "1",
        "0 not determined, 1 low, 2 raised: ratio at most 1.3, or septum within 25 mm",
    ]
    rings: Annotated[int, "1", "rings and bands, whose sutures bear the pull of the annulus"]
    chords_over_strain: Annotated[
        int, "1", "chordae strained beyond the limit of their kind, closed"
    ]
    chords_over_tension: Annotated[
        int, "1", "chordae that carry more than the limit of their kind, closed"
    ]
    open_valve: Annotated[Any, "1", "the valve opened in diastole (mvs.Snapshot)"]
