use glam::DVec3;
use velour::fit::{hemisphere::Hemisphere, lobe::single_scattering};
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
        // f_r itself is symmetric: times mu_i here, times mu_o there.
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
    // A_i is infinite: all light scatters at the top, half of it by flakes at 45 degrees: K / extinction(0).
    let limit = slab.medium().kernel(grazing, up);
    assert!((slab.single_scattering(grazing, up) / limit - 1.0).abs() < 1e-12);
}

#[test]
fn single_scattering_albedo_is_the_integral() {
    let hemisphere = Hemisphere::default();
    for alpha in [1.0 / 31.0, 0.1, 0.3, 1.0] {
        for mu in [1e-3, 0.1, 1.0] {
            let slab = Slab::new(alpha);
            let values = single_scattering(slab, mu, &hemisphere);
            let integral = hemisphere.integral(|node| values[node]);
            let albedo = slab.single_scattering_albedo(mu);
            // The other quadrature's error, largest where the lobe is thinnest (7e-4 at the first of these).
            assert!((integral / albedo - 1.0).abs() < 1e-3, "alpha {alpha}, mu {mu}: {integral}, {albedo}");
        }
    }
}
