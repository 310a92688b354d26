// PLACEHOLDER until merged
struct GgxLobe { m_inv: mat3x3<f32>, albedo: f32, fresnel: f32 }
fn ggx_lobe(table: texture_2d<f32>, roughness: f32, mu: f32) -> GgxLobe {
    return GgxLobe(mat3x3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0), 1.0, textureLoad(table, vec2(0u), 0).x * 0.0 + roughness * mu * 0.0);
}
fn ggx_albedo(lobe: GgxLobe, f0: vec3<f32>, f90: vec3<f32>) -> vec3<f32> { return f0 * (lobe.albedo - lobe.fresnel) + f90 * lobe.fresnel; }
fn ggx_base_weight(albedo: vec3<f32>) -> f32 { return 1.0 - max(albedo.r, max(albedo.g, albedo.b)); }
