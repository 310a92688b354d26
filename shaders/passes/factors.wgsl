// A material's factors: what it is made of where no texture says more.

struct Factors {
    base_color: vec4f,
    sheen_color: vec3f,
    sheen_weight: f32,
    // Of a dielectric; specular is its value at grazing angles and scales it.
    f0: vec3f,
    specular: f32,
    metallic: f32,
    roughness: f32,
    sheen_roughness: f32,
    // alpha = roughness^exponent
    alpha_exponent: f32,
    normal_scale: f32,
    occlusion_strength: f32,
    alpha_cutoff: f32,
    layering: u32,
    // What is left of the base where layering is none of MATERIAL_LAYERING_...
    manual: f32,
}

// Texels of a material.
const FACTORS_TEXELS = 6u;

fn factors_of(material: u32) -> Factors {
    let first = FACTORS_TEXELS * material;
    let base = bitcast<vec4f>(numbers_at(first));
    let sheen = bitcast<vec4f>(numbers_at(first + 1u));
    let f0 = bitcast<vec4f>(numbers_at(first + 2u));
    let shape = bitcast<vec4f>(numbers_at(first + 3u));
    let rest = numbers_at(first + 4u);
    let scales = bitcast<vec4f>(rest);
    return Factors(
        base, sheen.rgb, sheen.a, f0.rgb, f0.a, shape.x, shape.y, shape.z, shape.w, scales.x, scales.y, scales.z, rest.w,
        bitcast<f32>(numbers_at(first + 5u).x),
    );
}
