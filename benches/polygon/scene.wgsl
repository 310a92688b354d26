// What every variant shades: a wavy floor seen in perspective, lit by one rectangle that reaches below the horizon of
// some points.

struct Scene {
    corners: array<vec4<f32>, 4>,  // counter-clockwise from the lit side
    light_normal: vec4<f32>,
    eye: vec4<f32>,
}

struct Point {
    position: vec3<f32>,
    normal: vec3<f32>,
    view: vec3<f32>,
    roughness: f32,
}

@group(0) @binding(0) var<uniform> scene: Scene;
// Made-up specular lobes, as smooth as fitted ones: rows (a,0,b),(0,c,0),(0,0,1) as texels a, b, c, 1; and two weights.
@group(0) @binding(1) var specular_matrices: texture_2d<f32>;
@group(0) @binding(2) var specular_weights: texture_2d<f32>;
@group(0) @binding(3) var filtering: sampler;
@group(0) @binding(4) var sheen_table: texture_2d<f32>;

const IDENTITY = mat3x3<f32>(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);

@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(vec2<f32>(vec2(index & 1u, index >> 1u)) * 4.0 - 1.0, 0.0, 1.0);
}

fn point(pixel: vec2<f32>) -> Point {
    let across = (pixel - vec2(640.0, 360.0)) / 360.0;
    let ray = vec3(across.x, 1.3, -0.9 - 0.7 * across.y);
    let position = scene.eye.xyz - ray * (scene.eye.z / ray.z);
    let wave = 0.4 * vec2(sin(3.0 * position.x), cos(4.0 * position.y));
    let roughness = 0.5 + 0.4 * sin(2.0 * position.x + position.y);
    return Point(position, normalize(vec3(wave, 1.0)), normalize(scene.eye.xyz - position), roughness);
}

@fragment
fn empty(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let at = point(pixel.xy);
    return vec4(at.normal + at.view, at.roughness);
}
