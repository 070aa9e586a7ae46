// Editing by mouse and keyboard: the program's state changes as a person means it, and survives.
import assert from 'node:assert/strict';
import { PHONE, WIDE } from '../harness.mjs';

const settled = (state) => state.current && state.running === null;

async function ready(page) {
  return page.until(settled, 'an analysis of the shown document');
}

export default async ({ step, open, browser }) => {
  await step('the first example is analysed in a worker and verified', async () => {
    const page = await open();
    const state = await ready(page);
    assert.equal(state.verified, true, JSON.stringify(state.errors));
    assert.equal(state.conditions.length > 0, true, 'conditions are listed');
    assert.ok(state.elapsedMs > 0, 'its duration is known');
    assert.equal(state.message, null, 'no note about a missing worker');
    assert.ok(page.requests.some((address) => address.endsWith('/worker.js')), 'the worker was loaded');
    assert.equal(page.requests.filter((address) => address.endsWith('.wasm')).length, 1, 'the program only once');
  });

  await step('a typed number reaches the matrix and the design', async () => {
    const page = await open();
    const before = await ready(page);
    await page.type('textbox', 'A[1, 1]', '-1.5');
    const after = await page.until((state) => settled(state) && state.revision > before.revision, 'a new analysis');
    assert.equal(after.matrices.A[0][0], -1.5);
    assert.equal(after.verified, true, JSON.stringify(after.errors));
  });

  await step('wrong input keeps its text, and the last good value stays in force', async () => {
    const page = await open();
    const before = await ready(page);
    await page.type('textbox', 'A[1, 1]', '1/');
    const wrong = await page.until((state) => state.drafts === 1, 'a draft');
    assert.deepEqual(wrong.matrices, before.matrices);
    assert.equal(wrong.revision, before.revision);
    await page.page.waitForTimeout(200);
    assert.equal(await page.widget('textbox', 'A[1, 1]').getAttribute('data-value'), '1/');
    await page.type('textbox', 'A[1, 1]', '1/4');
    const right = await page.until((state) => state.drafts === 0, 'no draft');
    assert.equal(right.matrices.A[0][0], 0.25);
  });

  await step('typed poles are placed; undo brings the old ones back', async () => {
    const page = await open();
    const before = await ready(page);
    await page.type('textbox', 'Poles', '-10, -4+3i, -4-3i');
    const after = await page.until((state) => settled(state) && state.revision > before.revision, 'a new design');
    assert.deepEqual(after.poles, [[-10, 0], [-4, 3], [-4, -3]]);
    assert.equal(after.verified, true, JSON.stringify(after.errors));
    const placed = after.spectrum.map(([re, im]) => `${re.toFixed(3)} ${im.toFixed(3)}`).sort();
    assert.deepEqual(placed, ['-10.000 0.000', '-4.000 -3.000', '-4.000 3.000']);
    await page.click('button', 'Undo');
    const back = await page.until((state) => settled(state) && state.revision > after.revision, 'the undo');
    assert.deepEqual(back.poles, before.poles);
    assert.equal(back.canUndo, false, 'it was one step');
  });

  await step('a pole follows the mouse, and the drag is one step', async () => {
    const page = await open();
    const before = await ready(page);
    await page.click('button', 'Poles');
    await page.until((state) => state.tab === 'Poles', 'the plane of poles');
    await page.page.waitForTimeout(300);
    const [x, y] = await page.middle('slider', /^pole 1\b/);
    await page.page.mouse.move(x, y);
    await page.page.mouse.down();
    for (let k = 1; k <= 12; k += 1) await page.page.mouse.move(x - 4 * k, y);
    await page.page.mouse.up();
    await page.page.waitForTimeout(500);
    const after = await page.until((state) => settled(state) && state.revision > before.revision, 'a dragged pole');
    assert.ok(after.poles[0][0] < before.poles[0][0], `${before.poles[0]} went left to ${after.poles[0]}`);
    assert.equal(after.verified, true, JSON.stringify(after.errors));
    await page.page.keyboard.press('Control+Z');
    const back = await page.until((state) => state.revision > after.revision, 'the undo');
    assert.deepEqual(back.poles, before.poles);
    assert.equal(back.canUndo, false, 'it was one step');
  });

  await step('what was edited is there after loading the page again', async () => {
    const page = await open();
    await ready(page);
    await page.type('textbox', 'A[1, 1]', '-7');
    await page.until((state) => settled(state) && state.matrices.A[0][0] === -7, 'the edit');
    await page.page.reload();
    await page.started();
    const again = await ready(page);
    assert.equal(again.matrices.A[0][0], -7);
  });

  await step('a link holds the whole document', async () => {
    const page = await open();
    await ready(page);
    await page.type('textbox', 'Poles', '-5, -6, -7');
    const shared = await page.until((state) => settled(state) && state.poles[0][0] === -5, 'the edit');
    await page.click('button', 'File');
    await page.page.waitForTimeout(200);
    await page.click('button', 'Share link');
    await page.until((state) => state.message?.text.includes('copied the address'), 'the message');
    const address = page.page.url();
    assert.match(address, /#d1=[A-Za-z0-9_-]+$/);
    assert.equal(await page.page.evaluate(() => navigator.clipboard.readText()), address, 'it was copied');
    const other = await open({ hash: new URL(address).hash });
    const opened = await ready(other);
    assert.deepEqual(opened.poles, shared.poles);
    assert.equal(opened.title, shared.title);
    await other.type('textbox', 'Poles', '-8, -9, -10');
    await other.until((state) => settled(state) && state.poles[0][0] === -8, 'an edit of the linked document');
    assert.equal(new URL(other.page.url()).hash, '', 'the address no longer claims to hold it');
    await other.page.reload();
    await other.started();
    assert.equal((await ready(other)).poles[0][0], -8, 'and loading again keeps the edit');
  });

  await step('a damaged link says so and opens the first example', async () => {
    const page = await open({ hash: '#d1=AAAA' });
    const state = await ready(page);
    assert.equal(state.message.error, true);
    assert.match(state.message.text, /damaged|cut off/);
    assert.equal(state.verified, true, 'the first example');
  });

  await step('a document is saved, and a saved one is opened', async () => {
    const page = await open();
    const before = await ready(page);
    await page.click('button', 'File');
    await page.page.waitForTimeout(200);
    const saved = await page.download('button', 'Save document');
    assert.match(saved.name, /^[a-z0-9-]+\.json$/);
    const document = JSON.parse(saved.bytes.toString());
    document.title = 'From a file';
    await page.click('button', 'File');
    await page.page.waitForTimeout(200);
    const [chooser] = await Promise.all([
      page.page.waitForEvent('filechooser'),
      page.click('button', 'Open document'),
    ]);
    await chooser.setFiles({ name: 'mine.json', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify(document)) });
    const after = await page.until((state) => settled(state) && state.revision > before.revision, 'the opened document');
    assert.equal(after.title, 'From a file');
    assert.match(after.message.text, /opened mine\.json/);
  });

  await step('a file that is dropped is opened, one that is too large is refused unread', async () => {
    const page = await open();
    const before = await ready(page);
    const drop = (text, name) => page.page.evaluate(([content, file]) => {
      const data = new DataTransfer();
      data.items.add(new File([content], file, { type: 'application/json' }));
      document.getElementById('app').dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
    }, [text, name]);
    await drop(' '.repeat(3 << 20), 'big.json');
    const refused = await page.until((state) => state.message?.error, 'a refusal');
    assert.match(refused.message.text, /big\.json has 3\.1 MB/);
    assert.equal(refused.revision, before.revision);
    await drop('{"descry":1,"system":{"E":[[1]],"A":[[-1]],"B":[[1]],"C":[[1]],"D":[[1]]}}', 'small.json');
    const opened = await page.until((state) => state.revision > before.revision, 'the dropped document');
    assert.deepEqual(opened.matrices.A, [[-1]]);
  });

  await step('nothing is drawn while nothing happens', async () => {
    const page = await open();
    await ready(page);
    await page.page.mouse.move(5, 5);
    await page.page.waitForTimeout(2500);
    const before = (await page.state()).frames;
    await page.page.waitForTimeout(3000);
    assert.equal((await page.state()).frames - before, 0, 'pictures in three seconds');
  });

  for (const [name, options] of [
    ['edited-wide-light', { viewport: WIDE, colorScheme: 'light' }],
    ['edited-wide-dark', { viewport: WIDE, colorScheme: 'dark' }],
    ['edited-phone', { viewport: PHONE, colorScheme: 'light', touch: true }],
  ]) {
    await step(`the picture ${name} has content`, async () => {
      const page = await open(options);
      await ready(page);
      await page.page.waitForTimeout(300);
      assert.ok(await page.colours(await page.screenshot(name)) >= 40, 'more than a flat page');
    });
  }
};
