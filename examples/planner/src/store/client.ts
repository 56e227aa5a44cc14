// Requests to the worker: one message out, one answer in. The worker is a classic worker from a blob, the only
// kind that a page from disk may have.
import { refusals } from '../text/texts';
import PlannerWorker from '../worker/main?worker&inline';
import type { CallName, Calls } from '../calls';
import type { Failure, Motion, Picture, Shown } from '../protocol';

/** A request that failed. */
export class CallError extends Error {
  constructor(readonly failure: Failure) {
    super(failure.message);
  }
  get cancelled(): boolean {
    return this.failure.code === 'MVS_E_CANCELLED';
  }
}

/** The pictures of a message: of a motion, of a stage, and of results. */
function picturesIn(data: { motion?: Motion; stage?: Shown; result?: unknown }): Picture[] {
  const result = data.result as Partial<Shown & { shown: Shown; first: Shown }> | null | undefined;
  const holders = [data.motion, data.stage, result, result?.shown, result?.first];
  return holders.flatMap((holder) => holder?.picture ?? []);
}

interface Open {
  resolve: (value: never) => void;
  reject: (error: unknown) => void;
  motion?: (motion: Motion) => void;
  stage?: (shown: Shown) => void;
  share?: (share: number) => void;
}

export interface CallOptions {
  motion?: (motion: Motion) => void;
  stage?: (shown: Shown) => void;
  share?: (share: number) => void;
}

export class Client {
  private worker: Worker;
  private next = 1;
  private open = new Map<number, Open>();
  private listeners = new Map<number, (motion: Motion) => void>();

  /** `pictured` takes every picture that comes, also one whose request was dropped: its connectivity comes once. */
  constructor(
    private readonly broken: (sentence: string) => void,
    private readonly pictured: (picture: Picture) => void,
  ) {
    this.worker = new PlannerWorker();
    this.worker.onmessage = ({ data }) => this.receive(data);
    this.worker.onerror = (event) => this.broken(event.message || refusals.noWorker);
  }

  call<Name extends CallName>(
    name: Name,
    argument: Calls[Name]['argument'],
    options: CallOptions = {},
  ): Promise<Calls[Name]['result']> & { id: number } {
    const id = this.next++;
    const promise = new Promise<Calls[Name]['result']>((resolve, reject) => {
      this.open.set(id, { resolve: resolve as never, reject, ...options });
      if (options.motion && name === 'hand_begin') {
        // one hand at a time
        this.listeners.clear();
        this.listeners.set(id, options.motion);
      }
      this.worker.postMessage({ id, call: name, argument });
    });
    return Object.assign(promise, { id });
  }

  /** A message without an answer, handled at once. */
  tell(name: CallName, argument: unknown): void {
    this.worker.postMessage({ id: 0, call: name, argument });
  }

  cancel(id: number): void {
    this.worker.postMessage({ cancel: id });
  }

  private receive(data: {
    id: number;
    result?: unknown;
    failure?: Failure;
    motion?: Motion;
    stage?: Shown;
    share?: number;
  }): void {
    const request = this.open.get(data.id);
    for (const picture of picturesIn(data)) this.pictured(picture);
    if (data.motion) {
      (request?.motion ?? this.listeners.get(data.id))?.(data.motion);
      return;
    }
    if (data.stage) {
      request?.stage?.(data.stage);
      return;
    }
    if (data.share !== undefined) {
      request?.share?.(data.share);
      return;
    }
    if (!request) {
      if (data.failure) this.broken(data.failure.message);
      return;
    }
    this.open.delete(data.id);
    if (data.failure) request.reject(new CallError(data.failure));
    else request.resolve(data.result as never);
  }
}
