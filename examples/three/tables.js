// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// The tables and shaders of the repository, fetched. Change REPOSITORY to where your copies lie.

import { DataTexture, HalfFloatType, NearestFilter, RGBAFormat } from 'three';

const REPOSITORY = new URL('../../', import.meta.url);

async function fetched(path) {
    const url = new URL(path, REPOSITORY);
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url}: ${response.status}; REPOSITORY in tables.js says where files are looked for`);
    return response;
}

export async function text(path) {
    return (await fetched(path)).text();
}

// A table of half floats, RGBA, behind a DX10 header of 148 bytes. Shaders read its texels one by one, with weights of their own.
export async function table(path) {
    const bytes = await (await fetched(path)).arrayBuffer();
    const header = new DataView(bytes);
    const [height, width] = [header.getUint32(12, true), header.getUint32(16, true)];
    const texture = new DataTexture(new Uint16Array(bytes, 148), width, height, RGBAFormat, HalfFloatType);
    texture.minFilter = texture.magFilter = NearestFilter;
    texture.needsUpdate = true;
    return texture;
}
