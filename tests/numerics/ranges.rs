//! The solver's and the slab's ranges: what is outside is refused, and what is inside works up to the ends.

use velour::physics::slab::Slab;
use velour::physics::transport::{Resolution, Transport};

fn solve(alpha: f64, modes: usize, refinement: f64) -> Transport {
    Transport::new(Slab::new(alpha), Resolution { modes, refinement, ridge: None })
}

#[test]
fn what_is_out_of_range_is_told() {
    let solution = solve(0.5, 1, 0.5);
    for mu in [-0.1, 1.1, f64::NAN, f64::INFINITY] {
        let caught = std::panic::catch_unwind(|| solution.albedo(mu)).expect_err("a wrong cosine");
        let message = caught.downcast_ref::<String>().expect("a message");
        assert!(message.contains("mu is in [0, 1]"), "{message}");
    }
    for alpha in [0.0, -0.5, 1.5, f64::NAN] {
        assert!(std::panic::catch_unwind(|| Slab::new(alpha)).is_err(), "alpha {alpha}");
    }
    for mu in [-0.5, 1.5, f64::NAN] {
        assert!(std::panic::catch_unwind(|| Slab::new(0.5).single_scattering_albedo(mu)).is_err(), "mu {mu}");
    }
    for thickness in [0.0, 1e300, f64::NAN] {
        assert!(
            std::panic::catch_unwind(|| Slab::new(0.5).with_thickness(thickness)).is_err(),
            "thickness {thickness}"
        );
    }
    for refinement in [0.0, 0.1, 17.0, f64::NAN] {
        assert!(std::panic::catch_unwind(|| solve(0.5, 1, refinement)).is_err(), "refinement {refinement}");
    }
    for alpha in [0.01, 0.1, 0.3, 0.45, 1.0] {
        let (coarsest, truth) = (solve(alpha, 1, 0.25), solve(alpha, 1, 1.0));
        assert!((coarsest.albedo(0.3) / truth.albedo(0.3) - 1.0).abs() < 0.02, "alpha {alpha}");
    }
    // A slab may be so, but the solver cannot solve it: it refuses before it takes memory.
    assert!(std::panic::catch_unwind(|| solve(1e-6, 1, 1.0)).is_err());
}
