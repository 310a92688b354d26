// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// A surface under any number of polygon lights: one walk round each light feeds the diffuse base, GGX and the sheen.
// Copy with it: ltc.wgsl, sheen.wgsl, ggx.wgsl and both tables, before it; and, before it too, what reads your lights, as said below.
// Frame: positions and directions in world space, corners counter-clockwise seen from the side that a light shines to.
// Example: let radiance = lights_shade(sheen_table, ggx_table, range, surface);
// Ranges: as of the files before it; lights planar, of 3 corners or more, convex or not; f0 no more than f90 in each channel.
// Greatest error: of form factors that of ltc.wgsl, with 1e-7 size/distance, as corners are taken into the frame; of the tables' numbers 3e-6.

// What reads your lights is yours, the struct LightsRange and six functions. A range is what tells which lights reach a point: a cluster, a tile,
// a count; where functions see no buffers but their arguments, it holds these too. A light that shines to one side has radiance power / (pi area).
//     fn lights_count(range: LightsRange) -> u32
//     fn lights_corners(range: LightsRange, light: u32) -> u32
//     fn lights_corner(range: LightsRange, light: u32, index: u32) -> vec3<f32>
//     fn lights_normal(range: LightsRange, light: u32) -> vec3<f32>
//     fn lights_radiance(range: LightsRange, light: u32) -> vec3<f32>
//     fn lights_two_sided(range: LightsRange, light: u32) -> bool

// The inverse matrix of the diffuse lobe.
const LIGHTS_DIFFUSE = mat3x3<f32>(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);

// What is lit.
struct LightsSurface {
    position: vec3<f32>,
    normal: vec3<f32>,       // unit, on the side that is seen
    view: vec3<f32>,         // unit, to the eye
    base_color: vec3<f32>,   // of the diffuse base: black for metals
    f0: vec3<f32>,           // reflectance head on: 0.04 for most, the colour of metals
    f90: vec3<f32>,          // and at grazing angles: 1
    roughness: f32,          // of the specular base; GGX's alpha is its square
    sheen_color: vec3<f32>,
    alpha: f32,              // roughness of the sheen: small is fuzz, large is dust
}

// What the surface scatters by, seen from where it is seen.
struct LightsLobes {
    frame: mat3x3<f32>,
    specular: GgxLobe,
    sheen: SheenLobe,
}

// A number for each lobe.
struct LightsFactors {
    diffuse: f32,
    specular: f32,
    sheen: f32,
}

// A colour for each lobe: the light that falls into it.
struct LightsIncident {
    diffuse: vec3<f32>,
    specular: vec3<f32>,
    sheen: vec3<f32>,
}

// On the way round a light.
struct LightsWalk {
    outline: LtcOutline,
    sums: LightsFactors,
    turn: vec2<f32>,           // along the horizon, of the diffuse lobe and the sheen
    specular_turn: vec2<f32>,  // and of GGX, which is not as wide as it is long
}

fn lights_lobes(sheen_table: texture_2d<f32>, ggx_table: texture_2d<f32>, surface: LightsSurface) -> LightsLobes {
    let mu = max(dot(surface.normal, surface.view), 0.0);
    let frame = ltc_frame(surface.normal, surface.view);
    return LightsLobes(frame, ggx_lobe(ggx_table, surface.roughness, mu), sheen_lobe(sheen_table, surface.alpha, mu));
}

// Corners are relative to the shaded point, in the lobes' frame.
fn lights_begin(last: vec3<f32>) -> LightsWalk {
    let none = LightsFactors(0.0, 0.0, 0.0);
    return LightsWalk(ltc_begin(last), none, LTC_LEVEL, LTC_LEVEL);
}

fn lights_next(walk: LightsWalk, corner: vec3<f32>, lobes: LightsLobes) -> LightsWalk {
    let outline = ltc_next(walk.outline, corner);
    var next = walk;
    next.outline = outline;
    next.sums.diffuse += ltc_edge(outline, LIGHTS_DIFFUSE);
    next.sums.specular += ltc_edge(outline, lobes.specular.m_inv);
    next.sums.sheen += ltc_edge(outline, lobes.sheen.m_inv);
    next.turn = ltc_turn(walk.turn, outline, LIGHTS_DIFFUSE);
    next.specular_turn = ltc_turn(walk.specular_turn, outline, lobes.specular.m_inv);
    return next;
}

// The form factors; side is ltc_side's.
fn lights_end(walk: LightsWalk, lobes: LightsLobes, side: f32) -> LightsFactors {
    return LightsFactors(
        ltc_form_factor(walk.sums.diffuse, walk.turn, LIGHTS_DIFFUSE, side),
        ltc_form_factor(walk.sums.specular, walk.specular_turn, lobes.specular.m_inv, side),
        ltc_form_factor(walk.sums.sheen, walk.turn, lobes.sheen.m_inv, side));
}

// The form factors of a light of any number of corners.
fn lights_polygon(lobes: LightsLobes, position: vec3<f32>, range: LightsRange, light: u32) -> LightsFactors {
    let corners = lights_corners(range, light);
    let last = lights_corner(range, light, corners - 1u) - position;
    var walk = lights_begin(lobes.frame * last);
    for (var k = 0u; k < corners; k++) {
        walk = lights_next(walk, lobes.frame * (lights_corner(range, light, k) - position), lobes);
    }
    let side = ltc_side(lights_normal(range, light), last, lights_two_sided(range, light));
    return lights_end(walk, lobes, side);
}

// The same of a light of four corners, without a loop: for where all lights are quads.
fn lights_quad(lobes: LightsLobes, position: vec3<f32>, range: LightsRange, light: u32) -> LightsFactors {
    let last = lights_corner(range, light, 3u) - position;
    var walk = lights_begin(lobes.frame * last);
    walk = lights_next(walk, lobes.frame * (lights_corner(range, light, 0u) - position), lobes);
    walk = lights_next(walk, lobes.frame * (lights_corner(range, light, 1u) - position), lobes);
    walk = lights_next(walk, lobes.frame * (lights_corner(range, light, 2u) - position), lobes);
    walk = lights_next(walk, lobes.frame * last, lobes);
    let side = ltc_side(lights_normal(range, light), last, lights_two_sided(range, light));
    return lights_end(walk, lobes, side);
}

// The radiance towards the eye: sheen over specular over diffuse, as glTF layers them.
fn lights_shade(sheen_table: texture_2d<f32>, ggx_table: texture_2d<f32>, range: LightsRange, surface: LightsSurface) -> vec3<f32> {
    let lobes = lights_lobes(sheen_table, ggx_table, surface);
    var incident = LightsIncident(vec3(0.0), vec3(0.0), vec3(0.0));
    for (var light = 0u; light < lights_count(range); light++) {
        let factors = lights_polygon(lobes, surface.position, range, light);
        let radiance = lights_radiance(range, light);
        incident.diffuse += radiance * factors.diffuse;
        incident.specular += radiance * factors.specular;
        incident.sheen += radiance * factors.sheen;
    }
    let reflectance = ggx_albedo(lobes.specular, surface.f0, surface.f90);
    let diffuse = surface.base_color * ggx_base_weight(reflectance) * incident.diffuse;
    let below = sheen_base_weight(surface.sheen_color, lobes.sheen.albedo) * (diffuse + reflectance * incident.specular);
    return below + surface.sheen_color * lobes.sheen.albedo * incident.sheen;
}

// A light's area times its normal, by its winding: half the sum of cross products round it. For a buffer of normals, not for each pixel.
fn lights_area_vector(range: LightsRange, light: u32) -> vec3<f32> {
    let first = lights_corner(range, light, 0u);
    var sum = vec3(0.0);
    for (var k = 2u; k < lights_corners(range, light); k++) {
        sum += 0.5 * cross(lights_corner(range, light, k - 1u) - first, lights_corner(range, light, k) - first);
    }
    return sum;
}
