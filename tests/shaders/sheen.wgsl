// The lobe of the sheen at each point, and the share it sends back of a light that covers the whole hemisphere.

struct Result {
    m_inv: mat3x3<f32>,
    albedo: f32,
    base_weight: f32,
    lit: f32,
}

@group(0) @binding(0) var<storage, read_write> results: array<Result>;
@group(0) @binding(1) var<storage, read> points: array<vec2<f32>>;
@group(0) @binding(2) var table: texture_2d<f32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&results) {
        return;
    }
    let lobe = sheen_lobe(table, points[id.x].x, points[id.x].y);
    let lit = lobe.albedo * ceiling(lobe.m_inv);
    results[id.x] = Result(lobe.m_inv, lobe.albedo, sheen_base_weight(vec3(0.2, 0.5, 0.3), lobe.albedo), lit);
}
