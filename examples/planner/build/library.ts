// Vite plugin: the package of bindings/js as the module `libmvs`, in the form for classic scripts, which asks
// for no file.
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import type { Plugin } from 'vite';

/** The folder of the built package; scripts/planner sets it. */
export function packageFolder(): string {
  return process.env.MVS_JS ?? resolve(__dirname, '../../../build/js/dist');
}

const names = ['loadMvs', 'MvsError', 'SYSTOLE_PA', 'DIASTOLE_PA', 'ChordKind', 'SettleFlags'];

export function library(): Plugin {
  return {
    name: 'libmvs',
    enforce: 'pre',
    resolveId: (id) => (id === 'libmvs' ? '\0libmvs' : null),
    load(id) {
      if (id !== '\0libmvs') return null;
      const code = readFileSync(resolve(packageFolder(), 'classic.js'), 'utf8');
      return `${code}\nexport const { ${names.join(', ')} } = libmvs;`;
    },
  };
}
