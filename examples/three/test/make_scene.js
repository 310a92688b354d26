// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// The scene of the test, as glTF: two balls with the normals of spheres on a floor, under two coloured rectangles, of which one is partly
// below the floor's horizon and faces away from some of what is there.

const FLOAT = 5126, SHORT = 5123;

function ball(radius, columns, rows) {
    const positions = [], normals = [], indices = [];
    for (let row = 0; row <= rows; row++) {
        for (let column = 0; column <= columns; column++) {
            const [theta, phi] = [(row * Math.PI) / rows, (2 * column * Math.PI) / columns];
            const normal = [Math.sin(theta) * Math.sin(phi), Math.cos(theta), Math.sin(theta) * Math.cos(phi)];
            normals.push(...normal);
            positions.push(...normal.map((x) => radius * x));
            if (row < rows && column < columns) {
                const at = row * (columns + 1) + column, below = at + columns + 1;
                indices.push(at, below, below + 1, at, below + 1, at + 1);
            }
        }
    }
    return { positions, normals, indices };
}

// In the plane z = 0, seen from +z.
function rectangle(width, height) {
    const [x, y] = [width / 2, height / 2];
    return { positions: [-x, -y, 0, x, -y, 0, x, y, 0, -x, y, 0], normals: [0, 1, 2, 3].flatMap(() => [0, 0, 1]), indices: [0, 1, 2, 0, 2, 3] };
}

function turned(axis, degrees) {
    const half = (degrees * Math.PI) / 360;
    return [...axis.map((x) => x * Math.sin(half)), Math.cos(half)];
}

function surface(name, baseColorFactor, roughnessFactor, metallicFactor, sheen) {
    const material = { name, pbrMetallicRoughness: { baseColorFactor: [...baseColorFactor, 1], roughnessFactor, metallicFactor } };
    if (sheen) {
        const [sheenColorFactor, sheenRoughnessFactor] = sheen;
        material.extensions = { KHR_materials_sheen: { sheenColorFactor, sheenRoughnessFactor } };
    }
    return material;
}

function glowing(name, emissiveFactor, emissiveStrength) {
    return {
        ...surface(name, [0, 0, 0], 1, 0), emissiveFactor, extensions: { KHR_materials_emissive_strength: { emissiveStrength } },
    };
}

// Each mesh, its material, and where it stands.
const THINGS = [
    [ball(0.5, 64, 32), surface('velvet', [0.1, 0.02, 0.15], 0.5, 0, [[0.9, 0.5, 0.3], 0.35]), { translation: [-0.6, 0.5, 0] }],
    [ball(0.4, 64, 32), surface('dusty brass', [0.8, 0.6, 0.3], 0.4, 1, [[0.4, 0.5, 0.7], 0.8]), { translation: [0.55, 0.4, 0.2] }],
    [rectangle(4, 4), surface('floor', [0.3, 0.3, 0.32], 0.3, 0), { rotation: turned([1, 0, 0], -90) }],
    [rectangle(0.8, 0.5), glowing('warm', [1, 0.7, 0.4], 12), { translation: [-0.2, 1.7, 0.3], rotation: turned([1, 0, 0], 70) }],
    [rectangle(0.6, 1.2), glowing('cool', [0.3, 0.6, 1], 9), { translation: [1.4, 0.3, -0.2], rotation: turned([0, 1, 0], -70) }],
];

export function makeScene() {
    const chunks = [], accessors = [], bufferViews = [];
    let byteLength = 0;
    const add = (values, componentType, type) => {
        const numbers = componentType === FLOAT ? new Float32Array(values) : new Uint16Array(values);
        const width = type === 'VEC3' ? 3 : 1;
        const along = (pick) => Array.from({ length: width }, (_, k) => numbers.filter((_, i) => i % width === k).reduce((a, b) => pick(a, b)));
        bufferViews.push({ buffer: 0, byteOffset: byteLength, byteLength: numbers.byteLength });
        accessors.push({
            bufferView: bufferViews.length - 1, componentType, count: numbers.length / width, type, min: along(Math.min), max: along(Math.max),
        });
        chunks.push(Buffer.from(numbers.buffer));
        byteLength += numbers.byteLength;
        return accessors.length - 1;
    };
    const meshes = THINGS.map(([{ positions, normals, indices }], material) => ({
        primitives: [{
            attributes: { POSITION: add(positions, FLOAT, 'VEC3'), NORMAL: add(normals, FLOAT, 'VEC3') }, indices: add(indices, SHORT, 'SCALAR'), material,
        }],
    }));
    const nodes = THINGS.map(([, { name }, place], mesh) => ({ name, mesh, ...place }));
    nodes.push({ name: 'camera', camera: 0, translation: [0, 1.2, 3.2], rotation: turned([1, 0, 0], -14) });
    return JSON.stringify({
        asset: { version: '2.0' }, extensionsUsed: ['KHR_materials_sheen', 'KHR_materials_emissive_strength'],
        scene: 0, scenes: [{ nodes: nodes.map((_, i) => i) }], nodes, meshes, materials: THINGS.map(([, material]) => material),
        cameras: [{ type: 'perspective', perspective: { yfov: 0.75, znear: 0.05, zfar: 50 } }],
        accessors, bufferViews, buffers: [{ byteLength, uri: `data:application/octet-stream;base64,${Buffer.concat(chunks).toString('base64')}` }],
    });
}
