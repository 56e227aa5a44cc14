// A hand in the living valve: a tool at the pointer, time steps of the library between two pictures. The valve
// of the plan does not change; it returns when the hand lets go.
import { MvsError, type Simulator } from 'libmvs';
import type { Hand, Motion } from '../protocol';
import { refusals } from '../text/texts';
import { motionOf } from './picture';
import { mm } from './units';

/** Milliseconds between pictures, and of them for time steps. */
const beat = 16;
const work = 11;
/** s; at most this much of simulated time between two pictures, so that fast machines run in real time. */
const step = { solver: 'implicit' as const, dt: 2e-3 };
const mostSteps = 8;

/** m: the ball, the farthest that it begins from its place, and the steps to there. */
const ballRadius = 3e-3;
const farthest = 30e-3;
const farther = 1.5e-3;

/** Adds the ball where there is room for it: else farther away on the way from the tissue, from where it moves in. */
function addBall(sim: Simulator, position: number[], tissue: number[]): bigint {
  const way = position.map((v, c) => v - tissue[c]);
  const length = Math.hypot(...way);
  for (let away = 0; away <= farthest; away += farther) {
    const at = position.map((v, c) => v + (away * way[c]) / length);
    try {
      return sim.addTool({ kind: 'ball', position: at, radius: ballRadius, max_force: 3 });
    } catch (error) {
      if (!(error instanceof MvsError && error.code === 'MVS_E_STATE')) throw error;
    }
  }
  throw new MvsError('MVS_E_STATE', 'tool', refusals.noRoom);
}

export class HandLoop {
  private tool: bigint;
  private running = true;
  private target: number[] | null;

  constructor(
    private readonly sim: Simulator,
    hand: Hand,
    private readonly show: (motion: Motion) => void,
    private readonly failed: (error: unknown) => void,
  ) {
    const [position, to] = [hand.position, hand.to].map((place) => place.map((v) => v / mm));
    this.target = to;
    this.tool =
      hand.tool === 'grasp' ? sim.grasp(hand.node, { position, max_force: 3 }) : addBall(sim, position, to);
    setTimeout(() => this.beat(), 0);
  }

  move(position: number[]): void {
    this.target = position.map((v) => v / mm);
  }

  private beat(): void {
    if (!this.running) return;
    const begin = performance.now();
    try {
      if (this.target) this.sim.moveTool(this.tool, this.target);
      this.target = null;
      for (let k = 0; k < mostSteps && performance.now() - begin < work; ++k) this.sim.step(step);
      const state = this.sim.tool(this.tool);
      this.sim.read((snapshot) => {
        const motion = motionOf(snapshot, 1);
        motion.picture.hand = Float32Array.from([...state.position, ...state.proxy], (v) => v * mm);
        this.show(motion);
      });
    } catch (error) {
      this.running = false;
      this.failed(error);
      return;
    }
    setTimeout(() => this.beat(), Math.max(0, beat - (performance.now() - begin)));
  }

  end(): void {
    this.running = false;
  }
}
