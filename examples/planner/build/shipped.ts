// Vite plugin: the picture of the open shipped valve as the module `first-picture`, a text. The library of the package
// makes it at build time with the code of the worker, so that the page draws it before its own library is ready.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { build, type Plugin } from 'vite';
import { encode, shippedVertices } from '../src/shipped';
import { packageFolder } from './library';

/** Code of the worker as a module for Node. */
async function workerCode(file: string): Promise<string> {
  const id = pathToFileURL(resolve(packageFolder(), 'index.mjs')).href;
  const built = await build({
    configFile: false,
    logLevel: 'warn',
    root: resolve(__dirname, '../src'),
    plugins: [
      {
        name: 'libmvs',
        enforce: 'pre',
        resolveId: (asked) => (asked === 'libmvs' ? { id, external: true } : null),
      },
    ],
    build: { ssr: resolve(__dirname, '../src/worker', file), write: false, target: 'node18' },
  });
  return (built as { output: { code: string }[] }).output[0].code;
}

async function firstPicture(): Promise<string> {
  const folder = mkdtempSync(join(tmpdir(), 'planner-'));
  try {
    const file = join(folder, 'shipped.mjs');
    writeFileSync(file, await workerCode('shipped.ts'));
    const shipped = await import(pathToFileURL(file).href);
    const { loadMvs } = await import(pathToFileURL(resolve(packageFolder(), 'index.mjs')).href);
    return encode(shipped.firstPicture(await loadMvs(), shippedVertices));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

export function shipped(): Plugin {
  return {
    name: 'first-picture',
    enforce: 'pre',
    resolveId: (id) => (id === 'first-picture' ? '\0first-picture' : null),
    load: async (id) =>
      id === '\0first-picture' ? `export default ${JSON.stringify(await firstPicture())};` : null,
  };
}
