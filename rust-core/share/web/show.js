// What the picture shows: a mix of groups, seen by an eye, beside another one.

// Seconds in which the eye goes 63 % of the way, and those of a change of scene.
const EYE = 1.2, FADE = 0.7;
const calm = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

class Show {
  constructor(data, light, renderer) {
    Object.assign(this, { data, light, renderer, stops: data.stops, adapts: false, falseColour: false, split: null, listeners: [] });
    this.mix = data.groups.map(() => ({ level: 1, kelvin: 0 }));
    this.beforeMix = this.mix.map((setting) => ({ ...setting }));
    this.adapted = Math.log(data.average);
    this.rise = riseTo(data.white);
    this.most = light.roundMost(light.factors(this.mix));
    this.mixed = light.factors(this.mix);
    this.start = performance.now() / 1000;
    this.last = this.start;
    this.asked = false;
  }

  // Settings of all groups; fades there where that is asked for.
  choose(mix, fades) {
    this.from = fades && !calm() ? this.mixed : null;
    this.start = performance.now() / 1000;
    this.mix = mix.map((setting) => ({ ...setting }));
    this.ask();
  }

  // Draws with the next frame of the screen.
  ask() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.step(performance.now() / 1000);
    });
  }

  step(now) {
    const goal = this.light.factors(this.mix);
    const part = this.from ? Math.min((now - this.start) / FADE, 1) : 1;
    this.mixed = part < 1 ? goal.map((factor, g) => factor.map((x, k) => this.from[g][k] + part * (x - this.from[g][k]))) : goal;
    if (part >= 1) this.from = null;
    const wanted = this.wanted(), far = wanted - this.adapted;
    const share = calm() ? 1 : 1 - Math.exp(-Math.min(now - this.last, 0.1) / EYE);
    this.last = now;
    this.adapted = Math.abs(far) < 0.002 ? wanted : this.adapted + share * far;
    this.draw();
    if (this.from || this.adapted !== wanted) this.ask();
  }

  // The logarithm of what the eye adapts to.
  wanted() {
    return Math.log(this.adapts ? this.light.average(this.light.factors(this.mix)) : this.data.average);
  }

  // All at once, without fading: for tests and for paper.
  settle() {
    this.from = null;
    this.mixed = this.light.factors(this.mix);
    this.adapted = this.wanted();
    this.draw();
  }

  draw() {
    this.renderer.draw({
      mixed: this.mixed,
      before: this.light.factors(this.beforeMix),
      split: this.split === null ? -1 : this.split * this.light.width,
      scale: (2 ** this.stops * KEY) / Math.exp(this.adapted),
      rise: this.rise,
      falseColour: this.falseColour,
      edges: edgesBelow(this.most),
    });
    for (const listener of this.listeners) listener();
  }

  // cd/m² of a pixel, of the side of the line that it is on.
  luminanceAt(x, y) {
    const isBefore = this.split !== null && x + 0.5 < this.split * this.light.width;
    return this.light.luminance(this.light.at(x, y, this.light.factors(isBefore ? this.beforeMix : this.mix)));
  }
}
