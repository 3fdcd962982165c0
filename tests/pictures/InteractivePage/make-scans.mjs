// make-scans.mjs: writes scans of a ball in a body, whose places are known, with slices that lie obliquely or are tilted; a
// scan of one slice; a label map with names that a page must not take for markup; and masks of a body and of its upper half.
import { mkdirSync, writeFileSync } from 'node:fs';

export const centre = [12, -34, 56];              // LPS mm, of the body
export const ball = { at: [32, -46, 74], radius: 12 }; // on the patient's left, in front, near the head

const size = [60, 54, 48], spacing = [2, 2, 3];
const degrees = Math.PI / 180;

/** The value at a point: air, body or ball, without steps. */
function valueAt(point) {
  const within = (distance) => 1 / (1 + Math.exp(-1.5 * distance));
  const way = point.map((x, axis) => x - centre[axis]);
  const fromBody = 45 * (1 - Math.hypot(way[0] / 50, way[1] / 40, way[2] / 55));
  const fromBall = ball.radius - Math.hypot(...point.map((x, axis) => x - ball.at[axis]));
  return -1000 + 1040 * within(fromBody) + 960 * within(fromBall);
}

/** Writes a NIfTI file: \a columns are the steps of the axes in LPS mm. */
function writeScan(file, counts, columns, type, value) {
  const first = centre.map((x, axis) => x - [0, 1, 2].reduce((sum, n) => sum + columns[n][axis] * (counts[n] - 1) / 2, 0));
  const bytesOfValue = type === 4 ? 2 : 1;
  const bytes = Buffer.alloc(352 + counts[0] * counts[1] * counts[2] * bytesOfValue);
  bytes.writeInt32LE(348, 0);
  [3, ...counts, 1, 1, 1, 1].forEach((n, at) => bytes.writeInt16LE(n, 40 + 2 * at));
  bytes.writeInt16LE(type, 70);
  bytes.writeInt16LE(8 * bytesOfValue, 72);
  [1, ...columns.map((column) => Math.hypot(...column)), 1, 1, 1, 1].forEach((x, at) => bytes.writeFloatLE(x, 76 + 4 * at));
  bytes.writeFloatLE(352, 108);
  bytes.writeFloatLE(1, 112);
  bytes.writeUInt8(2, 123);
  bytes.writeInt16LE(1, 254);
  for (let row = 0; row < 3; row++) {
    const sign = row < 2 ? -1 : 1; // NIfTI is RAS
    [...columns.map((column) => column[row]), first[row]].forEach((x, at) => bytes.writeFloatLE(sign * x, 280 + 16 * row + 4 * at));
  }
  bytes.write('n+1\0', 344);
  let at = 352;
  for (let k = 0; k < counts[2]; k++) for (let j = 0; j < counts[1]; j++) for (let i = 0; i < counts[0]; i++) {
    const number = value(first.map((x, axis) => x + i * columns[0][axis] + j * columns[1][axis] + k * columns[2][axis]));
    if (type === 4) bytes.writeInt16LE(Math.round(number), at);
    else bytes.writeUInt8(number, at);
    at += bytesOfValue;
  }
  writeFileSync(file, bytes);
}

/** The steps of axes that are turned about z and then tilted about x; \a shear tilts the slices alone. */
function columnsOf(turn, tilt, shear) {
  const [ct, st, cx, sx] = [Math.cos(turn), Math.sin(turn), Math.cos(tilt), Math.sin(tilt)];
  const turned = [[ct, st, 0], [-st, ct, 0], [0, 0, 1]].map(([x, y, z]) => [x, cx * y - sx * z, sx * y + cx * z]);
  turned[2] = turned[2].map((x, axis) => x + turned[1][axis] * Math.tan(shear));
  return turned.map((column, n) => column.map((x) => x * spacing[n]));
}

if (process.argv[1].endsWith('make-scans.mjs')) {
  writeScan('oblique.nii', size, columnsOf(20 * degrees, 12 * degrees, 0), 4, valueAt);
  writeScan('tilted.nii', size, columnsOf(0, 0, 18 * degrees), 4, valueAt);
  writeScan('slice.nii', [60, 54, 1], columnsOf(0, 0, 0), 4, valueAt);
  const labelAt = (point) => (valueAt(point) > 500 ? 2 : valueAt(point) > -300 ? (point[2] < centre[2] ? 1 : 3) : 0);
  writeScan('named.nii', size, columnsOf(0, 0, 0), 2, labelAt);
  writeScan('unnamed.nii', size, columnsOf(0, 0, 0), 2, labelAt);
  const bodyAt = (point) => (valueAt(point) > -300 ? 1 : 0);
  mkdirSync('overlap', { recursive: true });
  writeScan('overlap/body.nii', size, columnsOf(0, 0, 0), 2, bodyAt);
  writeScan('overlap/apex.nii', size, columnsOf(0, 0, 0), 2, (point) => (point[2] > centre[2] ? bodyAt(point) : 0));
  writeFileSync('named.tsv', 'index\tname\n1\t</script><img src=x onerror=alert(1)>\n2\t"the ""ball"" & \'co\' <!-- {{title}}"\n3\t\u05db\u05d1\u05d3 \u0643\u0628\u062f\n');
}
