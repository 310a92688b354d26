// The second pass: a frame's radiance, multisampled or not, to what is shown (tone curve, sRGB) or measured
// (the plain mean of a pixel's samples).

// Whether there are filtered shares of radiance that are left; otherwise what is known to be blocked is subtracted.
override DISPLAY_FILTERED: bool = false;
// What a pipeline shows with. 0: clamped; 1: Khronos PBR Neutral; 2: AgX.
override DISPLAY_TONE_CURVE: u32 = 0;

struct DisplayUniforms {
    // The pixel of the output that shows the radiance's first.
    origin: vec2u,
    // What exposed radiance is multiplied by: its exposure may have changed since.
    gain: f32,
}

@group(0) @binding(0) var<uniform> display_uniforms: DisplayUniforms;
@group(0) @binding(1) var display_radiance: texture_2d<f32>;
@group(0) @binding(2) var display_radiance_multisampled: texture_multisampled_2d<f32>;
// Of a frame with shadows: what is blocked, and the shares that are left.
@group(0) @binding(3) var display_blocked: texture_2d<f32>;
@group(0) @binding(4) var display_shares: texture_2d<f32>;

// Khronos PBR Neutral Tone Mapper, specification of 2024.
fn display_neutral(radiance: vec3f) -> vec3f {
    let fresnel = 0.04;
    let start = 0.8 - fresnel;
    let bounded = clamp(radiance, vec3f(0.0), vec3f(1e6));
    let least = min(bounded.r, min(bounded.g, bounded.b));
    let offset = select(fresnel, least - least * least / (4.0 * fresnel), least < 2.0 * fresnel);
    let color = bounded - offset;
    let peak = max(color.r, max(color.g, color.b));
    if peak < start {
        return color;
    }
    let room = 1.0 - start;
    let new_peak = 1.0 - room * room / (peak + room - start);
    let white = 1.0 - 1.0 / (0.15 * (peak - new_peak) + 1.0);
    return mix(color * (new_peak / peak), vec3f(new_peak), white);
}

// AgX (T. Sobotka 2022) as in Blender 4: see src/picture/tone.rs.
fn display_agx(radiance: vec3f) -> vec3f {
    let lowest = -12.47393;
    let highest = 4.026069;
    // Columns: linear Rec. 709 to Rec. 2020 with its primaries moved inwards.
    let inset = mat3x3f(
        0.544815, 0.140417, 0.088810,
        0.373787, 0.754138, 0.178872,
        0.081398, 0.105445, 0.732318);
    let outset = mat3x3f(
        1.12710060, -0.14132976, -0.14132976,
        -0.11060664, 1.15782370, -0.11060664,
        -0.01649394, -0.01649394, 1.25193640);
    let rec709_from_rec2020 = mat3x3f(
        1.660491, -0.124550, -0.018151,
        -0.587641, 1.132899, -0.100579,
        -0.072850, -0.008349, 1.118730);
    let color = inset * clamp(radiance, vec3f(0.0), vec3f(1e6));
    let stops = clamp(log2(max(color, vec3f(1e-6))), vec3f(lowest), vec3f(highest));
    let x = (stops - lowest) / (highest - lowest);
    let curve = (((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x - 0.00232;
    let linear = pow(max(outset * curve, vec3f(0.0)), vec3f(2.2));
    return clamp(rec709_from_rec2020 * linear, vec3f(0.0), vec3f(1.0));
}

// What an exposed radiance looks like: display-linear, in [0, 1].
fn display_tone(exposed: vec3f) -> vec3f {
    switch DISPLAY_TONE_CURVE {
        case 1u: {
            return display_neutral(exposed);
        }
        case 2u: {
            return display_agx(exposed);
        }
        default: {
            return clamp(exposed, vec3f(0.0), vec3f(1.0));
        }
    }
}

// The same where a share of it, in [0, 1], is lit; unlit colours are shown as they are.
fn display_seen(exposed: vec4f) -> vec3f {
    let as_it_is = clamp(exposed.rgb, vec3f(0.0), vec3f(1.0));
    return mix(as_it_is, display_tone(exposed.rgb), exposed.a);
}

fn display_srgb(linear: vec3f) -> vec4f {
    let curve = 1.055 * pow(max(linear, vec3f(1e-8)), vec3f(1.0 / 2.4)) - 0.055;
    return vec4f(select(curve, 12.92 * linear, linear <= vec3f(0.0031308)), 1.0);
}

// The share of a pixel's radiance that is left.
fn display_share(pixel: vec2u) -> vec3f {
    if DISPLAY_FILTERED {
        return textureLoad(display_shares, pixel, 0).rgb;
    }
    return vec3f(1.0);
}

// What such a share leaves of it, exposed anew.
fn display_shared(radiance: vec4f, share: vec3f) -> vec4f {
    if !DISPLAY_FILTERED {
        return radiance;
    }
    return vec4f(radiance.rgb * share * mix(1.0, display_uniforms.gain, radiance.a), radiance.a);
}

@fragment
fn display_shown_single(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy) - display_uniforms.origin;
    return display_srgb(display_seen(display_shared(textureLoad(display_radiance, pixel, 0), display_share(pixel))));
}

// Each sample goes through the tone curve before the mean is taken: the edge of a bright light stays smooth.
@fragment
fn display_shown_multisampled(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy) - display_uniforms.origin;
    let share = display_share(pixel);
    var sum = vec3f(0.0);
    for (var sample = 0u; sample < 4u; sample++) {
        sum += display_seen(display_shared(textureLoad(display_radiance_multisampled, pixel, sample), share));
    }
    return display_srgb(0.25 * sum);
}

@fragment
fn display_measured_single(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return textureLoad(display_radiance, vec2u(position.xy) - display_uniforms.origin, 0);
}

@fragment
fn display_measured_multisampled(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy) - display_uniforms.origin;
    var sum = vec4f(0.0);
    for (var sample = 0u; sample < 4u; sample++) {
        sum += textureLoad(display_radiance_multisampled, pixel, sample);
    }
    return 0.25 * sum;
}

// What is left of a pixel's radiance, and the share of it that is lit.
fn display_left(position: vec4f) -> vec4f {
    let pixel = vec2u(position.xy) - display_uniforms.origin;
    let radiance = textureLoad(display_radiance, pixel, 0);
    if DISPLAY_FILTERED {
        return display_shared(radiance, display_share(pixel));
    }
    let left = max(radiance.rgb - textureLoad(display_blocked, pixel, 0).rgb, vec3f(0.0));
    return vec4f(left * mix(1.0, display_uniforms.gain, radiance.a), radiance.a);
}

@fragment
fn display_shown_shadowed(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return display_srgb(display_seen(display_left(position)));
}

@fragment
fn display_measured_shadowed(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return display_left(position);
}
