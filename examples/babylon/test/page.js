// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// Hands the test a picture of a scene in linear radiance, a sample a pixel.

import { Constants } from '@babylonjs/core/Engines/constants.js';
import { Engine } from '@babylonjs/core/Engines/engine.js';
import '@babylonjs/core/Loading/loadingScreen.js';
import { AppendSceneAsync } from '@babylonjs/core/Loading/sceneLoader.js';
import { Scene } from '@babylonjs/core/scene.js';
import { RenderTargetTexture } from '@babylonjs/core/Materials/Textures/renderTargetTexture.js';
import { Color4 } from '@babylonjs/core/Maths/math.color.js';
import '@babylonjs/loaders/glTF/2.0/index.js';
import { areaSheen } from '../area_sheen.js';
import { lightsOfGlowing } from '../glowing.js';

async function picture(gltfText, width, height, isOurs) {
    const engine = new Engine(document.querySelector('canvas'), false);
    engine.setSize(width, height);
    const scene = new Scene(engine);
    scene.useRightHandedSystem = true;
    await AppendSceneAsync(new File([gltfText], 'scene.gltf'), scene);
    scene.clearColor = new Color4(0, 0, 0, 1);
    scene.imageProcessingConfiguration.applyByPostProcess = true;
    lightsOfGlowing(scene);
    if (isOurs) new Set(scene.meshes.map(({ material }) => material).filter(Boolean)).forEach(areaSheen);
    const target = new RenderTargetTexture('linear', { width, height }, scene, {
        type: Constants.TEXTURETYPE_FLOAT, generateMipMaps: false, samplingMode: Constants.TEXTURE_NEAREST_SAMPLINGMODE,
    });
    target.renderList = scene.meshes;
    target.activeCamera = scene.cameras[0];
    scene.customRenderTargets.push(target);
    scene.activeCamera = scene.cameras[0];
    await scene.whenReadyAsync(true);
    scene.render();
    return Array.from(await target.readPixels());
}

window.picture = picture;
