// Assertions for cases that run in Node and in a browser's worker alike.
export function ok(condition, what) {
  if (!condition) throw new Error(what ?? "does not hold");
}

export function equal(found, expected, what = "value") {
  if (!Object.is(found, expected)) throw new Error(`${what} is ${String(found)}, expected ${String(expected)}`);
}

export function near(found, expected, tolerance, what = "value") {
  if (!(Math.abs(found - expected) <= tolerance)) throw new Error(`${what} is ${found}, expected ${expected} within ${tolerance}`);
}

/** Runs `work`, which has to throw an MvsError of `code` whose sentence matches; returns it. */
export async function fails(work, code, sentence, part) {
  let error;
  try {
    await work();
  } catch (thrown) {
    error = thrown;
  }
  ok(error, `nothing was thrown: expected ${code}`);
  equal(error.name, "MvsError", `${String(error)}: name`);
  equal(error.code, code, `code of "${error.message}"`);
  ok(sentence.test(error.message), `the sentence "${error.message}" does not match ${sentence}`);
  if (part !== undefined) equal(error.part, part, `part of "${error.message}"`);
  return error;
}
