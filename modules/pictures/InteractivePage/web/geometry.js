
// ---------------------------------------------------------------------------------------------------------------------
// Geometry in LPS mm: x to the patient's left, y to the back, z to the head.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const along = (from, way, share) => [from[0] + share * way[0], from[1] + share * way[1], from[2] + share * way[2]];
const minus = (a, b) => along(a, b, -1);
const length = (a) => Math.sqrt(dot(a, a));
const unit = (a) => a.map((x) => x / length(a));
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

function boxOf(points) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let n = 0; n < points.length; n++) {
    const axis = n % 3;
    if (points[n] < low[axis]) low[axis] = points[n];
    if (points[n] > high[axis]) high[axis] = points[n];
  }
  return { low, high };
}

function joinBoxes(boxes) {
  const low = [0, 1, 2].map((axis) => Math.min(...boxes.map((box) => box.low[axis])));
  const high = [0, 1, 2].map((axis) => Math.max(...boxes.map((box) => box.high[axis])));
  return { low, high };
}

const centreOf = (box) => [0, 1, 2].map((axis) => (box.low[axis] + box.high[axis]) / 2);

/** Half of the length of a box along a direction. */
const reachOf = (box, way) => [0, 1, 2].reduce((sum, axis) => sum + Math.abs(way[axis]) * (box.high[axis] - box.low[axis]) / 2, 0);

/** The axes of a view. Azimuth 0 is from the front, 90 from the patient's left; elevation lifts the viewer to the head. */
function frameOf(azimuth, elevation) {
  const a = azimuth * Math.PI / 180, e = elevation * Math.PI / 180;
  const ca = Math.cos(a), sa = Math.sin(a), ce = Math.cos(e), se = Math.sin(e);
  return { right: [ca, sa, 0], up: [-sa * se, ca * se, ce], look: [-sa * ce, ca * ce, -se] };
}

/** The letters of a direction: those of its larger components, the largest first. */
function lettersOf(way) {
  const letters = [['L', 'R'], ['P', 'A'], ['H', 'F']];
  return [0, 1, 2].filter((axis) => Math.abs(way[axis]) >= 0.25)
    .sort((a, b) => Math.abs(way[b]) - Math.abs(way[a]))
    .map((axis) => letters[axis][way[axis] > 0 ? 0 : 1]).join('');
}

/** Writes the letters at the edges of an element. */
function writeLetters(element, frame) {
  const ways = { right: frame.right, left: frame.right.map((x) => -x), top: frame.up, bottom: frame.up.map((x) => -x) };
  for (const [side, way] of Object.entries(ways)) {
    element.querySelector('.letter.' + side).textContent = page.oriented ? lettersOf(way) : '';
  }
}

/** Draws a scale bar of a round length; \a scale is in mm for each CSS pixel. */
function writeScale(element, scale) {
  const longest = 110 * scale;
  const power = 10 ** Math.floor(Math.log10(longest));
  const size = [5, 2, 1].map((n) => n * power).find((n) => n <= longest);
  element.querySelector('.scale i').style.width = size / scale + 'px';
  element.querySelector('.scale span').textContent = size >= 10 ? size / 10 + ' cm' : size + ' mm';
}

/** How a state is seen: positionOf() gives CSS pixels right of and below the middle of the picture, rayAt() the line of
 * sight there, as the axes of a view along it and its places right and up of the origin. */
function cameraOf(state, height) {
  const frame = frameOf(state.azimuth, state.elevation);
  const distance = state.perspective ? 2.3 * height * state.scale : Infinity; // of the eye from the centre: 24.5 degrees of height
  const positionOf = (point) => {
    const way = minus(point, state.centre);
    const scale = state.scale * (state.perspective ? Math.max(1 + dot(way, frame.look) / distance, 1e-3) : 1);
    return [dot(way, frame.right) / scale, -dot(way, frame.up) / scale];
  };
  const rayAt = (x, y) => {
    const across = along(along(state.centre, frame.right, x * state.scale), frame.up, -y * state.scale);
    if (!state.perspective) return { ...frame, x: dot(across, frame.right), y: dot(across, frame.up), nearest: -Infinity };
    const eye = along(state.centre, frame.look, -distance);
    const look = unit(minus(across, eye)), right = unit(cross(look, frame.up)), up = cross(right, look);
    return { right, up, look, x: dot(eye, right), y: dot(eye, up), nearest: dot(eye, look) };
  };
  return { frame, distance, positionOf, rayAt };
}

/** How far a surface is drawn behind where it lies, in mm along its normal: of overlapping segments with a wall in the same
 * place, that of the earlier layer is seen. \a scale is the mm of a CSS pixel. */
const behindOf = (organ, scale) => (organ.layer ? Math.min(organ.layer, 5) * Math.max(0.6 * scale, organ.gap) : 0);

/** Where a line of sight first meets a visible surface, as surfaces are drawn at a scale. Points on the side of the plane that
 * is cut away do not count; translucent surfaces only if there is no other. */
function castRay(organs, ray, cut, scale) {
  let best = null;
  for (const organ of organs) {
    if (!organ.visible) continue;
    const middle = centreOf(organ.box);
    if (Math.abs(dot(middle, ray.right) - ray.x) > reachOf(organ.box, ray.right) ||
        Math.abs(dot(middle, ray.up) - ray.y) > reachOf(organ.box, ray.up)) continue;
    const depth = depthOf(organ, ray, cut);
    if (depth === null) continue;
    const solid = organ.shown >= 0.5;
    const drawn = depth + behindOf(organ, scale);
    if (!best || (solid && !best.solid) || (solid === best.solid && drawn < best.drawn)) best = { organ, depth, drawn, solid };
  }
  return best ? { organ: best.organ, point: pointOn(ray, best.depth) } : null;
}

const pointOn = (ray, depth) => [0, 1, 2].map((axis) => ray.x * ray.right[axis] + ray.y * ray.up[axis] + depth * ray.look[axis]);

/** The least depth at which a line of sight meets a surface; null where it does not. */
function depthOf(organ, ray, cut) {
  const { points, triangles } = organ;
  const { right: r, up: u, look: l, x: right, y: up } = ray;
  let least = null;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ax = points[a] * r[0] + points[a + 1] * r[1] + points[a + 2] * r[2] - right;
    const bx = points[b] * r[0] + points[b + 1] * r[1] + points[b + 2] * r[2] - right;
    const cx = points[c] * r[0] + points[c + 1] * r[1] + points[c + 2] * r[2] - right;
    if ((ax < 0 && bx < 0 && cx < 0) || (ax > 0 && bx > 0 && cx > 0)) continue;
    const ay = points[a] * u[0] + points[a + 1] * u[1] + points[a + 2] * u[2] - up;
    const by = points[b] * u[0] + points[b + 1] * u[1] + points[b + 2] * u[2] - up;
    const cy = points[c] * u[0] + points[c + 1] * u[1] + points[c + 2] * u[2] - up;
    const wa = bx * cy - cx * by, wb = cx * ay - ax * cy, wc = ax * by - bx * ay;
    if ((wa < 0 || wb < 0 || wc < 0) && (wa > 0 || wb > 0 || wc > 0)) continue;
    const sum = wa + wb + wc;
    if (sum === 0) continue;
    const depthAt = (n) => points[n] * l[0] + points[n + 1] * l[1] + points[n + 2] * l[2];
    const depth = (wa * depthAt(a) + wb * depthAt(b) + wc * depthAt(c)) / sum;
    if (depth < ray.nearest || (least !== null && depth >= least)) continue;
    if (cut && dot(pointOn(ray, depth), cut.normal) > cut.offset) continue;
    least = depth;
  }
  return least;
}

/** The lines in which a plane at right angles to an axis cuts a surface: x, y of begin and end, again and again. */
function outlineOf(organ, axis, place, across, down) {
  const lines = [];
  if (place < organ.box.low[axis] || place > organ.box.high[axis]) return lines;
  const { points, triangles } = organ;
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const heights = [points[corners[0] + axis] - place, points[corners[1] + axis] - place, points[corners[2] + axis] - place];
    if ((heights[0] >= 0) === (heights[1] >= 0) && (heights[1] >= 0) === (heights[2] >= 0)) continue;
    for (let n = 0; n < 3; n++) {
      const m = (n + 1) % 3;
      if ((heights[n] >= 0) === (heights[m] >= 0)) continue;
      const share = heights[n] / (heights[n] - heights[m]);
      const a = corners[n], b = corners[m];
      lines.push(points[a + across] + share * (points[b + across] - points[a + across]),
                 points[a + down] + share * (points[b + down] - points[a + down]));
    }
  }
  return lines;
}

// A small figure as the view sees it: ellipsoids in shares of its height, x to its left, y to its back, z up.
const figureParts = (() => {
  const body = '#8c99ab', limb = '#a8b5c4', dark = '#5c616b', face = '#f7e0cc', nose = '#cc9e85';
  const groups = [];
  for (const side of [-1, 1]) {
    groups.push({ recess: 0.07, parts: [[[side * 0.06, 0, -0.19], [0.055, 0.062, 0.19], limb], [[side * 0.072, 0.006, -0.365], [0.038, 0.045, 0.13], limb],
                                        [[side * 0.078, -0.042, -0.478], [0.036, 0.08, 0.024], dark]] });
  }
  groups.push({ recess: 0, parts: [[[0, 0, 0.315], [0.036, 0.04, 0.055], body], [[0, 0, 0.215], [0.128, 0.075, 0.105], body],
                                   [[0, 0, 0.1], [0.1, 0.068, 0.15], body], [[0, 0, 0], [0.108, 0.075, 0.08], body]] });
  for (const side of [-1, 1]) {
    groups.push({ recess: 0, parts: [[[side * 0.165, 0, 0.11], [0.037, 0.04, 0.175], limb], [[side * 0.2, -0.005, -0.075], [0.026, 0.032, 0.046], face]] });
  }
  groups.push({ recess: 0, parts: [[[0, 0.008, 0.413], [0.06, 0.07, 0.084], dark], [[0, -0.022, 0.402], [0.055, 0.053, 0.075], face],
                                   [[0, -0.078, 0.395], [0.012, 0.02, 0.018], nose]] });
  return groups;
})();

function drawFigure(canvas, frame) {
  const context = canvas.getContext('2d');
  const side = canvas.width;
  context.clearRect(0, 0, side, side);
  if (!page.oriented) return;
  const depth = (group) => Math.round(1000 * (dot([group.parts[0][0][0], 0, group.parts[0][0][2]], frame.look) + group.recess));
  const draw = ([centre, radii], excess, colour) => {
    let xx = 0, xy = 0, yy = 0;
    for (let axis = 0; axis < 3; axis++) {
      const x = radii[axis] * frame.right[axis], y = -radii[axis] * frame.up[axis];
      xx += x * x; xy += x * y; yy += y * y;
    }
    const spread = Math.hypot((xx - yy) / 2, xy), mean = (xx + yy) / 2;
    context.beginPath();
    context.ellipse(side / 2 + side * dot(centre, frame.right), side / 2 - side * dot(centre, frame.up),
                    side * Math.sqrt(mean + spread) + excess, side * Math.sqrt(Math.max(mean - spread, 0)) + excess,
                    Math.atan2(2 * xy, xx - yy) / 2, 0, 7);
    context.fillStyle = colour;
    context.fill();
  };
  for (const group of [...figureParts].sort((a, b) => depth(b) - depth(a))) {
    const parts = [...group.parts].sort((a, b) => dot(b[0], frame.look) - dot(a[0], frame.look));
    for (const part of parts) draw(part, 0.008 * side, '#383d47');
    for (const part of parts) draw(part, 0, part[2]);
  }
}
