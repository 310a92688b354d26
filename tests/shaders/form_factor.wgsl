// Form factors of polygons under the diffuse lobe and another, both from a single walk.

struct Case {
    position: vec3<f32>,
    first: u32,
    normal: vec3<f32>,
    count: u32,
    view: vec3<f32>,
    two_sided: u32,
    light_normal: vec3<f32>,
    m_inv: mat3x3<f32>,
}

@group(0) @binding(0) var<storage, read_write> results: array<vec2<f32>>;
@group(0) @binding(1) var<storage, read> cases: array<Case>;
@group(0) @binding(2) var<storage, read> contours: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> vertices: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&results) {
        return;
    }
    let case_ = cases[id.x];
    let frame = ltc_frame(case_.normal, case_.view);
    let identity = mat3x3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    let to_vertex = vertices[contours[case_.first].x].xyz - case_.position;
    let side = ltc_side(case_.light_normal, to_vertex, case_.two_sided != 0u);
    var diffuse = 0.0;
    var lobe = 0.0;
    var level = LTC_LEVEL;
    var turn = LTC_LEVEL;
    for (var c = case_.first; c < case_.first + case_.count; c++) {
        let contour = contours[c];
        var outline = ltc_begin(frame * (vertices[contour.x + contour.y - 1u].xyz - case_.position));
        for (var v = contour.x; v < contour.x + contour.y; v++) {
            outline = ltc_next(outline, frame * (vertices[v].xyz - case_.position));
            diffuse += ltc_edge(outline, identity);
            lobe += ltc_edge(outline, case_.m_inv);
            level = ltc_turn(level, outline, identity);
            turn = ltc_turn(turn, outline, case_.m_inv);
        }
    }
    results[id.x] = vec2(ltc_form_factor(diffuse, level, identity, side), ltc_form_factor(lobe, turn, case_.m_inv, side));
}
