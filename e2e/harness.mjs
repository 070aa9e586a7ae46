// The page in a browser, as a person and as a screen reader meet it. Tests find widgets by role and name in the
// mirror of the canvas (web/boot.js) and read the program's state as JSON.
import { accessSync, constants, mkdirSync } from 'node:fs';
import { delimiter, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

const OUT = join(dirname(fileURLToPath(import.meta.url)), 'out');

// The same names as in xtask/src/setup.rs.
const BROWSERS = ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable', 'chrome'];
const MAC_BROWSER = '/Applications/Google Chrome.app/Contents/MacOS/Google Chrome';
// WebGL 2 works without a graphics card by Chromium's own software renderer, without further arguments.
const ARGUMENTS = [
  '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
  '--disable-sync',
];

export const WIDE = { width: 1280, height: 800 };
export const PHONE = { width: 390, height: 844 };

function isProgram(file) {
  try {
    accessSync(file, constants.X_OK);
    return true;
  } catch {
    return false;
  }
}

function findBrowser() {
  if (process.env.CHROME) return process.env.CHROME;
  const folders = (process.env.PATH ?? '').split(delimiter);
  const files = BROWSERS.flatMap((name) => folders.map((folder) => join(folder, name)));
  const found = [...files, MAC_BROWSER].find(isProgram);
  if (!found) throw new Error(`no browser found: install Chromium or set CHROME (looked for ${BROWSERS.join(', ')})`);
  return found;
}

export function launch() {
  return chromium.launch({ executablePath: findBrowser(), headless: true, args: ARGUMENTS });
}

/** One page with the program running in it. */
export class Page {
  /** Console errors and uncaught errors so far. A test that provokes one takes it out of the list. */
  errors = [];
  /** The addresses of everything that the page asked for. */
  requests = [];

  /**
   * Opens the page and waits for its first picture.
   * Options: viewport, colorScheme ('light' | 'dark'), hash (with '#'), touch, context (another page's, to share its
   * storage), init (a function that runs in the page before anything else), wait (false: do not wait).
   */
  static async open(browser, url, options = {}) {
    const self = new Page();
    self.viewport = options.viewport ?? WIDE;
    self.ownsContext = !options.context;
    self.context = options.context ?? await browser.newContext({
      viewport: self.viewport,
      colorScheme: options.colorScheme ?? 'light',
      hasTouch: options.touch ?? false,
      acceptDownloads: true,
      permissions: ['clipboard-read', 'clipboard-write'],
    });
    self.page = await self.context.newPage();
    self.page.on('console', (message) => { if (message.type() === 'error') self.errors.push(message.text()); });
    self.page.on('pageerror', (error) => self.errors.push(error.stack ?? error.message));
    self.page.on('request', (request) => self.requests.push(request.url()));
    if (options.init) await self.page.addInitScript(options.init);
    try {
      await self.page.goto(url + (options.hash ?? ''));
      if (options.wait !== false) await self.started();
    } catch (error) {
      await self.screenshot('failed-start').catch(() => {});
      await self.close();
      throw new Error(`${error.message}\nlogged: ${brief(self.errors.join('\n') || 'nothing')}`);
    }
    return self;
  }

  /** Waits for the first picture; when the page reports a failure instead, throws its reason. */
  async started(timeout = 60_000) {
    await this.page.waitForSelector('body[data-started], #failure:not([hidden])', { timeout });
    const failure = this.page.locator('#failure:not([hidden])');
    if (await failure.count()) throw new Error(`the page reports: ${await failure.innerText()}`);
  }

  /** The program's state, or undefined before it runs. */
  async state() {
    const json = await this.page.evaluate(() => window.descry?.debug_state());
    return json === undefined ? undefined : JSON.parse(json);
  }

  /** Waits until the predicate holds for the program's state, and returns that state. */
  async until(predicate, what = String(predicate), timeout = 30_000) {
    const end = Date.now() + timeout;
    for (;;) {
      const state = await this.state();
      if (state !== undefined && predicate(state)) return state;
      if (Date.now() > end) throw new Error(`waited ${timeout} ms for ${what}; state: ${brief(JSON.stringify(state))}`);
      await this.page.waitForTimeout(50);
    }
  }

  /** The mirror's element; `name` is a string (the whole name) or a regular expression. */
  widget(role, name) {
    return this.page.locator('#a11y').getByRole(role, { name, exact: typeof name === 'string', includeHidden: true }).first();
  }

  /** Every widget as `role: name = value`, in the order of the mirror. */
  widgets() {
    return this.page.locator('#a11y > *').evaluateAll((elements) => elements.map((element) => {
      const value = element.dataset.value === undefined ? '' : ` = ${element.dataset.value}`;
      return `${element.getAttribute('role')}: ${element.getAttribute('aria-label') ?? ''}${value}`;
    }));
  }

  /** Clicks the middle of a widget, with the mouse: what the canvas gets is what it gets from a person. */
  async click(role, name, options = {}) {
    const [x, y] = await this.middle(role, name);
    await this.page.mouse.click(x, y, options);
    // egui needs a picture to move the focus to its text input.
    await this.page.waitForTimeout(100);
  }

  async middle(role, name) {
    const widget = this.widget(role, name);
    try {
      await widget.waitFor({ state: 'attached', timeout: 10_000 });
    } catch {
      throw new Error(`no ${role} ${name}; there are: ${brief((await this.widgets()).join(', '))}`);
    }
    const { x, y, width, height } = await widget.boundingBox();
    const [right, bottom] = [x + width / 2, y + height / 2];
    if (right < 0 || bottom < 0 || right > this.viewport.width || bottom > this.viewport.height) {
      throw new Error(`${role} ${name} is outside the window at ${right}, ${bottom}: scroll first`);
    }
    return [right, bottom];
  }

  /** Turns the wheel over a widget. */
  async wheel(role, name, deltaY) {
    const [x, y] = await this.middle(role, name);
    await this.page.mouse.move(x, y);
    await this.page.mouse.wheel(0, deltaY);
    await this.page.waitForTimeout(200);
  }

  /** Clicks a widget, replaces its text and presses `end` (null: nothing). */
  async type(role, name, text, end = 'Enter') {
    await this.click(role, name);
    await this.page.keyboard.press('Control+A');
    await this.page.keyboard.type(text);
    if (end) await this.page.keyboard.press(end);
  }

  /** Pastes text where the focus is. */
  async paste(text) {
    await this.page.evaluate((value) => navigator.clipboard.writeText(value), text);
    await this.page.keyboard.press('Control+V');
  }

  /** Saves a picture as `e2e/out/<name>.png` and returns its bytes. */
  screenshot(name) {
    mkdirSync(OUT, { recursive: true });
    return this.page.screenshot({ path: join(OUT, `${name}.png`) });
  }

  /** How many colours a picture has: a blank page has one, text with smooth edges has dozens. */
  async colours(picture) {
    return await this.page.evaluate(async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
      context.drawImage(image, 0, 0);
      const { data } = context.getImageData(0, 0, image.width, image.height);
      return new Set(new Uint32Array(data.buffer)).size;
    }, picture.toString('base64'));
  }

  /** Reads the text that a click makes the page save. */
  async download(role, name) {
    const [download] = await Promise.all([
      this.page.waitForEvent('download', { timeout: 10_000 }),
      this.click(role, name),
    ]);
    const chunks = [];
    for await (const chunk of await download.createReadStream()) chunks.push(chunk);
    return { name: download.suggestedFilename(), bytes: Buffer.concat(chunks) };
  }

  /** Closes the page, and what it stored unless another page shares it. */
  close() {
    return this.ownsContext ? this.context.close() : this.page.close();
  }
}

function brief(text = 'none') {
  return text.length > 1500 ? `${text.slice(0, 1500)} ...` : text;
}
