// The vector of a triangle in the local frame, two-sided, and the diffuse form factor.

@group(0) @binding(0) var<storage, read_write> results: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> vertices: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&results) {
        return;
    }
    let identity = mat3x3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    let first = vertices[3u * id.x].xyz;
    let normal = cross(vertices[3u * id.x + 1u].xyz - first, vertices[3u * id.x + 2u].xyz - first);
    let side = ltc_side(normalize(normal), first, true);
    var outline = ltc_begin(vertices[3u * id.x + 2u].xyz);
    var vector = vec3(0.0);
    var sum = 0.0;
    var turn = LTC_LEVEL;
    for (var k = 0u; k < 3u; k++) {
        outline = ltc_next(outline, vertices[3u * id.x + k].xyz);
        vector += ltc_edge_vector(outline, identity);
        sum += ltc_edge(outline, identity);
        turn = ltc_turn(turn, outline, identity);
    }
    results[id.x] = vec4(ltc_vector(vector, turn, side), ltc_form_factor(sum, turn, identity, side));
}
