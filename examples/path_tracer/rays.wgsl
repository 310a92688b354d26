// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// Rays against the scene's triangles, by a hierarchy of boxes without a stack, and the points that they meet: what a program of yours has already.

// Either inner, and its first child follows it, or a leaf; the node to go on with where it is missed, or done with, is `skip`.
struct Node { low: vec3f, skip: u32, high: vec3f, leaf: u32 }
struct Corner { position: vec3f, surface: u32, normal: vec3f }
struct Triangle { a: Corner, b: Corner, c: Corner }
struct Surface {
    base_color: vec3f, metallic: f32,
    f0: vec3f, f90: f32,
    sheen_color: vec3f, sheen_alpha: f32,
    emission: vec3f, roughness: f32,
    double_sided: u32,
}

@group(0) @binding(1) var<storage, read> nodes: array<Node>;
@group(0) @binding(2) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(3) var<storage, read> surfaces: array<Surface>;

const NONE = 0xffffffffu;

struct Ray { origin: vec3f, direction: vec3f }
// Weights of the second and the third corner.
struct Hit { distance: f32, triangle: u32, v: f32, w: f32, front: bool }
// A point of a surface; `origin` is where rays leave it, but for `apart`.
struct Point { origin: vec3f, face: vec3f, local_from_world: mat3x3f, mu: f32 }

// The nearest triangle between two distances; with `culls`, backs of one-sided surfaces are passed by, with `any`, the first one found will do.
fn rays_nearest(ray: Ray, near: f32, far: f32, culls: bool, any: bool) -> Hit {
    var hit = Hit(far, NONE, 0.0, 0.0, false);
    let tiny = abs(ray.direction) < vec3f(1e-20);
    let inverse = 1.0 / select(ray.direction, vec3f(1e-20), tiny);
    var at = 0u;
    while at < arrayLength(&nodes) {
        let node = nodes[at];
        let one = (node.low - ray.origin) * inverse;
        let other = (node.high - ray.origin) * inverse;
        let enter = min(one, other);
        let leave = max(one, other);
        let begin = max(max(enter.x, enter.y), max(enter.z, near));
        let end = min(min(leave.x, leave.y), min(leave.z, hit.distance));
        // The boxes are padded by what f32 rounds away.
        at = select(node.skip, at + 1u, begin <= end);
        if begin > end || node.leaf == 0u {
            continue;
        }
        for (var index = node.leaf >> 3u; index < (node.leaf >> 3u) + (node.leaf & 7u); index++) {
            let found = rays_meet(ray, index);
            let counts = found.front || !culls || surfaces[triangles[index].a.surface].double_sided != 0u;
            if counts && found.distance >= near && found.distance < hit.distance {
                hit = found;
            }
        }
        if any && hit.triangle != NONE {
            break;
        }
    }
    return hit;
}

// Moeller and Trumbore 1997; where the ray misses, at a distance of -1.
fn rays_meet(ray: Ray, index: u32) -> Hit {
    let corner = triangles[index].a.position;
    let first = triangles[index].b.position - corner;
    let second = triangles[index].c.position - corner;
    let across = cross(ray.direction, second);
    let slope = dot(first, across);
    let to_origin = ray.origin - corner;
    let over = cross(to_origin, first);
    let scale = select(1.0 / slope, 0.0, slope == 0.0);
    let v = dot(to_origin, across) * scale;
    let w = dot(ray.direction, over) * scale;
    let inside = slope != 0.0 && v >= 0.0 && w >= 0.0 && v + w <= 1.0;
    return Hit(select(-1.0, dot(second, over) * scale, inside), index, v, w, slope > 0.0);
}

// Where the normals curve outwards rays leave from the curved surface that the triangle stands for (Hanika 2021, "Hacking the Shadow Terminator").
fn point_at(hit: Hit, view: vec3f) -> Point {
    let t = triangles[hit.triangle];
    let side = select(-1.0, 1.0, hit.front);
    let u = 1.0 - hit.v - hit.w;
    let position = u * t.a.position + hit.v * t.b.position + hit.w * t.c.position;
    let normal = side * normalize(u * t.a.normal + hit.v * t.b.normal + hit.w * t.c.normal);
    let lift = u * lifted(position, t.a, side) + hit.v * lifted(position, t.b, side) + hit.w * lifted(position, t.c, side);
    return Point(position + lift, triangle_normal(t), ltc_frame(normal, view), clamp(dot(normal, view), 0.0, 1.0));
}

fn triangle_normal(t: Triangle) -> vec3f {
    return normalize(cross(t.b.position - t.a.position, t.c.position - t.a.position));
}

fn lifted(position: vec3f, corner: Corner, side: f32) -> vec3f {
    let normal = side * corner.normal;
    return -min(dot(position - corner.position, normal), 0.0) * normal;
}

fn leaving(point: Point, direction: vec3f) -> Ray {
    return Ray(point.origin + frame.apart * sign(dot(point.face, direction)) * point.face, direction);
}
