// Words and controls that nothing covers: tooltips leave the goals in sight, notices the keys of the colours; the card of the verdict
// holds all its words, and a form shows each field above its foot.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { closed, figures, sharePlanner } from './fixtures/browser.mjs';
import { apply, begin, fillIn, openPanel, startAfresh, undo } from './fixtures/person.mjs';

describe('planner words that cover nothing', () => {
  let page;
  sharePlanner((opened) => ({ page } = opened));
  beforeEach(() => startAfresh(page));

  it('covers_no_goal_by_a_tooltip', async () => {
    await openPanel(page, 'Learn');
    await page.getByRole('button', { name: 'Valve 1' }).click();
    await page.getByTestId('score').getByText('Before illness').waitFor();
    await closed(page);
    await page.getByRole('tab', { name: 'Learn' }).focus();
    let seen = 0;
    for (let k = 0; k < 12; ++k) {
      await page.keyboard.press('Tab');
      const covered = await page.evaluate(() => {
        const a = document.querySelector('[data-testid=tip]').getBoundingClientRect();
        if (!a.width || !document.activeElement.closest('.panel')) return null;
        return [...document.querySelectorAll('.goals, .panel h3, .panel p')].filter((part) => {
          const b = part.getBoundingClientRect();
          return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
        }).length;
      });
      if (covered === null) continue;
      ++seen;
      assert.equal(covered, 0, await page.evaluate(() => document.activeElement.textContent));
    }
    assert.ok(seen > 4, `${seen} tooltips`);
  });

  it('leaves_the_keys_of_the_colours_where_they_are_when_a_notice_comes', async () => {
    const top = async () => (await page.locator('.scale').boundingBox()).y;
    const before = await top();
    await page.evaluate(() => {
      const action = { text: 'Return to it', run() {} };
      window.planner.state.notice.value = { kind: 'info', text: 'The changed plan was closed.', action };
    });
    const close = page.getByTestId('notice').getByRole('button', { name: 'Close' });
    await close.hover();
    await page.waitForTimeout(100);
    assert.equal(await top(), before);
    // its words are seen under the mouse
    const [ink, ground] = await close.evaluate((button) => {
      const light = (colour) => {
        const [r, g, b, a = 1] = colour.match(/[\d.]+/g).map(Number);
        return (a * (r + g + b)) / 765;
      };
      const style = getComputedStyle(button);
      return [light(style.color), light(style.backgroundColor)];
    });
    assert.ok(ink - ground > 0.5, `ink ${ink} on ${ground}`);
    await close.click();
  });

  it('writes_the_whole_verdict', async () => {
    await openPanel(page, 'Learn');
    await page.getByRole('button', { name: 'Valve 3' }).click();
    await page.getByTestId('score').getByText('Before illness').waitFor();
    await closed(page);
    const cut = () =>
      page.evaluate(() => {
        const card = document.querySelector('.verdict');
        const lines = [card, ...card.querySelectorAll('*')].filter(
          (e) => e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).overflowX !== 'visible',
        );
        return [
          ...lines.map((e) => e.className),
          card.scrollHeight > card.clientHeight ? 'too high' : '',
        ].join('');
      });
    assert.equal(await cut(), '');
    // many lines: a narrow ring with overloaded chordae
    await begin(page, 'ring');
    await fillIn(page, 'size', '24');
    await apply(page);
    await page.getByText('is below the goal').first().waitFor();
    assert.ok((await figures(page)).measures.chordsOver > 0);
    assert.equal(await cut(), '');
    // and a leak in two places after a clip, which narrows the valve
    await begin(page, 'clip');
    await page.evaluate(() => {
      const { state } = window.planner;
      const { figures, ...shown } = state.preview.value;
      const [part] = [...figures.orificeParts, { area: 9, centroid: [0, 0, 0], direction: [0, 0, 1] }];
      const commissure = figures.regions.find((region) => region.commissure);
      const regions = figures.regions.map((region) => ({
        ...region,
        orifice: region === commissure || /^P/.test(region.name) ? 5 : 0,
      }));
      const chords = figures.chords.map((chord) => ({ ...chord, tension: 4.7 * chord.tensionLimit }));
      const measures = { ...figures.measures, orifice: 17, chordLoad: 4.7, chordsOver: 29 };
      const hash = 'many lines';
      state.openings.value = new Map([[hash, { hash, openArea: 172 }]]);
      const parts = [part, { ...part, centroid: part.centroid.map((v) => v + 20) }].map((one) => ({
        ...one,
        area: 9,
      }));
      const changed = { ...figures, hash, regions, chords, measures, orificeParts: parts };
      state.preview.value = { ...shown, figures: changed };
    });
    await page.locator('.verdict .beyond-names').waitFor();
    assert.match(
      await page.getByTestId('verdict').innerText(),
      /opens to 1\.7\scm²[^]*chordae[^]*and others, in 2\splaces[^]*times/,
    );
    assert.equal(await cut(), '');
    await page.keyboard.press('Escape');
    await page.keyboard.press('Escape');
    await closed(page);
    await undo(page);
  });

  it('shows_each_field_of_a_form_above_its_foot', async () => {
    for (const [width, height] of [
      [1366, 768],
      [1280, 720],
    ]) {
      await page.setViewportSize({ width, height });
      for (const kind of ['clip', 'resect']) {
        await begin(page, kind);
        await page
          .getByTestId('opening')
          .getByText(/without it \d/)
          .waitFor();
        const covered = await page.evaluate(async () => {
          const found = [];
          for (const field of document.querySelectorAll('.form > .field, .form .fields > .field')) {
            field.scrollIntoView({ block: 'nearest' });
            await new Promise(requestAnimationFrame);
            const box = field.getBoundingClientRect();
            const [foot, head] = ['.form-foot', '.tabs'].map((part) =>
              document.querySelector(part).getBoundingClientRect(),
            );
            if (box.bottom > foot.top + 1 || box.top < head.bottom - 1)
              found.push(
                `${field.innerText}: ${[box.top, box.bottom, head.bottom, foot.top].map(Math.round)}`,
              );
          }
          return found;
        });
        assert.deepEqual(covered, [], `${kind} at ${width} x ${height}`);
        await page.keyboard.press('Escape');
        await page.keyboard.press('Escape');
        await closed(page);
      }
    }
    await page.setViewportSize({ width: 1280, height: 720 });
  });
});
