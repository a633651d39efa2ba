// Figures around the picture: luminance under the cursor, legend, energy, notes, and the table that is printed.

const element = (id) => document.getElementById(id);

class Figures {
  constructor(show, words) {
    Object.assign(this, { show, words, place: null });
    const language = document.documentElement.lang;
    this.number = new Intl.NumberFormat(language, { maximumSignificantDigits: 3 });
    this.percent = new Intl.NumberFormat(language, { style: 'percent', maximumFractionDigits: 1 });
    this.whole = new Intl.NumberFormat(language, { maximumFractionDigits: 0 });
    this.stops = new Intl.NumberFormat(language, { minimumFractionDigits: 1, maximumFractionDigits: 1, signDisplay: 'exceptZero' });
    this.makeReading();
    this.makeEnergy();
    this.makeNotes();
    show.listeners.push(() => this.read());
  }

  // After settings changed.
  refresh() {
    if (this.show.falseColour) this.legend();
    this.energy();
    this.paper();
    this.read();
  }

  // A sentence with its holes filled.
  say(key, holes) {
    return this.words[key].replace(/\{(\w+)\}/g, (_, name) => holes[name]);
  }

  makeReading() {
    const canvas = element('canvas'), { width, height } = this.show.light;
    const within = (x, most) => Math.min(Math.max(Math.floor(x), 0), most - 1);
    const point = (event) => {
      const box = canvas.getBoundingClientRect();
      const [x, y] = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
      this.place = [within(x * width, width), within(y * height, height)];
      this.read();
    };
    canvas.addEventListener('pointermove', point);
    canvas.addEventListener('pointerdown', point);
    canvas.addEventListener('keydown', (event) => {
      const [x, y] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key] || [0, 0];
      if (!x && !y) return;
      event.preventDefault();
      const size = event.shiftKey ? 1 : Math.max(1, Math.round(width / 100));
      const [column, row] = this.place || [width >> 1, height >> 1];
      this.place = [within(column + x * size, width), within(row + y * size, height)];
      element('readout').setAttribute('aria-live', 'polite');
      this.read();
    });
  }

  // The luminance at the place pointed at.
  read() {
    const { width, height } = this.show.light, mark = element('mark'), out = element('readout');
    mark.hidden = !this.place;
    if (!this.place) {
      out.textContent = this.words.point;
      return;
    }
    const [x, y] = this.place, value = document.createElement('b');
    mark.style.left = `${((x + 0.5) / width) * 100}%`;
    mark.style.top = `${((y + 0.5) / height) * 100}%`;
    value.textContent = `${this.number.format(this.show.luminanceAt(x, y))} cd/m²`;
    out.replaceChildren(value, ` · ${x}, ${y}`);
  }

  legend() {
    const edges = edgesBelow(this.show.most);
    const swatches = RAMP.map((colour, step) => {
      const swatch = document.createElement('span');
      swatch.style.setProperty('--swatch', `rgb(${colour.join(' ')})`);
      if (step) swatch.append(Object.assign(document.createElement('b'), { textContent: this.number.format(edges[step - 1]) }));
      return swatch;
    });
    element('legend').replaceChildren(...swatches, Object.assign(document.createElement('em'), { textContent: 'cd/m²' }));
  }

  makeEnergy() {
    const { groups, hours } = this.show.data;
    element('energy').hidden = groups.every(({ watts }) => watts === null);
    element('hours').value = hours;
    element('hours').addEventListener('input', () => this.energy());
  }

  energy() {
    const hours = Math.min(Math.max(Number(element('hours').value) || 0, 0), 8784), { groups } = this.show.data;
    const row = (tag, name, watts) => {
      const line = document.createElement('tr');
      const texts = [name, this.number.format(watts), this.whole.format((watts * hours) / 1000)];
      line.append(...texts.map((text) => Object.assign(document.createElement(tag), { textContent: text })));
      return line;
    };
    const known = groups.map(({ name, watts }, g) => ({ name, full: watts, now: (watts || 0) * this.show.mix[g].level }));
    const rows = known.filter(({ full }) => full !== null);
    const sum = (key) => rows.reduce((sum, group) => sum + group[key], 0);
    element('energy-rows').replaceChildren(...rows.map(({ name, now }) => row('td', name, now)));
    const share = sum('full') > 0 ? this.say('saved', { percent: this.percent.format(sum('now') / sum('full')) }) : '';
    const beside = document.createElement('tr');
    beside.append(Object.assign(document.createElement('td'), { colSpan: 3, textContent: share }));
    element('energy-total').replaceChildren(row('th', this.words.total, sum('now')), beside);
  }

  // The table that is printed.
  paper() {
    const cells = [...element('paper-rows').rows].map((row) => [...row.cells]);
    cells.forEach(([, level, tint, power], g) => {
      const setting = this.show.mix[g], { watts } = this.show.data.groups[g];
      level.textContent = this.percent.format(setting.level);
      tint.textContent = setting.kelvin ? `${this.whole.format(setting.kelvin)} K` : '–';
      power.textContent = watts === null ? '–' : `${this.number.format(watts * setting.level)} W`;
    });
  }

  makeNotes() {
    const { size: [width, height], original: [columns, rows], perStop, groups } = this.show.data;
    const notes = [this.words.keys, this.words.noteRead, this.say('noteAccuracy', { percent: this.percent.format(2 ** (0.5 / perStop) - 1) })];
    if (width !== columns || height !== rows) notes.push(this.say('noteSize', { width, height, columns, rows }));
    notes.push(this.words.noteTint);
    if (groups.some(({ watts }) => watts !== null)) notes.push(this.words.noteEnergy);
    notes.push(this.words.noteScreen);
    element('notes').append(...notes.map((note) => Object.assign(document.createElement('li'), { textContent: note })));
  }
}
