// The page starts, everywhere, and says why when it cannot.
import assert from 'node:assert/strict';
import { PHONE, WIDE } from '../harness.mjs';

const PICTURES = [
  ['wide-light', { viewport: WIDE, colorScheme: 'light' }],
  ['wide-dark', { viewport: WIDE, colorScheme: 'dark' }],
  ['phone-light', { viewport: PHONE, colorScheme: 'light', touch: true }],
];

// More than a spinner on a flat page has; a window with text has hundreds.
const FEWEST_COLOURS = 40;

export default async ({ step, open, url }) => {
  await step('the first picture replaces the loading text', async () => {
    const page = await open();
    assert.equal(await page.page.locator('#loading').count(), 0, 'the loading text is gone');
    assert.equal(await page.page.locator('#failure').isVisible(), false, 'no failure is shown');
    assert.notEqual(await page.state(), undefined, 'the program has a state');
  });

  await step('the mirror names the widgets', async () => {
    const page = await open();
    const widgets = await page.widgets();
    assert.ok(widgets.length > 0, 'there are widgets');
    const nameless = widgets.filter((widget) => widget.endsWith(': '));
    assert.deepEqual(nameless, [], 'every widget has a name');
    assert.equal(await page.page.locator('#a11y [tabindex]').count(), 0, 'the keyboard belongs to the canvas');
  });

  await step('nothing is asked of other machines', async () => {
    const page = await open();
    const foreign = page.requests.filter((address) => !/^(data|blob):/.test(address) && !address.startsWith(url));
    assert.deepEqual(foreign, []);
  });

  for (const [name, options] of PICTURES) {
    await step(`the picture ${name} is not blank`, async () => {
      const page = await open(options);
      const colours = await page.colours(await page.screenshot(name));
      assert.ok(colours >= FEWEST_COLOURS, `only ${colours} colours`);
    });
  }

  await step('a browser without WebGL 2 is told so', async () => {
    const page = await open({
      wait: false,
      init: () => { HTMLCanvasElement.prototype.getContext = () => null; },
    });
    await page.page.waitForSelector('#failure:not([hidden])');
    assert.match(await page.page.locator('#failure-reason').innerText(), /WebGL 2/);
    await page.screenshot('failure-webgl');
  });

  await step('a browser without WebAssembly is told so', async () => {
    const page = await open({ wait: false, init: () => { delete globalThis.WebAssembly; } });
    await page.page.waitForSelector('#failure:not([hidden])');
    assert.match(await page.page.locator('#failure-reason').innerText(), /no WebAssembly/);
  });

  await step('a failure of the running program is shown with its text', async () => {
    const page = await open({ colorScheme: 'dark', viewport: PHONE });
    await page.page.evaluate(() => window.descry_fail('first reason'));
    await page.page.evaluate(() => window.descry_fail('second reason'));
    assert.equal(await page.page.locator('#failure-reason').innerText(), 'first reason', 'the cause stays');
    assert.equal(await page.page.locator('#failure-title').innerText(), 'descry stopped at an error');
    assert.equal(await page.page.locator('#a11y > *').count(), 0, 'what is not visible any more is not read aloud');
    await page.screenshot('failure-stop');
  });
};
