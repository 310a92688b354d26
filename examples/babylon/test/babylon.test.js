// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// Babylon.js with our shaders against `velour render`.

import { after, before } from 'node:test';
import { babylonTables, compareEngine, open } from '../../three/test/harness.js';

let session;

before(async () => {
    session = await open('babylon', { 'https://assets.babylonjs.com/core/areaLights/areaLightsLTC.bin': babylonTables() });
});

after(() => session?.close());

compareEngine(() => session, 'babylon', 'test/page.html', 'sheen.glsl');
