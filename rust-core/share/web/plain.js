// The picture without WebGL 2: the same sums by the processor.

class ByCanvas {
  constructor(canvas, light) {
    Object.assign(this, { light, context: canvas.getContext('2d', { alpha: false }) });
    this.image = this.context.createImageData(light.width, light.height);
    this.image.data.fill(255);
    // sRGB's curve at places close enough for 8 bits: the difference within one is below a fifth of a step.
    this.curve = Uint8Array.from({ length: 65537 }, (_, i) => Math.round(255 * srgb(i / 65536)));
  }

  draw(view) {
    const { light, image: { data }, curve } = this;
    const all = [view.before, view.mixed].map((factors) => factors.map((factor, g) => factor.map((x) => x * light.lows[g])));
    const count = light.codes.length, table = light.table, candela = 1 / light.data.exposure;
    for (let y = 0, i = 0; y < light.height; y++) {
      for (let x = 0; x < light.width; x++, i++) {
        const factors = all[x + 0.5 < view.split ? 0 : 1];
        let red = 0, green = 0, blue = 0;
        for (let g = 0; g < count; g++) {
          const codes = light.codes[g], factor = factors[g];
          red += factor[0] * table[codes[3 * i]];
          green += factor[1] * table[codes[3 * i + 1]];
          blue += factor[2] * table[codes[3 * i + 2]];
        }
        let luminance = WEIGHTS[0] * red + WEIGHTS[1] * green + WEIGHTS[2] * blue;
        if (view.falseColour) {
          luminance *= candela;
          let step = 0;
          while (step < view.edges.length && luminance >= view.edges[step]) step++;
          data.set(RAMP[step], 4 * i);
          continue;
        }
        luminance *= view.scale;
        const factor = (65536 * view.scale * (1 + view.rise * luminance)) / (1 + luminance);
        data[4 * i] = curve[Math.min(Math.round(red * factor), 65536)];
        data[4 * i + 1] = curve[Math.min(Math.round(green * factor), 65536)];
        data[4 * i + 2] = curve[Math.min(Math.round(blue * factor), 65536)];
      }
    }
    this.context.putImageData(this.image, 0, 0);
  }

  pixels() {
    return new Uint8Array(this.image.data);
  }
}
