// SPDX-License-Identifier: MIT OR Apache-2.0
// SPDX-FileCopyrightText: 2026 The Velour authors
// Opens the exported tables in the loaders of three.js and Babylon.js, and compares them with the .csv.
//
//     cargo build && cd tests/loaders && npm install && npm test
//
// VELOUR names another program than target/debug/velour.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';

import { DDSTools } from '@babylonjs/core/Misc/dds.js';
import { _DDSTextureLoader } from '@babylonjs/core/Materials/Textures/Loaders/ddsTextureLoader.js';
import * as THREE from 'three';
import { DDSLoader } from 'three/examples/jsm/loaders/DDSLoader.js';
import { EXRLoader } from 'three/examples/jsm/loaders/EXRLoader.js';
import { KTX2Loader } from 'three/examples/jsm/loaders/KTX2Loader.js';

const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
const program = process.env.VELOUR ?? join(root, 'target', 'debug', 'velour');
let folder;

before(() => {
    folder = mkdtempSync(join(tmpdir(), 'velour-'));
    execFileSync(program, ['export', 'tables', '-o', folder]);
    execFileSync(program, ['export', 'tables', '-o', folder, '--only', 'sheen', '--format', 'ktx2', '--size', '16']);
});
after(() => rmSync(folder, { recursive: true }));

function buffer(name) {
    const bytes = readFileSync(join(folder, name));
    return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
}

// a, b, r of the node (alpha, mu), and the specular base's columns of (roughness, t), by the .csv.
function nodes(name) {
    const lines = readFileSync(join(folder, name), 'utf8').split('\n').filter((line) => /^[0-9]/.test(line));
    const rows = lines.map((line) => line.split(',').slice(2).map(Number));
    return (x, y) => rows[32 * x + y];
}

// The texel (x, y) as it should be.
function expected(stem) {
    const node = nodes(`${stem}.csv`);
    if (stem === 'sheen_ltc') return { height: 32, texel: (x, y) => [...node(x, y), 1] };
    const lower = (x, y) => [node(x, y)[3], node(x, y)[4], 0, 1];
    return { height: 64, texel: (x, y) => (y < 32 ? [...node(x, y).slice(0, 3), 1] : lower(x, y - 32)) };
}

// Whether halves, in rows, are a table; `place` says where a reader looks for the texel (x, y).
function holds(halves, stem, place = (x, y) => 32 * y + x) {
    const { height, texel } = expected(stem);
    if (halves.length !== 32 * height * 4) return false;
    for (let y = 0; y < height; y++) {
        for (let x = 0; x < 32; x++) {
            const should = texel(x, y);
            for (let c = 0; c < 4; c++) {
                const found = THREE.DataUtils.fromHalfFloat(halves[4 * place(x, y) + c]);
                if (!(Math.abs(found - should[c]) <= Math.abs(should[c]) * 4.9e-4 + 3.1e-8)) return false;
            }
        }
    }
    return true;
}

function check(halves, stem) {
    assert.ok(holds(halves, stem), stem);
    const { height } = expected(stem);
    assert.ok(!holds(halves, stem, (x, y) => 32 * (32 * Math.floor(y / 32) + x) + (y % 32)), `${stem} transposed`);
    assert.ok(!holds(halves, stem, (x, y) => 32 * (height - 1 - y) + x), `${stem} upside down`);
}

const STEMS = ['sheen_ltc', 'ggx_ltc'];

test('three: KTX2Loader opens the .ktx2 without a transcoder', async () => {
    for (const stem of STEMS) {
        const loader = new KTX2Loader();
        loader.workerConfig = {}; // what detectSupport() would fill: nothing of it matters for halves
        const texture = await new Promise((done, fail) => loader.parse(buffer(`${stem}.ktx2`), done, fail));
        assert.ok(texture.isDataTexture);
        assert.equal(texture.type, THREE.HalfFloatType);
        assert.equal(texture.format, THREE.RGBAFormat);
        assert.equal(texture.colorSpace, THREE.NoColorSpace);
        assert.equal(texture.flipY, false);
        assert.equal(texture.generateMipmaps, false);
        assert.equal(texture.minFilter, THREE.NearestFilter);
        check(texture.image.data, stem);
    }
});

test('three: KTX2Loader opens a small table by its own name', async () => {
    const loader = new KTX2Loader();
    loader.workerConfig = {};
    const { image } = await new Promise((done, fail) => loader.parse(buffer('sheen_ltc_16.ktx2'), done, fail));
    assert.deepEqual([image.width, image.height, image.data.length], [16, 16, 16 * 16 * 4]);
});

test('three: the module of JavaScript is what DataTexture takes', async () => {
    for (const [stem, name] of [['sheen_ltc', 'sheenLtc'], ['ggx_ltc', 'ggxLtc']]) {
        const code = readFileSync(join(folder, `${stem}.js`));
        const { [name]: table } = await import(`data:text/javascript;base64,${code.toString('base64')}`);
        const texture = new THREE.DataTexture(
            table.data, table.width, table.height, THREE.RGBAFormat, THREE.HalfFloatType);
        assert.equal(texture.colorSpace, THREE.NoColorSpace);
        check(texture.image.data, stem);
    }
});

test('three: the .bin is what DataTexture takes', () => {
    for (const stem of STEMS) check(new Uint16Array(buffer(`${stem}.bin`)), stem);
});

test('three: EXRLoader opens the .exr, its rows from the bottom up', () => {
    const texture = new EXRLoader().parse(buffer('sheen_ltc.exr'));
    assert.equal(texture.type, THREE.HalfFloatType);
    assert.ok(holds(texture.data, 'sheen_ltc', (x, y) => 32 * (31 - y) + x));
    assert.ok(!holds(texture.data, 'sheen_ltc'));
});

// A .dds of halves with a header of Direct3D 9, whose FourCC is 113.
function legacy(name) {
    const file = Buffer.from(buffer(name));
    file.writeUInt32LE(113, 84);
    return Buffer.concat([file.subarray(0, 128), file.subarray(148)]);
}

test('three: DDSLoader refuses halves, by either header', () => {
    const silent = console.error;
    const said = [];
    console.error = (...words) => said.push(words.join(' '));
    try {
        const old = legacy('sheen_ltc.dds');
        for (const file of [buffer('sheen_ltc.dds'), old.buffer.slice(old.byteOffset, old.byteOffset + old.length)]) {
            const found = new DDSLoader().parse(file, false);
            assert.deepEqual([found.width, found.mipmaps.length], [0, 0]);
        }
    } finally {
        console.error = silent;
    }
    assert.match(said[0], /Unsupported DXGI_FORMAT code\s+10/);
    assert.match(said[1], /Unsupported FourCC code/);
});

// What Babylon's loader hands to the graphics driver.
function opened(bytes) {
    const uploads = [];
    const engine = {
        getCaps: () => ({ textureHalfFloat: true, textureHalfFloatLinearFiltering: true, textureFloat: true }),
        _getRGBABufferInternalSizedFormat: () => 0,
        _uploadDataToTextureDirectly: (texture, data, face, level) => uploads.push({ texture, data, face, level }),
    };
    const texture = { generateMipMaps: false, getEngine: () => engine };
    let size;
    new _DDSTextureLoader().loadData(new Uint8Array(bytes), texture, (width, height, mips, compressed, done) => {
        size = [width, height, mips];
        done();
    });
    return { size, uploads };
}

test('Babylon: its loader opens the .dds, by either header', () => {
    for (const stem of STEMS) {
        for (const file of [buffer(`${stem}.dds`), legacy(`${stem}.dds`)]) {
            const { size, uploads } = opened(file);
            assert.deepEqual(size, [32, expected(stem).height, false]);
            assert.equal(uploads.length, 1);
            assert.deepEqual([uploads[0].face, uploads[0].level, uploads[0].texture.type], [0, 0, 2]); // 2: half floats
            check(uploads[0].data, stem);
        }
    }
    assert.equal(DDSTools.GetDDSInfo(new Uint8Array(buffer('sheen_ltc.dds'))).dxgiFormat, 10);
});
