
// ---------------------------------------------------------------------------------------------------------------------
// A plane that cuts the scene open.

const cutKinds = ['off', 'axial', 'coronal', 'sagittal', 'free'];

/** The plane of a state: what lies on the side of its normal is removed; null without a cut. */
function cutOf(state) {
  const { kind, place, flipped, normal } = state.cut;
  if (kind === 'off') return null;
  const ways = { axial: [0, 0, 1], coronal: [0, -1, 0], sagittal: [1, 0, 0], free: normal };
  const sign = flipped ? -1 : 1;
  const way = ways[kind].map((x) => sign * x);
  return { normal: way, offset: sign * place };
}

class CutTool {
  constructor(viewer, place) {
    this.viewer = viewer;
    const select = make('select', { 'aria-label': 'Plane of the cut' });
    for (const kind of cutKinds) select.append(make('option', { value: kind, textContent: kind === 'off' ? 'no cut' : kind === 'free' ? 'as seen now' : kind }));
    const flip = make('button', { type: 'button', textContent: 'Other side' });
    const slider = make('input', { type: 'range', 'aria-label': 'Place of the cut', step: 0.5 });
    const output = make('output', { className: 'value' });
    Object.assign(this, { select, flip, slider, output });
    select.addEventListener('change', () => this.choose(select.value));
    flip.addEventListener('click', () => { viewer.state.cut.flipped = !viewer.state.cut.flipped; viewer.changed(); });
    slider.addEventListener('input', () => { viewer.state.cut.place = Number(slider.value); viewer.changed(); });
    this.second = make('div', { className: 'row' }, slider, output);
    place.append(make('details', {}, make('summary', { textContent: 'Cut' }), make('div', { className: 'row' }, select, flip), this.second,
                      make('p', { className: 'note', textContent: 'Cut faces show the scan\u2019s own greys.' })));
    this.element = place.lastElementChild;
  }

  choose(kind) {
    const { state } = this.viewer;
    const look = frameOf(state.azimuth, state.elevation).look;
    state.cut = { kind, flipped: false, normal: look.map((x) => -x), place: 0 };
    if (kind !== 'off') [state.cut.place] = this.range();
    this.viewer.changed();
  }

  /** The middle of the scene along the plane's normal, and half its length there. */
  range() {
    const { state, box } = this.viewer;
    const way = cutOf({ ...state, cut: { ...state.cut, flipped: false } }).normal;
    return [dot(centreOf(box), way), reachOf(box, way)];
  }

  update() {
    const { cut } = this.viewer.state;
    if (cut.kind !== 'off' && cut.kind !== this.select.value) this.element.open = true;
    this.select.value = cut.kind;
    this.second.hidden = this.flip.hidden = cut.kind === 'off';
    if (cut.kind === 'off') return;
    const [middle, reach] = this.range();
    this.slider.min = middle - reach;
    this.slider.max = middle + reach;
    this.slider.value = cut.place;
    this.output.textContent = formatNumber(cut.kind === 'coronal' ? -cut.place : cut.place, 1) + ' mm';
  }
}
