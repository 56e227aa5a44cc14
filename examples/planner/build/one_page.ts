// Vite plugin: puts script, style and the compressed library into the HTML file, which then is the only
// output. The library is gzip in base64: a third of the size of plain base64.
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { gzipSync } from 'node:zlib';
import type { Plugin } from 'vite';
import { packageFolder } from './library';

/** Text that is safe inside <script>: the parser must not see an end tag or a comment. */
function inScript(code: string): string {
  return code.replace(/<\/(script)/gi, '<\\/$1').replace(/<!--/g, '<\\!--');
}

const bundled = ['three', 'preact', '@preact/signals', '@preact/signals-core', 'fflate', 'lucide-preact'];

/** The licences of libmvs and of the npm packages in the page, which have to go with it. */
function licences(): string {
  const root = resolve(__dirname, '..');
  const texts = [`libmvs\n\n${readFileSync(resolve(root, '../../LICENSE'), 'utf8')}`];
  for (const name of bundled)
    texts.push(`${name}\n\n${readFileSync(resolve(root, 'node_modules', name, 'LICENSE'), 'utf8')}`);
  return texts.join(`\n${'-'.repeat(60)}\n`);
}

export function onePage(): Plugin {
  return {
    name: 'one-page',
    apply: 'build',
    enforce: 'post',
    generateBundle(_options, bundle) {
      const page = Object.values(bundle).find((item) => item.fileName.endsWith('.html'));
      if (!page || page.type !== 'asset') throw new Error('the build has no HTML page');
      let html = String(page.source);
      let script = '';
      let style = '';
      for (const [name, item] of Object.entries(bundle)) {
        if (item === page) continue;
        if (item.type === 'chunk') script += item.code;
        else if (name.endsWith('.css')) style += String(item.source);
        else throw new Error(`the page would need another file: ${name}`);
        delete bundle[name];
      }
      const library = gzipSync(readFileSync(resolve(packageFolder(), 'mvs.wasm')), { level: 9 }).toString(
        'base64',
      );
      html = html
        .replace(/<script type="module"[^>]*><\/script>/, '')
        .replace(/<link rel="stylesheet"[^>]*>/, '')
        .replace('</head>', () => `<style>${style}</style></head>`)
        .replace(
          '</body>',
          () =>
            `<script type="text/plain" id="library">${library}</script>` +
            `<script type="text/plain" id="licences">${inScript(licences())}</script>` +
            `<script type="module">${inScript(script)}</script></body>`,
        );
      page.source = html;
    },
  };
}
