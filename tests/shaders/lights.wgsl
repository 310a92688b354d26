// Shades points by the loop over lights.

struct Point {
    position: vec4f,
    normal: vec4f,
    view: vec4f,
}

@group(0) @binding(0) var<storage, read_write> shaded: array<vec4f>;
@group(0) @binding(3) var<storage, read> points: array<Point>;
@group(0) @binding(4) var sheen_table: texture_2d<f32>;
@group(0) @binding(5) var ggx_table: texture_2d<f32>;

fn surface_of(point: Point) -> LightsSurface {
    return LightsSurface(
        point.position.xyz, point.normal.xyz, point.view.xyz, vec3f(0.1, 0.3, 0.4), vec3f(0.04, 0.05, 0.06), vec3f(1.0), 0.35,
        vec3f(0.9, 0.5, 0.3), 0.4,
    );
}

// Two numbers a point: its radiance; and of the first light, its area vector, and by how much the walk without a loop differs.
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&points) {
        return;
    }
    let surface = surface_of(points[id.x]);
    let range = LightsRange(1u, 3u);
    shaded[2u * id.x] = vec4f(lights_shade(sheen_table, ggx_table, range, surface), 0.0);
    let lobes = lights_lobes(sheen_table, ggx_table, surface);
    let loop_factors = lights_polygon(lobes, surface.position, range, 0u);
    let quad_factors = lights_quad(lobes, surface.position, range, 0u);
    let apart = max(
        abs(loop_factors.diffuse - quad_factors.diffuse),
        max(abs(loop_factors.specular - quad_factors.specular), abs(loop_factors.sheen - quad_factors.sheen)),
    );
    shaded[2u * id.x + 1u] = vec4f(lights_area_vector(range, 0u), apart);
}
