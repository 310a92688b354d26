// Draws a ball on a floor among three lights, nine rays a pixel, by the loop over lights.

@group(0) @binding(0) var<storage, read_write> picture: array<vec4f>;
@group(0) @binding(3) var sheen_table: texture_2d<f32>;
@group(0) @binding(4) var ggx_table: texture_2d<f32>;

const SHELL_SIZE = vec2u(360u, 240u);
const SHELL_BALL = vec3f(0.0, 1.0, 0.0);

fn shell_radiance(eye: vec3f, ray: vec3f) -> vec3f {
    let range = LightsRange(0u, 3u);
    var surface = LightsSurface();
    surface.view = -ray;
    surface.f0 = vec3f(0.04);
    surface.f90 = vec3f(1.0);
    let along = dot(eye - SHELL_BALL, ray);
    let root = along * along - dot(eye - SHELL_BALL, eye - SHELL_BALL) + 1.0;
    if root > 0.0 {
        surface.position = eye + (-along - sqrt(root)) * ray;
        surface.normal = normalize(surface.position - SHELL_BALL);
        surface.base_color = vec3f(0.005, 0.03, 0.04);
        surface.roughness = 0.6;
        surface.sheen_color = vec3f(1.0, 0.55, 0.45);
        surface.alpha = 0.6;
    } else if ray.y < 0.0 {
        surface.position = eye - eye.y / ray.y * ray;
        surface.normal = vec3f(0.0, 1.0, 0.0);
        surface.base_color = vec3f(0.12);
        surface.roughness = 0.3;
        surface.sheen_color = vec3f(0.5);
        surface.alpha = 0.7;
    } else {
        return vec3f(0.0);
    }
    return lights_shade(sheen_table, ggx_table, range, surface);
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= SHELL_SIZE) {
        return;
    }
    let eye = vec3f(0.6, 1.9, 5.6);
    let forward = normalize(vec3f(0.0, 0.85, 0.0) - eye);
    let right = normalize(cross(forward, vec3f(0.0, 1.0, 0.0)));
    let up = cross(right, forward);
    var sum = vec3f(0.0);
    for (var k = 0u; k < 9u; k++) {
        let at = vec2f(id.xy) + (vec2f(f32(k % 3u), f32(k / 3u)) + 0.5) / 3.0 - 0.5 * vec2f(SHELL_SIZE);
        let aim = 0.56 / f32(SHELL_SIZE.y) * (at.x * right - at.y * up);
        sum += shell_radiance(eye, normalize(forward + aim)) / 9.0;
    }
    picture[id.y * SHELL_SIZE.x + id.x] = vec4f(sum, 1.0);
}
