// Shading, filtered over a pixel.

// Over a pixel at a silhouette the cosine to the view runs through 0, and only its positive part is seen. A single sample there could be anything
// up to the sheen's peak; this is the mean over the visible part of a pixel whose cosines span `width`.
fn filters_visible_mean(mu: f32, width: f32) -> f32 {
    let half_width = min(0.5 * width, 0.5);
    return 0.5 * (max(mu - half_width, 0.0) + max(mu + half_width, 0.0));
}

// Normals that vary over a pixel widen the specular lobe (Tokuyoshi and Kaplanyan 2019, eqs. 4 and 5: the half vector's variance from
// the normal's derivatives), as do those that a mipmap has averaged, whose mean is shorter than 1 (Toksvig 2005).
fn filters_roughness(roughness: f32, variance: f32, mean_length: f32) -> f32 {
    let mapped = 2.0 * (1.0 - mean_length) / max(mean_length, 0.5);
    let alpha = roughness * roughness;
    return sqrt(sqrt(min(alpha * alpha + min(variance + mapped, 0.18), 1.0)));
}
