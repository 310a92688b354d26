//! How the first pass filters shading over a pixel.

use velour::renderer::SURFACES_WGSL;

use super::device;

fn run(inputs: &[[f32; 4]]) -> Vec<[f32; 2]> {
    let source = [SURFACES_WGSL, include_str!("filters.wgsl")].concat();
    device::run(&source, &[bytemuck::cast_slice(inputs)], None, inputs.len())
}

/// A pixel that spans some cosines shows those above 0: their mean, by quadrature.
#[test]
fn the_sheen_is_seen_at_the_mean_of_the_visible_cosines() {
    let mut inputs = Vec::new();
    for mu in [-0.3f32, -0.1, 0.0, 0.05, 0.2, 0.9] {
        inputs.extend([0.0f32, 0.05, 0.3, 0.9].map(|width| [mu, width, 1.0, 0.0]));
    }
    for (&[mu, width, ..], [mean, _]) in inputs.iter().zip(run(&inputs)) {
        const POINTS: usize = 20_000;
        let at = |k: usize| f64::from(mu) + f64::from(width) * ((k as f64 + 0.5) / POINTS as f64 - 0.5);
        let seen: Vec<f64> = (0..POINTS).map(at).filter(|&cosine| cosine > 0.0).collect();
        let expected = if seen.is_empty() { 0.0 } else { seen.iter().sum::<f64>() / seen.len() as f64 };
        assert!((f64::from(mean) - expected).abs() < 1e-4, "{mu} +- {width} / 2: {mean} for {expected}");
    }
}

/// alpha^2 grows by the normals' variance, and by twice (1 - l) / l where a mipmap's mean normal is l long (Toksvig 2005); by 0.18 at
/// most (Tokuyoshi and Kaplanyan 2019).
#[test]
fn normals_that_vary_widen_the_specular_lobe() {
    let mut inputs = Vec::new();
    for roughness in [0.0f32, 0.2, 0.5, 1.0] {
        for variance in [0.0f32, 0.02, 0.15, 0.5] {
            inputs.extend([1.0f32, 0.98, 0.94, 0.6].map(|length| [roughness, variance, length, 0.0]));
        }
    }
    for (&[roughness, variance, length, _], [_, found]) in inputs.iter().zip(run(&inputs)) {
        let [roughness, variance, length] = [roughness, variance, length].map(f64::from);
        let added = (variance + 2.0 * (1.0 - length) / length).min(0.18);
        let expected = (roughness.powi(4) + added).min(1.0).powf(0.25);
        let found = f64::from(found);
        assert!((found - expected).abs() < 1e-5, "{roughness}, {variance}, {length}: {found} for {expected}");
    }
}
