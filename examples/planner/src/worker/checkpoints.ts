// Checkpoints of a plan: snapshots by name, in the order in which they were kept. The last one that was removed or
// replaced can be put back.
import { MvsError, type Snapshot } from 'libmvs';
import type { CheckpointList } from '../protocol';
import { planTexts, refusals } from '../text/texts';

interface Removed {
  name: string;
  snapshot: Snapshot;
  /** Its index in the order. */
  place: number;
}

/** The name in "checkpoint NAME"; null for another valve. */
export const checkpointIn = (which: string): string | null =>
  which.startsWith('checkpoint ') ? which.slice('checkpoint '.length) : null;

export class Checkpoints extends Map<string, Snapshot> {
  private removed: Removed | null = null;

  list(): CheckpointList {
    return {
      names: [...this.keys()],
      hashes: [...this.values()].map(({ hash }) => hash),
      removed: this.removed?.name ?? null,
    };
  }

  /** Keeps a snapshot under a name, in place of the one that had it. */
  keep(name: string, snapshot: Snapshot): CheckpointList {
    const place = [...this.keys()].indexOf(name);
    if (place >= 0) this.setAside({ name, snapshot: this.of(name), place });
    this.set(name, snapshot);
    return this.list();
  }

  /** The snapshot of a name, or a refusal. */
  of(name: string): Snapshot {
    const kept = this.get(name);
    if (!kept) throw new MvsError('MVS_E_ID', name, refusals.noCheckpoint(name));
    return kept;
  }

  /** Gives a checkpoint a name that no other one has; it keeps its place in the order. */
  rename(name: string, to: string): CheckpointList {
    this.of(name);
    if (to !== name && this.has(to)) throw new MvsError('MVS_E_ID', to, refusals.sameCheckpoint(to));
    this.order([...this].map(([other, snapshot]) => [other === name ? to : other, snapshot]));
    return this.list();
  }

  remove(name: string): CheckpointList {
    this.setAside({ name, snapshot: this.of(name), place: [...this.keys()].indexOf(name) });
    this.delete(name);
    return this.list();
  }

  /** Puts the last removed one back into its place; where another one has its name by now, under a name that is free. */
  putBack(): CheckpointList {
    const { removed } = this;
    if (!removed) throw new MvsError('MVS_E_STATE', 'checkpoint', refusals.nothingRemoved);
    let { name } = removed;
    for (let k = 2; this.has(name); ++k) name = planTexts.copyOf(removed.name, k);
    const kept = [...this];
    kept.splice(removed.place, 0, [name, removed.snapshot]);
    this.order(kept);
    this.removed = null;
    return this.list();
  }

  forget(): void {
    for (const snapshot of this.values()) snapshot.dispose();
    this.clear();
    this.setAside(null);
  }

  private order(entries: [string, Snapshot][]): void {
    this.clear();
    for (const [name, snapshot] of entries) this.set(name, snapshot);
  }

  private setAside(removed: Removed | null): void {
    this.removed?.snapshot.dispose();
    this.removed = removed;
  }
}
