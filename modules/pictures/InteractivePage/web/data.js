
// ---------------------------------------------------------------------------------------------------------------------
// The data of the page: surfaces coded by meshoptimizer, the scan's values as numbers of levels.

const page = JSON.parse(document.getElementById('data').textContent);

/** The bytes of a data block. */
function bytesOf(id) {
  const text = document.getElementById(id).textContent;
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let n = 0; n < binary.length; n++) bytes[n] = binary.charCodeAt(n);
  return bytes;
}

/** The bytes of a data block that is a zlib stream. */
async function inflate(id) {
  const stream = new Blob([bytesOf(id)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Positions and triangles of all surfaces together. */
async function readMesh() {
  const mesh = page.mesh;
  const [codedPoints, codedTriangles] = await Promise.all([inflate('points'), inflate('triangles')]);
  const numbers = new Uint8Array(mesh.points * 8);
  MeshoptDecoder.decodeVertexBuffer(numbers, mesh.points, 8, codedPoints);
  const triangles = new Uint8Array(mesh.triangles * 12);
  MeshoptDecoder.decodeIndexBuffer(triangles, mesh.triangles * 3, 4, codedTriangles);
  return { numbers: new Uint16Array(numbers.buffer), triangles: new Uint32Array(triangles.buffer) };
}

/** Unit normals at the points: means of the triangles around, by area. */
function normalsOf(points, triangles) {
  const normals = new Float32Array(points.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = points[b] - points[a], uy = points[b + 1] - points[a + 1], uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a], vy = points[c + 1] - points[a + 1], vz = points[c + 2] - points[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    for (const corner of [a, b, c]) {
      normals[corner] += x; normals[corner + 1] += y; normals[corner + 2] += z;
    }
  }
  for (let n = 0; n < normals.length; n += 3) {
    const length = Math.hypot(normals[n], normals[n + 1], normals[n + 2]) || 1;
    normals[n] /= length; normals[n + 1] /= length; normals[n + 2] /= length;
  }
  return normals;
}

/** The surfaces, each with its own points (LPS mm) and triangles; walls that two surfaces share are in both. */
async function readOrgans() {
  const { numbers, triangles } = await readMesh();
  const { origin, quantum, sheets } = page.mesh;
  const starts = [];
  let start = 0;
  for (const sheet of sheets) { starts.push(start); start += 3 * sheet[2]; }
  const places = new Int32Array(page.mesh.points).fill(-1); // of the points in the organ
  return page.surfaces.map((surface, number) => {
    const corners = [];
    const points = [];
    const used = [];
    const add = (point) => {
      if (places[point] < 0) {
        places[point] = used.length;
        used.push(point);
        for (let axis = 0; axis < 3; axis++) points.push(origin[axis] + quantum * numbers[4 * point + axis]);
      }
      corners.push(places[point]);
    };
    sheets.forEach(([front, back, count], n) => {
      const isFront = front === number + 1;
      if (!isFront && back !== number + 1) return;
      for (let t = starts[n]; t < starts[n] + 3 * count; t += 3) {
        add(triangles[t]);
        add(triangles[isFront ? t + 1 : t + 2]);
        add(triangles[isFront ? t + 2 : t + 1]);
      }
    });
    for (const point of used) places[point] = -1;
    const positions = Float32Array.from(points);
    const indices = Uint32Array.from(corners);
    return { ...surface, number, points: positions, triangles: indices, normals: normalsOf(positions, indices), box: boxOf(positions),
             visible: true, shown: surface.opacity };
  });
}

/** The scan's values; null if the page has none. */
async function readVolume() {
  const volume = page.volume;
  if (!volume) return null;
  const [columns, rows, slices] = volume.size;
  const slice = columns * rows;
  const numbers = new Uint8Array(slice * slices);
  for (let block = 0; block < volume.blocks; block++) {
    const differences = await inflate('slices-' + block);
    const first = block * volume.slicesOfBlock * slice;
    for (let n = 0; n < differences.length; n++) {
      const place = n % slice;
      const hasLeft = place % columns > 0, hasUpper = place >= columns;
      const at = first + n;
      const left = hasLeft ? numbers[at - 1] : 0, upper = hasUpper ? numbers[at - columns] : 0;
      const upperLeft = hasLeft && hasUpper ? numbers[at - columns - 1] : 0;
      const low = left < upper ? left : upper, high = left < upper ? upper : left;
      const guess = left + upper - upperLeft;
      numbers[at] = differences[n] + (guess < low ? low : guess > high ? high : guess);
    }
  }
  const levels = Float32Array.from([NaN, ...volume.levels]); // by number; 0 is outside of the scan
  const highest = volume.origin.map((from, axis) => from + (volume.size[axis] - 1) * volume.spacing[axis]);
  return { ...volume, numbers, levels, highest };
}

/** The scan's value at a point, linear between samples; NaN outside. */
function valueAt(volume, point) {
  const at = [0, 1, 2].map((axis) => (point[axis] - volume.origin[axis]) / volume.spacing[axis]);
  if (at.some((place, axis) => place < -0.5 || place > volume.size[axis] - 0.5)) return NaN;
  let sum = 0, weights = 0;
  const low = at.map((place, axis) => Math.min(Math.max(Math.floor(place), 0), volume.size[axis] - 1));
  for (let corner = 0; corner < 8; corner++) {
    let weight = 1, index = 0, stride = 1;
    for (let axis = 0; axis < 3; axis++) {
      const share = Math.min(Math.max(at[axis] - low[axis], 0), 1);
      const upper = corner >> axis & 1;
      weight *= upper ? share : 1 - share;
      index += stride * Math.min(low[axis] + upper, volume.size[axis] - 1);
      stride *= volume.size[axis];
    }
    const value = volume.levels[volume.numbers[index]];
    if (weight > 0 && !Number.isNaN(value)) { sum += weight * value; weights += weight; }
  }
  return weights > 0 ? sum / weights : NaN;
}
