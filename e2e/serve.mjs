// A static server for the finished page, on a free port and under a path: like a project page of a web host.
import { createServer } from 'node:http';
import { readFile, realpath } from 'node:fs/promises';
import { extname, join, sep } from 'node:path';

const TYPES = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.json': 'application/json',
  '.wasm': 'application/wasm',
};

const PREFIX = '/some/path/';

/** The file that a request means, or null when it is outside the folder. */
async function fileOf(root, url) {
  const path = decodeURIComponent(new URL(url, 'http://localhost').pathname);
  if (!path.startsWith(PREFIX)) return null;
  const file = await realpath(join(root, path.slice(PREFIX.length) || 'index.html'));
  return file.startsWith(root + sep) ? file : null;
}

/** Serves the folder; `url` is the page's address, `close()` ends the server. */
export async function serve(folder) {
  const root = await realpath(folder);
  const server = createServer(async (request, response) => {
    try {
      const file = await fileOf(root, request.url);
      const body = file && await readFile(file);
      if (body) response.writeHead(200, { 'content-type': TYPES[extname(file)] ?? 'application/octet-stream' }).end(body);
      else response.writeHead(404).end();
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const close = () => new Promise((resolve) => { server.close(resolve); server.closeAllConnections(); });
  return { url: `http://127.0.0.1:${server.address().port}${PREFIX}`, close };
}
