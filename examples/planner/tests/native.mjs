// The native command, and the valves of saved sessions, which it repeats.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { unzipSync } from 'fflate';

export const mvs = (...words) => String(execFileSync(process.env.MVS_COMMAND, words));

/** Repeats a session: the hash of its valve, and JSON of a command on that valve, or the valve as OBJ. */
export function repeated(session) {
  const folder = mkdtempSync(join(tmpdir(), 'session-'));
  const at = (name) => join(folder, name);
  const files = unzipSync(readFileSync(session));
  for (const name of ['valve.obj', 'plan.json']) writeFileSync(at(name), files[name]);
  const valve = at('closed.h5');
  const told = mvs('plan', 'replay', at('plan.json'), '--on', at('valve.obj'), '-o', valve, '--json');
  return {
    hash: JSON.parse(told).hash,
    json: (command) => JSON.parse(mvs(command, valve, '--json')),
    obj: () => {
      mvs('convert', valve, '-o', at('closed.obj'));
      return readFileSync(at('closed.obj'), 'utf8');
    },
  };
}
