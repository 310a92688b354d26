// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// three.js with our shaders against `velour render`, in linear radiance.
// CHROMIUM and VELOUR say where these are; else /usr/bin/chromium and the repository's target/.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';
import { DataTexture, FloatType } from 'three';
import { EXRExporter } from 'three/addons/exporters/EXRExporter.js';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { serve } from '../server.js';
import { makeScene } from './make_scene.js';

const [WIDTH, HEIGHT] = [256, 192];
// A pixel agrees where it differs by no more than this, times its radiance where that is above 1.
const GREATEST = 1e-3;
// Chromium draws on SwiftShader; where its driver for other programs is found, velour does too. Other drivers rasterise on another grid, which
// moves silhouettes and what is interpolated by up to 1/16 pixel. The mean difference is over the mean radiance.
const SWIFTSHADER = ['/usr/lib/chromium', dirname(process.env.CHROMIUM ?? '/')].map((folder) => `${folder}/vk_swiftshader_icd.json`).find(existsSync);
const LIMITS = SWIFTSHADER ? { outliers: 10, greatest: 0.02, mean: 5e-5 } : { outliers: 2000, greatest: Infinity, mean: 5e-3 };

const OUT = fileURLToPath(new URL('out/', import.meta.url));
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

let browser, server, url, truth;
const scene = makeScene();

before(async () => {
    mkdirSync(OUT, { recursive: true });
    writeFileSync(`${OUT}scene.gltf`, scene);
    velour('render', `${OUT}scene.gltf`, '-o', `${OUT}velour.exr`, '--size', `${WIDTH}x${HEIGHT}`, '--msaa', '1', '--shadows', 'off');
    const loaded = new EXRLoader().setDataType(FloatType).parse(readFileSync(`${OUT}velour.exr`).buffer);
    assert.deepEqual([loaded.width, loaded.height], [WIDTH, HEIGHT]);
    truth = loaded.data;
    ({ server, url } = await serve(0));
    browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: FLAGS });
});

after(async () => {
    await browser?.close();
    server?.close();
});

// A page, and the errors and warnings that it has so far.
async function opened() {
    const page = await browser.newPage();
    const messages = [];
    page.on('console', (message) => ['error', 'warning'].includes(message.type()) && messages.push(message.text()));
    page.on('pageerror', (error) => messages.push(String(error)));
    return { page, messages };
}

// The picture of a flavour; `mistakes` are [file, from, to] that are made in what the page is served.
async function drawn(flavour, { gltf = scene, isOurs = true, mistakes = [] } = {}) {
    const { page, messages } = await opened();
    for (const [file, from, to] of mistakes) {
        await page.route(`**/${file}`, async (route) => {
            const body = await (await route.fetch()).text();
            assert.ok(body.includes(from), `${file} has no ${from}`);
            await route.fulfill({ body: body.replaceAll(from, to) });
        });
    }
    await page.goto(`${url}test/page.html?${flavour}`);
    await page.waitForFunction(() => window.picture, null, { timeout: 60_000 }).catch(() => {});
    const pixels = await page.evaluate((args) => window.picture(...args), [gltf, WIDTH, HEIGHT, isOurs]).catch((error) => {
        throw new Error([error.message, ...messages].join('\n'));
    });
    await page.close();
    return { pixels: new Float32Array(pixels), messages };
}

function difference(pixels) {
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

function agrees({ mean, greatest, outliers }) {
    return mean <= LIMITS.mean && greatest <= LIMITS.greatest && outliers <= LIMITS.outliers;
}

// The same by velour's own measure, which reads what three writes.
async function compare(name, pixels) {
    const texture = new DataTexture(pixels, WIDTH, HEIGHT, undefined, FloatType);
    writeFileSync(`${OUT}${name}.exr`, await new EXRExporter().parse(texture, { type: FloatType }));
    return JSON.parse(velour('compare', `${OUT}${name}.exr`, `${OUT}velour.exr`, '--json'));
}

for (const [flavour, extension] of [['webgpu', 'wgsl'], ['webgl', 'glsl']]) {
    test(`${flavour} draws what velour renders`, async (context) => {
        const { pixels, messages } = await drawn(flavour);
        assert.deepEqual(messages, []);
        const measured = difference(pixels);
        const { relative_mean_absolute_error: relative } = await compare(flavour, pixels);
        context.diagnostic(JSON.stringify(measured));
        assert.ok(agrees(measured), JSON.stringify(measured));
        assert.ok(Math.abs(relative - measured.mean) < 1e-3 * measured.mean, `velour compare says ${relative}`);
    });

    test(`${flavour}: a wrong sign in the sheen is found out`, async (context) => {
        const { pixels, messages } = await drawn(flavour, { mistakes: [[`sheen.${extension}`, 'abr.y', '-abr.y']] });
        assert.deepEqual(messages, []);
        const measured = difference(pixels);
        context.diagnostic(JSON.stringify(measured));
        assert.ok(!agrees(measured) && measured.outliers > 1000, JSON.stringify(measured));
    });

    test(`${flavour}: three's own area lights are another picture`, async (context) => {
        const { pixels, messages } = await drawn(flavour, { isOurs: false });
        assert.deepEqual(messages, []);
        const measured = difference(pixels);
        context.diagnostic(JSON.stringify(measured));
        assert.ok(!agrees(measured) && measured.outliers > 1000, JSON.stringify(measured));
    });

    test(`${flavour}: three's clear coat lies on top`, async () => {
        const coated = JSON.parse(scene);
        coated.extensionsUsed.push('KHR_materials_clearcoat');
        for (const material of coated.materials.slice(0, 3)) {
            material.extensions = { ...material.extensions, KHR_materials_clearcoat: { clearcoatFactor: 1, clearcoatRoughnessFactor: 0.3 } };
        }
        const { pixels, messages } = await drawn(flavour, { gltf: JSON.stringify(coated) });
        assert.deepEqual(messages, []);
        const { greatest, mean } = difference(pixels);
        assert.ok(greatest > 0.1 && mean < 1, JSON.stringify({ greatest, mean }));
    });

    test(`${flavour}: the page draws, whoever lights it`, async () => {
        const { page, messages } = await opened();
        await page.setViewportSize({ width: 640, height: 360 });
        await page.goto(`${url}?scene=dust${flavour === 'webgl' ? '&webgl' : ''}`);
        await page.waitForSelector('[data-drawn]', { timeout: 60_000 });
        const ours = await page.screenshot({ path: `${OUT}page_${flavour}.png` });
        await page.selectOption('select', { index: 1 });
        await page.waitForTimeout(2000);
        const own = await page.screenshot();
        await page.close();
        assert.deepEqual(messages, []);
        // A canvas that stayed empty takes a tenth of that.
        assert.ok(ours.length > 50_000 && own.length > 50_000 && !ours.equals(own));
    });
}
