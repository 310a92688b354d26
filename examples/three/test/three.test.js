// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// three.js with our shaders, in both flavours, against `velour render`; and the page.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { OUT, compareEngine, difference, drawn, newPage, open, scene } from './harness.js';

let session;

before(async () => {
    session = await open('three');
});

after(() => session?.close());

for (const [flavour, sheenFile] of [['webgpu', 'sheen.wgsl'], ['webgl', 'sheen.glsl']]) {
    const path = `test/page.html?${flavour}`;
    compareEngine(() => session, flavour, path, sheenFile);

    test(`${flavour}: three's clear coat lies on top`, async () => {
        const coated = JSON.parse(scene);
        coated.extensionsUsed.push('KHR_materials_clearcoat');
        for (const material of coated.materials.slice(0, 3)) {
            material.extensions = { ...material.extensions, KHR_materials_clearcoat: { clearcoatFactor: 1, clearcoatRoughnessFactor: 0.3 } };
        }
        const { greatest, mean } = difference(await drawn(session, path, { gltf: JSON.stringify(coated) }));
        assert.ok(greatest > 0.1 && mean < 1, JSON.stringify({ greatest, mean }));
    });

    test(`${flavour}: the page draws, whoever lights it`, async () => {
        const { page, messages } = await newPage(session);
        await page.setViewportSize({ width: 640, height: 360 });
        await page.goto(`${session.url}?scene=dust${flavour === 'webgl' ? '&webgl' : ''}`);
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
