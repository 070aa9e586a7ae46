// Starts the program, shows why it cannot start or why it stopped, and mirrors what it draws for screen readers.
//
//   window.descry        the program's module once it is loaded (debug_state, ...)
//   descry_fail(text)    the program reports why it cannot go on
//   descry_a11y(json)    the program reports what the canvas shows
// `<body data-started>` says that the first picture is up.

const byId = (id) => document.getElementById(id);

// ---- Failures ------------------------------------------------------------------------------------------------------

const ADVICE = {
  webassembly: ['Use a current version of Firefox, Chrome, Edge or Safari.',
    'Where WebAssembly was switched off (by a policy, or by a strict security mode), allow it for this page.'],
  webgl: ['Switch on graphics acceleration in the settings of the browser, then start the browser again.',
    'Update the browser and the graphics driver, or try another browser.',
    'The native program needs no browser: run cargo run --release in the project\'s folder.'],
  network: ['Check the connection to the network, then load the page again.',
    'If it goes on: the files of the page may be incomplete. Build them again with cargo xtask web.'],
  start: ['Load the page again.', 'Update the browser, or try another one.'],
  stop: ['Load the page again.', 'If it happens again: keep the text above, it says where the program stopped.'],
};

let failed = false;

/** Shows the reason over the canvas. The first reason is the cause of the later ones, so it stays. */
function fail(kind, reason) {
  if (failed) return;
  failed = true;
  byId('loading')?.remove();
  byId('app').hidden = true;
  byId('a11y').replaceChildren();
  const stopped = kind === 'stop';
  byId('failure-title').textContent = stopped ? 'descry stopped at an error' : 'descry could not start';
  byId('failure-reason').textContent = String(reason);
  byId('failure-advice').replaceChildren(...ADVICE[kind].map((text) => {
    const item = document.createElement('li');
    item.textContent = text;
    return item;
  }));
  byId('failure-reload').onclick = () => location.reload();
  byId('failure').hidden = false;
  // Later: the program may be in the middle of a picture, and moving the focus calls it.
  setTimeout(() => byId('failure-reload').focus());
}

const started = () => 'started' in document.body.dataset;

window.descry_fail = (text) => fail(started() ? 'stop' : 'start', text);

// Once the program runs, only its own traps end it: extensions and the browser itself also raise errors in a page.
function onError(error, message) {
  const own = error instanceof WebAssembly.RuntimeError;
  if (own || !started()) fail(started() ? 'stop' : 'start', error?.stack || message || error);
}

// ---- Mirror --------------------------------------------------------------------------------------------------------

const CHECKED = new Set(['checkbox', 'radio', 'switch', 'menuitemcheckbox', 'menuitemradio', 'option']);
const VALUED = new Set(['spinbutton', 'slider', 'progressbar', 'meter', 'scrollbar']);
const NAMED_BY_TEXT = new Set(['note', 'paragraph', 'heading', 'text']);

/** Sets an attribute, or removes it; an unchanged one is not touched (screen readers read changes aloud). */
function attribute(element, name, value) {
  if (value === null || value === undefined || value === '') element.removeAttribute(name);
  else if (element.getAttribute(name) !== String(value)) element.setAttribute(name, value);
}

/** Writes text only when it is another one. */
function text(element, value) {
  if (element.textContent !== value) element.textContent = value;
}

function describe(element, node) {
  const [x, y, width, height] = node.rect;
  element.style.cssText = `left:${x}px;top:${y}px;width:${width}px;height:${height}px`;
  const value = node.value ?? '';
  const role = node.role;
  attribute(element, 'role', role === 'text' ? 'note' : role);
  attribute(element, 'aria-label', node.name || value);
  attribute(element, 'aria-disabled', node.disabled ? 'true' : null);
  attribute(element, 'aria-level', role === 'heading' ? '2' : null);
  const checked = node.checked ?? null;
  attribute(element, 'aria-checked', CHECKED.has(role) ? checked ?? false : null);
  attribute(element, 'aria-pressed', role === 'button' ? checked : null);
  attribute(element, 'aria-selected', role === 'tab' ? checked : null);
  const numeric = VALUED.has(role) && value !== '' && Number.isFinite(Number(value));
  attribute(element, 'aria-valuenow', numeric ? Number(value) : null);
  attribute(element, 'aria-valuetext', VALUED.has(role) ? value : null);
  attribute(element, 'data-value', value);
  attribute(element, 'data-focused', node.focused ? 'true' : null);
  text(element, NAMED_BY_TEXT.has(role) ? node.name || value : role === 'textbox' ? value : '');
}

const mirrored = new Map();

/**
 * Keeps one element per widget over the canvas, without a tabindex: the keyboard belongs to the canvas.
 * Elements stay the same as long as their widgets do, so that a reader keeps its place.
 */
window.descry_a11y = (json) => {
  if (failed) return;
  const nodes = JSON.parse(json);
  const status = nodes.filter((node) => node.role === 'status').map((node) => node.value || node.name).join('\n');
  text(byId('status'), status);
  const host = byId('a11y');
  const gone = new Set(mirrored.keys());
  let previous = null;
  for (const node of nodes) {
    if (node.role === 'status') continue;
    const key = String(node.id);
    let element = mirrored.get(key);
    if (!element) {
      element = document.createElement('div');
      mirrored.set(key, element);
    }
    gone.delete(key);
    describe(element, node);
    const place = previous ? previous.nextSibling : host.firstChild;
    if (place !== element) host.insertBefore(element, place);
    previous = element;
  }
  for (const key of gone) {
    mirrored.get(key).remove();
    mirrored.delete(key);
  }
  if (!started()) requestAnimationFrame(firstPicture);
};

// ---- Start ---------------------------------------------------------------------------------------------------------

function firstPicture() {
  if (failed || started()) return;
  byId('loading')?.remove();
  document.body.dataset.started = '';
  performance.mark('first-picture');
}

/** A program without a mirror has started once it has a state. */
function watch(app) {
  if (failed || started()) return;
  if (app.debug_state?.() !== undefined) requestAnimationFrame(firstPicture);
  else requestAnimationFrame(() => watch(app));
}

async function start() {
  if (typeof WebAssembly !== 'object') return fail('webassembly', 'This browser has no WebAssembly.');
  window.addEventListener('error', (event) => onError(event.error, event.message));
  window.addEventListener('unhandledrejection', (event) => onError(event.reason));
  if (!document.createElement('canvas').getContext('webgl2')) {
    return fail('webgl', 'This browser offers no WebGL 2, which draws the page.');
  }
  performance.mark('boot');
  let app;
  try {
    app = await import('./descry.js');
  } catch (error) {
    return fail('network', `The program's file descry.js could not be loaded.\n${error}`);
  }
  const url = new URL('descry_bg.wasm', import.meta.url);
  let program;
  try {
    program = await fetch(url);
  } catch (error) {
    return fail('network', `The program's file descry_bg.wasm could not be loaded.\n${error}`);
  }
  if (!program.ok) return fail('network', `The program's file descry_bg.wasm could not be loaded: ${program.status}`);
  window.descry = app;
  try {
    await app.default({ module_or_path: program });
  } catch (error) {
    return fail('start', error?.stack || error);
  }
  performance.mark('program-ready');
  watch(app);
}

start();
