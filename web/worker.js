// One worker is one more instance of the page's own program.
//   in:  the compiled WebAssembly.Module (no second download, no second compilation), then jobs as Uint8Array
//   out: the string 'ready', then replies as Uint8Array, which the program posts itself
import init, { worker_run } from './descry.js';

let ready = null;

// Inside a promise an error would be lost here: this way it reaches `onerror` of the page's Worker.
const report = (error) => setTimeout(() => { throw error; });

self.onmessage = ({ data }) => {
  if (ready === null) {
    ready = init({ module_or_path: data });
    ready.then(() => self.postMessage('ready')).catch(report);
  } else {
    ready.then(() => worker_run(data)).catch(report);
  }
};
