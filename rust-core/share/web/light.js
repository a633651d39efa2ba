// What the light of a mix is: factors of groups, luminance, the eye's adaptation, the tone curve. The same formulas as the engine's.

const WEIGHTS = [0.2126, 0.7152, 0.0722];
const KEY = 0.18;
// Pixels of a run that counts once for the log-average, and runs that are enough for it.
const RUN = 16, ENOUGH = 1 << 16;

class Light {
  constructor(data, codes) {
    this.data = data;
    this.codes = codes;
    [this.width, this.height] = data.size;
    let most = 1;
    for (const group of codes) for (let i = 0; i < group.length; i++) if (group[i] > most) most = group[i];
    // Light of codes where code 1 is 1.
    this.table = Float64Array.from({ length: most + 1 }, (_, code) => (code ? 2 ** ((code - 1) / data.perStop) : 0));
    this.lows = data.groups.map((group) => 2 ** group.low);
    this.runs = codes.map((group, number) => this.runsOf(group, this.lows[number]));
  }

  // Mean red, green and blue of runs of pixels.
  runsOf(codes, low) {
    const pixels = codes.length / 3, whole = Math.floor(pixels / RUN);
    const step = Math.floor(whole / (2 * ENOUGH)) * 2 + 1, means = [];
    const mean = (from, to) => {
      const sum = [0, 0, 0];
      for (let i = 3 * from; i < 3 * to; i += 3) for (let k = 0; k < 3; k++) sum[k] += this.table[codes[i + k]];
      for (let k = 0; k < 3; k++) means.push((low * sum[k]) / (to - from));
    };
    for (let run = 0; run < whole; run += step) mean(run * RUN, (run + 1) * RUN);
    if (pixels % RUN) mean(whole * RUN, pixels);
    return Float32Array.from(means);
  }

  // Factors of red, green and blue for each setting of a level and a colour temperature (0: none).
  factors(mix) {
    const { first, step, colours } = this.data.tints;
    return mix.map(({ level, kelvin }) => {
      const place = Math.min(Math.max(Math.round((kelvin - first) / step), 0), colours.length - 1);
      return (kelvin ? colours[place] : [1, 1, 1]).map((x) => x * level);
    });
  }

  // What an eye adapts to: the geometric mean of the luminance of runs, black ones left out.
  average(factors) {
    let sum = 0, count = 0;
    const weights = factors.map((factor) => factor.map((x, k) => x * WEIGHTS[k]));
    for (let i = 0; i < this.runs[0].length; i += 3) {
      let y = 0;
      for (let g = 0; g < weights.length; g++) {
        const run = this.runs[g], [r, gr, b] = weights[g];
        y += r * run[i] + gr * run[i + 1] + b * run[i + 2];
      }
      if (y > 1e-9) {
        sum += Math.log(y);
        count++;
      }
    }
    return count ? Math.exp(sum / count) : KEY;
  }

  // Red, green and blue of a pixel.
  at(x, y, factors) {
    const i = 3 * (y * this.width + x), sum = [0, 0, 0];
    this.codes.forEach((codes, g) => {
      for (let k = 0; k < 3; k++) sum[k] += factors[g][k] * this.lows[g] * this.table[codes[i + k]];
    });
    return sum;
  }

  // cd/m² of a colour.
  luminance(colour) {
    return (colour[0] * WEIGHTS[0] + colour[1] * WEIGHTS[1] + colour[2] * WEIGHTS[2]) / this.data.exposure;
  }

  // A round luminance (1, 2 or 5 times a power of ten) that 99.5 % of the runs do not exceed.
  roundMost(factors) {
    const values = [];
    for (let i = 0; i < this.runs[0].length; i += 3) {
      const sum = [0, 1, 2].map((k) => factors.reduce((sum, factor, g) => sum + factor[k] * this.runs[g][i + k], 0));
      values.push(this.luminance(sum));
    }
    values.sort((a, b) => a - b);
    return roundUp(values[Math.floor(values.length * 0.995)] || 1);
  }
}

// 1, 2 or 5 times a power of ten, at least the value.
function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  const factor = [1, 2, 5, 10].find((factor) => factor * power >= value * 0.999);
  return Number((factor * power).toPrecision(1));
}

// How the photographic operator rises towards white: y (1 + rise y) / (1 + y) is 1 where y is white.
const riseTo = (white) => ((1 + white) / white - 1) / white;

function srgb(x) {
  const within = Math.min(Math.max(x, 0), 1);
  return within < 0.0031308 ? 12.92 * within : 1.055 * within ** (1 / 2.4) - 0.055;
}

// Viridis (Smith and van der Walt, public domain) at even places, as gonio falsecolor has it.
const RAMP = [
  [68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142],
  [31, 158, 137], [53, 183, 121], [109, 205, 89], [180, 222, 44], [253, 231, 37],
];

// Lower edges of the false colours' steps but the first's, ascending 1, 2, 5 to the greatest but one.
function edgesBelow(most) {
  const edges = [];
  for (let edge = most; edges.length < RAMP.length - 1; ) {
    edge = Number((edge / (String(edge.toExponential(0)).startsWith('5') ? 2.5 : 2)).toPrecision(1));
    edges.unshift(edge);
  }
  return edges;
}
