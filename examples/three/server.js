// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// Serves this folder, and of the repository what it reads: shaders, tables and scenes. `node server.js [PORT]` prints the address.

import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import { extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const PAGE = '/examples/three/';
const SERVED = [PAGE, '/shaders/', '/tables/', '/assets/'];
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json' };

async function answer(request, response) {
    const path = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
    if (path === '/') {
        response.writeHead(302, { location: PAGE }).end();
        return;
    }
    try {
        if (!SERVED.some((folder) => path.startsWith(folder))) throw new Error('not served');
        const file = path.endsWith('/') ? `${path}index.html` : path;
        const bytes = await readFile(join(ROOT, file));
        const type = TYPES[extname(file)] ?? 'application/octet-stream';
        response.writeHead(200, { 'content-type': `${type}; charset=utf-8`, 'cache-control': 'no-cache' }).end(bytes);
    } catch {
        response.writeHead(404).end();
    }
}

// Port 0 takes any that is free.
export function serve(port) {
    const server = createServer(answer);
    return new Promise((resolve, reject) => {
        server.once('error', reject);
        server.listen(port, '127.0.0.1', () => resolve({ server, url: `http://localhost:${server.address().port}${PAGE}` }));
    });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const port = Number(process.argv[2] ?? 8187);
    const { url } = await serve(port).catch((error) => (error.code === 'EADDRINUSE' ? serve(0) : Promise.reject(error)));
    console.log(`Open ${url} (add ?webgl for WebGL 2). Ctrl-C ends it.`);
}
