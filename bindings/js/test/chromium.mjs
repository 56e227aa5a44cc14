// Debian's Chromium, without a window: runs JavaScript in a classic worker of a page that is opened from
// disk, as the planner does. The library comes as gzip in base64, and its bytes go by message.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

import { chromium } from "playwright-core";

export const executable = process.env.MVS_CHROMIUM ?? "/usr/bin/chromium";

const policy = "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; connect-src 'none'";
const text = (name, content) => `<script type="text/plain" id="${name}">${content.replaceAll("</script", "<\\/script")}</script>`;

// In the page: starts the worker, sends it the bytes, and collects its messages up to `done`.
function start() {
  const content = (name) => document.getElementById(name).textContent;
  globalThis.run = (job) =>
    new Promise((resolve, reject) => {
      const worker = new Worker(URL.createObjectURL(new Blob([content("classic"), "\n", content("work")])));
      const messages = [];
      worker.onerror = (event) => reject(new Error(event.message));
      worker.onmessage = ({ data }) => {
        messages.push(data);
        if (!data.done) return;
        worker.terminate();
        resolve(messages);
      };
      worker.postMessage({ packed: content("packed"), job });
    });
}

/** Opens a page with the classic script, the script `work` and a packed module; returns run(job). */
export async function openPage({ classic, work, packed }) {
  const folder = mkdtempSync(join(tmpdir(), "mvs-page-"));
  const file = join(folder, "page.html");
  writeFileSync(file, `<!doctype html><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="${policy}">
${text("classic", classic)}${text("work", work)}${text("packed", packed)}
<script>(${start})()</script>`);
  const browser = await chromium.launch({
    executablePath: executable,
    args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
      "--disable-component-update", "--disable-sync", "--js-flags=--expose-gc"],
  });
  const page = await browser.newPage();
  const requests = [];
  page.on("request", (request) => {
    if (!/^(file|blob|data):/.test(request.url())) requests.push(request.url());
  });
  await page.goto(pathToFileURL(file).href);
  return {
    run: (job) => page.evaluate((given) => globalThis.run(given), job),
    requests,
    version: browser.version(),
    close: async () => {
      await browser.close();
      rmSync(folder, { recursive: true });
    },
  };
}

export const read = (path) => readFileSync(path, "utf8");
