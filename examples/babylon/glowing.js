// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// A RectAreaLight for each flat mesh that glows, which lies in its own plane z = 0 and shines to its +z, as those in assets/ do.

import { RectAreaLight } from '@babylonjs/core/Lights/rectAreaLight.js';
import { TransformNode } from '@babylonjs/core/Meshes/transformNode.js';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';

// Rectangles are kept; any other outline becomes the square of its area.
export function lightsOfGlowing(scene) {
    const glowing = scene.meshes.filter(({ material }) => material?.emissiveColor?.toLuminance() > 0);
    return glowing.map((mesh) => {
        // An area light shines along its parent's -z.
        const holder = new TransformNode(`${mesh.name} light`, scene);
        holder.parent = mesh;
        holder.rotation.y = Math.PI;
        const { width, height } = extent(mesh);
        const light = new RectAreaLight(mesh.name, Vector3.Zero(), width, height, scene);
        light.parent = holder;
        light.diffuse = mesh.material.emissiveColor;
        light.intensity = mesh.material.emissiveIntensity;
        return light;
    });
}

function extent(mesh) {
    if (mesh.getTotalVertices() === 4) {
        const { minimum, maximum } = mesh.getBoundingInfo();
        return { width: maximum.x - minimum.x, height: maximum.y - minimum.y };
    }
    const positions = mesh.getVerticesData('position');
    const indices = mesh.getIndices();
    const corner = (i) => Vector3.FromArray(positions, 3 * indices[i]);
    let area = 0;
    for (let i = 0; i < indices.length; i += 3) {
        const first = corner(i);
        area += Vector3.Cross(corner(i + 1).subtract(first), corner(i + 2).subtract(first)).length() / 2;
    }
    return { width: Math.sqrt(area), height: Math.sqrt(area) };
}
