// Designs by linear matrix inequalities, in the page: examples, sliders, infeasible demands, figures, cancel.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { PHONE } from '../harness.mjs';

const settled = (state) => state.current && state.running === null;

async function opened(open, name, options) {
  const page = await open(options);
  await page.until(settled, 'the first example');
  await page.click('button', 'Examples');
  await page.click('button', name);
  return [page, await page.until((state) => settled(state) && state.method !== 'proportional-integral', name)];
}

const near = (found, expected, relative) => Math.abs(found - expected) <= relative * Math.abs(expected);

export default async ({ step, open }) => {
  await step('the H-infinity observer of the Lipschitz example is designed, certified and simulated', async () => {
    const [, state] = await opened(open, /H-infinity observer with a Lipschitz term/);
    assert.equal(state.verified, true, JSON.stringify(state.errors));
    const [result] = state.lmi;
    assert.equal(result.proved, true, JSON.stringify(result));
    // least gamma^2 with decay 0.5, computed by two other solvers
    assert.ok(near(result.gammaBest, Math.sqrt(5.24633037), 1e-4), `${result.gammaBest}`);
    assert.ok(near(result.gamma, 1.01 * result.gammaBest, 1e-3), `one percent back: ${result.gamma}`);
    assert.ok(state.rms.every((value) => value < 0.5), `the estimate follows: ${state.rms}`);
  });

  await step('both subsystems of the decentralized example have a certified observer', async () => {
    const [, state] = await opened(open, /Decentralized observers of two/);
    assert.equal(state.verified, true, JSON.stringify(state.errors));
    assert.equal(state.lmi.length, 2);
    assert.ok(near(state.lmi[0].gammaBest, 0.002 / 0.998, 1e-3), `${state.lmi[0].gammaBest}`);
    assert.ok(near(state.lmi[1].gammaBest, 0.0008 / 0.9996, 1e-3), `${state.lmi[1].gammaBest}`);
    assert.ok(state.lmi.every((result) => result.proved), JSON.stringify(state.lmi));
  });
};
