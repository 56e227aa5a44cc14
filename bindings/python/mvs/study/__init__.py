"""The founding paper's study: a healthy valve, three that leak, and their repair.

Tenenholtz et al. (IROS 2011) made three regurgitant valves from a healthy one: (1) annulus dilated
by 15 %, a chord elongated by 25 %; (2) a chord shortened by 30 %; (3) annulus dilated by 10 %, a
chord shortened by 33 %. A surgeon repaired them: (1) annulus to 97 % of the original, chordae added
elsewhere; (2) annulus to 95 %, the short chord removed, chordae added there; (3) annulus to 99 %,
the short chord lengthened, chordae added elsewhere. The paper does not name the chordae; they are
chosen here by their position on the leaflets.

    from mvs import study
    for stage in study.run(study.healthy_valve(), study.PARAMETRIC):
        print(stage.title, stage.closed.measures.regurgitant_orifice_area)
"""

from .anatomy import Anatomy, Chord, Site
from .plans import KAISER, PARAMETRIC, Disease, Plan, Repair
from .stages import Stage, healthy_valve, run

__all__ = [
    "KAISER",
    "PARAMETRIC",
    "Anatomy",
    "Chord",
    "Disease",
    "Plan",
    "Repair",
    "Site",
    "Stage",
    "healthy_valve",
    "run",
]
