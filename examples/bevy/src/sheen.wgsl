// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// The fragment shader of a StandardMaterial under a sheen. sheen.rs puts examples/lights.wgsl behind it, and what that
// asks of its reader is here.

#import bevy_pbr::{
    forward_io::{VertexOutput, FragmentOutput},
    lighting,
    mesh_view_bindings as view_bindings,
    pbr_fragment::pbr_input_from_standard_material,
    pbr_functions,
    pbr_types,
}
#import velour::ltc::{
    LtcOutline, LTC_LEVEL, ltc_frame, ltc_side, ltc_begin, ltc_next, ltc_edge, ltc_turn, ltc_form_factor
}
#import velour::sheen::{SheenLobe, sheen_lobe, sheen_base_weight}
#import velour::ggx::{GgxLobe, ggx_lobe, ggx_albedo, ggx_base_weight}

struct SurfaceSheen {
    color: vec4<f32>,
    alpha: f32,
}

@group(#{MATERIAL_BIND_GROUP}) @binding(100) var<uniform> surface_sheen: SurfaceSheen;
@group(#{MATERIAL_BIND_GROUP}) @binding(101) var surface_sheen_table: texture_2d<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(102) var surface_ggx_table: texture_2d<f32>;

// Bevy holds all rectangle lights for all points; how far they reach depends on the point.
struct LightsRange {
    position: vec3<f32>,
}

fn lights_count(range: LightsRange) -> u32 {
    return view_bindings::lights.n_rect_lights;
}

fn lights_corners(range: LightsRange, light: u32) -> u32 {
    return 4u;
}

// A light shines along its -z, from where its x points left.
fn lights_corner(range: LightsRange, light: u32, index: u32) -> vec3<f32> {
    let rect = &view_bindings::lights.rect_lights[light];
    let x = select(-0.5, 0.5, index == 0u || index == 3u) * (*rect).width;
    let y = select(-0.5, 0.5, index >= 2u) * (*rect).height;
    return (*rect).position + x * (*rect).right + y * (*rect).up;
}

fn lights_normal(range: LightsRange, light: u32) -> vec3<f32> {
    let rect = &view_bindings::lights.rect_lights[light];
    return cross((*rect).up, (*rect).right);
}

// With the fade that Bevy gives a light towards its range.
fn lights_radiance(range: LightsRange, light: u32) -> vec3<f32> {
    let rect = &view_bindings::lights.rect_lights[light];
    let away = (*rect).position - range.position;
    let reach = max((*rect).range * (*rect).range, 1e-4);
    return (*rect).color.rgb * lighting::getRangeFalloff(dot(away, away), 1.0 / reach);
}

fn lights_two_sided(range: LightsRange, light: u32) -> bool {
    return false;
}

#ifndef VELOUR_TERMS
// The radiance of the sheen alone.
fn surface_sheen_radiance(lobe: SheenLobe, range: LightsRange, normal: vec3<f32>, view: vec3<f32>) -> vec3<f32> {
    let frame = ltc_frame(normal, view);
    var incident = vec3(0.0);
    for (var light = 0u; light < lights_count(range); light++) {
        let last = lights_corner(range, light, 3u) - range.position;
        var outline = ltc_begin(frame * last);
        var sum = 0.0;
        var turn = LTC_LEVEL;
        for (var k = 0u; k < 4u; k++) {
            outline = ltc_next(outline, frame * (lights_corner(range, light, k) - range.position));
            sum += ltc_edge(outline, lobe.m_inv);
            turn = ltc_turn(turn, outline, lobe.m_inv);
        }
        let side = ltc_side(lights_normal(range, light), last, false);
        incident += lights_radiance(range, light) * ltc_form_factor(sum, turn, lobe.m_inv, side);
    }
    return surface_sheen.color.rgb * lobe.albedo * incident;
}
#endif

// The radiance of rectangle lights: all of it, or that of the sheen alone where Bevy has added the other terms.
fn surface_radiance(pbr: pbr_types::PbrInput, lobe: SheenLobe) -> vec3<f32> {
    let range = LightsRange(pbr.world_position.xyz);
#ifdef VELOUR_TERMS
    let material = pbr.material;
    let base_color = pbr_functions::calculate_diffuse_color(
        material.base_color.rgb, material.metallic, material.specular_transmission, material.diffuse_transmission);
    let f0 = pbr_functions::calculate_F0(material.base_color.rgb, material.metallic, material.reflectance);
    return lights_shade(surface_sheen_table, surface_ggx_table, range, LightsSurface(
        range.position, pbr.N, pbr.V, base_color, f0, vec3(1.0), material.perceptual_roughness,
        surface_sheen.color.rgb, surface_sheen.alpha));
#else
    return surface_sheen_radiance(lobe, range, pbr.N, pbr.V);
#endif
}

@fragment
fn fragment(in: VertexOutput, @builtin(front_facing) is_front: bool) -> FragmentOutput {
    var pbr = pbr_input_from_standard_material(in, is_front);
    pbr.material.base_color = pbr_functions::alpha_discard(pbr.material, pbr.material.base_color);
    // What glows is not dimmed by the sheen.
    let exposure = view_bindings::view.exposure;
    let glow = pbr.material.emissive.rgb * mix(1.0, exposure, pbr.material.emissive.a) * pbr.material.base_color.a;
    pbr.material.emissive = vec4(0.0);

    let lobe = sheen_lobe(surface_sheen_table, surface_sheen.alpha, max(dot(pbr.N, pbr.V), 0.0));
    let below = pbr_functions::apply_pbr_lighting(pbr);
    let weight = sheen_base_weight(surface_sheen.color.rgb, lobe.albedo);
    let ambient = surface_sheen.color.rgb * lobe.albedo * view_bindings::lights.ambient_color.rgb;
    let radiance = weight * below.rgb + exposure * (surface_radiance(pbr, lobe) + ambient) + glow;
    var out: FragmentOutput;
    out.color = pbr_functions::main_pass_post_lighting_processing(pbr, vec4(radiance, below.a));
    return out;
}
