
// ---------------------------------------------------------------------------------------------------------------------
// Which layer runs: the 3D scene, or the turntable of pictures beside the slices; and one line that says why.

function tellLayer(text) {
  document.getElementById('layer').textContent = text;
}

/** Pictures around the patient that one drags: what is shown without WebGL2. */
class Turntable {
  constructor(viewer) {
    this.viewer = viewer;
    this.image = document.getElementById('turntable');
    this.frames = [];
    this.frame = 0;
    let last = null;
    this.image.addEventListener('pointerdown', (event) => {
      event.preventDefault();
      this.image.focus({ preventScroll: true });
      this.image.setPointerCapture(event.pointerId);
      last = event.clientX;
    });
    this.image.addEventListener('pointermove', (event) => {
      if (last === null) return;
      const steps = Math.trunc((last - event.clientX) / 14);
      if (steps !== 0) { last -= steps * 14; this.turn(steps); }
    });
    for (const end of ['pointerup', 'pointercancel']) this.image.addEventListener(end, () => { last = null; });
    this.image.addEventListener('keydown', (event) => {
      if (event.key === 'ArrowLeft' || event.key === 'ArrowRight') {
        this.turn(event.key === 'ArrowRight' ? 1 : -1);
        event.preventDefault();
      }
    });
  }

  turn(steps) {
    this.viewer.state.azimuth += steps * 360 / page.turntable;
    this.viewer.changed();
  }

  /** Shows the picture that is nearest to the azimuth. */
  draw() {
    const count = page.turntable;
    if (count === 0) return;
    const n = ((Math.round(this.viewer.state.azimuth * count / 360) % count) + count) % count;
    if (!this.frames[n]) this.frames[n] = URL.createObjectURL(new Blob([bytesOf('turn-' + n)], { type: 'image/jpeg' }));
    if (this.image.src !== this.frames[n]) this.image.src = this.frames[n];
    const frame = frameOf(n * 360 / count, 0);
    writeLetters(document.getElementById('scene'), frame);
    drawFigure(document.getElementById('figure'), frame);
    this.image.alt = describeView(n * 360 / count, 0) + '; drag or use the arrow keys to turn';
  }
}

/** "The structures, seen from the front", with the angles. */
function describeView(azimuth, elevation) {
  const round = (Math.round(azimuth) % 360 + 360) % 360;
  const view = standardViews.find((standard) => standard.azimuth === round && standard.elevation === Math.round(elevation));
  return 'The structures, seen ' + (view ? 'from ' + view.from : `${round}\u00b0 from the front towards the left, ${Math.round(elevation)}\u00b0 up`);
}

/** The bar of the colours beside the scene, with its numbers. */
function showBar({ title, numbers, map, marks }) {
  const canvas = make('canvas', { width: 1, height: map.length / 6, ariaHidden: 'true' });
  const context = canvas.getContext('2d');
  map.match(/.{6}/g).forEach((colour, n) => {
    context.fillStyle = '#' + colour;
    context.fillRect(0, canvas.height - 1 - n, 1, 1);
  });
  context.fillStyle = '#000';
  marks.forEach((share) => context.fillRect(0, (1 - share) * canvas.height - 1, 1, 2));
  const labels = make('div', {}, ...[...numbers].reverse().map((number) => make('span', { textContent: number })));
  const bar = document.getElementById('colours');
  bar.append(make('b', { textContent: title }), make('div', {}, canvas, labels));
  bar.setAttribute('aria-label', `Colours: ${title}, from ${numbers[0]} to ${numbers[numbers.length - 1]}`);
  bar.hidden = false;
}

/** Changes between the turntable and the 3D scene, also when the context is lost and restored. */
class Layers {
  constructor(viewer) {
    this.viewer = viewer;
    this.turntable = new Turntable(viewer);
    this.canvas = document.getElementById('canvas');
    if (page.colours) showBar(page.colours);
    this.canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.usePictures('the browser has taken back its graphics memory; 3D comes back when it gives it again');
    });
    this.canvas.addEventListener('webglcontextrestored', () => {
      this.scene.load();
      this.useScene();
    });
    this.usePictures('the surfaces are being read');
  }

  /** Starts the scene where that is possible. */
  start3d() {
    try {
      this.scene = new Scene(this.canvas, this.viewer.organs, this.viewer.volume);
      this.useScene();
    } catch (error) {
      this.usePictures(error.message);
    }
  }

  useScene() {
    this.show(this.scene);
    tellLayer('Interactive 3D. This page is one file and asks nothing of any network.');
  }

  usePictures(why) {
    this.show(null);
    tellLayer('Pictures to turn' + (page.volume ? ' and slices to scroll' : '') + ', no free 3D: ' + why + '.');
  }

  show(scene) {
    this.viewer.scene = scene;
    this.viewer.turntable = scene ? null : this.turntable;
    this.canvas.hidden = !scene;
    this.turntable.image.hidden = Boolean(scene);
    for (const element of document.querySelectorAll('.needs3d')) element.hidden = !scene;
    document.querySelector('#scene .scale').hidden = !scene;
    document.body.dataset.layer = scene ? '3d' : 'pictures';
    this.viewer.changed();
  }
}
