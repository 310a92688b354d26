// Fills the table of the prior sheens' albedos: a target of its size, a texel each node.

// Steps of the cube root of the cosine of wo, and of half a turn, that albedos are summed over.
const PRIOR_ALBEDOS_ELEVATIONS = 48u;
const PRIOR_ALBEDOS_AZIMUTHS = 32u;

@vertex
fn prior_albedos_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(select(-1.0, 3.0, index == 1u), select(-1.0, 3.0, index == 2u), 0.0, 1.0);
}

@fragment
fn prior_albedos_fragment(@builtin(position) position: vec4f) -> @location(0) u32 {
    let view = prior_sheens_view_of_node(vec2<u32>(position.xy));
    // Drivers' sines may err by 5e-4, which narrow lobes would show: so directions are normalised.
    var sum = 0.0;
    for (var k = 0u; k < PRIOR_ALBEDOS_ELEVATIONS * PRIOR_ALBEDOS_AZIMUTHS; k++) {
        let rise = (f32(k / PRIOR_ALBEDOS_AZIMUTHS) + 0.5) / f32(PRIOR_ALBEDOS_ELEVATIONS);
        let phi = (f32(k % PRIOR_ALBEDOS_AZIMUTHS) + 0.5) / f32(PRIOR_ALBEDOS_AZIMUTHS) * LTC_PI;
        let height = rise * rise * rise;
        let sine = sqrt((1.0 - height) * (1.0 + height));
        let wo = vec3f(sine * normalize(vec2f(cos(phi), sin(phi))), height);
        sum += 3.0 * rise * rise * prior_sheens_value(view, wo);
    }
    let albedo = sum * 2.0 * LTC_PI / f32(PRIOR_ALBEDOS_ELEVATIONS * PRIOR_ALBEDOS_AZIMUTHS);
    return bitcast<u32>(log(max(albedo, 1e-20)));
}
