// Opens a page in Firefox without a graphics context, with scripts and without them, through WebDriver BiDi.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import WebSocket from 'ws';

let failures = 0;
function check(isTrue, what) {
  console.log(`${isTrue ? 'ok    ' : 'FAILED'} ${what}`);
  failures += isTrue ? 0 : 1;
}

/** The address at which Firefox listens, which it prints when it has started. */
const addressOf = (firefox) => new Promise((found, failed) => {
  let text = '';
  firefox.stderr.on('data', (bytes) => {
    text += bytes;
    const address = /WebDriver BiDi listening on (ws:\/\/\S+)/.exec(text);
    if (address) found(address[1]);
  });
  firefox.on('exit', () => failed(new Error('Firefox ended: ' + text)));
});

/** Opens a file in a Firefox of its own, with settings of its profile, runs \a work, and checks that the page asked for
 * nothing and reported no error. */
async function open(file, settings, work) {
  const profile = mkdtempSync(join(tmpdir(), 'page-firefox-'));
  writeFileSync(join(profile, 'user.js'), Object.entries({
    'webgl.disabled': true, 'app.update.enabled': false, 'browser.shell.checkDefaultBrowser': false, 'network.captive-portal-service.enabled': false,
    'network.connectivity-service.enabled': false, 'browser.startup.page': 0, 'datareporting.policy.dataSubmissionEnabled': false, ...settings,
  }).map(([name, value]) => `user_pref(${JSON.stringify(name)}, ${JSON.stringify(value)});\n`).join(''));
  const firefox = spawn('firefox-esr', ['--headless', '--no-remote', '--profile', profile, '--remote-debugging-port', '0', '--width', '1200', '--height', '900'],
    { stdio: ['ignore', 'ignore', 'pipe'], env: { ...process.env, HOME: profile, MOZ_HEADLESS: '1' } });
  try {
    const socket = new WebSocket(await addressOf(firefox) + '/session');
    await new Promise((opened, failed) => { socket.on('open', opened); socket.on('error', failed); });
    const waiting = new Map(), requests = [], errors = [];
    socket.on('message', (bytes) => {
      const message = JSON.parse(bytes);
      if (message.type === 'event') {
        const { request, level, text } = message.params;
        if (request && !/^(data|blob):/.test(request.url)) requests.push(request.url);
        if (level === 'error') errors.push(text);
        return;
      }
      const { done, failed } = waiting.get(message.id);
      message.type === 'error' ? failed(new Error(message.message)) : done(message.result);
    });
    const send = (method, params = {}) => new Promise((done, failed) => {
      const id = waiting.size + 1;
      waiting.set(id, { done, failed });
      socket.send(JSON.stringify({ id, method, params }));
    });
    await send('session.new', { capabilities: {} });
    await send('session.subscribe', { events: ['network.beforeRequestSent', 'log.entryAdded'] });
    const { contexts: [{ context }] } = await send('browsingContext.getTree');
    const start = Date.now();
    await send('browsingContext.navigate', { context, url: 'file://' + resolve(file), wait: 'complete' });
    const page = {
      async evaluate(expression) {
        const { result, exceptionDetails } = await send('script.evaluate', { expression: `(async () => JSON.stringify(await (${expression})))()`, target: { context }, awaitPromise: true });
        if (exceptionDetails) throw new Error(exceptionDetails.text);
        return result.value === undefined ? undefined : JSON.parse(result.value);
      },
      count: async (selector) => (await send('browsingContext.locateNodes', { context, locator: { type: 'css', value: selector } })).nodes.length,
      async screenshot(path) { writeFileSync(path, Buffer.from((await send('browsingContext.captureScreenshot', { context })).data, 'base64')); },
      press: (key) => send('input.performActions', { context, actions: [{ type: 'key', id: 'keyboard', actions: [{ type: 'keyDown', value: key }, { type: 'keyUp', value: key }] }] }),
    };
    await work(page);
    console.log(`${file}: ${Date.now() - start} ms in Firefox`);
    check(requests.every((url) => url === 'file://' + resolve(file)), `Firefox, ${file}: no request but for itself ${requests.filter((url) => !url.startsWith('file:')).join(' ')}`);
    check(errors.length === 0, `Firefox, ${file}: no errors ${errors.join('; ')}`);
    await send('browser.close').catch(() => {});
    socket.terminate();
  } finally {
    const ended = new Promise((done) => { firefox.exitCode === null ? firefox.once('exit', done) : done(); });
    firefox.kill();
    await ended;
    rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
  }
}

const arrowRight = '\uE014';

await open('shell.html', {}, async (page) => {
  await page.evaluate(`new Promise((done) => { const look = () => document.body.dataset.ready === 'yes' ? done() : setTimeout(look, 50); look(); })`);
  check(await page.evaluate('document.body.dataset.layer') === 'pictures', 'Firefox without WebGL: the turntable runs');
  check((await page.evaluate(`document.getElementById('layer').textContent`)).includes('no WebGL2'), 'and the page says why');
  await page.evaluate(`document.getElementById('turntable').focus()`);
  for (let n = 0; n < 6; n++) await page.press(arrowRight);
  const letters = await page.evaluate(`new Promise((done) => setTimeout(() => done(['left', 'right', 'top', 'bottom'].map((side) => document.querySelector('#scene .letter.' + side).textContent).join(' ')), 300))`);
  check(letters === 'A P H F', `six pictures on is the view from the left: ${letters}`);
  check(await page.evaluate(`document.getElementById('turntable').naturalWidth`) > 0, 'its picture is there');
  const means = await page.evaluate(`[...document.querySelectorAll('.slice canvas')].slice(0, 3).map((canvas) => {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return data.reduce((sum, value) => sum + value, 0) / data.length; })`);
  check(means.length === 3 && means.every((mean) => mean > 66), `three slices are drawn: ${means.map((mean) => mean.toFixed(0))}`);
  await page.screenshot('firefox-pictures.png');
});

await open('shell.html', { 'javascript.enabled': false }, async (page) => {
  check(await page.count('#still img') === 7, 'Firefox without scripts: four views and three slices');
  check(await page.count('#still tbody tr') === 2, 'and the table');
  await page.screenshot('firefox-still.png');
});

console.log(failures === 0 ? 'Firefox: all is well' : `Firefox: ${failures} checks failed`);
process.exit(failures === 0 ? 0 : 1);
