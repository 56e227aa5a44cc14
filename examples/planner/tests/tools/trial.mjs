// A trial by a person who sees pictures of the page and sends mouse and key events, nothing else. A server keeps the
// page open in Chromium; each command sends it one action, or looks at it without an action.
//
//   node tests/tools/trial.mjs start [WIDTH HEIGHT] &   opens out/planner.html from disk, counts from 0
//   node tests/tools/trial.mjs look                     writes a picture of the window, prints its path
//   node tests/tools/trial.mjs click X Y                also: double X Y, right X Y, move X Y
//   node tests/tools/trial.mjs drag X1 Y1 X2 Y2 [right] also: wheel X Y AMOUNT (positive is towards the person)
//   node tests/tools/trial.mjs drop X Y FILE           a file is dropped on the page
//   node tests/tools/trial.mjs key Control+z            names of keys as playwright has them; also: type TEXT
//   node tests/tools/trial.mjs wait SECONDS             no action
//   node tests/tools/trial.mjs stop
//
// Lists that the browser opens over the page are missing from the pictures: choose in them with the arrow keys.
import { mkdirSync, readFileSync, rmSync } from 'node:fs';
import { createServer, request } from 'node:http';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { openBrowser, page_path } from '../fixtures/browser.mjs';

const folder = process.env.PLANNER_TRIAL ?? join(tmpdir(), 'planner-trial');
const socket = join(folder, 'socket');
/** ms between an action and the next picture, in which a person sees the page react. */
const reaction = 300;

const numbers = (words) =>
  words.map((word) => {
    const value = Number(word);
    if (!Number.isFinite(value)) throw new Error(`${word} is not a number`);
    return value;
  });

/** Drops a file at a place, as a file manager does. */
async function dropFile(page, x, y, path) {
  const bytes = readFileSync(path).toString('base64');
  await page.evaluate(
    ([x, y, name, text]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
      const target = document.elementFromPoint(x, y);
      for (const type of ['dragover', 'drop'])
        target.dispatchEvent(
          new DragEvent(type, { dataTransfer: transfer, bubbles: true, cancelable: true }),
        );
    },
    [x, y, basename(path), bytes],
  );
}

const actions = {
  click: (page, [x, y]) => page.mouse.click(x, y),
  double: (page, [x, y]) => page.mouse.dblclick(x, y),
  right: (page, [x, y]) => page.mouse.click(x, y, { button: 'right' }),
  move: (page, [x, y]) => page.mouse.move(x, y, { steps: 4 }),
  wheel: async (page, [x, y, amount]) => {
    await page.mouse.move(x, y);
    await page.mouse.wheel(0, amount);
  },
  drag: async (page, [x1, y1, x2, y2], words) => {
    const button = words[4] === 'right' ? 'right' : 'left';
    await page.mouse.move(x1, y1);
    await page.mouse.down({ button });
    await page.mouse.move(x2, y2, { steps: 12 });
    await page.mouse.up({ button });
  },
  drop: (page, [x, y], words) => dropFile(page, x, y, words[2]),
  key: (page, _, [name]) => page.keyboard.press(name),
  type: (page, _, words) => page.keyboard.type(words.join(' ')),
};

/** Carries out commands on an open page; returns the answer to print. */
function performer(page) {
  let count = 0;
  let pictures = 0;
  return async (command, words) => {
    if (command === 'look') {
      const path = join(folder, `look-${String(++pictures).padStart(3, '0')}.png`);
      await page.screenshot({ path });
      return `${path} (${count} actions)`;
    }
    if (command === 'wait') {
      await page.waitForTimeout(1000 * numbers(words)[0]);
      return `${count} actions`;
    }
    if (!Object.hasOwn(actions, command))
      throw new Error(`unknown command ${command}; see tests/tools/trial.mjs`);
    const textual = command === 'key' || command === 'type';
    await actions[command](
      page,
      textual ? [] : numbers(words.slice(0, command === 'drop' ? 2 : 4).filter((w) => w !== 'right')),
      words,
    );
    await page.waitForTimeout(reaction);
    return `${++count} actions`;
  };
}

async function serve(words) {
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const [width, height] = words.length ? numbers(words) : [1280, 720];
  const { context } = await openBrowser({ width, height });
  const page = context.pages()[0] ?? (await context.newPage());
  await page.goto(pathToFileURL(page_path).href);
  const perform = performer(page);
  const server = createServer((asked, answer) => {
    const text = [];
    asked.on('data', (part) => text.push(part));
    asked.on('end', async () => {
      const [command, ...rest] = JSON.parse(Buffer.concat(text).toString());
      try {
        if (command === 'stop') await context.close();
        answer.end(command === 'stop' ? 'stopped' : await perform(command, rest));
      } catch (error) {
        answer.statusCode = 400;
        answer.end(String(error.message ?? error));
      }
      if (command === 'stop') server.close();
    });
  });
  server.listen(socket, () => console.log(`open at ${width} x ${height}; pictures go to ${folder}`));
}

function send(words) {
  const asked = request({ socketPath: socket, method: 'POST' }, (answer) => {
    const text = [];
    answer.on('data', (part) => text.push(part));
    answer.on('end', () => {
      console.log(Buffer.concat(text).toString());
      process.exitCode = answer.statusCode === 200 ? 0 : 1;
    });
  });
  asked.on('error', () => {
    console.error('no trial is open: node tests/tools/trial.mjs start');
    process.exitCode = 1;
  });
  asked.end(JSON.stringify(words));
}

const [command, ...rest] = process.argv.slice(2);
if (command === 'start') await serve(rest);
else if (command) send([command, ...rest]);
else
  console.error(
    'node tests/tools/trial.mjs start | look | click X Y | ... : the first lines of the file list all',
  );
