// Requests of the page to the worker and their answers; the data in them is described in protocol.ts.
import type {
  BuildRequest,
  CheckpointList,
  Cost,
  Failure,
  FileUnit,
  Finding,
  FoundingResult,
  Hand,
  Known,
  Motion,
  Operation,
  OperationInfo,
  Section,
  SectionRequest,
  SessionContents,
  SessionOpened,
  Shown,
  SideFile,
  Spread,
  Surface,
} from './protocol';

/** How far a valve opens. */
export interface CostRequest {
  which: 'main' | 'preview' | 'first' | `checkpoint ${string}`;
}

/** Requests of the page: name, argument, result. */
export interface Calls {
  start: { argument: { library: string }; result: { version: string; operations: OperationInfo[] } };
  open_shipped: { argument: { name: string; vertices: number }; result: Shown };
  begin_here: { argument: null; result: Shown };
  open_file: { argument: { name: string; bytes: Uint8Array }; result: Shown };
  preview: { argument: Operation; result: Shown };
  /** null: the page has all figures of the preview. */
  accept: { argument: { has: Known }; result: Shown | null };
  discard: { argument: null; result: null };
  check: { argument: Operation; result: null };
  undo: { argument: null; result: Shown };
  redo: { argument: null; result: Shown };
  open_to: { argument: { share: number }; result: Motion };
  cost: { argument: CostRequest; result: Cost };
  section: { argument: SectionRequest; result: Section };
  hand_begin: { argument: Hand; result: null };
  hand_move: { argument: { position: number[] }; result: null };
  hand_end: { argument: null; result: Shown };
  checkpoint: { argument: { name: string }; result: CheckpointList };
  rename_checkpoint: { argument: { name: string; to: string }; result: CheckpointList };
  remove_checkpoint: { argument: { name: string }; result: CheckpointList };
  put_back_checkpoint: { argument: null; result: CheckpointList };
  restore: { argument: { name: string }; result: Shown };
  read_checkpoint: { argument: { name: string }; result: Shown };
  save_obj: { argument: null; result: Uint8Array };
  save_session: { argument: SessionContents; result: Uint8Array };
  open_session: { argument: { bytes: Uint8Array }; result: SessionOpened };
  founding_healthy: { argument: { vertices: number }; result: FoundingResult['healthy'] };
  founding_repair: {
    argument: { number: number; vertices: number };
    result: Required<FoundingResult>['repaired'];
  };
  spread: { argument: { members: number }; result: Spread };
  /** null: the unit that the file states, else a guess. */
  read_surface: { argument: { name: string; bytes: Uint8Array; unit: FileUnit | null }; result: Surface };
  /** How many triangles the file of the closed leaflets has. */
  read_closed: { argument: SideFile & { unit: FileUnit }; result: number };
  build: { argument: BuildRequest; result: { shown: Shown; findings: Finding[] } };
}

export type CallName = keyof Calls;

export type ToWorker = { id: number; call: CallName; argument: unknown } | { cancel: number };

export type FromWorker =
  | { id: number; result: unknown }
  | { id: number; failure: Failure }
  | { id: number; motion: Motion }
  | { id: number; stage: Shown }
  | { id: number; share: number };
