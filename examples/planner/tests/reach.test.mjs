// The page for everybody: keyboard alone, touch, no WebGL, small windows, a crash.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { pathToFileURL } from 'node:url';
import { closed, figures, openBrowser, openPlanner, page_path, withPlanner } from './fixtures/browser.mjs';
import {
  answered,
  apply,
  begin,
  openForm,
  openPanel,
  shareOfTissue,
  tabTo,
  undo,
} from './fixtures/person.mjs';

/** Runs a check in windows of these sizes, each after the page has found its layout. */
async function inWindows(page, sizes, check) {
  for (const [width, height] of sizes) {
    await page.setViewportSize({ width, height });
    await page.waitForTimeout(300);
    await check(`${width} x ${height}`);
  }
}

describe('planner for everybody', () => {
  it('is_used_with_the_keyboard_alone', async () => {
    await withPlanner({}, async ({ page }) => {
      const { hash } = await figures(page);
      await openForm(page, /annulus_scale/);
      await answered(page, 150);
      await tabTo(page, /f-factor/);
      await page.keyboard.press('Control+a');
      await page.keyboard.type('92');
      await tabTo(page, /Apply/);
      await answered(page, 150);
      await page.keyboard.press('Enter');
      await answered(page, 150);
      assert.match((await figures(page)).history[0].title, /92/);
      await undo(page);
      assert.equal((await figures(page)).hash, hash);
      await tabTo(page, /^ *$|valve/i);
    });
  });

  it('resects_along_an_outline_drawn_with_the_keyboard_alone', async () => {
    await withPlanner({}, async ({ page }) => {
      await openForm(page, /resect/);
      await answered(page, 150);
      await tabTo(page, /Draw the cut/);
      await page.keyboard.press('Enter');
      const press = async (key, times = 1) => {
        for (let k = 0; k < times; ++k) await page.keyboard.press(key);
      };
      // from the middle of P2: two points towards the annulus, two at the edge
      await press('ArrowLeft', 4);
      await press('ArrowUp', 1);
      await press('Space');
      await press('ArrowDown', 4);
      await press('Space');
      await press('ArrowRight', 7);
      await press('Space');
      await press('Space');
      await press('Backspace');
      await press('ArrowUp', 4);
      await press('Space');
      assert.match(await page.getByTestId('status').innerText(), /On P2. 4 points/);
      await press('Enter');
      await answered(page, 100);
      await press('Enter');
      await page.getByTestId('form').waitFor({ state: 'detached' });
      await closed(page);
      assert.match((await figures(page)).history.at(-1).title, /P2 along an outline/);
    });
  });

  it('ties_an_artificial_chord_with_the_keyboard_alone', async () => {
    await withPlanner({}, async ({ page }) => {
      await openForm(page, /neochord/);
      await page.waitForTimeout(200);
      // from the middle of P2 towards its free edge
      for (const key of ['ArrowRight', 'ArrowUp', 'Space']) await page.keyboard.press(key);
      await answered(page, 150);
      await page.keyboard.press('Enter');
      await page.getByTestId('form').waitFor({ state: 'detached' });
      await closed(page);
      assert.match((await figures(page)).history.at(-1).title, /P2/);
    });
  });

  for (const hash of ['#software', '#webgl']) {
    it(`draws_by_${hash.slice(1)}`, async () => {
      await withPlanner({ hash }, async ({ page }) => {
        assert.equal(await page.evaluate(() => window.planner.viewport.renderer.name), hash.slice(1));
        await begin(page, 'ring');
        await apply(page);
        assert.equal((await figures(page)).history.length, 1);
      });
    });
  }

  it('draws_where_the_browser_has_no_webgl', async () => {
    await withPlanner({ software: true }, async ({ page }) => {
      assert.equal(await page.evaluate(() => window.planner.viewport.renderer.name), 'software');
    });
  });

  it('comes_back_after_a_lost_context', async () => {
    await withPlanner({ hash: '#webgl' }, async ({ page }) => {
      const share = () => shareOfTissue(page);
      const before = await share();
      assert.ok(before > 0.15);
      await page.evaluate(async () => {
        const context = window.planner.viewport.renderer.canvas.getContext('webgl2');
        const extension = context.getExtension('WEBGL_lose_context');
        extension.loseContext();
        await new Promise((done) => setTimeout(done, 200));
        extension.restoreContext();
        await new Promise((done) => setTimeout(done, 400));
      });
      assert.ok(Math.abs((await share()) - before) < 0.02, 'the same picture as before');
    });
  });

  it('recovers_a_session_after_a_closed_tab_only_where_it_was_allowed', async () => {
    await withPlanner({}, async ({ page, context }) => {
      await begin(page, 'annulus_scale');
      await apply(page);
      await page.reload({ waitUntil: 'load' });
      await closed(page);
      assert.equal(await page.getByTestId('recovery').count(), 0);
      await openPanel(page, 'Plan');
      await page.getByLabel(/Keep a copy/).check();
      await begin(page, 'annulus_scale');
      await apply(page);
      await page.waitForTimeout(400);
      const { hash } = await figures(page);
      const other = await context.newPage();
      await page.close({ runBeforeUnload: false });
      await other.goto(pathToFileURL(page_path).href);
      await closed(other);
      await other.getByRole('button', { name: 'Recover it' }).click();
      await other.waitForTimeout(300);
      await closed(other);
      assert.equal((await figures(other)).hash, hash);
    });
  });

  it('says_that_the_browser_refuses_storage', async () => {
    const { context } = await openBrowser();
    try {
      // as a browser does whose user forbids it
      await context.addInitScript(() => {
        const refuse = () => {
          throw new DOMException('denied', 'SecurityError');
        };
        for (const name of ['localStorage', 'indexedDB'])
          Object.defineProperty(window, name, { get: refuse });
      });
      const { page, errors } = await openPlanner(context);
      await openPanel(page, 'Plan');
      await page.getByText('This browser refuses storage to pages from disk').waitFor();
      assert.ok(await page.getByLabel(/Keep a copy/).isDisabled());
      await begin(page, 'ring');
      await apply(page);
      assert.deepEqual(errors, []);
    } finally {
      await context.close();
    }
  });

  it('fits_a_tablet_and_a_large_screen', async () => {
    for (const [width, height] of [
      [1280, 720],
      [1920, 1080],
      [820, 1180],
    ]) {
      await withPlanner({ width, height }, async ({ page }) => {
        const clipped = await page.evaluate(() => {
          const bad = [];
          for (const button of document.querySelectorAll('header button, .viewbar button, .tabs button')) {
            const box = button.getBoundingClientRect();
            if (box.left < 0 || box.right > innerWidth + 0.5 || box.bottom > innerHeight + 0.5)
              bad.push(button.textContent || button.ariaLabel);
          }
          return bad;
        });
        assert.deepEqual(clipped, [], `${width} x ${height}`);
      });
    }
  });

  it('reaches_everything_in_small_windows_and_at_two_and_four_times_the_size', async () => {
    await withPlanner({}, async ({ page }) => {
      const sizes = [
        [1024, 768],
        [640, 360],
        [360, 640],
        [320, 256],
      ];
      await inWindows(page, sizes, async (size) => {
        // after scrolling down at most: nothing is scrolled sideways
        const cut = await page.evaluate(() => {
          const bad = [];
          const controls = document.querySelectorAll(
            'header button, .viewbar button, .viewbar input, .viewbar select, .tabs button',
          );
          for (const control of controls) {
            control.scrollIntoView({ block: 'nearest', inline: 'nearest' });
            const box = control.getBoundingClientRect();
            const seen = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
            // half a pixel: places of the layout are fractions, those of scrolling are not
            if (
              Math.min(box.left, box.top) < -0.5 ||
              box.right > innerWidth + 0.5 ||
              box.bottom > innerHeight + 0.5
            )
              bad.push(control.textContent || control.ariaLabel);
            else if (!seen?.closest('button, label, input, select'))
              bad.push(`covered: ${control.ariaLabel}`);
          }
          const sideways = [...document.querySelectorAll('.app, .top, .viewbar, .side, .panel')].filter(
            (part) => part.scrollWidth > part.clientWidth + 1,
          );
          const picture = document.querySelector('.canvas').getBoundingClientRect();
          if (picture.height < 150) bad.push(`picture ${picture.height} px high`);
          return [...bad, ...sideways.map((part) => `${part.className} is scrolled sideways`)];
        });
        assert.deepEqual(cut, [], size);
      });
    });
  });

  it('covers_no_control_that_has_the_focus_by_a_notice', async () => {
    await withPlanner({}, async ({ page }) => {
      await begin(page, 'ring');
      const sizes = [
        [1280, 720],
        [853, 480],
        [820, 1180],
        [320, 256],
      ];
      await inWindows(page, sizes, async (size) => {
        const covered = await page.evaluate(async () => {
          const text =
            '“Valve 3: dilated, and a short chord” is finished. Its repair can be opened once more.';
          window.planner.state.notice.value = { kind: 'error', text };
          const bad = [];
          for (const control of document.querySelectorAll('button, select, input, summary, textarea')) {
            const notice = document.querySelector('[data-testid=notice]');
            if (!control.checkVisibility() || notice?.contains(control)) continue;
            control.focus();
            // it is scrolled to in one frame, the notice makes way in the next one
            for (let k = 0; k < 3; ++k) await new Promise(requestAnimationFrame);
            const [a, b] = [control, document.querySelector('[data-testid=notice]')].map((part) =>
              part.getBoundingClientRect(),
            );
            if (a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom)
              bad.push(
                `${control.ariaLabel || control.textContent} at ${a.top} to ${a.bottom}, ${b.top} to ${b.bottom}`,
              );
          }
          return bad;
        });
        assert.deepEqual(covered, [], size);
      });
    });
  });

  it('turns_and_zooms_with_fingers', async () => {
    await withPlanner({ width: 820, height: 1180, touch: true }, async ({ page, context }) => {
      const client = await context.newCDPSession(page);
      const camera = () =>
        page.evaluate(() => [
          ...window.planner.viewport.camera.orientation.toArray(),
          window.planner.viewport.camera.distance,
        ]);
      const touch = (type, points) => client.send('Input.dispatchTouchEvent', { type, touchPoints: points });
      const start = await camera();
      await touch('touchStart', [{ x: 400, y: 300 }]);
      for (let k = 1; k <= 8; ++k) await touch('touchMove', [{ x: 400 + 10 * k, y: 300 }]);
      await touch('touchEnd', []);
      const turned = await camera();
      assert.ok(Math.abs(turned[1] - start[1]) + Math.abs(turned[0] - start[0]) > 0.05);
      await touch('touchStart', [
        { x: 380, y: 300, id: 1 },
        { x: 420, y: 300, id: 2 },
      ]);
      for (let k = 1; k <= 8; ++k)
        await touch('touchMove', [
          { x: 380 - 8 * k, y: 300, id: 1 },
          { x: 420 + 8 * k, y: 300, id: 2 },
        ]);
      await touch('touchEnd', []);
      assert.ok((await camera())[4] < 0.6 * turned[4], 'spreading two fingers brings the valve nearer');
    });
  });
});
