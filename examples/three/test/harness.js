// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// An engine in Chromium with our shaders, against `velour render`, in linear radiance.
// CHROMIUM and VELOUR say where these are; else /usr/bin/chromium and the repository's target/.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';
import { DataTexture, FloatType } from 'three';
import { EXRExporter } from 'three/addons/exporters/EXRExporter.js';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { RectAreaLightTexturesLib } from 'three/addons/lights/RectAreaLightTexturesLib.js';
import { serve } from '../server.js';
import { makeScene } from './make_scene.js';

const [WIDTH, HEIGHT] = [256, 192];
// A pixel agrees where it differs by no more than this, times its radiance where that is above 1.
const GREATEST = 1e-3;
// Chromium draws on SwiftShader; where its driver for other programs is found, velour does too. Other drivers rasterise on another grid, which
// moves silhouettes and what is interpolated by up to 1/16 pixel. The mean difference is over the mean radiance.
const SWIFTSHADER = ['/usr/lib/chromium', dirname(process.env.CHROMIUM ?? '/')].map((folder) => `${folder}/vk_swiftshader_icd.json`).find(existsSync);
const LIMITS = SWIFTSHADER ? { outliers: 10, greatest: 0.02, mean: 5e-5 } : { outliers: 3000, greatest: Infinity, mean: 5e-3 };

export const OUT = fileURLToPath(new URL('out/', import.meta.url));
const FLAGS = [
    '--no-sandbox', '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader', '--enable-features=Vulkan', '--use-vulkan=swiftshader',
    '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
];

function velour(...args) {
    const target = fileURLToPath(new URL('../../../target/', import.meta.url));
    const paths = [process.env.VELOUR, `${target}release/velour`, `${target}debug/velour`];
    const path = paths.find((candidate) => candidate && existsSync(candidate));
    assert.ok(path, 'there is no velour to compare with: run `cargo build --release` in the repository, or set VELOUR');
    const env = { ...process.env, ...(SWIFTSHADER && { VK_DRIVER_FILES: SWIFTSHADER }) };
    return execFileSync(path, args, { encoding: 'utf8', env, stdio: ['ignore', 'pipe', 'pipe'] });
}

export const scene = makeScene();

// A browser, a server of a folder of examples/, and what velour renders of the scene. Its pages set window.picture(gltf, width, height, isOurs);
// `answers` are what addresses elsewhere would answer, so that no test needs a network.
export async function open(folder, answers = {}) {
    mkdirSync(OUT, { recursive: true });
    writeFileSync(`${OUT}scene.gltf`, scene);
    velour('render', `${OUT}scene.gltf`, '-o', `${OUT}velour.exr`, '--size', `${WIDTH}x${HEIGHT}`, '--msaa', '1', '--shadows', 'off');
    const loaded = new EXRLoader().setDataType(FloatType).parse(readFileSync(`${OUT}velour.exr`).buffer);
    assert.deepEqual([loaded.width, loaded.height], [WIDTH, HEIGHT]);
    const { server, url } = await serve(folder, 0);
    const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: FLAGS });
    return { browser, url, answers, truth: loaded.data, close: () => Promise.all([browser.close(), server.close()]) };
}

// The tables of Babylon's own area lights, which it fetches from its site: both engines took them from one source, and three has them at hand.
export function babylonTables() {
    const { LTC_HALF_1, LTC_HALF_2 } = RectAreaLightTexturesLib.init();
    const [first, second] = [LTC_HALF_1, LTC_HALF_2].map(({ image }) => image.data);
    return Buffer.from(Uint16Array.from({ length: 2 * first.length }, (_, i) => (i % 8 < 4 ? first : second)[4 * (i >> 3) + (i % 4)]).buffer);
}

// A page, and the errors and warnings that it has so far.
export async function newPage({ browser, answers }) {
    const page = await browser.newPage();
    for (const [url, body] of Object.entries(answers)) await page.route(url, (route) => route.fulfill({ body }));
    const messages = [];
    page.on('console', (message) => {
        // Drivers remark that reading pixels back takes time.
        const counts = ['error', 'warning'].includes(message.type()) && !message.text().includes('GPU stall due to ReadPixels');
        if (counts) messages.push(message.text());
    });
    page.on('pageerror', (error) => messages.push(String(error)));
    return { page, messages };
}

// The picture of a page, and what velour renders; `mistakes` are [file, from, to] that are made in what the page is served.
export async function drawn(session, path, { gltf = scene, isOurs = true, mistakes = [] } = {}) {
    const { page, messages } = await newPage(session);
    for (const [file, from, to] of mistakes) {
        await page.route(`**/${file}`, async (route) => {
            const body = await (await route.fetch()).text();
            assert.ok(body.includes(from), `${file} has no ${from}`);
            await route.fulfill({ body: body.replaceAll(from, to) });
        });
    }
    await page.goto(session.url + path);
    await page.waitForFunction(() => window.picture, null, { timeout: 60_000 }).catch(() => {});
    const pixels = await page.evaluate((args) => window.picture(...args), [gltf, WIDTH, HEIGHT, isOurs]).catch((error) => {
        throw new Error([error.message, ...messages].join('\n'));
    });
    await page.close();
    assert.deepEqual(messages, []);
    return { pixels: new Float32Array(pixels), truth: session.truth };
}

export function difference({ pixels, truth }) {
    let [sum, radiance, outliers, greatest] = [0, 0, 0, 0];
    pixels.forEach((value, at) => {
        if (at % 4 === 3) return;
        const error = Math.abs(value - truth[at]);
        assert.ok(Number.isFinite(error));
        sum += error;
        radiance += truth[at];
        const scaled = error / Math.max(truth[at], 1);
        greatest = Math.max(greatest, scaled);
        if (scaled > GREATEST) outliers++;
    });
    return { mean: sum / radiance, greatest, outliers };
}

export function agrees({ mean, greatest, outliers }) {
    return mean <= LIMITS.mean && greatest <= LIMITS.greatest && outliers <= LIMITS.outliers;
}

// The same by velour's own measure, of a picture as three writes it.
export async function compare(name, { pixels }) {
    const texture = new DataTexture(pixels, WIDTH, HEIGHT, undefined, FloatType);
    writeFileSync(`${OUT}${name}.exr`, await new EXRExporter().parse(texture, { type: FloatType }));
    return JSON.parse(velour('compare', `${OUT}${name}.exr`, `${OUT}velour.exr`, '--json'));
}

// The three comparisons of an engine: ours agrees, and would not if it were wrong, nor does the engine's own.
export function compareEngine(session, name, path, sheenFile) {
    test(`${name} draws what velour renders`, async (context) => {
        const picture = await drawn(session(), path);
        const measured = difference(picture);
        context.diagnostic(JSON.stringify(measured));
        const { relative_mean_absolute_error: relative } = await compare(name, picture);
        assert.ok(agrees(measured), JSON.stringify(measured));
        assert.ok(Math.abs(relative - measured.mean) < 1e-3 * measured.mean, `velour compare says ${relative}`);
    });

    test(`${name}: a wrong sign in the sheen is found out`, async (context) => {
        const measured = difference(await drawn(session(), path, { mistakes: [[sheenFile, 'abr.y', '-abr.y']] }));
        context.diagnostic(JSON.stringify(measured));
        assert.ok(!agrees(measured) && measured.outliers > 1000, JSON.stringify(measured));
    });

    test(`${name}: the engine's own area lights are another picture`, async (context) => {
        const measured = difference(await drawn(session(), path, { isOurs: false }));
        context.diagnostic(JSON.stringify(measured));
        assert.ok(!agrees(measured) && measured.outliers > 1000, JSON.stringify(measured));
    });
}
