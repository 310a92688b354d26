// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// A RectAreaLight for each flat mesh that glows: glTF has no area lights yet, and Velour takes what is emissive for one.

import { Matrix4, RectAreaLight, Triangle, Vector3 } from 'three';

// Rectangles are kept; any other outline becomes the square of its area. Adds the lights to root, in world space, and returns them.
export function lightsOfGlowing(root) {
    root.updateMatrixWorld(true);
    const lights = [];
    root.traverse((object) => {
        const { material } = object;
        if (!object.isMesh || !material.emissive || material.emissive.getHex() === 0) return;
        const light = new RectAreaLight(material.emissive, material.emissiveIntensity);
        const { center, x, normal, width, height } = rectangle(object);
        Object.assign(light, { width, height });
        // It shines along its -z.
        const z = normal.clone().negate();
        light.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(x, new Vector3().crossVectors(z, x), z));
        light.position.copy(center);
        lights.push(light);
    });
    if (lights.length > 0) root.add(...lights);
    return lights;
}

function rectangle(mesh) {
    const { position } = mesh.geometry.attributes;
    const index = mesh.geometry.index?.array ?? Array.from({ length: position.count }, (_, i) => i);
    const corners = Array.from({ length: position.count }, (_, i) => (
        new Vector3().fromBufferAttribute(position, i).applyMatrix4(mesh.matrixWorld)
    ));
    const [normal, center] = [new Vector3(), new Vector3()];
    let area = 0;
    for (let i = 0; i < index.length; i += 3) {
        const triangle = new Triangle(...[0, 1, 2].map((k) => corners[index[i + k]]));
        const part = triangle.getArea();
        area += part;
        normal.addScaledVector(triangle.getNormal(new Vector3()), part);
        center.addScaledVector(triangle.getMidpoint(new Vector3()), part);
    }
    normal.normalize();
    center.divideScalar(area);
    const [short, long] = corners.slice(1).map((corner) => corner.clone().sub(corners[0])).sort((a, b) => a.length() - b.length());
    const isRectangle = corners.length === 4 && Math.abs(short.dot(long)) < 1e-4 * area;
    const width = isRectangle ? long.length() : Math.sqrt(area);
    return { center, x: long.normalize(), normal, width, height: area / width };
}
