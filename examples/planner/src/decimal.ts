// Decimal numbers as people write them.

/** 1,000 is a thousand to some and one to others; 0,125 is plain. */
const ambiguous = /^[-+]?[1-9]\d{0,2},\d{3}$/;
const plain = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;

/** A number with a decimal point or a decimal comma; undefined of an empty text, null of what is no number or can be read in two ways. */
export function decimalOf(text: string): number | null | undefined {
  const given = text.trim().replace('−', '-');
  if (!given) return undefined;
  const pointed = given.replace(',', '.');
  return plain.test(pointed) && !ambiguous.test(given) ? +pointed : null;
}
