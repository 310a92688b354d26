// A point on the same rectangle, by one lobe: its form factor, and then a second walk for the point.

fn one_lobe(at: Point, m_inv: mat3x3<f32>) -> f32 {
    let frame = ltc_frame(at.normal, at.view);
    let side = ltc_side(scene.light_normal.xyz, to_corner(at, 0u), false);
    var sum = 0.0;
    var turn = LTC_LEVEL;
    var outline = ltc_begin(frame * to_corner(at, 3u));
    for (var k = 0u; k < 4u; k++) {
        outline = ltc_next(outline, frame * to_corner(at, k));
        sum += ltc_edge(outline, m_inv);
        turn = ltc_turn(turn, outline, m_inv);
    }
    return ltc_form_factor(sum, turn, m_inv, side);
}

@fragment
fn one(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let at = point(pixel.xy);
    let m_inv = loaded_specular(at).m_inv;
    let form_factor = one_lobe(at, m_inv);
    return vec4(m_inv[0].x, form_factor, form_factor, 1.0);
}

@fragment
fn sampled(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let at = point(pixel.xy);
    let m_inv = loaded_specular(at).m_inv;
    let form_factor = one_lobe(at, m_inv);
    let frame = ltc_frame(at.normal, at.view);
    let numbers = fract(vec2(0.7548777, 0.5698403) * (pixel.x + 1280.0 * pixel.y));
    var fan = ltc_sample_begin(numbers.x, form_factor);
    var outline = ltc_begin(frame * to_corner(at, 3u));
    for (var k = 0u; k < 4u; k++) {
        outline = ltc_next(outline, frame * to_corner(at, k));
        fan = ltc_sample_edge(fan, outline.p, outline.q, outline.normal, outline.sine, m_inv);
    }
    return vec4(ltc_sample_point(fan, m_inv, numbers.y), form_factor);
}
