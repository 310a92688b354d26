// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// The page: the drape of assets/, lit by what glows in its file. ?webgl draws with WebGL 2, ?scene=dust the other scene.

import { NeutralToneMapping, Vector3, WebGLRenderer } from 'three';
import { WebGPURenderer } from 'three/webgpu';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { GUI } from 'three/addons/libs/lil-gui.module.min.js';
import { lightsOfGlowing } from './glowing.js';

const query = new URLSearchParams(location.search);
const SCENE = query.get('scene') === 'dust' ? 'dust' : 'drape';
const isWebGPU = !query.has('webgl') && Boolean(await navigator.gpu?.requestAdapter());
const { areaSheen } = await import(isWebGPU ? './area_sheen.js' : './area_sheen_webgl.js');
const renderer = isWebGPU ? new WebGPURenderer({ antialias: true }) : new WebGLRenderer({ antialias: true });
if (isWebGPU) await renderer.init();
renderer.toneMapping = NeutralToneMapping;
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
document.body.prepend(renderer.domElement);

const gltf = await new GLTFLoader().loadAsync(new URL(`../../assets/${SCENE}.glb`, import.meta.url).href);
const [scene, camera] = [gltf.scene, gltf.cameras[0]];
const lights = lightsOfGlowing(scene);

const pairs = [];
scene.traverse((mesh) => {
    if (mesh.isMesh) pairs.push({ mesh, own: mesh.material, ours: areaSheen(mesh.material) });
});
const sheens = pairs.filter(({ own }) => own.sheen > 0);

// The file's camera stands free in the scene; the controls turn about the middle of what it looks at.
camera.removeFromParent();
const target = camera.getWorldDirection(new Vector3()).multiplyScalar(camera.position.length()).add(camera.position);
const controls = new OrbitControls(camera, renderer.domElement);
controls.target.copy(target);
controls.minDistance = 1;
controls.maxDistance = 8;
controls.maxPolarAngle = 0.55 * Math.PI;

const settings = {
    lit: 'Velour',
    alpha: sheens[0].own.sheenRoughness,
    sheen: sheens[0].own.sheenColor.clone(),
    base: sheens[0].own.color.clone(),
    light: 1,
};
const strengths = lights.map(({ intensity }) => intensity);

function update() {
    for (const { mesh, own, ours } of pairs) mesh.material = settings.lit === 'Velour' ? ours : own;
    for (const material of sheens.flatMap(({ own, ours }) => [own, ours])) {
        material.sheenRoughness = settings.alpha;
        material.sheenColor.copy(settings.sheen);
        material.color.copy(settings.base);
    }
    lights.forEach((light, i) => { light.intensity = settings.light * strengths[i]; });
}

const gui = new GUI({ title: 'Sheen' });
gui.add(settings, 'lit', ['Velour', 'three']).name('lit by');
gui.add(settings, 'alpha', 0.02, 1).name('alpha: fuzz to dust');
gui.addColor(settings, 'sheen').name('colour of the fibres');
gui.addColor(settings, 'base').name('colour of the base');
gui.add(settings, 'light', 0, 2).name('strength of the lights');

const links = [['WebGPU', 'WebGL 2'], ['drape', 'dust']].map((names, at) => names.map((name, i) => {
    const isHere = at === 0 ? isWebGPU === (i === 0) : name === SCENE;
    const [gl, scene] = at === 0 ? [i === 1, SCENE] : [!isWebGPU, name];
    return isHere ? name : `<a href="?scene=${scene}${gl ? '&webgl' : ''}">${name}</a>`;
}).join(' | '));
document.getElementById('note').innerHTML = `${links.join(' &nbsp; ')} &nbsp; drag to turn, scroll to come near`;

// Where nothing moves nothing is drawn.
function draw() {
    renderer.render(scene, camera);
    document.body.dataset.drawn = 'yes';
}

function resize() {
    camera.aspect = innerWidth / innerHeight;
    camera.updateProjectionMatrix();
    renderer.setSize(innerWidth, innerHeight);
    draw();
}

controls.addEventListener('change', draw);
gui.onChange(() => {
    update();
    draw();
});
addEventListener('resize', resize);
update();
controls.update();
resize();
