use glam::DVec3;
use std::f64::consts::PI;
use velour::math::quadrature::gauss_legendre;
use velour::physics::slab::Slab;

#[test]
fn unscattered_light_is_exact() {
    // Isotropic: extinction 1.
    assert!((Slab::new(1.0).unscattered(0.5) - (-2.0_f64).exp()).abs() < 1e-15);
    // Along the fibres: extinction sigma = alpha^2.
    assert!((Slab::new(0.5).unscattered(1.0) - (-0.25_f64).exp()).abs() < 1e-15);
    assert_eq!(Slab::new(0.5).unscattered(0.0), 0.0);
}

#[test]
fn single_scattering_of_the_isotropic_slab_is_the_textbook_one() {
    // Phase 1 / (4 pi), depths 1 / mu: the reflection function of Chandrasekhar's slab of optical thickness 1.
    let (mu_i, mu_o) = (0.8, 0.3);
    let (wi, wo) = (DVec3::new(0.6, 0.0, mu_i), DVec3::new(0.0, (1.0_f64 - 0.09).sqrt(), mu_o));
    let depth = 1.0 / mu_i + 1.0 / mu_o;
    let exact = mu_o * (1.0 - (-depth).exp()) / (4.0 * std::f64::consts::PI * (mu_i + mu_o));
    assert!((Slab::new(1.0).single_scattering(wi, wo) / exact - 1.0).abs() < 1e-14);
}

#[test]
fn single_scattering_is_reciprocal() {
    for alpha in [1.0, 0.3, 0.05] {
        let slab = Slab::new(alpha);
        let (wi, wo) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(-0.3, 0.95, 0.0_f64).normalize());
        let wo = (wo + DVec3::Z * 0.01).normalize();
        // f_r itself is symmetric, and each of these is f_r mu_i mu_o.
        let (there, back) = (slab.single_scattering(wi, wo) * wi.z, slab.single_scattering(wo, wi) * wo.z);
        assert!((there / back - 1.0).abs() < 1e-12, "alpha {alpha}: {there}, {back}");
    }
}

#[test]
fn single_scattering_is_finite_at_the_horizon() {
    let slab = Slab::new(1.0 / 31.0);
    let (grazing, up) = (DVec3::X, DVec3::Z);
    assert_eq!(slab.single_scattering(up, grazing), 0.0);
    assert_eq!(slab.single_scattering(grazing, grazing), 0.0);
    // A_i is infinite: all light scatters at the very top, and K / extinction(0) of it upwards, by flakes at 45
    // degrees.
    let limit = slab.medium().kernel(grazing, up);
    assert!((slab.single_scattering(grazing, up) / limit - 1.0).abs() < 1e-12);
}

#[test]
fn single_scattering_albedo_is_the_integral() {
    // Over mu_o = t^3 and phi = pi (1 - u^2), dense towards the horizon and straight on.
    let rule = gauss_legendre(96, 0.0, 1.0);
    for alpha in [0.01, 1.0 / 31.0, 0.1, 0.3, 1.0] {
        for mu in [0.0, 1e-3, 0.1, 1.0] {
            let slab = Slab::new(alpha);
            let wi = DVec3::new((1.0_f64 - mu * mu).sqrt(), 0.0, mu);
            let mut integral = 0.0;
            for (t, t_weight) in &rule {
                let mu_o = t * t * t;
                let s = (1.0 - mu_o * mu_o).sqrt();
                for (u, u_weight) in &rule {
                    let (sin_phi, cos_phi) = (PI * (1.0 - u * u)).sin_cos();
                    let wo = DVec3::new(s * cos_phi, s * sin_phi, mu_o);
                    let measure = 3.0 * t * t * t_weight * 4.0 * PI * u * u_weight;
                    integral += measure * slab.single_scattering(wi, wo);
                }
            }
            let albedo = slab.single_scattering_albedo(mu);
            // This quadrature's own error, which is largest where the lobe is thinnest.
            let tolerance = if alpha < 0.03 { 1e-4 } else { 3e-6 };
            assert!((integral / albedo - 1.0).abs() < tolerance, "alpha {alpha}, mu {mu}: {integral}, {albedo}");
        }
    }
}

#[test]
fn single_transmission_is_the_textbook_one_and_its_limit_along_one_elevation() {
    let (wi, below) = (DVec3::new(0.6, 0.0, 0.8), |mu: f64| DVec3::new(0.0, (1.0 - mu * mu).sqrt(), -mu));
    let slab = Slab::new(1.0);
    let exact = 0.3 * ((-1.0 / 0.8_f64).exp() - (-1.0 / 0.3_f64).exp()) / (4.0 * PI * (0.8 - 0.3));
    assert!((slab.single_transmission(wi, below(0.3)) / exact - 1.0).abs() < 1e-14);
    let limit = (-1.0 / 0.8_f64).exp() / (4.0 * PI * 0.8);
    for mu in [0.8, 0.8 - 1e-12, 0.8 + 1e-9] {
        assert!((slab.single_transmission(wi, below(mu)) / limit - 1.0).abs() < 1e-8, "mu {mu}");
    }
    assert_eq!(slab.single_transmission(wi, below(0.0)), 0.0);
    assert_eq!(slab.single_transmission(DVec3::X, below(0.5)), 0.0);
}
