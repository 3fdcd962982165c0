
// ---------------------------------------------------------------------------------------------------------------------
// The viewer: its state, what changes it, and when it is drawn.

const standardViews = [
  { name: 'Front', from: 'the front', azimuth: 0, elevation: 0 }, { name: 'Back', from: 'behind', azimuth: 180, elevation: 0 },
  { name: 'Left', from: 'the left', azimuth: 90, elevation: 0 }, { name: 'Right', from: 'the right', azimuth: 270, elevation: 0 },
  { name: 'Head', from: 'above', azimuth: 180, elevation: 90 }, { name: 'Feet', from: 'below', azimuth: 0, elevation: -90 },
];

class Viewer {
  constructor(organs, volume) {
    this.organs = organs;
    this.volume = volume;
    this.box = joinBoxes(organs.map((organ) => organ.box));
    const light = window.matchMedia('(prefers-color-scheme: light)');
    this.state = {
      azimuth: 0, elevation: 0, centre: centreOf(this.box), scale: 1, point: centreOf(this.box), window: page.volume ? page.volume.window : [1, 0],
      planes: [false, false, false], crosshair: true, outlines: true, cut: { kind: 'off', place: 0, flipped: false, normal: [0, -1, 0] },
      points: [], marked: -1, isLight: light.matches, perspective: false,
    };
    this.read = 0; // parts of the page's data
    this.isRead = false; // all slices
    this.pause = 200; // ms of rest before a slow machine draws all
    light.addEventListener('change', () => { this.state.isLight = light.matches; this.changed(); });
    this.list = new List(this, document.getElementById('list'));
    const tools = document.getElementById('tools');
    if (page.volume) this.sliceTool = new SliceTool(this, tools);
    this.cutTool = new CutTool(this, tools);
    this.cutTool.element.classList.add('needs3d');
    this.measure = new Measure(this, tools);
    new Share(this, tools);
    this.slices = volume ? planes.map((plane) => new SliceView(this, plane, document.getElementById('slices'))) : [];
    this.addViews();
    this.listen();
    new ResizeObserver(() => this.changed()).observe(document.getElementById('stage'));
    window.addEventListener('hashchange', () => { if (decodeState(location.hash, this.state, this.organs)) this.changed(); });
  }

  addViews() {
    const place = document.getElementById('views');
    standardViews.forEach((view, n) => {
      const button = make('button', { type: 'button', textContent: view.name, title: `From ${view.from} (key ${n + 1})`, className: view.elevation !== 0 ? 'needs3d' : '' });
      button.addEventListener('click', () => this.turnTo(view));
      place.append(button);
    });
    const fit = make('button', { type: 'button', textContent: 'Fit', title: 'Fit what is shown (key 0)', className: 'needs3d' });
    fit.addEventListener('click', () => { this.fit(); this.changed(); });
    place.append(fit);
    this.perspective = make('button', { type: 'button', textContent: 'Perspective', title: 'Near things larger (key p)', 'aria-pressed': 'false', className: 'needs3d' });
    this.perspective.addEventListener('click', () => this.togglePerspective());
    place.append(this.perspective);
  }

  togglePerspective() {
    this.state.perspective = !this.state.perspective;
    this.changed();
  }

  /** Turns to a view; at once where the reader wants little motion. */
  turnTo(view) {
    const { state } = this;
    const from = [state.azimuth, state.elevation];
    const turn = ((view.azimuth - from[0] + 180) % 360 + 360) % 360 - 180;
    const time = this.scene && !window.matchMedia('(prefers-reduced-motion: reduce)').matches ? 350 : 0;
    const start = performance.now();
    const step = (now) => {
      const share = time > 0 ? clamp((now - start) / time, 0, 1) : 1;
      const eased = share * share * (3 - 2 * share);
      state.azimuth = share < 1 ? from[0] + eased * turn : view.azimuth;
      state.elevation = from[1] + eased * (view.elevation - from[1]);
      this.changed();
      if (share < 1) requestAnimationFrame(step);
    };
    step(start);
  }

  /** Chooses centre and scale so that all that is shown can be seen from any side. */
  fit() {
    const shown = this.organs.filter((organ) => organ.visible && organ.triangles.length > 0);
    const box = shown.length > 0 ? joinBoxes(shown.map((organ) => organ.box)) : this.box;
    const canvas = document.getElementById('scene');
    const frame = frameOf(this.state.azimuth, this.state.elevation);
    this.state.centre = centreOf(box);
    const views = document.getElementById('views');
    const isNarrow = views.offsetWidth > 0.8 * canvas.clientWidth; // then the buttons lie above the scene, not beside it
    const width = 0.9 * canvas.clientWidth, height = isNarrow ? canvas.clientHeight - 3 * views.offsetHeight : 0.9 * canvas.clientHeight;
    this.state.scale = Math.max(2 * reachOf(box, frame.right) / width, 2 * reachOf(box, frame.up) / Math.max(height, 50), 1e-3);
    if (isNarrow) this.state.centre = along(this.state.centre, frame.up, 0.6 * views.offsetHeight * this.state.scale);
  }

  setPoint(point) { this.state.point = point; this.changed(); }

  setWindow(values) { this.state.window = values; this.changed(); }

  mark(number) {
    this.state.marked = this.state.marked === number ? -1 : number;
    this.changed();
    if (this.state.marked >= 0) this.list.reveal(number);
  }

  /** Names an organ at a place of the scene for a while. */
  tell(text, x, y) {
    const told = document.getElementById('told');
    told.textContent = text;
    told.style.left = x + 'px';
    told.style.top = y + 'px';
    clearTimeout(this.telling);
    this.telling = setTimeout(() => { told.textContent = ''; }, 2500);
  }

  /** A click into the scene: names the organ and moves the crosshair there, or sets a point. */
  pick(x, y) {
    const { state } = this;
    const canvas = document.getElementById('canvas');
    const hit = castRay(this.organs, cameraOf(state, canvas.clientHeight).rayAt(x - canvas.clientWidth / 2, y - canvas.clientHeight / 2), cutOf(state), state.scale);
    if (this.measure.isOn) {
      if (hit) this.measure.add(hit.point);
      return;
    }
    if (!hit) { this.mark(-1); return; }
    state.marked = -1;
    this.mark(hit.organ.number);
    this.tell(hit.organ.name, x, y);
    this.setPoint(hit.point);
  }

  rotate(across, down) {
    this.state.azimuth -= across;
    this.state.elevation = clamp(this.state.elevation + down, -90, 90);
    this.changed();
  }

  pan(x, y) {
    const frame = frameOf(this.state.azimuth, this.state.elevation);
    this.state.centre = along(along(this.state.centre, frame.right, -x * this.state.scale), frame.up, y * this.state.scale);
    this.changed();
  }

  /** Enlarges about a place of the canvas. */
  zoom(factor, x, y) {
    const { state } = this;
    const canvas = document.getElementById('canvas');
    const dx = x - canvas.clientWidth / 2, dy = y - canvas.clientHeight / 2;
    const next = clamp(state.scale / factor, 1e-4, 100);
    const frame = frameOf(state.azimuth, state.elevation);
    const moved = state.scale - next;
    state.centre = along(along(state.centre, frame.right, dx * moved), frame.up, -dy * moved);
    state.scale = next;
    this.changed();
  }

  listen() {
    const canvas = document.getElementById('canvas');
    const pointers = new Map();
    let moved = 0, mode = 'rotate';
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      canvas.focus({ preventScroll: true });
      pointers.set(event.pointerId, [event.clientX, event.clientY]);
      mode = event.button > 0 || event.shiftKey ? 'pan' : 'rotate';
      moved = pointers.size > 1 ? 100 : 0;
      canvas.classList.add('busy');
    });
    canvas.addEventListener('pointermove', (event) => {
      const last = pointers.get(event.pointerId);
      if (!last) return;
      const next = [event.clientX, event.clientY];
      const [dx, dy] = [next[0] - last[0], next[1] - last[1]];
      moved += Math.abs(dx) + Math.abs(dy);
      pointers.set(event.pointerId, next);
      if (moved < 4) return;
      if (pointers.size === 2) {
        const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
        const apart = (place) => Math.hypot(place[0] - other[0], place[1] - other[1]);
        const box = canvas.getBoundingClientRect();
        this.zoom(apart(next) / Math.max(apart(last), 1), (next[0] + other[0]) / 2 - box.left, (next[1] + other[1]) / 2 - box.top);
        this.pan(dx / 2, dy / 2);
      } else if (mode === 'pan') this.pan(dx, dy);
      else this.rotate(dx * 0.5, dy * 0.5);
    });
    for (const end of ['pointerup', 'pointercancel']) {
      canvas.addEventListener(end, (event) => {
        const isClick = end === 'pointerup' && moved < 4 && pointers.size === 1 && event.button === 0;
        pointers.delete(event.pointerId);
        if (pointers.size === 0) canvas.classList.remove('busy');
        if (isClick) {
          const box = canvas.getBoundingClientRect();
          this.pick(event.clientX - box.left, event.clientY - box.top);
        }
      });
    }
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      const box = canvas.getBoundingClientRect();
      this.zoom(Math.exp(-clamp(event.deltaY, -200, 200) / 500), event.clientX - box.left, event.clientY - box.top);
    }, { passive: false });
    canvas.addEventListener('keydown', (event) => this.press(event));
    document.addEventListener('keydown', (event) => { if (event.key === 'Escape') this.escape(); });
  }

  /** Ends setting points; else nothing is marked any more. */
  escape() {
    document.getElementById('told').textContent = '';
    if (this.measure.isOn) this.measure.turn(false);
    else if (this.state.marked >= 0) this.mark(-1);
  }

  press(event) {
    const degrees = event.shiftKey ? 1 : 10;
    const turns = { ArrowLeft: [-degrees, 0], ArrowRight: [degrees, 0], ArrowUp: [0, -degrees], ArrowDown: [0, degrees] };
    const canvas = document.getElementById('canvas');
    if (turns[event.key]) this.rotate(...turns[event.key]);
    else if (event.key === '+' || event.key === '=' || event.key === '-') this.zoom(event.key === '-' ? 1 / 1.15 : 1.15, canvas.clientWidth / 2, canvas.clientHeight / 2);
    else if (event.key >= '1' && event.key <= '6') this.turnTo(standardViews[Number(event.key) - 1]);
    else if (event.key === '0') { this.fit(); this.changed(); }
    else if (event.key === 'p') this.togglePerspective();
    else return;
    event.preventDefault();
  }

  /** Asks for drawing, once for each frame of the screen. */
  changed() {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      this.draw();
    });
  }

  draw() {
    this.list.update();
    this.cutTool.update();
    this.measure.update();
    if (this.sliceTool) this.sliceTool.update();
    this.perspective.setAttribute('aria-pressed', String(this.state.perspective));
    for (const slice of this.slices) slice.draw();
    if (this.scene) this.drawScene();
    if (this.turntable) this.turntable.draw();
    this.drawOverlay();
  }

  /** Draws coarsely at first and, on slow machines, while the view moves; all when it rests. */
  drawScene() {
    const { state, scene } = this;
    const isFine = this.isSlow === false || this.isResting;
    this.isResting = false;
    const start = performance.now();
    scene.draw(state, isFine);
    scene.canvas.dataset.triangles = isFine ? 'all' : 'coarse';
    if (this.isSlow !== false) {
      scene.wait();
      const time = performance.now() - start;
      if (isFine) this.pause = clamp(time, 200, 1000);
      else if (this.isSlow === undefined) this.isSlow = time > 40;
      clearTimeout(this.rest);
      if (!isFine) this.rest = setTimeout(() => { this.isResting = true; this.changed(); }, this.isSlow ? this.pause : 0);
    }
    const frame = frameOf(state.azimuth, state.elevation);
    const element = document.getElementById('scene');
    writeLetters(element, frame);
    writeScale(element, state.scale);
    drawFigure(document.getElementById('figure'), frame);
    scene.canvas.setAttribute('aria-label', describeView(state.azimuth, state.elevation));
  }

  /** Crosshair and distances over the scene. */
  drawOverlay() {
    const overlay = document.getElementById('overlay');
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    overlay.width = Math.round(overlay.clientWidth * ratio);
    overlay.height = Math.round(overlay.clientHeight * ratio);
    if (!this.scene) return;
    const { state } = this;
    const context = overlay.getContext('2d');
    const camera = cameraOf(state, overlay.clientHeight);
    const positionOf = (point) => {
      const [x, y] = camera.positionOf(point);
      return [overlay.width / 2 + x * ratio, overlay.height / 2 + y * ratio];
    };
    this.measure.drawOn(context, positionOf, ratio, () => true);
    if (state.crosshair && this.volume) {
      const [x, y] = positionOf(state.point);
      context.strokeStyle = state.isLight ? '#0b62c4' : '#78beff';
      context.lineWidth = 1.5 * ratio;
      context.beginPath();
      for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
        context.moveTo(x + dx * 4 * ratio, y + dy * 4 * ratio);
        context.lineTo(x + dx * 13 * ratio, y + dy * 13 * ratio);
      }
      context.stroke();
    }
  }

  /** The surfaces are read. */
  takeOrgans() {
    this.read++;
    this.box = joinBoxes(this.organs.filter((organ) => organ.triangles.length > 0).map((organ) => organ.box));
    this.state.point = centreOf(this.box);
    this.fit();
    decodeState(location.hash, this.state, this.organs);
  }

  /** Some slices of the scan are read. */
  takeSlices(first, count) {
    this.read++;
    this.isRead = first + count >= this.volume.size[2];
    if (this.scene) this.scene.loadSlices(first, count);
    this.changed();
  }
}

/** Window, crosshair and outlines; and what the crosshair is on. */
class SliceTool {
  constructor(viewer, place) {
    this.viewer = viewer;
    const { volume } = page;
    const presets = make('select', { 'aria-label': 'Window of the greys' });
    presets.append(make('option', { value: '', textContent: 'own window' }));
    for (const [name, width, centre] of volume.windows) presets.append(make('option', { value: width + '/' + centre, textContent: `${name} (${width}/${centre})` }));
    presets.append(make('option', { value: volume.window.join('/'), textContent: 'first window' }));
    presets.addEventListener('change', () => { if (presets.value) viewer.setWindow(presets.value.split('/').map(Number)); });
    const check = (label, get, set, kind) => {
      const box = make('input', { type: 'checkbox', checked: get() });
      box.addEventListener('change', () => { set(box.checked); viewer.changed(); });
      this.checks = [...(this.checks || []), [box, get]];
      return make('label', kind ? { className: kind } : {}, box, label);
    };
    const stateOf = () => viewer.state;
    this.presets = presets;
    this.window = make('output', { className: 'value' });
    this.value = make('output', { className: 'value readout' });
    place.append(make('details', { open: true }, make('summary', { textContent: 'Slices' }),
      this.value,
      make('div', { className: 'row' }, presets, this.window),
      make('div', { className: 'row' }, check('outlines', () => stateOf()?.outlines ?? true, (on) => { stateOf().outlines = on; }),
           check('crosshair', () => stateOf()?.crosshair ?? true, (on) => { stateOf().crosshair = on; })),
      make('div', { className: 'row needs3d' }, make('span', { className: 'note', textContent: 'in 3D:' }),
           ...planes.map((plane) => check(plane.name, () => stateOf()?.planes[plane.axis] ?? false, (on) => { stateOf().planes[plane.axis] = on; }))),
      make('p', { className: 'note', textContent: 'Radiological: the patient\u2019s right is on the left. Wheel: next slice. Right button or Shift and drag: window.' +
           (volume.resampled ? ' The scan\u2019s slices lie otherwise; these are resampled along the patient\u2019s axes.' : '') })));
  }

  update() {
    const { state, volume } = this.viewer;
    const [width, centre] = state.window;
    const key = width + '/' + centre;
    this.presets.value = [...this.presets.options].some((option) => option.value === key) ? key : '';
    this.window.textContent = `${Math.round(width)} / ${Math.round(centre)} ${page.volume.unit}`;
    for (const [box, get] of this.checks) box.checked = get();
    if (!volume) return;
    const value = valueAt(volume, state.point);
    const last = volume.levels[volume.levels.length - 1];
    const shown = !this.viewer.isRead ? '\u2026' : Number.isNaN(value) ? 'outside of the scan' : (value >= last ? '\u2265 ' : '') + formatNumber(value, Math.abs(last) < 20 ? 2 : 0) + ' ' + volume.unit;
    this.value.replaceChildren(make('span', { textContent: 'LPS ' + state.point.map((place) => formatNumber(place, 1)).join(', ') + ' mm: ' }), make('b', { textContent: shown }));
  }
}

/** Shows the list and pictures at once, then the scene, then the slices. */
async function start() {
  document.getElementById('app').hidden = false;
  document.body.classList.add('runs');
  if (!page.volume) document.getElementById('stage').classList.add('alone');
  const viewer = new Viewer(makeOrgans(), makeVolume());
  const layers = new Layers(viewer);
  await new Promise((done) => requestAnimationFrame(() => setTimeout(done, 0)));
  await readOrgans(viewer.organs);
  viewer.takeOrgans();
  layers.start3d();
  requestAnimationFrame(() => setTimeout(() => performance.mark('usable'), 0));
  if (viewer.volume) await readVolume(viewer.volume, (first, count) => viewer.takeSlices(first, count));
  requestAnimationFrame(() => requestAnimationFrame(() => { document.body.dataset.ready = 'yes'; }));
}

start().catch((error) => tellLayer('Still pictures: the interactive part did not start (' + error.message + ').'));
