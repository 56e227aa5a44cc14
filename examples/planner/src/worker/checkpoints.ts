// Checkpoints of a plan: snapshots by name, in the order in which they were kept.
import { MvsError, type Snapshot } from 'libmvs';
import { refusals } from '../text/texts';

export class Checkpoints extends Map<string, Snapshot> {
  /** Keeps a snapshot in place of the one with this name. */
  keep(name: string, snapshot: Snapshot): void {
    super.get(name)?.dispose();
    this.set(name, snapshot);
  }

  /** The snapshot of a name, or a refusal. */
  of(name: string): Snapshot {
    const kept = this.get(name);
    if (!kept) throw new MvsError('MVS_E_ID', name, refusals.noCheckpoint(name));
    return kept;
  }

  /** Gives a checkpoint a name that no other one has; it keeps its place in the order. */
  rename(name: string, to: string): void {
    this.of(name);
    if (to !== name && this.has(to)) throw new MvsError('MVS_E_ID', to, refusals.sameCheckpoint(to));
    const kept = [...this];
    this.clear();
    for (const [other, snapshot] of kept) this.set(other === name ? to : other, snapshot);
  }

  forget(): void {
    for (const snapshot of this.values()) snapshot.dispose();
    this.clear();
  }
}
