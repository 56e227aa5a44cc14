// The rasteriser draws the pictures that were looked at when `node tests/tools/references.mjs` made them.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { openBrowser } from './fixtures/browser.mjs';
import { drawPictures, readReference } from './tools/references.mjs';

/**
 * Largest mean difference of two pictures, of 255. The positions have the same bits on every machine; the camera's tangent and
 * square roots may differ in the last bit, which moves single samples at the edges of triangles: 3 of 67,500 pixels that change
 * from black to white. A change of the closure's bits moves nodes by less than a thousandth of a pixel.
 */
const tolerance = 0.012;

/** Mean difference of the pictures of two data URLs over all pixels and colours, of 255; Infinity if their sizes differ. */
function difference(page, pair) {
  return page.evaluate(async (urls) => {
    const [a, b] = await Promise.all(
      urls.map(async (url) => {
        const image = new Image();
        image.src = url;
        await image.decode();
        const canvas = new OffscreenCanvas(image.width, image.height);
        const paint = canvas.getContext('2d');
        paint.drawImage(image, 0, 0);
        return paint.getImageData(0, 0, image.width, image.height);
      }),
    );
    if (a.width !== b.width || a.height !== b.height) return Infinity;
    let sum = 0;
    for (let i = 0; i < a.data.length; ++i) sum += Math.abs(a.data[i] - b.data[i]);
    return sum / (0.75 * a.data.length);
  }, pair);
}

describe('planner pictures', () => {
  it('are_those_of_the_references', async () => {
    const pictures = await drawPictures();
    const { context } = await openBrowser();
    try {
      const page = await context.newPage();
      let last;
      for (const [name, url] of Object.entries(pictures)) {
        const off = await difference(page, [url, readReference(name)]);
        assert.ok(off <= tolerance, `${name} differs by ${off} of 255`);
        // another picture is far outside of the tolerance
        if (last) assert.ok((await difference(page, [url, last])) > 100 * tolerance, name);
        last = url;
      }
    } finally {
      await context.close();
    }
  });
});
