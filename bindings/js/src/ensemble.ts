// An ensemble: closures of one valve along several loading paths, and their statistics.
import type { ArrayView } from "./arrays.js";
import type { EnsembleArray, EnsembleStatistic } from "./generated/enums.js";
import type { EnsembleMember, EnsembleSummary, Measures, Stats } from "./generated/structs.js";
import { Owned } from "./handles.js";
import type { Mvs } from "./library.js";
import { Snapshot } from "./snapshot.js";

export class Ensemble extends Owned {
  constructor(readonly mvs: Mvs, handle: number) {
    const { c } = mvs;
    super("ensemble", handle, () => c.mvs_ensemble_release(handle));
  }

  get summary(): EnsembleSummary {
    return this.mvs.c.mvs_ensemble_get_summary(this.handle);
  }

  members(): EnsembleMember[] {
    return Array.from({ length: this.summary.members }, (_, k) => this.mvs.c.mvs_ensemble_get_member(this.handle, k));
  }

  stats(member: number): Stats {
    return this.mvs.c.mvs_ensemble_get_member_stats(this.handle, member);
  }

  /** The closed valve of a member, which the caller disposes of. */
  snapshot(member: number): Snapshot {
    return new Snapshot(this.mvs, this.mvs.c.mvs_ensemble_get_member_snapshot(this.handle, member));
  }

  /** A statistic of every measure over the members at rest. */
  measure(statistic: EnsembleStatistic): Measures {
    return this.mvs.c.mvs_ensemble_measure(this.handle, statistic);
  }

  view(which: EnsembleArray): ArrayView {
    return this.mvs.c.mvs_ensemble_get_array(this.handle, which).ownedBy(this);
  }
}
