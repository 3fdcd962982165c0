
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

const trianglesOfFastScenes = 150000; // any machine turns them

/** Lets the browser draw and take input, where the work since the last time took longer than a frame of the screen. */
const turns = {
  begin: performance.now(),
  async rest() {
    if (performance.now() - this.begin < 25) return;
    await new Promise((done) => setTimeout(done, 0));
    this.begin = performance.now();
  },
};

/** The surfaces as the list shows them, before their points are read. */
function makeOrgans() {
  const { origin, extent } = page.mesh;
  const box = { low: origin, high: origin.map((low, axis) => low + extent[axis]) };
  const none = { points: new Float32Array(0), normals: new Float32Array(0), triangles: new Uint32Array(0) };
  return page.surfaces.map((surface, number) => ({ ...surface, ...none, number, box, visible: !surface.hidden, shown: surface.opacity }));
}

/** Positions and triangles of all surfaces together. */
async function readMesh() {
  const mesh = page.mesh;
  const codedPoints = await inflate('points');
  const numbers = new Uint8Array(mesh.points * 8);
  MeshoptDecoder.decodeVertexBuffer(numbers, mesh.points, 8, codedPoints);
  await turns.rest();
  const codedTriangles = await inflate('triangles');
  const triangles = new Uint8Array(mesh.triangles * 12);
  MeshoptDecoder.decodeIndexBuffer(triangles, mesh.triangles * 3, 4, codedTriangles);
  await turns.rest();
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
    normals[a] += x; normals[a + 1] += y; normals[a + 2] += z;
    normals[b] += x; normals[b + 1] += y; normals[b + 2] += z;
    normals[c] += x; normals[c + 1] += y; normals[c + 2] += z;
  }
  for (let n = 0; n < normals.length; n += 3) {
    const length = Math.sqrt(normals[n] ** 2 + normals[n + 1] ** 2 + normals[n + 2] ** 2) || 1;
    normals[n] /= length; normals[n + 1] /= length; normals[n + 2] /= length;
  }
  return normals;
}

/** The triangles of a surface whose corners lie in different cells of a grid: one point stands for all of its cell. */
function coarsen(points, triangles, { low, high }, cell) {
  const size = [0, 1, 2].map((axis) => Math.floor((high[axis] - low[axis]) / cell) + 1);
  const firsts = new Int32Array(size[0] * size[1] * size[2]).fill(-1);
  const points3 = points.length / 3;
  const stands = new Uint32Array(points3);
  for (let n = 0; n < points3; n++) {
    const [i, j, k] = [0, 1, 2].map((axis) => Math.floor((points[3 * n + axis] - low[axis]) / cell));
    const at = i + size[0] * (j + size[1] * k);
    if (firsts[at] < 0) firsts[at] = n;
    stands[n] = firsts[at];
  }
  const coarse = new Uint32Array(triangles.length);
  let count = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = stands[triangles[t]], b = stands[triangles[t + 1]], c = stands[triangles[t + 2]];
    if (a === b || b === c || c === a) continue;
    coarse[count++] = a; coarse[count++] = b; coarse[count++] = c;
  }
  return coarse.slice(0, count);
}

/** Three bytes for each number of a point: 0 is grey, for no value, 1 to 255 are the colours of the scale. */
function coloursOf(numbers) {
  const bytes = Uint8Array.from(page.colours.map.match(/../g), (text) => parseInt(text, 16));
  const colours = new Uint8Array(3 * numbers.length);
  numbers.forEach((number, n) => colours.set(number > 0 ? bytes.subarray(3 * number - 3, 3 * number) : [128, 128, 128], 3 * n));
  return colours;
}

/** Gives each surface its own points (LPS mm) and triangles; walls that two surfaces share are in both. */
async function readOrgans(organs) {
  const { numbers, triangles } = await readMesh();
  const { origin, quantum, sheets } = page.mesh;
  const starts = [];
  let start = 0;
  for (const sheet of sheets) { starts.push(start); start += 3 * sheet[2]; }
  const places = new Int32Array(page.mesh.points).fill(-1); // of the points in the organ
  const used = new Uint32Array(page.mesh.points);
  for (const organ of organs) {
    const own = sheets.map((sheet, n) => n).filter((n) => sheets[n][0] === organ.number + 1 || sheets[n][1] === organ.number + 1);
    const corners = new Uint32Array(own.reduce((sum, n) => sum + 3 * sheets[n][2], 0));
    let count = 0, at = 0;
    for (const n of own) {
      const isFront = sheets[n][0] === organ.number + 1;
      const second = isFront ? 1 : 2;
      for (let t = starts[n]; t < starts[n] + 3 * sheets[n][2]; t += 3) {
        for (let corner = 0; corner < 3; corner++) {
          const point = triangles[t + (corner === 0 ? 0 : corner === 1 ? second : 3 - second)];
          if (places[point] < 0) {
            places[point] = count;
            used[count++] = point;
          }
          corners[at++] = places[point];
        }
      }
    }
    const points = new Float32Array(3 * count);
    const values = new Uint16Array(page.colours ? count : 0);
    for (let n = 0; n < count; n++) {
      const point = used[n];
      places[point] = -1;
      if (page.colours) values[n] = numbers[4 * point + 3];
      for (let axis = 0; axis < 3; axis++) points[3 * n + axis] = origin[axis] + quantum * numbers[4 * point + axis];
    }
    await turns.rest();
    const box = boxOf(points);
    if (page.colours) organ.colours = coloursOf(values);
    Object.assign(organ, { points, box, triangles: corners, normals: normalsOf(points, corners), coarse: corners });
    await turns.rest();
    if (page.mesh.triangles > trianglesOfFastScenes) organ.coarse = coarsen(points, corners, box, length(page.mesh.extent) / 180);
    await turns.rest();
  }
}

/** The scan's grid, whose values are those of places outside until they are read; null if the page has none. */
function makeVolume() {
  const volume = page.volume;
  if (!volume) return null;
  const levels = Float32Array.from([NaN, ...volume.levels]); // by number; 0 is outside of the scan
  const highest = volume.origin.map((from, axis) => from + (volume.size[axis] - 1) * volume.spacing[axis]);
  return { ...volume, numbers: new Uint8Array(volume.size[0] * volume.size[1] * volume.size[2]), levels, highest };
}

/** Reads the scan's values; \a isRead is called with the first slice and the number of slices of each block. */
async function readVolume(volume, isRead) {
  const { numbers, slicesOfBlock } = volume;
  const [columns, rows, slices] = volume.size;
  const slice = columns * rows;
  for (let block = 0; block < volume.blocks; block++) {
    const differences = await inflate('slices-' + block);
    const first = block * slicesOfBlock * slice;
    for (let n = 0, at = first; n < differences.length; n++, at++) { // each slice begins anew
      const place = n % slice;
      if (place % columns === 0) {
        numbers[at] = differences[n] + (place > 0 ? numbers[at - columns] : 0);
      } else if (place < columns) {
        numbers[at] = differences[n] + numbers[at - 1];
      } else {
        const left = numbers[at - 1], upper = numbers[at - columns];
        const low = left < upper ? left : upper, high = left < upper ? upper : left;
        const guess = left + upper - numbers[at - columns - 1];
        numbers[at] = differences[n] + (guess < low ? low : guess > high ? high : guess);
      }
    }
    isRead(block * slicesOfBlock, Math.min(slicesOfBlock, slices - block * slicesOfBlock));
    await turns.rest();
  }
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
