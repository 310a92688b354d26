// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// A surface under any number of polygon lights: one walk round each light feeds the diffuse base, GGX and the sheen.
// Copy with it: ltc.glsl, sheen.glsl, ggx.glsl and both tables, before it; and, before it too, what reads your lights, as said below.
// Frame: positions and directions in world space, corners counter-clockwise seen from the side that a light shines to.
// Example: vec3 radiance = lights_shade(sheen_table, ggx_table, range, surface);
// Ranges: as of the files before it; lights planar, of 3 corners or more, convex or not; f0 no more than f90 in each channel.
// Greatest error: of form factors that of ltc.glsl, with 1e-7 size/distance, as corners are taken into the frame; of the tables' numbers 3e-6.
// Language: GLSL ES 3.00, where `precision highp float; precision highp int; precision highp sampler2D;` come before it, or any later GLSL.

// What reads your lights is yours, the struct LightsRange and six functions. A range is what tells which lights reach a point: a cluster, a tile,
// a count; where functions see no buffers but their arguments, it holds these too. A light that shines to one side has radiance power / (pi area).
//     uint lights_count(LightsRange range);
//     uint lights_corners(LightsRange range, uint light);
//     vec3 lights_corner(LightsRange range, uint light, uint index);
//     vec3 lights_normal(LightsRange range, uint light);
//     vec3 lights_radiance(LightsRange range, uint light);
//     bool lights_two_sided(LightsRange range, uint light);

// The inverse matrix of the diffuse lobe.
const mat3 LIGHTS_DIFFUSE = mat3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);

// What is lit.
struct LightsSurface {
    vec3 position;
    vec3 normal;      // unit, on the side that is seen
    vec3 view;        // unit, to the eye
    vec3 base_color;  // of the diffuse base: black for metals
    vec3 f0;          // reflectance head on: 0.04 for most, the colour of metals
    vec3 f90;         // and at grazing angles: 1
    float roughness;  // of the specular base; GGX's alpha is its square
    vec3 sheen_color;
    float alpha;      // roughness of the sheen: small is fuzz, large is dust
};

// What the surface scatters by, seen from where it is seen.
struct LightsLobes {
    mat3 frame;
    GgxLobe specular;
    SheenLobe sheen;
};

// A number for each lobe.
struct LightsFactors {
    float diffuse;
    float specular;
    float sheen;
};

// A colour for each lobe: the light that falls into it.
struct LightsIncident {
    vec3 diffuse;
    vec3 specular;
    vec3 sheen;
};

// On the way round a light.
struct LightsWalk {
    LtcOutline outline;
    LightsFactors sums;
    vec2 turn;           // along the horizon, of the diffuse lobe and the sheen
    vec2 specular_turn;  // and of GGX, which is not as wide as it is long
};

LightsLobes lights_lobes(sampler2D sheen_table, sampler2D ggx_table, LightsSurface surface) {
    float mu = max(dot(surface.normal, surface.view), 0.0);
    mat3 frame = ltc_frame(surface.normal, surface.view);
    return LightsLobes(frame, ggx_lobe(ggx_table, surface.roughness, mu), sheen_lobe(sheen_table, surface.alpha, mu));
}

// Corners are relative to the shaded point, in the lobes' frame.
LightsWalk lights_begin(vec3 last) {
    LightsFactors none = LightsFactors(0.0, 0.0, 0.0);
    return LightsWalk(ltc_begin(last), none, LTC_LEVEL, LTC_LEVEL);
}

LightsWalk lights_next(LightsWalk walk, vec3 corner, LightsLobes lobes) {
    LtcOutline outline = ltc_next(walk.outline, corner);
    LightsWalk next = walk;
    next.outline = outline;
    next.sums.diffuse += ltc_edge(outline, LIGHTS_DIFFUSE);
    next.sums.specular += ltc_edge(outline, lobes.specular.m_inv);
    next.sums.sheen += ltc_edge(outline, lobes.sheen.m_inv);
    next.turn = ltc_turn(walk.turn, outline, LIGHTS_DIFFUSE);
    next.specular_turn = ltc_turn(walk.specular_turn, outline, lobes.specular.m_inv);
    return next;
}

// The form factors; side is ltc_side's.
LightsFactors lights_end(LightsWalk walk, LightsLobes lobes, float side) {
    return LightsFactors(
        ltc_form_factor(walk.sums.diffuse, walk.turn, LIGHTS_DIFFUSE, side),
        ltc_form_factor(walk.sums.specular, walk.specular_turn, lobes.specular.m_inv, side),
        ltc_form_factor(walk.sums.sheen, walk.turn, lobes.sheen.m_inv, side));
}

// The form factors of a light of any number of corners.
LightsFactors lights_polygon(LightsLobes lobes, vec3 position, LightsRange range, uint light) {
    uint corners = lights_corners(range, light);
    vec3 last = lights_corner(range, light, corners - 1u) - position;
    LightsWalk walk = lights_begin(lobes.frame * last);
    for (uint k = 0u; k < corners; k++) {
        walk = lights_next(walk, lobes.frame * (lights_corner(range, light, k) - position), lobes);
    }
    float side = ltc_side(lights_normal(range, light), last, lights_two_sided(range, light));
    return lights_end(walk, lobes, side);
}

// The same of a light of four corners, without a loop: for where all lights are quads.
LightsFactors lights_quad(LightsLobes lobes, vec3 position, LightsRange range, uint light) {
    vec3 last = lights_corner(range, light, 3u) - position;
    LightsWalk walk = lights_begin(lobes.frame * last);
    walk = lights_next(walk, lobes.frame * (lights_corner(range, light, 0u) - position), lobes);
    walk = lights_next(walk, lobes.frame * (lights_corner(range, light, 1u) - position), lobes);
    walk = lights_next(walk, lobes.frame * (lights_corner(range, light, 2u) - position), lobes);
    walk = lights_next(walk, lobes.frame * last, lobes);
    float side = ltc_side(lights_normal(range, light), last, lights_two_sided(range, light));
    return lights_end(walk, lobes, side);
}

// The radiance towards the eye: sheen over specular over diffuse, as glTF layers them.
vec3 lights_shade(sampler2D sheen_table, sampler2D ggx_table, LightsRange range, LightsSurface surface) {
    LightsLobes lobes = lights_lobes(sheen_table, ggx_table, surface);
    LightsIncident incident = LightsIncident(vec3(0.0), vec3(0.0), vec3(0.0));
    for (uint light = 0u; light < lights_count(range); light++) {
        LightsFactors factors = lights_polygon(lobes, surface.position, range, light);
        vec3 radiance = lights_radiance(range, light);
        incident.diffuse += radiance * factors.diffuse;
        incident.specular += radiance * factors.specular;
        incident.sheen += radiance * factors.sheen;
    }
    vec3 reflectance = ggx_albedo(lobes.specular, surface.f0, surface.f90);
    vec3 diffuse = surface.base_color * ggx_base_weight(reflectance) * incident.diffuse;
    vec3 below = sheen_base_weight(surface.sheen_color, lobes.sheen.albedo) * (diffuse + reflectance * incident.specular);
    return below + surface.sheen_color * lobes.sheen.albedo * incident.sheen;
}

// A light's area times its normal, by its winding: half the sum of cross products round it. For a buffer of normals, not for each pixel.
vec3 lights_area_vector(LightsRange range, uint light) {
    vec3 first = lights_corner(range, light, 0u);
    vec3 sum = vec3(0.0);
    for (uint k = 2u; k < lights_corners(range, light); k++) {
        sum += 0.5 * cross(lights_corner(range, light, k - 1u) - first, lights_corner(range, light, k) - first);
    }
    return sum;
}
