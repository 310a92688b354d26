// The lobes of a surface, each in a slot of its own: diffuse, specular and sheen.

@group(0) @binding(1) var lobes_sheen_table: texture_2d<f32>;
@group(0) @binding(2) var lobes_ggx_table: texture_2d<f32>;

// The inverse matrix of the diffuse lobe, which is the same everywhere.
const LOBES_DIFFUSE = mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);

// The lobes that tables give.
struct Lobes {
    specular: GgxLobe,
    sheen: SheenLobe,
}

// A number for each lobe: its sum along an outline, its form factor, its density.
struct LobesScalars {
    diffuse: f32,
    specular: f32,
    sheen: f32,
}

// A vector for each lobe, in the space where it is a cosine: its sum along an outline, the mean direction of a light.
struct LobesVectors {
    diffuse: vec3f,
    specular: vec3f,
    sheen: vec3f,
}

// A colour for each lobe: the light that falls into it.
struct LobesColors {
    diffuse: vec3f,
    specular: vec3f,
    sheen: vec3f,
}

fn lobes_at(roughness: f32, sheen_alpha: f32, mu: f32) -> Lobes {
    return Lobes(ggx_lobe(lobes_ggx_table, roughness, mu), lobes_sheen(sheen_alpha, mu));
}

// With the albedo of the variant's model: sums over points are divided by that, as the transformed cosine's density is.
fn lobes_sheen(alpha: f32, mu: f32) -> SheenLobe {
    var lobe = sheen_lobe(lobes_sheen_table, alpha, mu);
    if VARIANT_PRIOR_SHEEN {
        lobe.albedo = prior_sheens_albedo(alpha, mu);
    }
    return lobe;
}
