
// ---------------------------------------------------------------------------------------------------------------------
// The 3D scene, drawn by WebGL2 with the light of the program's pictures.

const surfaceVertex = `#version 300 es
in vec3 point;
in vec3 normal;
in vec3 own;
uniform mat4 clipFromPoint;
uniform mat3 viewFromNormal;
uniform vec3 back; // moves the surface away from the viewer, in depth alone: by so much along its normal
out vec3 place;
out vec3 direction;
out vec3 ownColour;
invariant gl_Position;
void main() {
  gl_Position = clipFromPoint * vec4(point, 1.0);
  vec4 behind = clipFromPoint * vec4(point + back / max(abs((viewFromNormal * normal).z), 0.2), 1.0);
  gl_Position.z = behind.z / behind.w * gl_Position.w;
  place = point;
  ownColour = own;
  direction = viewFromNormal * normal;
}`;

const surfaceFragment = `#version 300 es
precision highp float;
precision highp sampler2D;
in vec3 place;
in vec3 direction;
in vec3 ownColour; // of the point, seen without lights
uniform vec4 cut; // normal to the side that is removed, and offset; a normal of 0 removes nothing
uniform mat3 viewFromNormal;
uniform vec4 colour;
uniform vec4 light; // strength of key, fill, sky and rim
uniform vec2 shine; // of wide and narrow highlights
uniform float glow;
uniform bool isSmooth;
uniform bool hasOwnColours;
uniform bool isTranslucent;
uniform sampler2D nearWall;
out vec4 result;

vec3 lit(vec3 base, vec3 n) {
  float key = max(0.0, 0.8 * dot(n, vec3(-0.339, 0.565, 0.753)) + 0.2);
  float fill = max(0.0, 0.7 * dot(n, vec3(0.645, -0.242, 0.725)) + 0.3);
  float rim = 1.0 - clamp(n.z, 0.0, 1.0);
  float wide = pow(max(0.0, dot(n, vec3(-0.181, 0.302, 0.936))), 16.0);
  return base * (light.x * key + light.y * fill + light.z * (1.0 + 0.3 * n.y) + light.w * rim * rim) +
    shine.x * wide + shine.y * wide * wide * wide * wide;
}

void main() {
  float slack = 2e-5 + 1.5 * fwidth(gl_FragCoord.z); // the two depths may be those of different places in the pixel
  if (dot(cut.xyz, place) > cut.w) discard;
  if (isTranslucent && gl_FragCoord.z > texelFetch(nearWall, ivec2(gl_FragCoord.xy), 0).r + slack) discard;
  vec3 n = isSmooth ? normalize(direction) : normalize(viewFromNormal * cross(dFdx(place), dFdy(place)));
  if (isSmooth ? !gl_FrontFacing : n.z < 0.0) n = -n;
  float alpha = isTranslucent ? 1.0 - pow(1.0 - colour.a, 1.0 / max(abs(n.z), 0.15)) : 1.0;
  if (hasOwnColours) {
    result = vec4(mix(ownColour, vec3(1.0), glow), alpha);
    return;
  }
  vec3 base = mix(gl_FrontFacing ? colour.rgb : 0.85 * colour.rgb, vec3(1.0), glow);
  result = vec4(lit(base, n), alpha);
}`;

const depthFragment = `#version 300 es
precision highp float;
in vec3 place;
in vec3 direction;
uniform vec4 cut;
out vec4 result;
void main() {
  if (dot(cut.xyz, place) > cut.w) discard;
  result = vec4(1.0);
}`;

// A plane through the scan, or the cut faces of a surface, in the scan's greys.
const planeVertex = `#version 300 es
in vec3 point;
uniform mat4 clipFromPoint;
out vec3 place;
void main() {
  gl_Position = clipFromPoint * vec4(point, 1.0);
  place = point;
}`;

const planeFragment = `#version 300 es
precision highp float;
precision highp sampler3D;
in vec3 place;
uniform sampler3D numbers;
uniform sampler2D greys; // by number
uniform vec3 lowest;     // outer corner of the volume
uniform vec3 extent;
uniform vec4 cut;
uniform vec4 tint;
uniform bool hasVolume;
uniform bool isCap;
out vec4 result;
void main() {
  if (!isCap && dot(cut.xyz, place) > cut.w + 1e-3) discard;
  vec3 at = (place - lowest) / extent;
  bool inside = hasVolume && all(greaterThanEqual(at, vec3(0.0))) && all(lessThanEqual(at, vec3(1.0)));
  if (!inside && !isCap) discard;
  float number = inside ? texture(numbers, at).r * 255.0 : 0.0;
  vec3 grey = inside ? vec3(texture(greys, vec2((number + 0.5) / 256.0, 0.5)).r) : tint.rgb;
  result = vec4(mix(grey, tint.rgb * (0.35 + 0.65 * grey), tint.a), 1.0);
}`;

const wholeVertex = `#version 300 es
void main() {
  gl_Position = vec4(float(gl_VertexID % 2) * 4.0 - 1.0, float(gl_VertexID / 2) * 4.0 - 1.0, 0.0, 1.0);
}`;

// How much light cavities lose, and where the depth jumps at outlines: as in the program's pictures.
const shadeFragment = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D depths;
uniform vec2 lens;   // mm of a depth d: lens.x d / (1 - lens.y d)
uniform float pixel; // mm
uniform float side;  // mm, mean side of the picture
uniform float reach; // mm, largest distance of surfaces that take light away
uniform float ratio; // device pixels in a CSS pixel
uniform bool isFine;
out vec4 result;

float depthAt(ivec2 at) {
  float depth = texelFetch(depths, clamp(at, ivec2(0), textureSize(depths, 0) - 1), 0).r;
  return depth < 1.0 ? lens.x * depth / (1.0 - lens.y * depth) : 1e6;
}

float filled(float behind, float halfDepth, float radius) {
  return clamp(-behind / halfDepth, -1.0, 1.0) * clamp(2.5 + behind / radius, 0.0, 1.0);
}

float taken(ivec2 at, float depth) {
  float detail = 0.6 * pixel * ratio;
  float sum = 0.0;
  float turn = 0.3927 * float((at.x & 3) * 4 + ((at.y & 3) ^ (at.x & 1) * 2));
  for (int n = 0; n < 12; ++n) {
    float r = sqrt((float(n / 2) + 0.5) / 6.0) * 0.95;
    float angle = float(n) * 2.39996 + turn;
    float radius = max(reach * (n % 2 == 0 ? 1.0 : 0.25), 4.0 * detail);
    ivec2 offset = ivec2(round(vec2(cos(angle), sin(angle)) * r * radius / pixel));
    float halfDepth = radius * sqrt(1.0 - r * r);
    float after = depthAt(at + offset) - depth;
    float before = depthAt(at - offset) - depth;
    float sunk = -0.5 * (after + before) / length(vec2(1.0, 0.5 * (after - before) / (r * radius)));
    sum += max(0.0, filled(after, halfDepth, radius) + filled(before, halfDepth, radius)) *
      smoothstep(detail, 2.0 * detail, sunk);
  }
  return sum / 12.0;
}

float jump(ivec2 at, ivec2 offset, float depth) {
  float after = min(depthAt(at + offset) - depth, 1e5);
  float before = min(depthAt(at - offset) - depth, 1e5);
  float farAfter = min(depthAt(at + 2 * offset) - depth, 1e5) - after;
  float farBefore = min(depthAt(at - 2 * offset) - depth, 1e5) - before;
  return max(after - max(0.0, max(farAfter, -before)), before - max(0.0, max(farBefore, -after)));
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float depth = depthAt(at);
  result = vec4(0.0);
  if (depth > 1e5) return;
  int line = max(int(ratio + 0.5), 1);
  float least = max(0.006 * side, 2.0 * float(line) * pixel);
  float most = max(max(jump(at, ivec2(line, 0), depth), jump(at, ivec2(0, line), depth)),
                   max(jump(at, ivec2(line, line), depth), jump(at, ivec2(line, -line), depth)));
  result = vec4(isFine ? taken(at, depth) : 0.0, smoothstep(least, 2.0 * least, most), 0.0, 1.0);
}`;

// Multiplies the picture with the mean shade of the pixels around that have different angles, without other surfaces.
const darkenFragment = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D depths;
uniform sampler2D shades;
uniform vec2 lens;   // as above
uniform float alike; // mm, difference of depth within one surface
uniform vec2 strengths;
out vec4 result;

float placeOf(float depth) {
  return lens.x * depth / (1.0 - lens.y * depth);
}

void main() {
  ivec2 last = textureSize(depths, 0) - 1;
  ivec2 at = ivec2(gl_FragCoord.xy);
  float here = texelFetch(depths, at, 0).r;
  float taken = 0.0, count = 0.0, outline = 0.0;
  for (int y = -2; y < 2; ++y) for (int x = -2; x < 2; ++x) {
    ivec2 beside = clamp(at + ivec2(x, y), ivec2(0), last);
    float there = texelFetch(depths, beside, 0).r;
    float counts = there < 1.0 && (here == 1.0 || abs(placeOf(there) - placeOf(here)) < alike) ? 1.0 : 0.0;
    taken += counts * texelFetch(shades, beside, 0).r;
    count += counts;
  }
  for (int y = -1; y < 2; ++y) for (int x = -1; x < 2; ++x) {
    ivec2 beside = clamp(at + ivec2(x, y), ivec2(0), last);
    outline += texelFetch(shades, beside, 0).g * float((2 - abs(x)) * (2 - abs(y))) / 16.0;
  }
  float bright = (1.0 - min(strengths.x * taken / max(count, 1.0), 0.75)) * (1.0 - strengths.y * outline);
  result = vec4(vec3(bright), 1.0);
}`;

const clinicLook = { light: [0.68, 0.24, 0.20, 0.16], shine: [0.07, 0], glossy: [0.14, 0.40], strengths: [1.3, 0.7], background: [0, 0, 0] };
const paperLook = { light: [0.48, 0.24, 0.39, -0.06], shine: [0.03, 0], glossy: [0.10, 0.28], strengths: [1.0, 0.8], background: [1, 1, 1] };

function makeProgram(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, 'point');
  gl.bindAttribLocation(program, 1, 'normal');
  gl.bindAttribLocation(program, 2, 'own');
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(gl.getProgramInfoLog(program) || 'a shader was refused');
  }
  const uniforms = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) || 0;
  for (let n = 0; n < count; n++) {
    const { name } = gl.getActiveUniform(program, n);
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return { program, uniforms };
}

/** Draws organs, planes and cuts of a state into a canvas. Throws without WebGL2. */
class Scene {
  constructor(canvas, organs, volume) {
    this.canvas = canvas;
    this.organs = organs;
    this.volume = volume;
    this.box = joinBoxes(organs.map((organ) => organ.box));
    const gl = canvas.getContext('webgl2', { antialias: true, stencil: true, alpha: false, preserveDrawingBuffer: true });
    if (!gl || gl.isContextLost()) throw new Error('this browser gives no WebGL2');
    this.gl = gl;
    this.load();
  }

  /** Makes programs, buffers and textures: again after a lost context. */
  load() {
    const gl = this.gl;
    this.surface = makeProgram(gl, surfaceVertex, surfaceFragment);
    this.depth = makeProgram(gl, surfaceVertex, depthFragment);
    this.plane = makeProgram(gl, planeVertex, planeFragment);
    this.shade = makeProgram(gl, wholeVertex, shadeFragment);
    this.darken = makeProgram(gl, wholeVertex, darkenFragment);
    this.meshes = this.organs.map((organ) => this.loadOrgan(organ));
    this.quad = gl.createVertexArray();
    this.quadPoints = gl.createBuffer();
    gl.bindVertexArray(this.quad);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.quadPoints);
    gl.bufferData(gl.ARRAY_BUFFER, 48, gl.DYNAMIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    this.empty = gl.createVertexArray();
    gl.bindVertexArray(null);
    this.nearWall = gl.createTexture();
    this.nearTarget = gl.createFramebuffer();
    this.shades = gl.createTexture();
    this.shadeTarget = gl.createFramebuffer();
    this.targetSize = '';
    this.numbers = null;
    if (this.volume) this.loadVolume();
  }

  loadOrgan(organ) {
    const gl = this.gl;
    const [colours, ...buffers] = [organ.colours, organ.points, organ.normals].map((values) => {
      if (!values) return null;
      const buffer = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
      return buffer;
    });
    const load = (triangles) => {
      const array = gl.createVertexArray();
      gl.bindVertexArray(array);
      buffers.forEach((buffer, place) => {
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.enableVertexAttribArray(place);
        gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
      });
      if (colours) {
        gl.bindBuffer(gl.ARRAY_BUFFER, colours);
        gl.enableVertexAttribArray(2);
        gl.vertexAttribPointer(2, 3, gl.UNSIGNED_BYTE, true, 0, 0);
      }
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
      gl.bindVertexArray(null);
      return { array, count: triangles.length };
    };
    return { fine: load(organ.triangles), coarse: load(organ.coarse) };
  }

  loadVolume() {
    const gl = this.gl;
    this.numbers = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_3D, this.numbers);
    gl.texStorage3D(gl.TEXTURE_3D, 1, gl.R8, ...this.volume.size);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R]) gl.texParameteri(gl.TEXTURE_3D, wrap, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_3D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_3D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    this.greys = gl.createTexture();
    this.window = '';
    this.loadSlices(0, this.volume.size[2]);
  }

  /** Uploads some slices: the scene is shown before all of them are read. */
  loadSlices(first, count) {
    const gl = this.gl;
    const [columns, rows] = this.volume.size;
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.bindTexture(gl.TEXTURE_3D, this.numbers);
    gl.texSubImage3D(gl.TEXTURE_3D, 0, 0, 0, first, columns, rows, count, gl.RED, gl.UNSIGNED_BYTE,
                     this.volume.numbers.subarray(first * columns * rows, (first + count) * columns * rows));
  }

  /** Sizes the canvas and the depths to the place on the page. */
  resize() {
    const gl = this.gl;
    this.ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(this.canvas.clientWidth * this.ratio));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * this.ratio));
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    if (this.targetSize !== width + 'x' + height) {
      this.targetSize = width + 'x' + height;
      gl.bindTexture(gl.TEXTURE_2D, this.nearWall);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.DEPTH_COMPONENT24, width, height, 0, gl.DEPTH_COMPONENT, gl.UNSIGNED_INT, null);
      for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.nearTarget);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.nearWall, 0);
      gl.drawBuffers([gl.NONE]);
      gl.bindTexture(gl.TEXTURE_2D, this.shades);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
      for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadeTarget);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.shades, 0);
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    }
  }

  /** The camera's matrices, for \a state and the canvas; and its lens: a depth of d is lens[0] d / (1 - lens[1] d) mm
   * behind the nearest. */
  aim(state) {
    const { clientWidth, clientHeight } = this.canvas;
    const { frame, distance } = cameraOf(state, clientHeight);
    const reachAround = ({ low, high }) => length(minus(high, low)) / 2 + length(minus(centreOf({ low, high }), state.centre)) + 1;
    this.backs = this.organs.map((organ) => behindOf(organ, state.scale));
    const reach = 5 * Math.max(...this.backs) + Math.max(reachAround(this.box), this.volume ? reachAround({ low: this.volume.origin, high: this.volume.highest }) : 0);
    const rows = [[frame.right, 2 / (state.scale * clientWidth)], [frame.up, 2 / (state.scale * clientHeight)], [frame.look, 1 / reach]]
      .map(([way, factor]) => [...way.map((x) => x * factor), -dot(way, state.centre) * factor]);
    rows.push([0, 0, 0, 1]);
    let lens = [2 * reach, 0];
    if (state.perspective) {
      const near = Math.max(distance - reach, distance / 50), far = distance + reach;
      const look = rows[2].map((x) => x * reach); // mm behind the centre
      rows[3] = look.map((x, n) => x / distance + (n === 3 ? 1 : 0));
      rows[2] = look.map((x, n) => ((far + near) * (x + (n === 3 ? distance : 0)) - (n === 3 ? 2 * far * near : 0)) / ((far - near) * distance));
      lens = [near * (far - near) / far, (far - near) / far];
    }
    const matrix = new Float32Array(16);
    rows.forEach((row, n) => row.forEach((x, column) => { matrix[4 * column + n] = x; }));
    const rotation = new Float32Array(9);
    for (let axis = 0; axis < 3; axis++) {
      rotation[3 * axis] = frame.right[axis];
      rotation[3 * axis + 1] = frame.up[axis];
      rotation[3 * axis + 2] = -frame.look[axis];
    }
    return { frame, matrix, rotation, lens };
  }

  use(program, camera, cut) {
    const gl = this.gl;
    gl.useProgram(program.program);
    gl.uniformMatrix4fv(program.uniforms.clipFromPoint, false, camera.matrix);
    if (program.uniforms.viewFromNormal) gl.uniformMatrix3fv(program.uniforms.viewFromNormal, false, camera.rotation);
    this.back = program.uniforms.back;
    this.look = camera.frame.look;
    gl.uniform4f(program.uniforms.cut, ...(cut ? [...cut.normal, cut.offset] : [0, 0, 0, 1]));
  }

  drawOrgan(organ) {
    const mesh = this.meshes[organ.number][this.isFine ? 'fine' : 'coarse'];
    this.gl.uniform3f(this.back, ...this.look.map((x) => x * this.backs[organ.number]));
    this.gl.bindVertexArray(mesh.array);
    this.gl.drawElements(this.gl.TRIANGLES, mesh.count, this.gl.UNSIGNED_INT, 0);
  }

  paint(organ, look, marked) {
    const gl = this.gl, u = this.surface.uniforms;
    gl.uniform4f(u.colour, ...organ.colour.map((byte) => byte / 255), organ.shown);
    gl.uniform4f(u.light, ...look.light);
    gl.uniform2f(u.shine, ...(organ.glossy ? look.glossy : look.shine));
    gl.uniform1f(u.glow, organ.number === marked ? 0.18 : 0);
    gl.uniform1i(u.isSmooth, organ.smooth ? 1 : 0);
    gl.uniform1i(u.hasOwnColours, organ.colours ? 1 : 0);
    gl.uniform1i(u.isTranslucent, organ.shown < 1 ? 1 : 0);
    gl.uniform1i(u.nearWall, 0);
    this.drawOrgan(organ);
  }

  /** Depths of organs alone, in the texture. */
  drawDepths(organs, camera, cut) {
    const gl = this.gl;
    gl.bindTexture(gl.TEXTURE_2D, null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.nearTarget);
    gl.depthMask(true);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.use(this.depth, camera, cut);
    for (const organ of organs) this.drawOrgan(organ);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.bindTexture(gl.TEXTURE_2D, this.nearWall);
  }

  /** Uploads the greys of the levels in a window. */
  setWindow([width, centre]) {
    const key = width + '/' + centre;
    if (this.window === key) return;
    this.window = key;
    const gl = this.gl;
    const bytes = new Uint8Array(256);
    for (let n = 1; n < this.volume.levels.length; n++) bytes[n] = greyOf(this.volume.levels[n], width, centre);
    bytes.fill(bytes[this.volume.levels.length - 1], this.volume.levels.length);
    gl.bindTexture(gl.TEXTURE_2D, this.greys);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, 256, 1, 0, gl.RED, gl.UNSIGNED_BYTE, bytes);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
  }

  usePlanes(camera, cut, state) {
    const gl = this.gl, u = this.plane.uniforms;
    if (this.numbers) this.setWindow(state.window);
    this.use(this.plane, camera, cut);
    gl.uniform1i(u.hasVolume, this.numbers ? 1 : 0);
    gl.uniform1i(u.numbers, 1);
    gl.uniform1i(u.greys, 2);
    if (this.numbers) {
      const { origin, spacing, size } = this.volume;
      gl.uniform3f(u.lowest, ...origin.map((from, axis) => from - spacing[axis] / 2));
      gl.uniform3f(u.extent, ...size.map((count, axis) => count * spacing[axis]));
      gl.activeTexture(gl.TEXTURE1);
      gl.bindTexture(gl.TEXTURE_3D, this.numbers);
      gl.activeTexture(gl.TEXTURE2);
      gl.bindTexture(gl.TEXTURE_2D, this.greys);
      gl.activeTexture(gl.TEXTURE0);
    }
  }

  drawQuad(corners) {
    const gl = this.gl;
    gl.bindVertexArray(this.quad);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.quadPoints);
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, Float32Array.from(corners.flat()));
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }

  /** The cut faces: where more back than front walls lie behind the plane, the plane is inside a surface. */
  drawCaps(organs, camera, cut, state) {
    const gl = this.gl;
    const far = 2 * length(minus(this.box.high, this.box.low)) + 1;
    const n = cut.normal;
    const other = Math.abs(n[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
    const u = unit(cross(n, other));
    const v = cross(n, u);
    const middle = centreOf(this.box);
    const foot = along(middle, n, cut.offset - dot(n, middle));
    const corners = [[-1, -1], [1, -1], [-1, 1], [1, 1]].map(([a, b]) => along(along(foot, u, a * far), v, b * far));
    gl.enable(gl.STENCIL_TEST);
    for (const organ of [...organs].sort((a, b) => (b.volume || 0) - (a.volume || 0))) { // a lesion in its organ is seen
      this.use(this.depth, camera, cut);
      gl.colorMask(false, false, false, false);
      gl.depthMask(false);
      gl.disable(gl.DEPTH_TEST);
      gl.stencilFunc(gl.ALWAYS, 0, 255);
      gl.stencilOpSeparate(gl.FRONT, gl.KEEP, gl.KEEP, gl.DECR_WRAP);
      gl.stencilOpSeparate(gl.BACK, gl.KEEP, gl.KEEP, gl.INCR_WRAP);
      this.drawOrgan(organ);
      gl.colorMask(true, true, true, true);
      gl.depthMask(true);
      gl.enable(gl.DEPTH_TEST);
      gl.stencilFunc(gl.NOTEQUAL, 0, 255);
      gl.stencilOp(gl.ZERO, gl.ZERO, gl.ZERO);
      this.usePlanes(camera, cut, state);
      gl.uniform1i(this.plane.uniforms.isCap, 1);
      const tint = organ.shown < 1 ? 0 : 0.25;
      gl.uniform4f(this.plane.uniforms.tint, ...organ.colour.map((byte) => byte / 255), this.numbers ? tint : 1);
      this.drawQuad(corners);
    }
    gl.disable(gl.STENCIL_TEST);
  }

  /** The slices that stand in the scene. */
  drawSlices(camera, cut, state) {
    const gl = this.gl;
    this.usePlanes(camera, cut, state);
    gl.uniform1i(this.plane.uniforms.isCap, 0);
    gl.uniform4f(this.plane.uniforms.tint, 0, 0, 0, 0);
    const low = this.volume.origin.map((from, axis) => from - this.volume.spacing[axis] / 2);
    const high = this.volume.highest.map((to, axis) => to + this.volume.spacing[axis] / 2);
    for (let axis = 0; axis < 3; axis++) {
      if (!state.planes[axis]) continue;
      const [a, b] = [0, 1, 2].filter((n) => n !== axis);
      this.drawQuad([[low[a], low[b]], [high[a], low[b]], [low[a], high[b]], [high[a], high[b]]].map(([p, q]) => {
        const corner = [...state.point];
        corner[a] = p;
        corner[b] = q;
        return corner;
      }));
    }
  }

  /** Darkens cavities and outlines of what is opaque. */
  drawShades(opaque, camera, cut, state, look) {
    const gl = this.gl, u = this.shade.uniforms;
    this.drawDepths(opaque, camera, cut);
    gl.useProgram(this.shade.program);
    gl.uniform1i(u.depths, 0);
    gl.uniform2f(u.lens, ...camera.lens);
    gl.uniform1f(u.pixel, state.scale / this.ratio);
    gl.uniform1f(u.side, state.scale * (this.canvas.clientWidth + this.canvas.clientHeight) / 2);
    gl.uniform1f(u.reach, 0.02 * dot(minus(this.box.high, this.box.low), [1, 1, 1])); // 0.06 of the mean side
    gl.uniform1f(u.ratio, this.ratio);
    gl.uniform1i(u.isFine, this.isFine ? 1 : 0);
    gl.disable(gl.DEPTH_TEST);
    gl.bindVertexArray(this.empty);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadeTarget);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.useProgram(this.darken.program);
    gl.uniform1i(this.darken.uniforms.depths, 0);
    gl.uniform1i(this.darken.uniforms.shades, 1);
    gl.uniform2f(this.darken.uniforms.lens, ...camera.lens);
    gl.uniform1f(this.darken.uniforms.alike, 0.006 * state.scale * (this.canvas.clientWidth + this.canvas.clientHeight) / 2);
    gl.uniform2f(this.darken.uniforms.strengths, page.colours ? 0 : look.strengths[0], look.strengths[1]); // colours are numbers
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.shades);
    gl.activeTexture(gl.TEXTURE0);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ZERO, gl.SRC_COLOR);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
  }

  /** Returns when all is drawn. */
  wait() {
    this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** Draws the state. \a isFine: all triangles, and shadows in cavities. */
  draw(state, isFine) {
    const gl = this.gl;
    if (gl.isContextLost()) return;
    this.isFine = isFine;
    this.resize();
    const look = state.isLight ? paperLook : clinicLook;
    const camera = this.aim(state);
    const cut = cutOf(state);
    const visible = this.organs.filter((organ) => organ.visible && organ.triangles.length > 0);
    const opaque = visible.filter((organ) => organ.shown >= 1);
    const nearest = (organ) => dot(centreOf(organ.box), camera.frame.look) - reachOf(organ.box, camera.frame.look);
    const translucent = visible.filter((organ) => organ.shown < 1).sort((a, b) => nearest(b) - nearest(a));
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(...look.background, 1);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.nearWall);
    this.use(this.surface, camera, cut);
    for (const organ of opaque) this.paint(organ, look, state.marked);
    if (opaque.length > 0) this.drawShades(opaque, camera, cut, state, look);
    if (cut) this.drawCaps(visible, camera, cut, state);
    if (this.numbers && state.planes.some(Boolean)) this.drawSlices(camera, cut, state);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    for (const organ of translucent) {
      this.drawDepths([organ], camera, cut);
      gl.depthMask(false);
      gl.enable(gl.BLEND);
      this.use(this.surface, camera, cut);
      this.paint(organ, look, state.marked);
      gl.disable(gl.BLEND);
      gl.depthMask(true);
    }
    gl.bindVertexArray(null);
  }
}
