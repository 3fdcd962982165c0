
// ---------------------------------------------------------------------------------------------------------------------
// The list of structures: colour, eye, name, volume, opacity.

/** An element with properties and children. */
function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in element) element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

function swatchOf(organ) {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg');
  svg.setAttribute('class', 'swatch');
  svg.setAttribute('viewBox', '0 0 10 10');
  svg.setAttribute('aria-hidden', 'true');
  const rect = document.createElementNS(space, 'rect');
  for (const [name, value] of Object.entries({ width: 10, height: 10, rx: 2, fill: `rgb(${organ.colour})` })) rect.setAttribute(name, value);
  svg.append(rect);
  return svg;
}

/** "0.4 ml", "863 ml", "16.8 l". */
function describeVolume(volume) {
  if (volume === undefined) return '';
  if (volume < 0.05) return '< 0.1 ml';
  return volume < 99.95 ? volume.toFixed(1) + ' ml' : volume < 999.5 ? volume.toFixed(0) + ' ml' : (volume / 1000).toFixed(volume < 9995 ? 2 : 1) + ' l';
}

class List {
  constructor(viewer, place) {
    this.viewer = viewer;
    this.rows = viewer.organs.map((organ) => this.makeRow(organ));
    const search = make('input', { type: 'search', placeholder: 'Search', 'aria-label': 'Search structures' });
    search.addEventListener('input', () => this.filter(search.value));
    const all = make('button', { type: 'button', textContent: 'All', title: 'Show everything again' });
    all.addEventListener('click', () => this.showAll());
    place.append(make('div', { className: 'head' }, search, all));
    const groups = new Map();
    viewer.organs.forEach((organ) => {
      const group = organ.group || '';
      groups.set(group, [...(groups.get(group) || []), organ]);
    });
    this.groups = [];
    for (const [name, organs] of [...groups].sort(([a], [b]) => (a === 'other') - (b === 'other'))) {
      const rows = organs.map((organ) => this.rows[organ.number].element);
      if (!name) { place.append(...rows); continue; }
      const box = make('input', { type: 'checkbox', className: 'eye', checked: true, 'aria-label': 'Show the group ' + name });
      box.addEventListener('change', () => {
        for (const organ of organs) organ.visible = box.checked;
        this.viewer.changed();
      });
      const fold = make('button', { type: 'button', className: 'fold', 'aria-expanded': 'true', textContent: `${name} (${organs.length})` });
      const details = make('div', { className: 'group' }, make('div', { className: 'title' }, box, fold), ...rows);
      fold.addEventListener('click', () => this.fold(details, details.classList.contains('folded')));
      this.groups.push({ box, organs, details });
      place.append(details);
    }
  }

  makeRow(organ) {
    const eye = make('input', { type: 'checkbox', className: 'eye', checked: organ.visible, 'aria-label': 'Show ' + organ.name });
    eye.addEventListener('change', () => { organ.visible = eye.checked; this.viewer.changed(); });
    const name = make('button', { type: 'button', className: 'name', title: organ.name, dir: 'auto', textContent: organ.name });
    name.addEventListener('click', () => this.viewer.mark(organ.number));
    const opacity = make('input', { type: 'range', className: 'opacity', min: 0.05, max: 1, step: 0.05, value: organ.shown, 'aria-label': 'Opacity of ' + organ.name });
    opacity.addEventListener('input', () => { organ.shown = Number(opacity.value); this.viewer.changed(); });
    const only = make('button', { type: 'button', className: 'only', textContent: 'only', title: 'Only this', 'aria-label': 'Show only ' + organ.name });
    only.addEventListener('click', () => {
      for (const other of this.viewer.organs) other.visible = other === organ;
      this.viewer.mark(organ.number);
    });
    const volume = make('span', { className: 'volume', textContent: describeVolume(organ.volume) });
    const element = make('div', { className: 'organ' }, eye, swatchOf(organ), name, opacity, volume, only);
    return { element, eye, opacity };
  }

  fold(group, isOpen) {
    group.classList.toggle('folded', !isOpen);
    group.querySelector('.fold').setAttribute('aria-expanded', String(isOpen));
  }

  filter(text) {
    const words = text.toLowerCase().split(/\s+/);
    for (const organ of this.viewer.organs) {
      this.rows[organ.number].element.hidden = !words.every((word) => organ.name.toLowerCase().includes(word));
    }
    for (const { organs, details } of this.groups) details.hidden = organs.every((organ) => this.rows[organ.number].element.hidden);
  }

  showAll() {
    for (const organ of this.viewer.organs) { organ.visible = true; organ.shown = organ.opacity; }
    this.viewer.mark(-1);
  }

  update() {
    const { organs, state } = this.viewer;
    for (const organ of organs) {
      const { element, eye, opacity } = this.rows[organ.number];
      eye.checked = organ.visible;
      opacity.value = organ.shown;
      element.classList.toggle('off', !organ.visible);
      element.classList.toggle('marked', organ.number === state.marked);
    }
    for (const { box, organs: members } of this.groups) {
      const count = members.filter((organ) => organ.visible).length;
      box.checked = count === members.length;
      box.indeterminate = count > 0 && count < members.length;
    }
  }

  reveal(number) {
    const { element } = this.rows[number];
    const group = element.closest('.group');
    if (group) this.fold(group, true);
    const list = document.getElementById('list');
    const row = element.getBoundingClientRect(), frame = list.getBoundingClientRect();
    if (list.scrollHeight > list.clientHeight && (row.top < frame.top + 50 || row.bottom > frame.bottom)) list.scrollTop += row.top - frame.top - 80;
  }
}
