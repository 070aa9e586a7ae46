// Papers 001 and 003 and the comparison of designs, in the page.
import assert from 'node:assert/strict';
import { PHONE } from '../harness.mjs';

const settled = (state) => state.current && state.running === null;

async function opened(open, name, method, options) {
  const page = await open(options);
  await page.until(settled, 'the first example');
  await page.click('button', 'Examples');
  await page.click('button', name);
  return [page, await page.until((state) => settled(state) && state.method === method, `${name}`)];
}

const wide = (open, options) => opened(open, /Input-decoupled observer/, 'input-decoupled', options);
const network = (open, options) => opened(open, /a network, as a whole/, 'hierarchical', options);
/** Waits until a widget with that role and name is there, for example a plot with its title, and returns its place. */
async function seen(page, name) {
  const end = Date.now() + 20_000;
  for (;;) {
    const widgets = await page.widgets();
    const at = widgets.findIndex((widget) => name.test(widget));
    if (at >= 0) return at;
    assert.ok(Date.now() < end, `no ${name} among ${widgets.join('; ')}`);
    await page.page.waitForTimeout(100);
  }
}

export default async ({ step, open }) => {
  await step('the wide plant of paper 001 is observed, whatever its unknown input does', async () => {
    const [page, state] = await wide(open);
    assert.equal(state.verified, true, JSON.stringify(state.errors));
    const spectrum = state.spectrum.map(([re]) => re).sort((a, b) => a - b);
    assert.ok(Math.abs(spectrum[0] + 2) < 1e-6 && Math.abs(spectrum[1] + 1) < 1e-6, `${spectrum}`);
    const before = state.rms;
    await page.type('textbox', 'd1', '100*sin(3*t)');
    const after = await page.until((found) => settled(found) && found.revision > state.revision, 'another unknown input');
    after.rms.forEach((value, k) => {
      assert.ok(Math.abs(value - before[k]) < 1e-6 * (1 + before[k]), `the error does not change: ${before} ${after.rms}`);
    });
  });

  await step('a misprint of the paper stands beside the matrix that it concerns', async () => {
    const [page] = await wide(open);
    const matrix = await seen(page, /: G( =|$)/);
    const fold = await seen(page, /: Errata beside G( =|$)/);
    const text = await seen(page, /Misprint, section III, d_hat: printed "G = \[5\/3 4\/3\]".*\[0 16\/3\] with \+4\/3/);
    const next = await seen(page, /: Q1( =|$)/);
    assert.ok(matrix < fold && fold < text && text < next, `in this order: ${[matrix, fold, text, next]}`);
  });

  await step('its figures are one click away', async () => {
    const [page] = await wide(open);
    await page.click('button', 'Paper figures');
    await page.until((state) => settled(state) && state.figureReady, 'the first figure');
  });

  await step('a design is kept, another is chosen, and both stand in one table', async () => {
    const page = await open();
    await page.until(settled, 'the first example');
    await page.click('button', 'Keep to compare');
    await page.click('button', 'Proportional');
    await page.until((state) => settled(state) && state.method === 'proportional', 'the other method');
    await page.click('button', 'Compare');
    const state = await page.until((found) => settled(found) && found.compared && found.compare.length === 2, 'the table');
    assert.ok(state.compare.every((row) => row.verified), JSON.stringify(state.compare));
    assert.deepEqual(state.compare.map((row) => row.order), [2, 3], 'rank E, and one more for the integral');
    await page.click('button', /^Use /);
    await page.until((found) => settled(found) && found.method === 'proportional-integral', 'the exchange');
    await page.page.keyboard.press('Control+Z');
    await page.until((found) => settled(found) && found.method === 'proportional', 'the undo');
  });

  await step('every method has a light with its reason, and five designs stand in one table', async () => {
    const [page, state] = await opened(open, /One plant, five observers/, 'input-decoupled');
    const lights = Object.fromEntries(state.lmi.lights);
    assert.deepEqual(lights, {
      'proportional-integral': 'Exists', proportional: 'Exists', 'input-decoupled': 'Exists', 'h-infinity-lipschitz': 'Exists',
      decentralized: 'Missing', hierarchical: 'Missing',
    }, 'there are no subsystems and no network');
    await page.click('button', 'Why: 4 of 6 methods exist');
    await seen(page, /note: Decentralized observers need subsystems/);
    await seen(page, /is seen when it is designed/);
    await page.click('button', 'Compare');
    const compared = await page.until((found) => settled(found) && found.compared && found.compare.length === 5, 'the table');
    assert.ok(compared.compare.every((row) => row.verified), JSON.stringify(compared.compare));
    assert.deepEqual(compared.compare.map((row) => row.order), [2, 2, 4, 4, 3], 'orders, the chosen design first');
    for (const line of ['Order', 'Spectrum', 'd to e', 'noise to e', 'rms e']) {
      await seen(page, new RegExp(`^note: ${line}`));
    }
    await seen(page, /note: 0, decoupled/);
  });

  await step('the trade-off of bandwidth and noise is drawn, and follows an edit', async () => {
    const page = await open();
    await page.until(settled, 'the first example');
    await page.click('button', 'Trade-off');
    await seen(page, /note: What is gained/);
    await seen(page, /note: One against the other/);
    await page.click('button', 'Full');
    await page.until((state) => settled(state) && state.order === 'full' && state.verified, 'the full order');
  });

  await step('a network is designed as a whole and one by one; a local observer is pulled out and plugged in', async () => {
    const [page, state] = await network(open);
    assert.equal(state.verified, true, JSON.stringify(state.errors));
    assert.equal(state.spectrum.length, 11, 'six of the whole, five of subsystem 4');
    const { subsystems, local, plugged, globalOrder } = state.network;
    assert.deepEqual([subsystems, local, plugged, globalOrder], [4, [4], [4], 6], 'the network of the paper');
    await page.click('button', '4: plugged in');
    const out = await page.until((found) => settled(found) && found.spectrum.length === 6, 'the whole alone');
    assert.equal(out.verified, true, JSON.stringify(out.errors));
    assert.deepEqual(out.network.plugged, [], 'no local observer');
    await page.page.keyboard.press('Control+Z');
    await page.until((found) => settled(found) && found.spectrum.length === 11, 'plugged in again');
    await page.click('button', 'Paper figures');
    await page.until((found) => settled(found) && found.figureReady, 'figure 5');
  });

  await step('a ring of a thousand subsystems is observed in the page', async () => {
    const [, state] = await opened(open, /A ring of a thousand/, 'hierarchical');
    assert.equal(state.verified, true, JSON.stringify(state.errors));
  });

  await step('on a phone the network has its place', async () => {
    const [page, state] = await network(open, { viewport: PHONE, touch: true });
    assert.equal(state.verified, true, JSON.stringify(state.errors));
    await page.click('button', 'System');
    await page.screenshot('phone-network');
  });
};
