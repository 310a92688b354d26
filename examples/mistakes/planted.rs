//! Mistakes as edits of the shaders' text.

/// What stands there, and what is written instead.
type Edit = (&'static str, &'static str);

/// By the names that golden numbers give them.
pub const MISTAKES: [(&str, &[Edit]); 9] = [
    ("table_transposed", &[("vec2(alpha, mu)", "vec2(mu, alpha)")]),
    (
        "m_inv_transposed",
        &[(
            "mat3x3(abr.x, 0.0, 0.0, 0.0, abr.x, 0.0, abr.y, 0.0, 1.0)",
            "mat3x3(abr.x, 0.0, abr.y, 0.0, abr.x, 0.0, 0.0, 0.0, 1.0)",
        )],
    ),
    ("frame_transposed", &[("return transpose(mat3x3(turn.x", "return (mat3x3(turn.x")]),
    (
        "frame_about_light",
        &[(
            "ltc_frame(surface.normal, surface.view)",
            "ltc_frame(surface.normal, normalize(vec3f(-2.0, 1.0, -1.0) - surface.position))",
        )],
    ),
    ("b_sign", &[("abr.y, 0.0, 1.0)", "-abr.y, 0.0, 1.0)")]),
    ("alpha_squared", &[("vec2(alpha, mu)", "vec2(alpha * alpha, mu)")]),
    (
        "no_half_texel",
        &[(
            "let at = clamp(vec2(alpha, mu), vec2(0.0), vec2(1.0)) * vec2<f32>(last);",
            "let at = clamp(vec2(alpha, mu) * vec2<f32>(last + 1u) - 0.5, vec2(0.0), vec2<f32>(last));",
        )],
    ),
    ("turn_forgotten", &[("return turned / max(abs(turned.x) + abs(turned.y), 1e-37);", "return turn;")]),
    (
        "winding_reversed",
        &[
            ("corners - 1u) - position", "0u) - position"),
            ("lights_corner(range, light, k) - position", "lights_corner(range, light, corners - 1u - k) - position"),
            ("ltc_side(lights_normal", "ltc_side(-lights_normal"),
        ],
    ),
];

/// The shaders, with the reader's side and the picture's, edited. Panics where what is edited does not stand there.
pub fn source(edits: &[Edit]) -> String {
    let files = [
        include_str!("../../shaders/ltc.wgsl"),
        include_str!("../../shaders/sheen.wgsl"),
        include_str!("../../shaders/ggx.wgsl"),
        include_str!("../lights_buffers.wgsl"),
        include_str!("../lights.wgsl"),
        include_str!("shell.wgsl"),
    ];
    edits.iter().fold(files.concat(), |source, (from, to)| {
        assert!(source.contains(from), "'{from}' stands in the files");
        source.replace(from, to)
    })
}
