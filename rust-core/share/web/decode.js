// Light of groups: base 64, deflated, differences from what neighbours let expect (pack.rs), codes of logarithms (codes.rs).

async function inflated(text) {
  const letters = atob(text.trim());
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// One plane of codes, from its low and its high bytes.
function plane(bytes, number, width, count) {
  const low = bytes.subarray(2 * number * count, (2 * number + 1) * count);
  const high = bytes.subarray((2 * number + 1) * count, (2 * number + 2) * count);
  const out = new Uint16Array(count);
  for (let at = 0, x = 0; at < count; at++) {
    let expected = 0;
    if (at >= width) {
      const above = out[at - width];
      if (x === 0) expected = above;
      else {
        const left = out[at - 1], corner = out[at - width - 1];
        const least = left < above ? left : above, most = left < above ? above : left;
        expected = corner >= most ? least : corner <= least ? most : left + above - corner;
      }
    } else if (x > 0) expected = out[at - 1];
    const folded = low[at] | (high[at] << 8);
    out[at] = ((folded >> 1) ^ -(folded & 1)) + expected;
    if (++x === width) x = 0;
  }
  return out;
}

// Codes of red, green and blue, pixel by pixel, rows from the top.
async function codesOf(text, width, height) {
  const count = width * height, bytes = await inflated(text);
  if (bytes.length !== 6 * count) throw new Error('the light of a group is cut off');
  const [green, red, blue] = [0, 1, 2].map((number) => plane(bytes, number, width, count));
  const codes = new Uint16Array(3 * count);
  for (let i = 0, j = 0; i < count; i++, j += 3) {
    const g = green[i];
    codes[j] = red[i] + g - 32768;
    codes[j + 1] = g;
    codes[j + 2] = blue[i] + g - 32768;
  }
  return codes;
}
