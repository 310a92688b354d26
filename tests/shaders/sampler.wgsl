// Points drawn on lights of convex parts, and what the file says about them.

struct Case {
    m_inv: mat3x3<f32>,
    first: u32,
    count: u32,
}

struct Result {
    wo: vec3<f32>,
    share: f32,  // by what the fan has gone through
    form_factor: f32,
    density: f32,
}

@group(0) @binding(0) var<storage, read_write> results: array<Result>;
@group(0) @binding(1) var<storage, read> cases: array<Case>;
// First vertex and count; the normal of the part stands after its vertices.
@group(0) @binding(2) var<storage, read> parts: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> vertices: array<vec4<f32>>;
// Two uniform numbers, and the case's index.
@group(0) @binding(4) var<storage, read> draws: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&results) {
        return;
    }
    let drawn = draws[id.x];
    let case_ = cases[bitcast<u32>(drawn.z)];
    var form_factor = 0.0;
    for (var k = case_.first; k < case_.first + case_.count; k++) {
        let part = parts[k];
        let side = ltc_side(vertices[part.x + part.y].xyz, vertices[part.x].xyz, true);
        var outline = ltc_begin(vertices[part.x + part.y - 1u].xyz);
        var sum = 0.0;
        var turn = LTC_LEVEL;
        for (var v = part.x; v < part.x + part.y; v++) {
            outline = ltc_next(outline, vertices[v].xyz);
            sum += ltc_edge(outline, case_.m_inv);
            turn = ltc_turn(turn, outline, case_.m_inv);
        }
        form_factor += ltc_form_factor(sum, turn, case_.m_inv, side);
    }
    var fan = ltc_sample_begin(drawn.x, form_factor);
    let start = fan.left;
    for (var k = case_.first; k < case_.first + case_.count; k++) {
        let part = parts[k];
        var outline = ltc_begin(vertices[part.x + part.y - 1u].xyz);
        fan.apex = vec3(0.0);
        for (var v = part.x; v < part.x + part.y; v++) {
            outline = ltc_next(outline, vertices[v].xyz);
            fan = ltc_sample_edge(fan, outline.p, outline.q, outline.normal, outline.sine, case_.m_inv);
        }
    }
    let wo = ltc_sample_point(fan, case_.m_inv, drawn.y);
    results[id.x] = Result(wo, (start - fan.left) / (2.0 * LTC_PI), form_factor, ltc_density(case_.m_inv, wo));
}
