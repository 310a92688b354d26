// The density in a direction (w = 0), or a sample from two uniform numbers (w = 1) and the density there.

@group(0) @binding(0) var<storage, read_write> results: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> m_inv: mat3x3<f32>;
@group(0) @binding(2) var<storage, read> inputs: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&results) {
        return;
    }
    let given = inputs[id.x];
    var direction = given.xyz;
    if given.w == 1.0 {
        direction = ltc_sample(m_inv, given.xy);
    }
    results[id.x] = vec4(direction, ltc_density(m_inv, direction));
}
