// Colours as colour-blind people see them, and how far colours are apart: the matrices of Machado, Oliveira and Fernandes
// (2009), "A physiologically-based model for simulation of color vision deficiency", IEEE TVCG 15(6), table of severity 1.0,
// in linear sRGB; CIELAB under D65; CIEDE2000 after Sharma, Wu and Dalal (2005), Color Research and Application 30(1).

/** Rows of the matrices in linear sRGB. */
export const visions = {
  normal: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  protanopia: [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  deuteranopia: [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  tritanopia: [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
};

const linear = (v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);

/** CIELAB of an sRGB colour (0 to 1) as a person with a vision sees it. */
export function labOf(colour, vision = 'normal') {
  const rgb = colour.map(linear);
  const seen = visions[vision].map((row) => {
    const sum = row.reduce((total, weight, c) => total + weight * rgb[c], 0);
    return Math.min(1, Math.max(0, sum));
  });
  // IEC 61966-2-1, divided by the white of D65
  const xyz = [
    (0.4124 * seen[0] + 0.3576 * seen[1] + 0.1805 * seen[2]) / 0.9505,
    0.2126 * seen[0] + 0.7152 * seen[1] + 0.0722 * seen[2],
    (0.0193 * seen[0] + 0.1192 * seen[1] + 0.9505 * seen[2]) / 1.089,
  ].map((t) => (t > (6 / 29) ** 3 ? Math.cbrt(t) : t / (3 * (6 / 29) ** 2) + 4 / 29));
  return [116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])];
}

const degrees = Math.PI / 180;

/** Hue angle, degrees from 0 to 360. */
const hueOf = (b, a) => (a === 0 && b === 0 ? 0 : (Math.atan2(b, a) / degrees + 360) % 360);

/** Difference and mean of two hues on the circle; where a colour is grey, the hue of the other one. */
function hues(h1, h2, grey) {
  if (grey) return { difference: 0, mean: h1 + h2 };
  const d = h2 - h1;
  const difference = d > 180 ? d - 360 : d < -180 ? d + 360 : d;
  const sum = h1 + h2;
  const mean = Math.abs(d) <= 180 ? sum / 2 : sum < 360 ? (sum + 360) / 2 : (sum - 360) / 2;
  return { difference, mean };
}

/** CIEDE2000 difference of two CIELAB colours. */
export function difference([L1, a1, b1], [L2, a2, b2]) {
  const seventh = (c) => Math.sqrt(c ** 7 / (c ** 7 + 25 ** 7));
  const g = 0.5 * (1 - seventh((Math.hypot(a1, b1) + Math.hypot(a2, b2)) / 2));
  const [p1, p2] = [(1 + g) * a1, (1 + g) * a2];
  const [c1, c2] = [Math.hypot(p1, b1), Math.hypot(p2, b2)];
  const { difference: dh, mean: h } = hues(hueOf(b1, p1), hueOf(b2, p2), c1 * c2 === 0);
  const dH = 2 * Math.sqrt(c1 * c2) * Math.sin((dh / 2) * degrees);
  const [L, c] = [(L1 + L2) / 2, (c1 + c2) / 2];
  const cosine = (factor, offset) => Math.cos((factor * h + offset) * degrees);
  const t = 1 - 0.17 * cosine(1, -30) + 0.24 * cosine(2, 0) + 0.32 * cosine(3, 6) - 0.2 * cosine(4, -63);
  const sL = 1 + (0.015 * (L - 50) ** 2) / Math.sqrt(20 + (L - 50) ** 2);
  const [sC, sH] = [1 + 0.045 * c, 1 + 0.015 * c * t];
  const turn = -2 * seventh(c) * Math.sin(60 * Math.exp(-(((h - 275) / 25) ** 2)) * degrees);
  const [l, m, n] = [(L2 - L1) / sL, (c2 - c1) / sC, dH / sH];
  return Math.sqrt(l * l + m * m + n * n + turn * m * n);
}
