// Materials: factors and textures to what a surface is made of at a point.

// The slots of textures (scene::TextureSlot).
const MATERIAL_BASE_COLOR = 0u;
const MATERIAL_METALLIC_ROUGHNESS = 1u;
const MATERIAL_NORMAL_MAP = 2u;
const MATERIAL_OCCLUSION = 3u;
const MATERIAL_EMISSION = 4u;
const MATERIAL_SPECULAR = 5u;
const MATERIAL_SPECULAR_COLOR = 6u;
const MATERIAL_SHEEN_COLOR = 7u;
const MATERIAL_SHEEN_ROUGHNESS = 8u;
const MATERIAL_SHEEN_WEIGHT = 9u;

const MATERIAL_LAYERING_GLTF = 0u;
const MATERIAL_LAYERING_OPENPBR = 1u;
const MATERIAL_LAYERING_RECIPROCAL = 2u;

// Rows of the matrices that take texture coordinates (u, v, 1) to each slot's; w = 1 in the first: of the second set.
struct MaterialTransforms {
    rows: array<vec4f, 20>,
}

struct MaterialSurface {
    base_color: vec3f,
    opacity: f32,
    metallic: f32,
    roughness: f32,
    f0: vec3f,
    f90: f32,
    // C_sheen, weighted.
    sheen_color: vec3f,
    sheen_weight: f32,
    sheen_alpha: f32,
    emission: vec3f,
    // As interpolated: not of unit length.
    normal: vec3f,
    // Of the mean of the unit normals that the normal map's texel stands for.
    normal_length: f32,
    occlusion: f32,
    // Which of the pixel's samples are covered, a bit each, where that counts.
    samples: u32,
    layering: u32,
    manual: f32,
}

@group(1) @binding(0) var material_base_color: texture_2d<f32>;
@group(1) @binding(1) var material_metallic_roughness: texture_2d<f32>;
@group(1) @binding(2) var material_normal: texture_2d<f32>;
@group(1) @binding(3) var material_occlusion: texture_2d<f32>;
@group(1) @binding(4) var material_emission: texture_2d<f32>;
@group(1) @binding(5) var material_specular: texture_2d<f32>;
@group(1) @binding(6) var material_specular_color: texture_2d<f32>;
@group(1) @binding(7) var material_sheen_color: texture_2d<f32>;
@group(1) @binding(8) var material_sheen_roughness: texture_2d<f32>;
@group(1) @binding(9) var material_sheen_weight: texture_2d<f32>;
@group(1) @binding(10) var material_base_color_sampler: sampler;
@group(1) @binding(11) var material_metallic_roughness_sampler: sampler;
@group(1) @binding(12) var material_normal_sampler: sampler;
@group(1) @binding(13) var material_occlusion_sampler: sampler;
@group(1) @binding(14) var material_emission_sampler: sampler;
@group(1) @binding(15) var material_specular_sampler: sampler;
@group(1) @binding(16) var material_specular_color_sampler: sampler;
@group(1) @binding(17) var material_sheen_color_sampler: sampler;
@group(1) @binding(18) var material_sheen_roughness_sampler: sampler;
@group(1) @binding(19) var material_sheen_weight_sampler: sampler;

// A uniform, because texture filtering takes derivatives, and helper invocations may read zeros from storage.
@group(1) @binding(20) var<uniform> material_transforms: MaterialTransforms;

// The base colour's, where that is cut out.
@group(1) @binding(21) var material_shares: texture_2d<f32>;
@group(1) @binding(22) var material_shares_sampler: sampler;

// The sheen's alpha for the user's roughness, both in [0, 1]: scene::RoughnessMap::alpha_from_roughness.
fn material_alpha_from_roughness(roughness: f32, exponent: f32) -> f32 {
    return pow(roughness, exponent);
}

// Without textures and vertex colours.
fn material_plain(material: u32, emission: vec3f, normal: vec3f) -> MaterialSurface {
    let factors = factors_of(material);
    return MaterialSurface(
        factors.base_color.rgb, factors.base_color.a, factors.metallic, factors.roughness, factors.f0,
        factors.specular, factors.sheen_color * factors.sheen_weight, factors.sheen_weight,
        material_alpha_from_roughness(factors.sheen_roughness, factors.alpha_exponent), emission, normal, 1.0, 1.0,
        select(0u, COVERAGE_ALL, factors.base_color.a >= factors.alpha_cutoff), factors.layering, factors.manual,
    );
}

fn material_has(slot: u32) -> bool {
    return (VARIANT_TEXTURES & (1u << slot)) != 0u;
}

fn material_uv(slot: u32, tex_coords: vec4f) -> vec2f {
    let u = material_transforms.rows[2u * slot];
    let v = material_transforms.rows[2u * slot + 1u];
    let at = vec3f(select(tex_coords.xy, tex_coords.zw, u.w != 0.0), 1.0);
    return vec2f(dot(u.xyz, at), dot(v.xyz, at));
}

fn material_textured(
    material: u32, emission: vec3f, normal: vec3f, tangent: vec4f, tex_coords: vec4f, color: vec4f, pixel: vec2f,
    seed: u32,
) -> MaterialSurface {
    var surface = material_plain(material, emission, normal);
    surface.base_color *= color.rgb;
    var texel = coverage_untextured();
    if material_has(MATERIAL_BASE_COLOR) {
        let uv = material_uv(MATERIAL_BASE_COLOR, tex_coords);
        texel = coverage_texel(
            material_base_color, material_base_color_sampler, material_shares, material_shares_sampler, uv, pixel,
        );
    }
    surface.base_color *= texel.color.rgb;
    if VARIANT_MASK {
        let cutoff = factors_of(material).alpha_cutoff;
        surface.samples = coverage_samples(texel, surface.opacity, color.a, cutoff, pixel, seed);
    }
    surface.opacity *= color.a * texel.color.a;
    if material_has(MATERIAL_METALLIC_ROUGHNESS) {
        let uv = material_uv(MATERIAL_METALLIC_ROUGHNESS, tex_coords);
        let texel = texels_at(material_metallic_roughness, material_metallic_roughness_sampler, uv, pixel);
        surface.roughness *= texel.g;
        surface.metallic *= texel.b;
    }
    if VARIANT_NORMAL_MAP {
        let uv = material_uv(MATERIAL_NORMAL_MAP, tex_coords);
        let texel = texels_at(material_normal, material_normal_sampler, uv, pixel);
        surface.normal_length = 1.0 - (1.0 - texel.a) * (1.0 - texel.a);
        let mapped = (2.0 * texel.xyz - 1.0) * vec3f(vec2f(factors_of(material).normal_scale), 1.0);
        let across = tangent.w * cross(normal, tangent.xyz);
        surface.normal = mapped.x * tangent.xyz + mapped.y * across + mapped.z * normal;
    }
    if material_has(MATERIAL_OCCLUSION) {
        let uv = material_uv(MATERIAL_OCCLUSION, tex_coords);
        let texel = texels_at(material_occlusion, material_occlusion_sampler, uv, pixel);
        surface.occlusion = 1.0 + factors_of(material).occlusion_strength * (texel.r - 1.0);
    }
    if material_has(MATERIAL_EMISSION) {
        let uv = material_uv(MATERIAL_EMISSION, tex_coords);
        surface.emission *= texels_at(material_emission, material_emission_sampler, uv, pixel).rgb;
    }
    if material_has(MATERIAL_SPECULAR) {
        let uv = material_uv(MATERIAL_SPECULAR, tex_coords);
        let strength = texels_at(material_specular, material_specular_sampler, uv, pixel).a;
        surface.f0 *= strength;
        surface.f90 *= strength;
    }
    if material_has(MATERIAL_SPECULAR_COLOR) {
        let uv = material_uv(MATERIAL_SPECULAR_COLOR, tex_coords);
        surface.f0 *= texels_at(material_specular_color, material_specular_color_sampler, uv, pixel).rgb;
    }
    if material_has(MATERIAL_SHEEN_COLOR) {
        let uv = material_uv(MATERIAL_SHEEN_COLOR, tex_coords);
        surface.sheen_color *= texels_at(material_sheen_color, material_sheen_color_sampler, uv, pixel).rgb;
    }
    if material_has(MATERIAL_SHEEN_ROUGHNESS) {
        let uv = material_uv(MATERIAL_SHEEN_ROUGHNESS, tex_coords);
        let texel = texels_at(material_sheen_roughness, material_sheen_roughness_sampler, uv, pixel);
        let factors = factors_of(material);
        surface.sheen_alpha = material_alpha_from_roughness(factors.sheen_roughness * texel.a, factors.alpha_exponent);
    }
    if material_has(MATERIAL_SHEEN_WEIGHT) {
        let uv = material_uv(MATERIAL_SHEEN_WEIGHT, tex_coords);
        let weight = texels_at(material_sheen_weight, material_sheen_weight_sampler, uv, pixel).r;
        surface.sheen_color *= weight;
        surface.sheen_weight *= weight;
    }
    return surface;
}
