// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// Serves a folder of examples/, and of the repository what it reads: shaders, tables and scenes. `node server.js [FOLDER] [PORT]` prints the
// address; without them it is this folder, at port 8187.

import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import { extname, join, sep } from 'node:path';
import { fileURLToPath } from 'node:url';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const SERVED = ['examples', 'shaders', 'tables', 'assets'].map((folder) => join(ROOT, folder) + sep);
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json' };

async function answer(request, response) {
    try {
        const path = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
        // Joined first: dots may lead out of a folder.
        const file = join(ROOT, path.endsWith('/') ? `${path}index.html` : path);
        if (!SERVED.some((folder) => file.startsWith(folder))) throw new Error('not served');
        const bytes = await readFile(file);
        const type = TYPES[extname(file)] ?? 'application/octet-stream';
        response.writeHead(200, { 'content-type': `${type}; charset=utf-8`, 'cache-control': 'no-cache' }).end(bytes);
    } catch {
        response.writeHead(404).end();
    }
}

// Port 0 takes any that is free.
export function serve(folder, port) {
    const server = createServer(answer);
    return new Promise((resolve, reject) => {
        server.once('error', reject);
        server.listen(port, '127.0.0.1', () => resolve({ server, url: `http://localhost:${server.address().port}/examples/${folder}/` }));
    });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const [folder = 'three', port = 8187] = process.argv.slice(2);
    const { url } = await serve(folder, Number(port)).catch((error) => (
        error.code === 'EADDRINUSE' ? serve(folder, 0) : Promise.reject(error)
    ));
    console.log(`Open ${url} (Ctrl-C ends it)`);
}
