// An artificial chord by the mouse alone, from the card of the operation and from a papillary head.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { closed, figures, withPlanner } from './fixtures/browser.mjs';
import { answered, cameraRests, edgePlace, headPlace, openPanel } from './fixtures/person.mjs';

/** Presses a control in its middle, as a hand does. */
async function press(page, control) {
  await control.scrollIntoViewIfNeeded();
  const box = await control.boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await answered(page, 250);
}

async function clickAt(page, { x, y }) {
  await page.mouse.click(x, y);
  await answered(page, 250);
}

const named = (page, name) => page.getByRole('button', { name, exact: true });

async function view(page, name) {
  await press(page, named(page, name));
  await cameraRests(page);
}

/** Tour valve 4, whose P2 is flail. */
async function flail(page) {
  await openPanel(page, 'Learn');
  await press(page, page.getByRole('button', { name: 'Valve 4' }));
  await press(page, page.getByRole('tab', { name: 'Repair' }));
}

/** Values of the form: the head by its name, and the length that the preview's chord has without pull, mm. */
function formOf(page) {
  return page.evaluate(() => {
    const { state } = window.planner;
    const { head, site } = state.draft.value?.fields ?? {};
    const parts = state.topologyOf(state.main.value.picture).heads;
    return {
      head: parts.find(({ id }) => id === head)?.name,
      site: JSON.stringify(site),
      picking: state.picking.value,
      rest: state.added.value?.rest ?? null,
      leak: state.preview.value?.figures.measures.orifice ?? null,
    };
  });
}

/** Names of the corners of the triangle in the form, by which other meshes of the valve have them too. */
function corners(page) {
  return page.evaluate(() => {
    const { state } = window.planner;
    const topology = state.topologyOf(state.main.value.picture);
    const { triangle } = state.draft.value.fields.site;
    return [...topology.triangles.slice(3 * triangle, 3 * triangle + 3)].map((node) => topology.origin[node]);
  });
}

/**
 * The artificial chord of the valve of the plan: names of its ends, and the corners that are no neighbours of its end,
 * which lies in the triangle of the corners if no such vertex exists.
 */
function tied(page, of = []) {
  return page.evaluate((names) => {
    const { state } = window.planner;
    const { picture, figures: known } = state.main.value;
    const topology = state.topologyOf(picture);
    const k = known.chords.findIndex((chord) => chord.artificial);
    if (k < 0) return null;
    const [start, end] = topology.chordNodes.slice(2 * k, 2 * k + 2);
    const around = new Set();
    for (let i = 0; i < topology.triangles.length; i += 3) {
      const nodes = [...topology.triangles.slice(i, i + 3)];
      if (nodes.includes(end)) for (const node of nodes) around.add(topology.origin[node]);
    }
    const { heads, scallops } = known.chords[k];
    const head = topology.heads[topology.headNodes.indexOf(start)]?.name;
    return { head, heads, scallops, missing: names.filter((name) => !around.has(name)) };
  }, of);
}

describe('planner, artificial chord by mouse', () => {
  it('is_tied_where_leaflet_and_head_are_clicked_and_undone', async () => {
    await withPlanner({}, async ({ page }) => {
      await flail(page);
      const before = await figures(page);
      assert.ok(before.measures.orifice > 3);
      await press(page, page.locator('[data-operation=neochord]'));
      await view(page, 'Surgeon');
      const first = await edgePlace(page, 'P2', 0.2);
      await clickAt(page, first);
      const asked = await formOf(page);
      // the nearer head is taken until another one is clicked, and the closed valve is shown
      assert.match(asked.head, /^(AL|PM)/);
      assert.equal(asked.picking, null);
      assert.ok(asked.leak < before.measures.orifice && asked.rest > 5, JSON.stringify(asked));
      // a second click moves the place
      const place = await edgePlace(page, 'P2', 0.5);
      await clickAt(page, place);
      const moved = await formOf(page);
      assert.notEqual(moved.site, asked.site);
      assert.equal(moved.head, asked.head);
      const triangle = await corners(page);
      // a head of the other muscle
      const other = asked.head.startsWith('AL') ? 'PM3' : 'AL3';
      await view(page, 'Behind');
      await clickAt(page, await headPlace(page, other));
      const chosen = await formOf(page);
      assert.equal(chosen.head, other);
      assert.equal(chosen.site, moved.site);
      assert.equal((await figures(page)).history.length, before.history.length + 1, 'a preview');
      await press(page, named(page, 'Apply'));
      await page.getByTestId('form').waitFor({ state: 'detached' });
      await closed(page);
      const after = await figures(page);
      assert.ok(after.measures.orifice < before.measures.orifice);
      const chord = await tied(page, triangle);
      assert.equal(chord.head, other);
      assert.deepEqual([chord.heads, chord.scallops], [other, 'P2']);
      assert.deepEqual(chord.missing, []);
      await press(page, page.getByRole('tab', { name: 'Valve' }));
      assert.match(await page.getByTestId('devices').innerText(), new RegExp(`${other} to P2`));
      await press(page, page.getByRole('button', { name: /^Undo/ }));
      assert.equal((await figures(page)).hash, before.hash);
      assert.equal(await tied(page), null);
    });
  });

  it('starts_from_a_head_that_is_clicked_first', async () => {
    await withPlanner({}, async ({ page }) => {
      await flail(page);
      await view(page, 'Behind');
      await clickAt(page, await headPlace(page, 'PM3'));
      await press(page, page.getByRole('button', { name: 'Artificial chord from here' }));
      assert.equal((await formOf(page)).head, 'PM3');
      await view(page, 'Surgeon');
      const place = await edgePlace(page, 'P2', 0.5);
      await clickAt(page, place);
      assert.equal((await formOf(page)).head, 'PM3');
      const triangle = await corners(page);
      await press(page, named(page, 'Apply'));
      await page.getByTestId('form').waitFor({ state: 'detached' });
      await closed(page);
      const chord = await tied(page, triangle);
      assert.deepEqual([chord.head, chord.scallops], ['PM3', 'P2']);
      assert.deepEqual(chord.missing, []);
    });
  });
});
