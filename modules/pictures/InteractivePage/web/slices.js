
// ---------------------------------------------------------------------------------------------------------------------
// Slices through the scan on 2D canvases, with outlines of the surfaces and a crosshair that all of them share.

const planes = [
  // Radiological: axial slices are seen from the feet, coronal ones from the front, sagittal ones from the left.
  { name: 'axial', axis: 2, letter: 'z', across: 0, down: 1, downSign: 1, frame: { right: [1, 0, 0], up: [0, -1, 0], look: [0, 0, 1] } },
  { name: 'coronal', axis: 1, letter: 'y', across: 0, down: 2, downSign: -1, frame: { right: [1, 0, 0], up: [0, 0, 1], look: [0, 1, 0] } },
  { name: 'sagittal', axis: 0, letter: 'x', across: 1, down: 2, downSign: -1, frame: { right: [0, 1, 0], up: [0, 0, 1], look: [-1, 0, 0] } },
];

/** From black to white, as DICOM's LINEAR_EXACT. */
function greyOf(value, width, centre) {
  const share = (value - centre) / width + 0.5;
  return share >= 1 ? 255 : share > 0 ? Math.floor(255 * share + 0.5) : 0;
}

const formatNumber = (value, decimals) => value.toFixed(decimals).replace('-', '\u2212');

/** One slice view. \a viewer has state, organs and volume, and is told of changes. */
class SliceView {
  constructor(viewer, plane, place) {
    this.viewer = viewer;
    this.plane = plane;
    this.element = document.createElement('div');
    this.element.className = 'panel slice';
    this.element.innerHTML = '<div class="picture"><canvas tabindex="0" role="img"></canvas><span class="letter top"></span>' +
      '<span class="letter bottom"></span><span class="letter left"></span><span class="letter right"></span>' +
      '<div class="scale" aria-hidden="true"><span></span><i></i></div></div>' +
      '<div class="bar"><b></b><input type="range"><output></output></div>';
    place.append(this.element);
    this.canvas = this.element.querySelector('canvas');
    this.slider = this.element.querySelector('input');
    this.slider.setAttribute('aria-label', plane.name + ' slice');
    this.element.querySelector('b').textContent = plane.name;
    this.samples = document.createElement('canvas');
    this.outlines = new Map();
    const volume = viewer.volume, axis = plane.axis;
    this.slider.min = volume.origin[axis];
    this.slider.max = volume.highest[axis];
    this.slider.step = volume.spacing[axis];
    this.slider.addEventListener('input', () => this.moveTo(axis, Number(this.slider.value)));
    writeLetters(this.element, plane.frame);
    this.listen();
  }

  listen() {
    const { canvas } = this;
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.step(event.deltaY > 0 ? 1 : -1);
    }, { passive: false });
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    let mode = null, last = null;
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      canvas.focus({ preventScroll: true });
      last = [event.clientX, event.clientY];
      mode = event.button === 2 || event.shiftKey ? 'window' : 'point';
      if (mode === 'point') this.pick(event, true);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!mode) return;
      if (mode === 'point') this.pick(event, false);
      else {
        const [width, centre] = this.viewer.state.window;
        const share = Math.max(width, 1) / 250;
        this.viewer.setWindow([Math.max(width + (event.clientX - last[0]) * share, 1), centre + (event.clientY - last[1]) * share]);
        last = [event.clientX, event.clientY];
      }
    });
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, () => { mode = null; });
    canvas.addEventListener('keydown', (event) => {
      const keys = { ArrowUp: [this.plane.down, -this.plane.downSign], ArrowDown: [this.plane.down, this.plane.downSign],
                     ArrowLeft: [this.plane.across, -1], ArrowRight: [this.plane.across, 1] };
      if (event.key === 'PageUp' || event.key === 'PageDown') this.step(event.key === 'PageUp' ? 1 : -1);
      else if (keys[event.key]) {
        const [axis, sign] = keys[event.key];
        this.moveTo(axis, this.viewer.state.point[axis] + sign * this.viewer.volume.spacing[axis]);
      } else return;
      event.preventDefault();
    });
  }

  step(count) {
    this.moveTo(this.plane.axis, this.viewer.state.point[this.plane.axis] + count * this.viewer.volume.spacing[this.plane.axis]);
  }

  moveTo(axis, place) {
    const { volume, state } = this.viewer;
    const point = [...state.point];
    point[axis] = clamp(place, volume.origin[axis], volume.highest[axis]);
    this.viewer.setPoint(point);
  }

  /** The place of the volume in the canvas: device pixels for each mm, and those of its first corner. */
  layout() {
    const { volume } = this.viewer, { across, down } = this.plane;
    const width = volume.size[across] * volume.spacing[across], height = volume.size[down] * volume.spacing[down];
    const zoom = Math.min(this.canvas.width / width, this.canvas.height / height) * 0.98;
    return { zoom, width, height, left: (this.canvas.width - zoom * width) / 2, top: (this.canvas.height - zoom * height) / 2 };
  }

  /** Pixels of the canvas from a point in LPS mm. */
  positionOf(point) {
    const { volume } = this.viewer, { across, down, downSign } = this.plane;
    const { zoom, left, top } = this.layout();
    const x = point[across] - volume.origin[across] + volume.spacing[across] / 2;
    const y = downSign > 0 ? point[down] - volume.origin[down] + volume.spacing[down] / 2
                           : volume.highest[down] + volume.spacing[down] / 2 - point[down];
    return [left + zoom * x, top + zoom * y];
  }

  /** The point of the slice at a pixel of the canvas. */
  pointAt(x, y) {
    const { volume, state } = this.viewer, { across, down, downSign } = this.plane;
    const { zoom, left, top } = this.layout();
    const point = [...state.point];
    point[across] = volume.origin[across] - volume.spacing[across] / 2 + (x - left) / zoom;
    point[down] = downSign > 0 ? volume.origin[down] - volume.spacing[down] / 2 + (y - top) / zoom
                               : volume.highest[down] + volume.spacing[down] / 2 - (y - top) / zoom;
    return point.map((value, axis) => clamp(value, volume.origin[axis], volume.highest[axis]));
  }

  pick(event, isFirst) {
    const box = this.canvas.getBoundingClientRect();
    const ratio = this.canvas.width / box.width;
    const point = this.pointAt((event.clientX - box.left) * ratio, (event.clientY - box.top) * ratio);
    if (this.viewer.measure.isOn) {
      if (isFirst) this.viewer.measure.add(point);
      return;
    }
    this.viewer.setPoint(point);
  }

  /** The greys of the slice through the crosshair, linear between the scan's slices. */
  readSamples() {
    const { volume, state } = this.viewer, { axis, across, down, downSign } = this.plane;
    const key = [state.point[axis], ...state.window, this.viewer.read].join();
    if (this.key === key) return;
    this.key = key;
    const columns = volume.size[across], rows = volume.size[down];
    const strides = [1, volume.size[0], volume.size[0] * volume.size[1]];
    const at = clamp((state.point[axis] - volume.origin[axis]) / volume.spacing[axis], 0, volume.size[axis] - 1);
    const low = Math.floor(at), share = at - low, step = share > 0 ? strides[axis] : 0;
    const image = new ImageData(columns, rows);
    const pixels = new Uint32Array(image.data.buffer);
    const [width, centre] = state.window;
    const { numbers, levels } = volume;
    for (let row = 0; row < rows; row++) {
      let n = strides[axis] * low + strides[down] * (downSign > 0 ? row : rows - 1 - row);
      for (let column = 0; column < columns; column++, n += strides[across]) {
        const value = share > 0 ? levels[numbers[n]] * (1 - share) + levels[numbers[n + step]] * share : levels[numbers[n]];
        const grey = greyOf(value, width, centre);
        pixels[row * columns + column] = 0xff000000 | grey << 16 | grey << 8 | grey;
      }
    }
    this.samples.width = columns;
    this.samples.height = rows;
    this.samples.getContext('2d').putImageData(image, 0, 0);
  }

  /** The outline of a surface in this slice, computed once for each place. */
  outlineOf(organ) {
    const { axis, across, down } = this.plane;
    const place = this.viewer.state.point[axis];
    const known = this.outlines.get(organ);
    if (known && known.place === place && known.triangles === organ.triangles) return known.lines;
    const lines = outlineOf(organ, axis, place, across, down);
    this.outlines.set(organ, { place, triangles: organ.triangles, lines });
    return lines;
  }

  drawOutlines(context, ratio) {
    const { state, organs } = this.viewer, { across, down } = this.plane;
    if (!state.outlines) return;
    context.lineWidth = 1.4 * ratio;
    for (const organ of organs) {
      if (!organ.visible) continue;
      const lines = this.outlineOf(organ);
      if (lines.length === 0) continue;
      const point = [...state.point];
      context.beginPath();
      for (let n = 0; n + 3 < lines.length; n += 4) {
        point[across] = lines[n]; point[down] = lines[n + 1];
        context.moveTo(...this.positionOf(point));
        point[across] = lines[n + 2]; point[down] = lines[n + 3];
        context.lineTo(...this.positionOf(point));
      }
      context.strokeStyle = organ.number === state.marked ? '#fff' : `rgb(${organ.colour})`;
      context.stroke();
    }
  }

  drawCross(context, ratio) {
    const { state } = this.viewer;
    if (!state.crosshair) return;
    const [x, y] = this.positionOf(state.point).map((place) => Math.round(place) + 0.5);
    const gap = 9 * ratio, rim = 22 * ratio; // the letters' room
    context.strokeStyle = 'rgba(121, 189, 255, 0.7)';
    context.lineWidth = ratio;
    context.beginPath();
    for (const [fromX, fromY, toX, toY] of [[Math.min(rim, x - gap), y, x - gap, y], [x + gap, y, Math.max(this.canvas.width - rim, x + gap), y],
                                            [x, Math.min(rim, y - gap), x, y - gap], [x, y + gap, x, Math.max(this.canvas.height - rim, y + gap)]]) {
      context.moveTo(fromX, fromY);
      context.lineTo(toX, toY);
    }
    context.stroke();
  }

  draw() {
    const { viewer, canvas, plane } = this;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio)), height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    const { point, window: greys, outlines, crosshair, marked, points } = viewer.state;
    const all = JSON.stringify([point, greys, outlines, crosshair, marked, points, width, height, viewer.read,
                                viewer.organs.map((organ) => organ.visible)]);
    if (this.all === all) return; // as when the scene is turned
    this.all = all;
    if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
    const context = canvas.getContext('2d');
    context.fillStyle = '#000';
    context.fillRect(0, 0, width, height);
    this.readSamples();
    const { zoom, left, top, width: across, height: down } = this.layout();
    context.imageSmoothingEnabled = true;
    context.imageSmoothingQuality = 'high';
    context.drawImage(this.samples, left, top, zoom * across, zoom * down);
    this.drawOutlines(context, ratio);
    viewer.measure.drawOn(context, (point) => this.positionOf(point), ratio,
                          (point) => Math.abs(point[plane.axis] - viewer.state.point[plane.axis]) <= 0.5 * viewer.volume.spacing[plane.axis]);
    this.drawCross(context, ratio);
    writeScale(this.element, ratio / zoom);
    const place = viewer.state.point[plane.axis];
    this.slider.value = place;
    this.slider.setAttribute('aria-valuetext', plane.letter + ' ' + formatNumber(place, 1) + ' mm');
    this.element.querySelector('output').textContent = plane.letter + ' = ' + formatNumber(place, 1) + ' mm';
    canvas.setAttribute('aria-label', `${plane.name} slice at ${plane.letter} ${formatNumber(place, 1)} mm`);
  }
}
