// Figures of the panel and colours of the maps beside the measures of the native library on the same valve, to the last digit
// shown: tenting, prolapse, coaptation, annulus, scallops, strain. A flail leaflet, so that none of them is 0.
import assert from 'node:assert/strict';
import { before, describe, it } from 'node:test';
import { closed, figures, sharePlanner } from './fixtures/browser.mjs';
import { repeated } from './fixtures/native.mjs';
import { openPanel, save } from './fixtures/person.mjs';

/** Repeats a session with the native command: its measures, and the valve as OBJ. */
function repeatNatively(session) {
  const { json, obj } = repeated(session);
  return { ...json('measure'), regions: json('leak').regions, obj: obj() };
}

/**
 * The largest principal stretch - 1 at each node, the mean of its triangles: from the positions and the rest shape of an OBJ
 * file. The stretches are the roots of the eigenvalues of C = F^T F, and in the plane of a triangle with edges E at rest and e
 * now, C = E^-T (e^T e) E^-1 has trace and determinant in closed form.
 */
function stretchOf(obj) {
  const [now, rest, faces] = [[], [], []];
  for (const line of obj.split('\n')) {
    const numbers = () => line.match(/-?\d[\d.e+-]*/g).map(Number);
    // a node is at rest where it is now, unless the next line says so
    if (line.startsWith('v ')) rest.push(now[now.push(numbers()) - 1]);
    else if (line.startsWith('#mvs rest ')) rest[rest.length - 1] = numbers();
    else if (line.startsWith('f ')) faces.push(numbers());
  }
  const dot = (a, b) => a.reduce((sum, v, c) => sum + v * b[c], 0);
  const minus = (a, b) => a.map((v, c) => v - b[c]);
  const sums = new Map();
  for (const corners of faces) {
    const metric = (x) => {
      const [a, b, c] = corners.map((k) => x[k - 1]);
      const [u, v] = [minus(b, a), minus(c, a)];
      return [dot(u, u), dot(u, v), dot(v, v)];
    };
    const [E, F, G] = metric(rest);
    const [e, f, g] = metric(now);
    const size = E * G - F * F;
    const trace = (e * G - 2 * f * F + g * E) / size;
    const determinant = (e * g - f * f) / size;
    const largest = trace / 2 + Math.sqrt(Math.max(0, (trace * trace) / 4 - determinant));
    for (const k of corners) {
      const sum = sums.get(k - 1) ?? [0, 0];
      sums.set(k - 1, [sum[0] + Math.sqrt(largest) - 1, sum[1] + 1]);
    }
  }
  return [...sums].map(([node, [sum, count]]) => [node, sum / count]);
}

describe('planner figures', { skip: process.env.MVS_COMMAND ? false : 'MVS_COMMAND is not set' }, () => {
  let page;
  let native;
  sharePlanner((opened) => ({ page } = opened));
  before(async () => {
    await openPanel(page, 'Learn');
    await page.getByRole('button', { name: 'Valve 4' }).click();
    await page.getByText('Valve 4 of the tour').waitFor();
    await closed(page);
    native = repeatNatively(await save(page));
  });

  it('are_those_of_the_library_in_the_panel', async () => {
    await openPanel(page, 'Valve');
    await page.locator('summary', { hasText: 'Physics' }).click();
    const shown = async (label, at = 0) => {
      const box = page.locator('.figure', { has: page.getByText(label, { exact: true }) }).nth(at);
      const text = (await box.locator('.figure-value').innerText()).replace(/\s+/g, ' ');
      // the scallop of a largest value is the next test's
      return text.replace(/ (at [AP]\d|along the (leaflets|axis))$/, '');
    };
    const m = native.measures;
    for (const [label, value, digits, unit] of [
      ['Tenting height', m.tenting_height_mm, 1, 'mm'],
      ['Tenting volume', m.tenting_volume_ml, 2, 'ml'],
      ['Billow above annulus', m.billow_height_mm, 1, 'mm'],
      ['Billow volume', m.billow_volume_ml, 2, 'ml'],
      ['Coaptation length, mean', m.coaptation_length_mean_mm, 1, 'mm'],
      ['Coaptation area', m.coaptation_area_mm2, 0, 'mm²'],
      ['Front to back (AP)', m.annulus_ap_mm, 1, 'mm'],
      ['Side to side (CC)', m.annulus_cc_mm, 1, 'mm'],
      ['Circumference', m.annulus_perimeter_mm, 0, 'mm'],
      ['Area', m.annulus_area_mm2 / 100, 1, 'cm²'],
      ['Saddle height', m.annulus_saddle_height_mm, 1, 'mm'],
      ['Non-planar angle', m.annulus_nonplanar_angle_deg, 0, '°'],
      ['Leaflet stretch, 95th percentile', 100 * m.leaflet_strain_p95, 0, '%'],
      ['Leaflet stress, 95th percentile', m.leaflet_stress_p95_kPa, 0, 'kPa'],
    ]) {
      assert.ok(value > 0, `${label} is ${value}`);
      assert.equal(await shown(label), `${value.toFixed(digits)} ${unit}`, label);
    }
    assert.match(
      await page.getByTestId('verdict').innerText(),
      new RegExp(`\\b${m.regurgitant_orifice_area_mm2.toFixed(0)}\\s+mm²`),
    );
  });

  it('of_the_scallops_add_up_to_those_of_the_library', async () => {
    const rows = [];
    for (const row of await page.getByTestId('scallops').locator('tbody tr').all())
      rows.push(await row.locator('th, td').allInnerTexts());
    const scallops = rows.filter(([name]) => /^[AP][123]$/.test(name));
    assert.equal(scallops.length, 6);
    const numbers = (column) => scallops.map((row) => Number(row[column].replace('–', '0')));
    const m = native.measures;
    // six numbers, each rounded to 0.1
    const sum = numbers(2).reduce((a, b) => a + b);
    assert.ok(Math.abs(sum - m.regurgitant_orifice_area_mm2) <= 0.3, `${sum} mm²`);
    assert.equal(Math.max(...numbers(3)).toFixed(1), m.billow_height_mm.toFixed(1));
  });

  it('say_of_which_scallop_the_largest_billow_is_and_how_high_each_free_edge_stands', async () => {
    await openPanel(page, 'Valve');
    const m = native.measures;
    const most = native.regions
      .filter(({ name }) => /^[AP][123]$/.test(name))
      .sort((a, b) => b.billow_height_mm - a.billow_height_mm)[0];
    // the edge of P2 is flail, and yet the leaflets billow most in A2
    assert.equal(most.name, 'A2');
    assert.equal(most.billow_height_mm.toFixed(3), m.billow_height_mm.toFixed(3));
    const box = page.locator('.figure', { has: page.getByText('Billow above annulus', { exact: true }) });
    assert.match(await box.innerText(), /at A2/);
    // heights of the nodes of the free edge over the plane of the frame, from the saved positions
    const rows = new Map();
    for (const row of await page.getByTestId('scallops').locator('tbody tr').all()) {
      const [name, , , , edge] = await row.locator('th, td').allInnerTexts();
      if (edge) rows.set(name, Number(edge.replace('−', '-')));
    }
    assert.deepEqual([...rows.keys()], ['A1', 'A2', 'A3', 'P1', 'P2', 'P3']);
    assert.ok(await page.getByTestId('scallops').isVisible());
    assert.ok(
      rows.get('P2') > 1 && [...rows].every(([name, mm]) => name === 'P2' || mm < -2),
      `${[...rows]}`,
    );
    await openPanel(page, 'Learn');
    assert.ok(
      (await page.getByTestId('goals').innerText()).includes(
        `now ${rows.get('P2').toFixed(1)}\u00a0mm above`,
      ) ||
        (await page.getByTestId('goals').innerText()).includes(`now ${rows.get('P2').toFixed(1)} mm above`),
    );
  });

  it('are_read_off_the_map_of_the_stretch', async () => {
    await page.getByLabel('Colours').selectOption({ label: 'Leaflet stretch' });
    await page.waitForTimeout(300);
    const { colours, ticks, front } = await page.evaluate(() => {
      const scale = document.querySelector('[data-testid=scale]');
      const { background } = scale.querySelector('.bar i').style;
      return {
        colours: [...background.matchAll(/rgb\((\d+),? (\d+),? (\d+)\)/g)].map((rgb) =>
          rgb.slice(1).map(Number),
        ),
        ticks: [...scale.querySelectorAll('.bar em')].map(({ textContent }) => Number(textContent)),
        front: [...window.planner.viewport.scene().meshes[0].front],
      };
    });
    assert.ok(colours.length > 4 && ticks.length > 2);
    // the place on the scale whose colour is nearest, as a person finds it
    const [low, high] = [ticks[0], ticks.at(-1)];
    const places = Array.from({ length: 1001 }, (_, k) => {
      const t = (k / 1000) * (colours.length - 1);
      const i = Math.min(colours.length - 2, Math.floor(t));
      return colours[i].map((v, c) => v + (t - i) * (colours[i + 1][c] - v));
    });
    const read = (node) => {
      const colour = front.slice(3 * node, 3 * node + 3).map((v) => 255 * v);
      const off = places.map((place) => Math.hypot(...place.map((v, c) => v - colour[c])));
      return low + ((high - low) * off.indexOf(Math.min(...off))) / 1000;
    };
    const seen = new Set();
    for (const [node, stretch] of stretchOf(native.obj)) {
      const wanted = Math.min(high, Math.max(low, 100 * stretch));
      // colours of the scale are rounded to 1 / 255: two of its 320 steps from violet to yellow
      assert.ok(Math.abs(read(node) - wanted) < 0.3, `node ${node}: ${read(node)} % for ${wanted} %`);
      seen.add(Math.round(wanted / 5));
    }
    // tissue of many stretches
    assert.ok(seen.size > 4, `${seen.size}`);
    await page.getByLabel('Colours').selectOption({ label: 'Tissue' });
  });
});
