// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// Hands the test a picture of a scene in linear radiance, a sample a pixel.

import { FloatType, NoToneMapping, WebGLRenderTarget, WebGLRenderer } from 'three';
import { RenderTarget, WebGPURenderer } from 'three/webgpu';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { lightsOfGlowing } from '../glowing.js';

const isWebGL = location.search === '?webgl';
const { areaSheen } = await import(isWebGL ? '../area_sheen_webgl.js' : '../area_sheen.js');

async function picture(gltfText, width, height, isOurs) {
    const gltf = await new GLTFLoader().parseAsync(gltfText, '');
    const [scene, camera] = [gltf.scene, gltf.cameras[0]];
    lightsOfGlowing(scene);
    if (isOurs) {
        scene.traverse((object) => {
            if (object.isMesh) object.material = areaSheen(object.material);
        });
    }
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    const renderer = isWebGL ? new WebGLRenderer() : new WebGPURenderer();
    if (!isWebGL) {
        await renderer.init();
        if (!renderer.backend.isWebGPUBackend) throw new Error('no WebGPU');
    }
    renderer.toneMapping = NoToneMapping;
    const options = { type: FloatType, samples: 0 };
    const target = isWebGL ? new WebGLRenderTarget(width, height, options) : new RenderTarget(width, height, options);
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    let pixels = new Float32Array(4 * width * height);
    if (isWebGL) await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height, pixels);
    else pixels = await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height);
    renderer.dispose();
    // Rows from the bottom up, as WebGL has them.
    const rows = Array.from({ length: height }, (_, y) => pixels.subarray(4 * width * y, 4 * width * (y + 1)));
    return (isWebGL ? rows : rows.reverse()).flatMap((row) => Array.from(row));
}

window.picture = picture;
