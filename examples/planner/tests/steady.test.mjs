// Nothing moves that a hand or an eye is on: controls stay where they are while words beside them change, notices leave the keys of the
// colours in sight, the words of the section plot stand beside its curves.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, sharePlanner } from './fixtures/browser.mjs';
import { answered, apply, begin, cameraRests, openPanel, startAfresh } from './fixtures/person.mjs';

const windows = [
  [1280, 800],
  [1024, 700],
  [853, 480],
  [820, 1180],
  [400, 800],
];

describe('planner layout', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  const openTour = async (number) => {
    await openPanel(page, 'Learn');
    await page.getByRole('button', { name: `Valve ${number}` }).click();
    await page.getByTestId('score').getByText('Before illness').waitFor();
    await closed(page);
  };
  const inWindows = async (work) => {
    for (const [width, height] of windows) {
      await page.setViewportSize({ width, height });
      await page.waitForTimeout(250);
      await work(`${width} x ${height}`);
      // a page in one column would be as far down when it is one again
      await page.evaluate(() => document.querySelector('.app').scrollTo(0, 0));
    }
    await page.setViewportSize({ width: 1280, height: 720 });
  };

  /**
   * Places that controls have, in CSS pixels from the top of what scrolls them, while the page answers a change of the form: each is
   * listed once.
   */
  const placesWhile = (kind, fields) =>
    page.evaluate(
      async ([operation, given]) => {
        const { state, edit } = window.planner;
        const controls = { tabs: '.tabs', field: '.form input[type=range]', apply: '.form-foot .main' };
        const places = Object.fromEntries(Object.keys(controls).map((name) => [name, new Set()]));
        const note = () => {
          for (const [name, selector] of Object.entries(controls)) {
            const control = document.querySelector(selector);
            if (control) places[name].add(Math.round(control.getBoundingClientRect().top));
          }
        };
        const old = state.preview.value?.figures.hash;
        edit(operation, given);
        for (const end = performance.now() + 60_000; performance.now() < end;) {
          await new Promise(requestAnimationFrame);
          note();
          const { figures } = state.preview.value ?? {};
          const known = figures && figures.hash !== old && figures.known === 'all' && !state.pending.value;
          if (known && state.openings.value.has(figures.hash)) break;
        }
        for (let k = 0; k < 5; ++k) await new Promise(requestAnimationFrame).then(note);
        return Object.fromEntries(Object.entries(places).map(([name, tops]) => [name, [...tops]]));
      },
      [kind, fields],
    );

  it('keeps_the_form_where_it_is_while_the_verdict_changes', async () => {
    await openTour(4);
    await begin(page, 'annulus_scale');
    let step = 0;
    await inWindows(async (size) => {
      // from a mild leak to a narrow sealed valve with loaded chordae: every line of the card comes and goes
      for (const factor of [1, 0.5]) {
        const places = await placesWhile('annulus_scale', { factor: factor - 0.01 * ++step });
        for (const [name, tops] of Object.entries(places))
          assert.equal(tops.length, 1, `${size}, ${factor}: ${name} at ${tops.join(', ')}`);
      }
    });
    await page.keyboard.press('Escape');
  });

  it('keeps_the_slider_of_a_chord_where_it_is_at_its_first_change', async () => {
    await startAfresh(page);
    await begin(page, 'chord_length');
    const slider = page.locator('.slide input');
    const belowTheTop = async () =>
      (await slider.boundingBox()).y - (await page.locator('.form-head').boundingBox()).y;
    await inWindows(async (size) => {
      // long words and figures: a strut, the rough zone, the longest one
      for (const name of ['A2/10', 'P1/9', 'A3/10']) {
        await page.locator('#f-chord').selectOption({ label: name });
        await closed(page);
        await slider.scrollIntoViewIfNeeded();
        const before = await belowTheTop();
        const { width, height } = await slider.boundingBox();
        await slider.click({ position: { x: 0.35 * width, y: height / 2 } });
        await answered(page, 300);
        await page.getByTestId('chosen').getByText('→').first().waitFor();
        assert.equal(await belowTheTop(), before, `${size}, ${name}`);
      }
    });
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
  });

  it('keeps_the_buttons_of_every_form_at_one_place', async () => {
    // shorter and longer than the panel
    const tops = new Set();
    for (const kind of ['band', 'ring', 'clip', 'resect', 'neochord']) {
      await begin(page, kind);
      await answered(page, 100);
      const { y, height } = await page.getByRole('button', { name: 'Apply', exact: true }).boundingBox();
      tops.add(Math.round(y + height));
      await page.keyboard.press('Escape');
      await page.keyboard.press('Escape');
    }
    assert.equal(tops.size, 1, [...tops].join(', '));
  });

  it('shows_the_keys_of_the_colours_beside_a_notice', async () => {
    await startAfresh(page);
    // with a preview there are buttons that compare
    await begin(page, 'band');
    await page.getByRole('button', { name: 'Before', exact: true }).waitFor();
    await inWindows(async (size) => {
      const text = 'The plan “Valve 3: dilated, and a short chord” was put aside; it reaches all goals.';
      await page.evaluate((words) => {
        const action = { text: 'Return to it', run() {} };
        window.planner.state.notice.value = { kind: 'info', text: words, action };
      }, text);
      await page.getByTestId('notice').waitFor();
      await page.waitForTimeout(100);
      const covered = await page.evaluate(() => {
        const a = document.querySelector('[data-testid=notice]').getBoundingClientRect();
        return ['.scale', '.compare', '.viewbar'].filter((selector) => {
          const b = document.querySelector(selector)?.getBoundingClientRect();
          return b && b.width && a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
        });
      });
      assert.deepEqual(covered, [], size);
      await page.evaluate(() => (window.planner.state.notice.value = null));
      await page.waitForTimeout(50);
      // and the keys stay at the foot of the picture
      const foot = await page.evaluate(() => {
        const [scale, stage] = ['.scale', '.stage'].map((part) => document.querySelector(part));
        const box = scale.getBoundingClientRect();
        return box.height ? stage.getBoundingClientRect().bottom - box.bottom : 0;
      });
      assert.ok(foot >= 0 && foot < 20, `${size}: ${foot}`);
    });
    await page.keyboard.press('Escape');
  });

  it('writes_no_word_of_the_section_over_a_curve_or_another_word', async () => {
    await openTour(4);
    await begin(page, 'band');
    await apply(page);
    await openPanel(page, 'Valve');
    await page
      .locator('details', { hasText: 'Section through the valve' })
      .evaluate((part) => (part.open = true));
    for (const offset of [0, 6, 12, 16, -9, -15]) {
      await page.evaluate((at) => (window.planner.state.sectionAt.value = at), offset);
      await page.locator('.outdated .plot').waitFor({ state: 'detached' });
      await answered(page, 300);
      const bad = await page.evaluate(() => {
        const plot = document.querySelector('svg.plot');
        const words = [...plot.querySelectorAll('text')].map((text) => [text.textContent, text.getBBox()]);
        const found = [];
        words.forEach(([name, a], k) => {
          for (const path of plot.querySelectorAll('path')) {
            const length = path.getTotalLength();
            for (let s = 0; s <= length; s += 0.25) {
              const { x, y } = path.getPointAtLength(s);
              if (x > a.x && x < a.x + a.width && y > a.y && y < a.y + a.height) {
                found.push(`${name} on ${path.getAttribute('class')}`);
                break;
              }
            }
          }
          for (const [other, b] of words.slice(k + 1))
            if (a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height)
              found.push(`${name} on ${other}`);
        });
        return found;
      });
      assert.deepEqual(bad, [], `plane at ${offset} mm`);
    }
    await page.evaluate(() => (window.planner.state.sectionAt.value = 0));
    await cameraRests(page);
  });
});
