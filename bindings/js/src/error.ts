// Failures as exceptions.

/**
 * A failure of the library, or of the values that were passed to it. structuredClone() and postMessage() make a plain Error of
 * it, without its fields: send { code, part, message, line }.
 */
export class MvsError extends Error {
  override readonly name = "MvsError";
  /** The result code by its name in C: "MVS_E_ARGUMENT". */
  readonly code: string;
  /** The part concerned ("triangle 17", "chord P2/3"), or "". */
  readonly part: string;
  /** The line of the file being read, from 1; 0 without a file. */
  readonly line: number;

  constructor(code: string, part: string, message: string, line = 0) {
    super(message);
    this.code = code;
    this.part = part;
    this.line = line;
  }
}

/** Refuses options that are not an object, and those of other names. */
export function knownOptions(options: unknown, names: readonly string[], what: string): void {
  if (typeof options !== "object" || options === null) refuse(what, `${what} is ${String(options)}: it has to be an object`);
  for (const key of Object.keys(options as object)) {
    if (!names.includes(key)) refuse(`${what}.${key}`, `${what} has no field ${key}; its fields are ${names.join(", ")}`);
  }
}

/** Throws MVS_E_ARGUMENT about a part with a sentence. */
export function refuse(part: string, message: string): never {
  throw new MvsError("MVS_E_ARGUMENT", part, message);
}
