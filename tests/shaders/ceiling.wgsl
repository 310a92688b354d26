// The form factor of a light that covers the whole hemisphere: a ceiling, 100 kilometres to each side at a metre's height.
fn ceiling(m_inv: mat3x3<f32>) -> f32 {
    let corner = vec3(1e5, 1e5, 1.0);
    let side = ltc_side(vec3(0.0, 0.0, -1.0), corner, false);
    var outline = ltc_begin(corner * vec3(-1.0, 1.0, 1.0));
    var sum = 0.0;
    var turn = LTC_LEVEL;
    outline = ltc_next(outline, corner);
    sum += ltc_edge(outline, m_inv);
    turn = ltc_turn(turn, outline, m_inv);
    outline = ltc_next(outline, corner * vec3(1.0, -1.0, 1.0));
    sum += ltc_edge(outline, m_inv);
    turn = ltc_turn(turn, outline, m_inv);
    outline = ltc_next(outline, corner * vec3(-1.0, -1.0, 1.0));
    sum += ltc_edge(outline, m_inv);
    turn = ltc_turn(turn, outline, m_inv);
    outline = ltc_next(outline, corner * vec3(-1.0, 1.0, 1.0));
    sum += ltc_edge(outline, m_inv);
    turn = ltc_turn(turn, outline, m_inv);
    return ltc_form_factor(sum, turn, m_inv, side);
}
