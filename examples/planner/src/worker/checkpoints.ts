// Checkpoints of a plan: snapshots by name, in the order in which they were kept.
import { MvsError, type Snapshot } from 'libmvs';
import { refusals } from '../text/texts';

export class Checkpoints extends Map<string, Snapshot> {
  private names(): string[] {
    return [...this.keys()];
  }

  /** Keeps a snapshot in place of the one with this name; returns all names. */
  keep(name: string, snapshot: Snapshot): string[] {
    this.get(name)?.dispose();
    this.set(name, snapshot);
    return this.names();
  }

  /** The snapshot of a name, or a refusal. */
  of(name: string): Snapshot {
    const kept = this.get(name);
    if (!kept) throw new MvsError('MVS_E_ID', name, refusals.noCheckpoint(name));
    return kept;
  }

  /** Gives a checkpoint a name that no other one has; it keeps its place in the order. Returns all names. */
  rename(name: string, to: string): string[] {
    this.of(name);
    if (to !== name && this.has(to)) throw new MvsError('MVS_E_ID', to, refusals.sameCheckpoint(to));
    const kept = [...this];
    this.clear();
    for (const [other, snapshot] of kept) this.set(other === name ? to : other, snapshot);
    return this.names();
  }

  forget(): void {
    for (const snapshot of this.values()) snapshot.dispose();
    this.clear();
  }
}
