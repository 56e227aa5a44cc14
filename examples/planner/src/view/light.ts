// The light of both renderers: a key light from the upper left of the viewer, a weak fill from the other side,
// an ambient part that falls from above to below, and a small highlight (Blinn-Phong). Axes of the camera.

export const key = normalised(-0.3, 0.42, 0.86);
export const fillLight = normalised(0.6, -0.6, 0.5);
export const strength = { key: 0.66, fill: 0.26, ambient: 0.32, highlight: 0.14, shininess: 28 };

function normalised(x: number, y: number, z: number): [number, number, number] {
  const s = 1 / Math.hypot(x, y, z);
  return [x * s, y * s, z * s];
}

const half = normalised(key[0], key[1], key[2] + 1);

/** Lights a colour (0 to 1) with a unit normal; writes 0 to 255. */
export function shade(
  r: number,
  g: number,
  b: number,
  nx: number,
  ny: number,
  nz: number,
  out: number[],
): void {
  const k = Math.max(0, nx * key[0] + ny * key[1] + nz * key[2]);
  const f = Math.max(0, nx * fillLight[0] + ny * fillLight[1] + nz * fillLight[2]);
  const ambient = strength.ambient * (0.85 + 0.15 * ny);
  const light = 255 * (ambient + strength.key * k + strength.fill * f);
  const h = Math.max(0, nx * half[0] + ny * half[1] + nz * half[2]);
  const highlight = 255 * strength.highlight * Math.pow(h, strength.shininess);
  out[0] = Math.min(255, r * light + highlight);
  out[1] = Math.min(255, g * light + highlight);
  out[2] = Math.min(255, b * light + highlight);
}

/** The same in GLSL: vec3 shade(vec3 colour, vec3 normal). */
export const shadeGlsl = `
vec3 shade(vec3 colour, vec3 n) {
  vec3 key = vec3(${key.join(', ')}), fill = vec3(${fillLight.join(', ')}), h = vec3(${half.join(', ')});
  float light = ${strength.ambient.toFixed(3)} * (0.85 + 0.15 * n.y) + ${strength.key.toFixed(3)} * max(0.0, dot(n, key))
    + ${strength.fill.toFixed(3)} * max(0.0, dot(n, fill));
  return colour * light + ${strength.highlight.toFixed(3)} * pow(max(0.0, dot(n, h)), ${strength.shininess.toFixed(1)});
}`;
