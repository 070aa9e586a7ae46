// Designs by linear matrix inequalities, in the page: examples, sliders, infeasible demands, figures, cancel.
import assert from 'node:assert/strict';
import { PHONE } from '../harness.mjs';

const settled = (state) => state.current && state.running === null;
const near = (found, expected, relative) => Math.abs(found - expected) <= relative * Math.abs(expected);

async function opened(open, name, method, options) {
  const page = await open(options);
  await page.until(settled, 'the first example');
  await page.click('button', 'Examples');
  await page.click('button', name);
  return [page, await page.until((state) => settled(state) && state.method === method, `${name}`)];
}

const lipschitz = (open, options) => opened(open, /H-infinity observer with a Lipschitz/, 'h-infinity-lipschitz', options);
const decentralized = (open, options) => opened(open, /Decentralized observers of two/, 'decentralized', options);

export default async ({ step, open }) => {
  await step('the H-infinity observer of the Lipschitz example is designed, certified and simulated', async () => {
    const [, state] = await lipschitz(open);
    assert.equal(state.verified, true, JSON.stringify(state.errors));
    const [result] = state.lmi.results;
    assert.equal(result.proved, true, JSON.stringify(result));
    // least gamma^2 with decay 0.5 as two other solvers find it
    assert.ok(near(result.gammaBest, Math.sqrt(5.24633037), 1e-4), `${result.gammaBest}`);
    assert.ok(near(result.gamma, 1.01 * result.gammaBest, 1e-3), `one percent back: ${result.gamma}`);
    assert.ok(state.rms.length === 3 && state.rms.every((value) => value < 0.5), `the estimate follows: ${state.rms}`);
  });

  await step('more decay costs attenuation, and the slider is one step of the history', async () => {
    const [page, before] = await lipschitz(open);
    const [x, y] = await page.middle('slider', 'Decay rate');
    await page.page.mouse.move(x, y);
    await page.page.mouse.down();
    for (let k = 1; k <= 6; k += 1) await page.page.mouse.move(x + k, y);
    await page.page.mouse.up();
    const after = await page.until((state) => settled(state) && state.lmi.decay !== before.lmi.decay, 'another decay');
    assert.ok(after.lmi.decay > before.lmi.decay, `${after.lmi.decay}`);
    if (after.verified) {
      assert.ok(after.lmi.results[0].gammaBest > before.lmi.results[0].gammaBest, JSON.stringify(after.lmi.results));
    }
    await page.page.keyboard.press('Control+Z');
    const back = await page.until((state) => settled(state) && state.lmi.decay === before.lmi.decay, 'the undo');
    assert.equal(back.verified, true, JSON.stringify(back.errors));
  });

  await step('a decay beyond the feasible is refused with what would be feasible', async () => {
    const [page] = await lipschitz(open);
    await page.type('spinbutton', 'Decay rate value', '3');
    const state = await page.until((found) => settled(found) && found.lmi.decay === 3, 'the refusal', 60_000);
    assert.equal(state.verified, false);
    assert.ok(state.lmi.infeasible, 'the block that stops it is named');
    const offers = (await page.widgets()).filter((widget) => /^button: Use /i.test(widget));
    assert.ok(offers.length > 0, `a button applies a feasible demand: ${await page.widgets()}`);
  });

  await step('both subsystems of the decentralized example have a certified observer', async () => {
    const [page, state] = await decentralized(open);
    assert.equal(state.verified, true, JSON.stringify(state.errors));
    assert.equal(state.subsystems, 2);
    const [first, second] = state.lmi.results;
    assert.ok(near(first.gammaBest, 0.002 / 0.998, 1e-3), `${first.gammaBest}`);
    assert.ok(near(second.gammaBest, 0.0008 / 0.9996, 1e-3), `${second.gammaBest}`);
    assert.ok(first.proved && second.proved, JSON.stringify(state.lmi));
    await page.click('button', 'Paper figures');
    const shown = await page.until((found) => found.figureReady, 'Fig. 1');
    assert.equal(shown.figure, 'fig1');
  });

  await step('an unfinished design can be cancelled, and the page stays alive', async () => {
    const [page, before] = await lipschitz(open);
    await page.type('spinbutton', 'Decay rate value', '2.5');
    await page.until((state) => state.running !== null || (state.current && state.lmi.decay === 2.5), 'a running design');
    if ((await page.state()).running !== null) await page.click('button', 'Cancel').catch(() => {});
    await page.page.keyboard.press('Control+Z');
    const back = await page.until((state) => settled(state) && state.lmi.decay === before.lmi.decay, 'the undo', 60_000);
    assert.equal(back.verified, true, JSON.stringify(back.errors));
  });

  await step('both designs are usable on a phone', async () => {
    const [page, state] = await lipschitz(open, { viewport: PHONE, touch: true });
    assert.equal(state.verified, true, JSON.stringify(state.errors));
    await page.click('button', 'Observer');
    await page.middle('slider', 'Decay rate');
  });
};
