
// ---------------------------------------------------------------------------------------------------------------------
// Points and distances; and the address that keeps a view.

class Measure {
  constructor(viewer, place) {
    this.viewer = viewer;
    this.isOn = false;
    this.button = make('button', { type: 'button', textContent: 'Set points', 'aria-pressed': 'false' });
    this.button.addEventListener('click', () => this.turn(!this.isOn));
    const here = make('button', { type: 'button', textContent: 'Point at the crosshair' });
    here.addEventListener('click', () => this.add([...viewer.state.point]));
    const clear = make('button', { type: 'button', textContent: 'Remove all' });
    clear.addEventListener('click', () => { viewer.state.points = []; viewer.changed(); });
    this.list = make('ol', { className: 'points' });
    this.result = make('div');
    place.append(make('details', {}, make('summary', { textContent: 'Measure' }), make('div', { className: 'row' }, this.button, here, clear), this.list, this.result,
                      make('p', { className: 'note', textContent: 'Click on a surface or a slice. Each two points are a distance.' }),
                      make('p', { className: 'note warning', textContent: 'Not for diagnosis.' })));
    this.element = place.lastElementChild;
  }

  turn(isOn) {
    this.isOn = isOn;
    this.button.setAttribute('aria-pressed', String(isOn));
    this.button.textContent = isOn ? 'Stop setting points' : 'Set points';
    document.getElementById('canvas').classList.toggle('measuring', isOn);
  }

  add(point) {
    const { points } = this.viewer.state;
    points.push({ name: 'point ' + (points.length + 1), at: point });
    this.viewer.changed();
  }

  pairs() {
    const { points } = this.viewer.state;
    const pairs = [];
    for (let n = 0; n + 1 < points.length; n += 2) pairs.push([points[n], points[n + 1], length(minus(points[n].at, points[n + 1].at))]);
    return pairs;
  }

  /** Draws points and distances. \a isNear: whether a point is shown in full. */
  drawOn(context, positionOf, ratio, isNear) {
    context.save();
    context.font = `600 ${13 * ratio}px system-ui, sans-serif`;
    context.lineWidth = 1.6 * ratio;
    const label = (text, x, y) => {
      context.lineJoin = 'round';
      context.strokeStyle = '#000';
      context.lineWidth = 4 * ratio;
      context.strokeText(text, x, y);
      context.fillStyle = '#ffd479';
      context.fillText(text, x, y);
    };
    for (const [a, b, distance] of this.pairs()) {
      if (!isNear(a.at) && !isNear(b.at)) continue;
      const [x1, y1] = positionOf(a.at), [x2, y2] = positionOf(b.at);
      context.strokeStyle = '#ffb454';
      context.lineWidth = 1.6 * ratio;
      context.beginPath();
      context.moveTo(x1, y1);
      context.lineTo(x2, y2);
      context.stroke();
      label(distance.toFixed(1) + ' mm', (x1 + x2) / 2 + 8 * ratio, (y1 + y2) / 2 - 6 * ratio);
    }
    for (const point of this.viewer.state.points) {
      if (!isNear(point.at)) continue;
      const [x, y] = positionOf(point.at);
      context.fillStyle = '#ffb454';
      context.strokeStyle = '#000';
      context.lineWidth = ratio;
      context.beginPath();
      context.arc(x, y, 4 * ratio, 0, 7);
      context.fill();
      context.stroke();
    }
    context.restore();
  }

  update() {
    const { state } = this.viewer;
    const shown = this.list.querySelectorAll('input');
    if (shown.length !== state.points.length) {
      this.element.open = this.element.open || state.points.length > shown.length;
      this.list.replaceChildren(...state.points.map((point, n) => {
        const name = make('input', { type: 'text', value: point.name, 'aria-label': 'Name of point ' + (n + 1), dir: 'auto' });
        name.addEventListener('change', () => { point.name = name.value; });
        const remove = make('button', { type: 'button', textContent: '\u00d7', 'aria-label': 'Remove ' + point.name });
        remove.addEventListener('click', () => { state.points.splice(n, 1); this.list.replaceChildren(); this.viewer.changed(); });
        const show = make('button', { type: 'button', textContent: 'show' });
        show.addEventListener('click', () => this.viewer.setPoint([...point.at]));
        return make('li', {}, name, show, remove);
      }));
    }
    this.result.replaceChildren(...this.pairs().map(([a, b, distance]) =>
      make('p', { className: 'value distance' }, `${a.name} to ${b.name}: `, make('b', { textContent: distance.toFixed(1) + ' mm' }), ' (not for diagnosis)')));
  }
}

// The state in the address is JSON in base64url, so that mail programs leave it whole.

function encodeState(state, organs) {
  const round = (value) => Math.round(value * 1000) / 1000;
  const kept = {
    a: round(state.azimuth), e: round(state.elevation), c: state.centre.map(round), s: round(state.scale), p: state.point.map(round),
    w: state.window.map(round), l: state.planes, cut: { ...state.cut, place: round(state.cut.place), normal: state.cut.normal.map(round) },
    o: organs.map((organ) => (organ.visible ? round(organ.shown) : -round(organ.shown))),
    m: state.points.map((point) => [point.name, ...point.at.map(round)]), v: state.perspective ? 1 : 0,
  };
  const bytes = new TextEncoder().encode(JSON.stringify(kept));
  return '#view=' + btoa(String.fromCharCode(...bytes)).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
}

/** Takes the state of an address, with or without what stands before #view=. Returns whether it was one. */
function decodeState(text, state, organs) {
  const code = /#?view=([A-Za-z0-9_-]+)/.exec(text);
  if (!code) return false;
  try {
    const binary = atob(code[1].replace(/-/g, '+').replace(/_/g, '/'));
    const kept = JSON.parse(new TextDecoder().decode(Uint8Array.from(binary, (letter) => letter.charCodeAt(0))));
    const numbers = (list, count) => Array.isArray(list) && list.length === count && list.every(Number.isFinite);
    if (![kept.a, kept.e, kept.s].every(Number.isFinite) || !numbers(kept.c, 3) || !numbers(kept.p, 3) || !numbers(kept.w, 2) || !(kept.s > 0)) return false;
    Object.assign(state, { azimuth: kept.a, elevation: clamp(kept.e, -90, 90), centre: kept.c, scale: kept.s, point: kept.p, window: [Math.max(kept.w[0], 1e-3), kept.w[1]] });
    state.perspective = Boolean(kept.v);
    if (Array.isArray(kept.l)) state.planes = [0, 1, 2].map((axis) => Boolean(kept.l[axis]));
    if (kept.cut && cutKinds.includes(kept.cut.kind) && Number.isFinite(kept.cut.place) && numbers(kept.cut.normal, 3)) {
      state.cut = { kind: kept.cut.kind, place: kept.cut.place, flipped: Boolean(kept.cut.flipped), normal: kept.cut.normal };
    }
    if (numbers(kept.o, organs.length)) {
      organs.forEach((organ, n) => { organ.visible = kept.o[n] > 0; organ.shown = clamp(Math.abs(kept.o[n]), 0.05, 1); });
    }
    if (Array.isArray(kept.m)) {
      state.points = kept.m.filter((point) => Array.isArray(point) && numbers(point.slice(1), 3)).map(([name, ...at]) => ({ name: String(name), at }));
    }
    return true;
  } catch {
    return false;
  }
}

class Share {
  constructor(viewer, place) {
    const copy = make('button', { type: 'button', textContent: 'Copy this view' });
    const field = make('input', { type: 'text', 'aria-label': 'A copied view', placeholder: 'Paste a view: #view=\u2026' });
    const told = make('p', { className: 'note', role: 'status' });
    copy.addEventListener('click', async () => {
      const text = encodeState(viewer.state, viewer.organs);
      field.value = text;
      try {
        await navigator.clipboard.writeText(text);
        told.textContent = 'Copied. It holds the view and the names of points, and no path.';
      } catch {
        field.select();
        told.textContent = 'Copy the text of the field.';
      }
    });
    field.addEventListener('change', () => {
      if (!field.value) return;
      const isView = decodeState(field.value, viewer.state, viewer.organs);
      told.textContent = isView ? 'This is the view.' : 'This is no view of such a page.';
      if (isView) viewer.changed();
    });
    place.append(make('details', {}, make('summary', { textContent: 'Share a view' }), make('div', { className: 'row' }, copy), make('div', { className: 'row' }, field), told));
  }
}
