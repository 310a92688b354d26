// The specular base at each point (roughness, mu, f0, f90), and the share it sends back of a light that covers the
// hemisphere.

struct Result {
    m_inv: mat3x3<f32>,
    albedo: f32,
    fresnel: f32,
    base_weight: f32,
    form_factor: f32,
    shares: vec3<f32>,
}

@group(0) @binding(0) var<storage, read_write> results: array<Result>;
@group(0) @binding(1) var<storage, read> points: array<vec4<f32>>;
@group(0) @binding(2) var table: texture_2d<f32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&results) {
        return;
    }
    let point = points[id.x];
    let lobe = ggx_lobe(table, point.x, point.y);
    let shares = ggx_albedo(lobe, point.z * vec3(1.0, 0.5, 0.0), point.w * vec3(1.0, 1.0, 0.25));
    let form_factor = ceiling(lobe.m_inv);
    results[id.x] = Result(lobe.m_inv, lobe.albedo, lobe.fresnel, ggx_base_weight(shares), form_factor, shares);
}
