// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// three.js with our shaders against `velour render`, in linear radiance.
// CHROMIUM and VELOUR say where these are; else /usr/bin/chromium and the repository's target/.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';
import { DataTexture, FloatType } from 'three';
import { EXRExporter } from 'three/addons/exporters/EXRExporter.js';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { serve } from '../server.js';
import { makeScene } from './make_scene.js';

const [WIDTH, HEIGHT] = [256, 192];
// Greatest and mean difference where both drew the same thing, in a picture whose surfaces have radiances of about 1.
const GREATEST = 1e-3;
const MEAN = 1e-4;
// Pixels past GREATEST: those on silhouettes, whose centre one rasteriser covers and the other does not.
const OUTLIERS = 40;

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
    return execFileSync(path, args, { encoding: 'utf8' });
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

// The picture of a flavour; `mistakes` are [file, from, to] that are made in what the page is served.
async function drawn(flavour, { isOurs = true, mistakes = [] } = {}) {
    const page = await browser.newPage();
    const messages = [];
    page.on('console', (message) => ['error', 'warning'].includes(message.type()) && messages.push(message.text()));
    page.on('pageerror', (error) => messages.push(String(error)));
    for (const [file, from, to] of mistakes) {
        await page.route(`**/${file}`, async (route) => {
            const body = await (await route.fetch()).text();
            assert.ok(body.includes(from), `${file} has no ${from}`);
            await route.fulfill({ body: body.replaceAll(from, to) });
        });
    }
    await page.goto(`${url}test/page.html?${flavour}`);
    await page.waitForFunction(() => window.picture, null, { timeout: 60_000 }).catch(() => {});
    const pixels = await page.evaluate((args) => window.picture(...args), [scene, WIDTH, HEIGHT, isOurs]).catch((error) => {
        throw new Error([error.message, ...messages].join('\n'));
    });
    await page.close();
    return { pixels: new Float32Array(pixels), messages };
}

function difference(pixels) {
    let [sum, count, outliers, greatest, greatestOutlier] = [0, 0, 0, 0, 0];
    for (let at = 0; at < pixels.length; at += 4) {
        const errors = [0, 1, 2].map((channel) => Math.abs(pixels[at + channel] - truth[at + channel]));
        const worst = Math.max(...errors);
        assert.ok(Number.isFinite(worst));
        if (worst > GREATEST) {
            outliers++;
            greatestOutlier = Math.max(greatestOutlier, worst);
        } else {
            greatest = Math.max(greatest, worst);
            sum += errors[0] + errors[1] + errors[2];
            count += 3;
        }
    }
    return { mean: sum / count, greatest, outliers, greatestOutlier };
}

async function compared(name, pixels) {
    const texture = new DataTexture(pixels, WIDTH, HEIGHT, undefined, FloatType);
    writeFileSync(`${OUT}${name}.exr`, await new EXRExporter().parse(texture, { type: FloatType }));
    return JSON.parse(velour('compare', `${OUT}${name}.exr`, `${OUT}velour.exr`, '--json'));
}

const isWithin = ({ mean, outliers }) => mean <= MEAN && outliers <= OUTLIERS;

for (const [flavour, extension] of [['webgpu', 'wgsl'], ['webgl', 'glsl']]) {
    test(`${flavour} draws what velour renders`, async () => {
        const { pixels, messages } = await drawn(flavour);
        const measured = difference(pixels);
        const { relative_mean_absolute_error: relative, flip } = await compared(flavour, pixels);
        console.log(flavour, { ...measured, relative, flip });
        assert.deepEqual(messages, []);
        assert.ok(isWithin(measured), JSON.stringify(measured));
    });

    test(`${flavour}: a sign that is wrong is found out`, async () => {
        const { pixels, messages } = await drawn(flavour, { mistakes: [[`sheen.${extension}`, 'abr.y', '-abr.y']] });
        assert.deepEqual(messages, []);
        assert.ok(!isWithin(difference(pixels)), JSON.stringify(difference(pixels)));
    });

    test(`${flavour}: three's own area lights are not ours`, async () => {
        const { pixels } = await drawn(flavour, { isOurs: false });
        const measured = difference(pixels);
        console.log(`${flavour}, three's own`, measured);
        assert.ok(!isWithin(measured), JSON.stringify(measured));
    });
}
