// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// Runs a row of tables/golden.json: reads its inputs, calls the function, gives its outputs.
// Copy with it: all files at the top of shaders/, and a shell with two functions of your own that move numbers in and out:
// golden_number(index: u32) -> f32 is a number of the row's "inputs", golden_put(index: u32, value: f32) takes one of its "outputs".
// Structs are their fields in order, matrices their columns, bools are 0 or 1; functions are numbered as in "functions".

const GOLDEN_IDENTITY = mat3x3<f32>(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);

fn golden_row(sheen_table: texture_2d<f32>, ggx_table: texture_2d<f32>, function: u32) {
    if function == 0u {
        golden_put_mat3(0u, ltc_frame(golden_vec3(0u), golden_vec3(3u)));
    } else if function == 1u {
        golden_put(0u, ltc_side(golden_vec3(0u), golden_vec3(3u), golden_number(6u) != 0.0));
    } else if function == 2u {
        golden_put_outline(0u, ltc_begin(golden_vec3(0u)));
    } else if function == 3u {
        golden_put_outline(0u, ltc_next(golden_outline(0u), golden_vec3(15u)));
    } else if function == 4u {
        golden_put(0u, ltc_edge(golden_outline(0u), golden_mat3(15u)));
    } else if function == 5u {
        golden_put_vec3(0u, ltc_edge_vector(golden_outline(0u), golden_mat3(15u)));
    } else if function == 6u {
        golden_put_vec2(0u, ltc_turn(golden_vec2(0u), golden_outline(2u), golden_mat3(17u)));
    } else if function == 7u {
        golden_put(0u, ltc_form_factor(golden_number(0u), golden_vec2(1u), golden_mat3(3u), golden_number(12u)));
    } else if function == 8u {
        golden_put_vec3(0u, ltc_vector(golden_vec3(0u), golden_vec2(3u), golden_number(5u)));
    } else if function == 9u {
        golden_put(0u, ltc_arc(golden_vec3(0u), golden_number(3u), golden_number(4u)));
    } else if function == 10u {
        golden_put(0u, ltc_angle(golden_number(0u), golden_number(1u)));
    } else if function == 11u {
        golden_put_vec3(0u, ltc_cross(golden_vec3(0u), golden_vec3(3u)));
    } else if function == 12u {
        golden_put(0u, ltc_density(golden_mat3(0u), golden_vec3(9u)));
    } else if function == 13u {
        golden_put_vec3(0u, ltc_sample(golden_mat3(0u), golden_vec2(9u)));
    } else if function == 14u {
        golden_put_fan(0u, ltc_sample_begin(golden_number(0u), golden_number(1u)));
    } else if function == 15u {
        golden_put_fan(0u, golden_sample_edge());
    } else if function == 16u {
        golden_put_vec3(0u, ltc_sample_point(golden_fan(0u), golden_mat3(33u), golden_number(42u)));
    } else if function == 17u {
        let lobe = sheen_lobe(sheen_table, golden_number(0u), golden_number(1u));
        golden_put_mat3(0u, lobe.m_inv);
        golden_put(9u, lobe.albedo);
    } else if function == 18u {
        golden_put(0u, sheen_base_weight(golden_vec3(0u), golden_number(3u)));
    } else if function == 19u {
        golden_put(0u, sheen_base_weight_openpbr(golden_number(0u), golden_number(1u)));
    } else if function == 20u {
        let lobe = ggx_lobe(ggx_table, golden_number(0u), golden_number(1u));
        golden_put_mat3(0u, lobe.m_inv);
        golden_put(9u, lobe.albedo);
        golden_put(10u, lobe.fresnel);
    } else if function == 21u {
        let lobe = GgxLobe(golden_mat3(0u), golden_number(9u), golden_number(10u));
        golden_put_vec3(0u, ggx_albedo(lobe, golden_vec3(11u), golden_vec3(14u)));
    } else if function == 22u {
        golden_put(0u, ggx_base_weight(golden_vec3(0u)));
    } else if function == 23u {
        golden_lights_factors(sheen_table, ggx_table);
    } else if function == 24u {
        let lobe = sheen_fit_lobe(golden_number(0u), golden_number(1u));
        golden_put_mat3(0u, lobe.m_inv);
        golden_put(9u, lobe.albedo);
    }
}

// The whole: what a light gives a diffuse surface, the sheen and the specular base, from one walk around it.
fn golden_lights_factors(sheen_table: texture_2d<f32>, ggx_table: texture_2d<f32>) {
    let position = golden_vec3(0u);
    let normal = golden_vec3(3u);
    let view = golden_vec3(6u);
    let count = u32(golden_number(12u));
    let frame = ltc_frame(normal, view);
    let mu = max(dot(normal, view), 0.0);
    let sheen = sheen_lobe(sheen_table, golden_number(9u), mu);
    let specular = ggx_lobe(ggx_table, golden_number(10u), mu);
    let first = golden_vec3(13u);
    var before = golden_vec3(10u + 3u * count);
    var outline = ltc_begin(frame * (before - position));
    var area = vec3<f32>(0.0, 0.0, 0.0);
    var sums = vec3<f32>(0.0, 0.0, 0.0);
    var turn = LTC_LEVEL;
    var specular_turn = LTC_LEVEL;
    for (var k = 0u; k < count; k++) {
        let corner = golden_vec3(13u + 3u * k);
        area = area + cross(before - first, corner - first);
        before = corner;
        outline = ltc_next(outline, frame * (corner - position));
        sums = sums + vec3<f32>(ltc_edge(outline, GOLDEN_IDENTITY), ltc_edge(outline, sheen.m_inv), ltc_edge(outline, specular.m_inv));
        turn = ltc_turn(turn, outline, GOLDEN_IDENTITY);
        specular_turn = ltc_turn(specular_turn, outline, specular.m_inv);
    }
    // Twice the area times the normal, by the winding: counter-clockwise is the lit side.
    let light_normal = area / max(length(area), 1e-30);
    let side = ltc_side(light_normal, first - position, golden_number(11u) != 0.0);
    golden_put(0u, mu);
    golden_put(1u, sheen.m_inv[0].x);
    golden_put(2u, sheen.m_inv[2].x);
    golden_put(3u, sheen.albedo);
    golden_put(4u, ltc_form_factor(sums.x, turn, GOLDEN_IDENTITY, side));
    golden_put(5u, ltc_form_factor(sums.z, specular_turn, specular.m_inv, side));
    golden_put(6u, ltc_form_factor(sums.y, turn, sheen.m_inv, side));
}

fn golden_sample_edge() -> LtcSampleFan {
    return ltc_sample_edge(golden_fan(0u), golden_vec3(33u), golden_vec3(36u), golden_vec3(39u), golden_number(42u), golden_mat3(43u));
}

fn golden_vec2(index: u32) -> vec2<f32> {
    return vec2<f32>(golden_number(index), golden_number(index + 1u));
}

fn golden_vec3(index: u32) -> vec3<f32> {
    return vec3<f32>(golden_number(index), golden_number(index + 1u), golden_number(index + 2u));
}

fn golden_mat3(index: u32) -> mat3x3<f32> {
    return mat3x3<f32>(golden_vec3(index), golden_vec3(index + 3u), golden_vec3(index + 6u));
}

fn golden_outline(index: u32) -> LtcOutline {
    let p = golden_vec3(index + 3u);
    let q = golden_vec3(index + 6u);
    let normal = golden_vec3(index + 9u);
    return LtcOutline(golden_vec3(index), p, q, normal, golden_number(index + 12u), golden_vec2(index + 13u));
}

fn golden_fan(index: u32) -> LtcSampleFan {
    let apex = golden_vec3(index + 2u);
    let reached = golden_vec3(index + 5u);
    let spoke = golden_vec3(index + 8u);
    let corners = golden_mat3(index + 12u);
    let normals = golden_mat3(index + 21u);
    let sectors = golden_vec3(index + 30u);
    return LtcSampleFan(golden_number(index), golden_number(index + 1u), apex, reached, spoke, golden_number(index + 11u), corners, normals, sectors);
}

fn golden_put_vec2(index: u32, v: vec2<f32>) {
    golden_put(index, v.x);
    golden_put(index + 1u, v.y);
}

fn golden_put_vec3(index: u32, v: vec3<f32>) {
    golden_put(index, v.x);
    golden_put(index + 1u, v.y);
    golden_put(index + 2u, v.z);
}

fn golden_put_mat3(index: u32, m: mat3x3<f32>) {
    golden_put_vec3(index, m[0]);
    golden_put_vec3(index + 3u, m[1]);
    golden_put_vec3(index + 6u, m[2]);
}

fn golden_put_outline(index: u32, outline: LtcOutline) {
    golden_put_vec3(index, outline.corner);
    golden_put_vec3(index + 3u, outline.p);
    golden_put_vec3(index + 6u, outline.q);
    golden_put_vec3(index + 9u, outline.normal);
    golden_put(index + 12u, outline.sine);
    golden_put_vec2(index + 13u, outline.turn);
}

fn golden_put_fan(index: u32, fan: LtcSampleFan) {
    golden_put(index, fan.left);
    golden_put(index + 1u, fan.drawn);
    golden_put_vec3(index + 2u, fan.apex);
    golden_put_vec3(index + 5u, fan.reached);
    golden_put_vec3(index + 8u, fan.spoke);
    golden_put(index + 11u, fan.spoke_sector);
    golden_put_mat3(index + 12u, fan.corners);
    golden_put_mat3(index + 21u, fan.normals);
    golden_put_vec3(index + 30u, fan.sectors);
}
