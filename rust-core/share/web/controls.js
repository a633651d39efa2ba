// What hands and keys find beside the picture: groups, scenes, view, and the line between before and now.

class Controls {
  constructor(show, words) {
    Object.assign(this, { show, words, kept: [] });
    this.figures = new Figures(show, words);
    const scenes = show.data.scenes.map(({ name, settings }) => ({ name, mix: this.mixOf(settings) }));
    this.scenes = [{ name: words.asDesigned, mix: this.mixOf([]) }, ...scenes];
    this.groups = show.data.groups.map((group, number) => this.group(group, number));
    this.makeScenes();
    this.makeView();
    this.makeSplit();
    document.addEventListener('keydown', (event) => this.key(event));
    this.refresh();
  }

  mixOf(settings) {
    const mix = this.show.data.groups.map(() => ({ level: 1, kelvin: 0 }));
    for (const { group, level, kelvin } of settings) mix[group] = { level, kelvin: kelvin || 0 };
    return mix;
  }

  group(group, number) {
    const item = element('group').content.firstElementChild.cloneNode(true);
    const part = (name) => item.querySelector('.' + name);
    const parts = { level: part('level'), text: part('level-text'), toggle: part('switch'), tints: part('tints') };
    Object.assign(parts, { kelvin: part('kelvin'), kelvinText: part('kelvin-text'), before: 1 });
    part('name').textContent = group.name;
    part('name').htmlFor = parts.level.id = `level-${number}`;
    parts.toggle.setAttribute('aria-label', this.figures.say('switch', group));
    parts.kelvin.setAttribute('aria-label', this.figures.say('temperature', group));
    parts.tints.setAttribute('aria-label', `${this.words.tint}: ${group.name}`);
    parts.kelvin.value = 4000;
    parts.kelvin.style.setProperty('--fill', this.colours());
    const setting = () => this.show.mix[number];
    parts.level.addEventListener('input', () => this.change(number, { level: parts.level.value / 100 }));
    parts.toggle.addEventListener('click', () => {
      const { level } = setting();
      if (level > 0) parts.before = level;
      this.change(number, { level: level > 0 ? 0 : parts.before });
    });
    const tint = () => this.change(number, { kelvin: parts.tints.checked ? Number(parts.kelvin.value) : 0 });
    parts.tints.addEventListener('change', tint);
    parts.kelvin.addEventListener('input', tint);
    element('groups').append(item);
    return parts;
  }

  // The tints' colours along their slider.
  colours() {
    const { colours } = this.show.data.tints;
    const stop = (colour) => `rgb(${colour.map((x) => Math.round(255 * srgb(x / Math.max(...colour)))).join(' ')})`;
    return `linear-gradient(90deg, ${colours.filter((_, i) => i % 20 === 0).map(stop).join(', ')})`;
  }

  change(number, part) {
    const mix = this.show.mix.map((setting, g) => (g === number ? { ...setting, ...part } : setting));
    this.show.choose(mix, false);
    this.refresh();
  }

  makeScenes() {
    this.chips = this.scenes.map(({ name, mix }) => {
      const chip = document.createElement('button');
      chip.type = 'button';
      chip.textContent = name;
      chip.addEventListener('click', () => this.choose(mix));
      element('scenes').append(chip);
      return chip;
    });
  }

  choose(mix) {
    this.show.choose(mix, true);
    this.refresh();
  }

  // Brings everything that shows settings up to date.
  refresh() {
    const { show } = this;
    this.groups.forEach((parts, number) => {
      const { level, kelvin } = show.mix[number];
      parts.level.value = Math.round(100 * level);
      parts.level.style.setProperty('--part', `${(100 * level) / 1.5}%`);
      parts.text.textContent = this.figures.percent.format(level);
      parts.toggle.setAttribute('aria-checked', level > 0);
      parts.tints.checked = kelvin > 0;
      parts.kelvin.hidden = parts.kelvinText.hidden = !kelvin;
      if (kelvin) parts.kelvin.value = kelvin;
      parts.kelvinText.textContent = `${this.figures.whole.format(parts.kelvin.value)} K`;
    });
    const same = (mix) => JSON.stringify(mix) === JSON.stringify(show.mix);
    this.chips.forEach((chip, number) => chip.setAttribute('aria-pressed', same(this.scenes[number].mix)));
    element('stops').value = show.stops;
    element('stops').style.setProperty('--part', `${((show.stops + 6) / 12) * 100}%`);
    element('stops-text').textContent = `${this.figures.stops.format(show.stops)} EV`;
    element('adapts').checked = show.adapts;
    element('show-false').checked = show.falseColour;
    element('show-picture').checked = !show.falseColour;
    element('most-row').hidden = element('legend').hidden = !show.falseColour;
    element('exposure-rows').hidden = show.falseColour;
    const compares = show.split !== null;
    element('compares').checked = compares;
    for (const id of ['before-row', 'split', 'tag-before', 'tag-after']) element(id).hidden = !compares;
    this.figures.refresh();
  }

  makeView() {
    const { show } = this;
    const on = (id, event, change) => element(id).addEventListener(event, () => {
      change(element(id));
      this.refresh();
      show.ask();
    });
    on('stops', 'input', (slider) => (show.stops = Number(slider.value)));
    on('adapts', 'change', (box) => (show.adapts = box.checked));
    on('show-picture', 'change', () => (show.falseColour = false));
    on('show-false', 'change', () => (show.falseColour = true));
    on('compares', 'change', (box) => this.compare(box.checked));
    on('most', 'change', (list) => (show.most = Number(list.value)));
    on('before', 'change', (list) => this.takeBefore(list.value));
    let most = show.most / 1000;
    for (let i = 0; i < 16; i++, most = roundUp(most * 1.5)) {
      const text = `${this.figures.number.format(roundUp(most))} cd/m²`;
      element('most').append(new Option(text, roundUp(most), false, roundUp(most) === show.most));
    }
    this.listBefore(0);
  }

  compare(on) {
    this.show.split = on ? 0.5 : null;
    this.moveSplit();
  }

  // Mixes that may stand before: scenes, those kept, and the present one.
  listBefore(chosen) {
    const names = [...this.scenes, ...this.kept].map(({ name }) => name);
    const options = names.map((name, i) => new Option(name, i, false, i === chosen));
    element('before').replaceChildren(...options, new Option(this.words.keep, 'keep'));
  }

  takeBefore(value) {
    if (value === 'keep') {
      const time = new Date().toLocaleTimeString(document.documentElement.lang, { hour: '2-digit', minute: '2-digit', second: '2-digit' });
      this.kept.push({ name: this.figures.say('kept', { time }), mix: this.show.mix.map((setting) => ({ ...setting })) });
      value = this.scenes.length + this.kept.length - 1;
      this.listBefore(value);
    }
    const { name, mix } = [...this.scenes, ...this.kept][value];
    this.show.beforeMix = mix;
    element('tag-before').textContent = `${this.words.before}: ${name}`;
  }

  makeSplit() {
    const handle = element('split');
    const move = (split) => {
      this.show.split = Math.min(Math.max(split, 0), 1);
      this.moveSplit();
      this.show.ask();
    };
    handle.addEventListener('pointerdown', (event) => handle.setPointerCapture(event.pointerId));
    handle.addEventListener('pointermove', (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const box = element('frame').getBoundingClientRect();
      move((event.clientX - box.left) / box.width);
    });
    handle.addEventListener('keydown', (event) => {
      const step = { ArrowLeft: -0.02, ArrowDown: -0.02, ArrowRight: 0.02, ArrowUp: 0.02, Home: -1, End: 1 }[event.key];
      if (!step) return;
      event.preventDefault();
      move(this.show.split + step);
    });
    this.takeBefore(0);
  }

  moveSplit() {
    const percent = Math.round(100 * (this.show.split ?? 0.5));
    element('split').style.left = `${100 * (this.show.split ?? 0.5)}%`;
    element('split').setAttribute('aria-valuenow', percent);
  }

  key(event) {
    const typing = event.target.matches('input[type=number], select');
    if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
    const { show } = this, letter = event.key.toLowerCase();
    if (letter >= '1' && letter <= '9' && this.scenes[letter - 1]) this.choose(this.scenes[letter - 1].mix);
    else if (letter === 'c') this.compare(show.split === null);
    else if (letter === 'f') show.falseColour = !show.falseColour;
    else if (letter === 'a') show.adapts = !show.adapts;
    else return;
    this.refresh();
    show.ask();
  }
}
