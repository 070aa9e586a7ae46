// node e2e/run.mjs DIST [NAME ...]: runs e2e/tests/*.mjs (or those named) in the order of their names.
//
// A test file exports `default async ({ step, open, url, browser }) => { ... }`:
//   open(options)       opens the page (see Page.open in harness.mjs) and closes it after the file
//   step(what, work)    one statement; it fails when `work` throws, and the file goes on. A picture of the page
//                       that was opened last is then in e2e/out/failed-*.png
// Every file ends with a step of its own: its pages logged no errors.
import { readdirSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import assert from 'node:assert/strict';
import { launch, Page } from './harness.mjs';
import { serve } from './serve.mjs';

const TESTS = join(dirname(fileURLToPath(import.meta.url)), 'tests');

function testFiles(names) {
  const all = readdirSync(TESTS).filter((file) => file.endsWith('.mjs')).sort();
  const chosen = all.filter((file) => names.length === 0 || names.includes(basename(file, '.mjs')));
  if (chosen.length === 0) throw new Error(`no such test; there are: ${all.map((file) => basename(file, '.mjs')).join(', ')}`);
  return chosen;
}

class Tally {
  passed = 0;
  failed = 0;

  /** Runs one step; `onFailure` may keep evidence. */
  async step(what, work, onFailure = () => {}) {
    const start = Date.now();
    try {
      await work();
      this.passed += 1;
      console.log(`ok    ${what} (${Date.now() - start} ms)`);
    } catch (error) {
      this.failed += 1;
      console.log(`FAIL  ${what} (${Date.now() - start} ms)\n      ${String(error.stack ?? error).replaceAll('\n', '\n      ')}`);
      await onFailure();
    }
  }
}

async function runFile(file, browser, url, tally) {
  const name = basename(file, '.mjs');
  const pages = [];
  const open = async (options) => {
    const page = await Page.open(browser, url, options);
    pages.push(page);
    return page;
  };
  const picture = () => pages.at(-1)?.screenshot(`failed-${name}-${tally.failed}`).catch(() => {});
  const step = (what, work) => tally.step(`${name}: ${what}`, work, picture);
  const { default: test } = await import(pathToFileURL(join(TESTS, file)));
  try {
    await test({ step, open, url, browser });
  } catch (error) {
    await step('runs to its end', () => { throw error; });
  }
  await step('no errors were logged', () => assert.deepEqual(pages.flatMap((page) => page.errors), []));
  for (const page of pages) await page.close();
}

async function main([dist, ...names]) {
  if (!dist) throw new Error('which folder? node e2e/run.mjs dist [NAME ...]');
  const files = testFiles(names);
  const tally = new Tally();
  const server = await serve(dist);
  try {
    const browser = await launch();
    try {
      for (const file of files) await runFile(file, browser, server.url, tally);
    } finally {
      await browser.close();
    }
  } finally {
    // An open server would keep this program alive for ever.
    await server.close();
  }
  console.log(`${tally.passed} passed, ${tally.failed} failed`);
  if (tally.failed > 0) process.exitCode = 1;
}

try {
  await main(process.argv.slice(2));
} catch (error) {
  console.error(`error: ${error.message}`);
  process.exitCode = 1;
}
