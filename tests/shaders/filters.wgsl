// The surfaces' pass filters shading over a pixel: its functions, for inputs (x, y, z).

@group(0) @binding(0) var<storage, read_write> results: array<vec2f>;
@group(0) @binding(1) var<storage, read> inputs: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&results) {
        let given = inputs[id.x];
        results[id.x] = vec2f(
            filters_visible_mean(given.x, given.y),
            filters_roughness(given.x, given.y, given.z),
        );
    }
}
