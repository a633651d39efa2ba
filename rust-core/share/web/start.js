// Unpacks the light, finds what can draw it, and puts the controls around it.

async function start() {
  const data = JSON.parse(element('data').textContent), words = data.words, [width, height] = data.size;
  if (typeof DecompressionStream === 'undefined') throw new Error(words.old);
  const codes = [];
  for (let group = 0; group < data.groups.length; group++) {
    const text = element(`light-${group}`);
    codes.push(await codesOf(text.textContent, width, height));
    text.remove();
  }
  const light = new Light(data, codes);
  let canvas = element('canvas');
  Object.assign(canvas, { width, height });
  let renderer = location.hash === '#plain' ? null : ByGl.on(canvas, light);
  if (!renderer) {
    // A canvas that was asked for WebGL gives nothing else.
    const fresh = canvas.cloneNode();
    canvas.replaceWith(fresh);
    canvas = fresh;
    renderer = new ByCanvas(canvas, light);
  }
  const show = new Show(data, light, renderer), controls = new Controls(show, words);
  canvas.addEventListener('webglcontextlost', () => location.reload());
  show.draw();
  canvas.hidden = false;
  element('still').hidden = true;
  return { show, controls, kind: renderer.constructor.name };
}

// For tests and for those who want more: resolves to what shows the picture, its controls, and which of both ways draws it.
window.gonio = start();
window.gonio.catch((error) => {
  const { words } = JSON.parse(element('data').textContent);
  element('readout').textContent = words.failed.replace('{reason}', error.message);
});
