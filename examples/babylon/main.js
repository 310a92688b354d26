// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// The page: the drape of assets/, lit by what glows in its file.

import { ArcRotateCamera } from '@babylonjs/core/Cameras/arcRotateCamera.js';
import { Engine } from '@babylonjs/core/Engines/engine.js';
import '@babylonjs/core/Loading/loadingScreen.js';
import { AppendSceneAsync } from '@babylonjs/core/Loading/sceneLoader.js';
import { ImageProcessingConfiguration } from '@babylonjs/core/Materials/imageProcessingConfiguration.js';
import { Color3 } from '@babylonjs/core/Maths/math.color.js';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { Scene } from '@babylonjs/core/scene.js';
import '@babylonjs/loaders/glTF/2.0/index.js';
import { areaSheen } from './area_sheen.js';
import { lightsOfGlowing } from './glowing.js';

const canvas = document.querySelector('canvas');
const engine = new Engine(canvas, true, { preserveDrawingBuffer: true });
const scene = new Scene(engine);
scene.useRightHandedSystem = true;
scene.imageProcessingConfiguration.toneMappingEnabled = true;
scene.imageProcessingConfiguration.toneMappingType = ImageProcessingConfiguration.TONEMAPPING_KHR_PBR_NEUTRAL;
await AppendSceneAsync(new URL('../../assets/drape.glb', import.meta.url).href, scene);
lightsOfGlowing(scene);

// The file's camera, turned by hand about the middle of what it looks at.
const seen = scene.cameras[0];
seen.computeWorldMatrix(true);
const position = seen.globalPosition.clone();
const target = position.add(seen.getDirection(Vector3.Forward(true)).scale(position.length()));
const camera = new ArcRotateCamera('hand', 0, 0, 1, target, scene);
camera.setPosition(position);
Object.assign(camera, { fov: seen.fov, minZ: seen.minZ, maxZ: seen.maxZ, lowerRadiusLimit: 1, upperRadiusLimit: 8, wheelDeltaPercentage: 0.01 });
camera.attachControl(canvas);
scene.activeCamera = camera;

const pairs = scene.meshes.filter(({ material }) => material).map((mesh) => (
    { mesh, own: mesh.material, ours: areaSheen(mesh.material.clone(mesh.material.name)) }
));
const sheens = pairs.filter(({ own }) => own.sheen.isEnabled).flatMap(({ own, ours }) => [own.sheen, ours.sheen]);
const { alpha, colour, ours: isOurs } = document.forms[0].elements;
alpha.value = sheens[0].roughness;
colour.value = sheens[0].color.toGammaSpace().toHexString();

function update() {
    for (const { mesh, own, ours } of pairs) mesh.material = isOurs.checked ? ours : own;
    for (const sheen of sheens) {
        sheen.roughness = Number(alpha.value);
        sheen.color = Color3.FromHexString(colour.value).toLinearSpace();
    }
}

document.forms[0].addEventListener('input', update);
update();
addEventListener('resize', () => engine.resize());
scene.executeWhenReady(() => { document.body.dataset.drawn = 'yes'; });
engine.runRenderLoop(() => scene.render());
