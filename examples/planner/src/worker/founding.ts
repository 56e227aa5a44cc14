// The valves of the tour: the three diseased valves of the founding paper's study (Tenenholtz et al., IROS 2011) and one
// with a flail leaflet, as examples/plans/README.md makes them, their healthy original, and a repair of each.
import type { Mvs, Simulator, Snapshot } from 'libmvs';
import plan1 from '../../../plans/valve1.json?raw';
import plan2 from '../../../plans/valve2.json?raw';
import plan3 from '../../../plans/valve3.json?raw';
import plan4 from '../../../plans/valve4.json?raw';
import flail from '../../../plans/flail.json?raw';
import type { FoundingResult } from '../protocol';
import { restResidual } from '../units';
import { figuresOf } from './picture';
import { mm2 } from './units';

interface Disease {
  annulus: number;
  chord?: [string, number];
  /** A plan that makes it ill. */
  illness?: string;
  plan: string;
}

const diseases: Record<number, Disease> = {
  0: { annulus: 1, plan: '' },
  1: { annulus: 1.15, chord: ['A1/11', 1.25], plan: plan1 },
  2: { annulus: 1, chord: ['A2/4', 0.7], plan: plan2 },
  3: { annulus: 1.1, chord: ['A2/4', 0.67], plan: plan3 },
  4: { annulus: 1.05, illness: flail, plan: plan4 },
};

/** The OBJ file of a valve of the study; number 0 is the healthy one. */
export function foundingValve(mvs: Mvs, number: number, vertices: number): Uint8Array {
  const { annulus, chord, illness } = diseases[number];
  const sim = mvs.simulator();
  try {
    sim.generateValve({ shape: 'founding', posterior_height: 0.012, annulus_scale: annulus, vertices });
    if (chord) sim.apply('chord_length', { chord: chord[0], factor: chord[1] });
    if (illness) sim.replayPlan(illness);
    return sim.read((snapshot) => snapshot.save('obj'));
  } finally {
    sim.dispose();
  }
}

function result(mvs: Mvs, sim: Simulator): { figures: ReturnType<typeof figuresOf>; openArea: number } {
  return sim.read((snapshot) => {
    const { cost, opened } = snapshot.cost({ residual: restResidual });
    opened.dispose();
    return { figures: figuresOf(mvs, snapshot), openArea: cost.open_area * mm2 };
  });
}

/** The closed healthy valve and its figures, calculated once for all valves of the tour. */
export class HealthyValve {
  readonly figures: FoundingResult['healthy'];
  readonly snapshot: Snapshot;

  constructor(mvs: Mvs, vertices: number) {
    const sim = mvs.simulator();
    try {
      sim.load(foundingValve(mvs, 0, vertices), 'obj');
      sim.setLoad();
      sim.settle({ residual: restResidual });
      const { figures, openArea } = result(mvs, sim);
      this.figures = { measures: figures.measures, openArea };
      this.snapshot = sim.snapshot();
    } finally {
      sim.dispose();
    }
  }
}

/** Figures of a repair of valve `number`: that of the founding paper, or our own of the fourth valve. */
export function foundingRepair(
  mvs: Mvs,
  number: number,
  vertices: number,
): Required<FoundingResult>['repaired'] {
  const sim = mvs.simulator();
  try {
    sim.load(foundingValve(mvs, number, vertices), 'obj');
    sim.replayPlan(diseases[number].plan);
    const { figures, openArea } = result(mvs, sim);
    return {
      measures: figures.measures,
      openArea,
      operations: figures.history.map((entry) => entry.title),
    };
  } finally {
    sim.dispose();
  }
}
