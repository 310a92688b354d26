//! Disks of EXT_lights_area, which are polygons here, against true disks.

use glam::{DMat3, DVec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use velour::reference::polygon::form_factor;

/// A disk of radius 1 as a scene holds it, in the plane z = 0.
fn disk() -> Vec<DVec3> {
    let light = r#"{"lights":[{"type":"disk","size":2}]}"#;
    let node = r#"{"extensions":{"EXT_lights_area":{"light":0}}}"#;
    let gltf =
        format!(r#"{{"asset":{{"version":"2.0"}},"extensions":{{"EXT_lights_area":{light}}},"nodes":[{node}]}}"#);
    let scene = velour::scene::gltf::from_slice(gltf.as_bytes(), "disk", &Default::default()).unwrap();
    scene.lights[0].polygons[0].contours[0].iter().map(|corner| corner.as_dvec3()).collect()
}

/// A circle so fine that its own error is a thousandth of the difference that is looked for.
fn circle() -> Vec<DVec3> {
    (0..4096)
        .map(|corner| -std::f64::consts::TAU * f64::from(corner) / 4096.0)
        .map(|angle| DVec3::new(angle.cos(), angle.sin(), 0.0))
        .collect()
}

/// The contour in the local frame of a point with a normal.
fn seen(contour: &[DVec3], point: DVec3, normal: DVec3) -> Vec<Vec<DVec3>> {
    let (right, up) = normal.any_orthonormal_pair();
    let local_from_world = DMat3::from_cols(right, up, normal).transpose();
    vec![contour.iter().map(|&corner| local_from_world * (corner - point)).collect()]
}

/// The greatest that the form factors of the three lobes are off, of 1 for the whole hemisphere. They fall with the square of the number
/// of sides, and docs/accuracy.md quotes them.
const GREATEST: [f64; 3] = [4.4e-4, 1e-3, 8.7e-3];

#[test]
fn a_disk_of_32_sides_lights_as_a_disk() {
    let (polygon, circle) = (disk(), circle());
    let mut random = Pcg64::seed_from_u64(5);
    let mut direction = || loop {
        let point = DVec3::from_array(std::array::from_fn(|_| random.random_range(-1.0..1.0)));
        if point.length() < 1.0 && point.length() > 0.01 {
            return point;
        }
    };
    // The cosine itself, and lobes of a sheen (a, b of the table), the last as sharp as they come.
    let lobes = [(1.0, 0.0), (0.6, -0.2), (0.15, -0.8)];
    let mut worst = [0.0f64; 3];
    for _ in 0..20_000 {
        let (point, normal) = (3.0 * direction(), direction().normalize());
        let point = point.with_z(-point.z.abs());
        let beside = (point.truncate().length() - 1.0).max(0.0);
        if beside.hypot(point.z) < 0.1 {
            continue;
        }
        for ((a, b), worst) in lobes.into_iter().zip(&mut worst) {
            let m_inv = DMat3::from_cols(DVec3::X * a, DVec3::Y * a, DVec3::new(b, 0.0, 1.0));
            let [found, expected] =
                [&polygon, &circle].map(|contour| form_factor(&seen(contour, point, normal), m_inv, false));
            *worst = worst.max((found - expected).abs());
        }
    }
    for (error, said) in worst.into_iter().zip(GREATEST) {
        // Said to two digits.
        assert!((error / said - 1.0).abs() < 0.02, "{worst:?}");
    }
    let [cosine, wide, narrow] = GREATEST;
    let quoted = format!("cosine: {cosine:e}; sheen of a = 0.6: {wide:e}, of a = 0.15: {narrow:e}");
    assert!(include_str!("../../docs/accuracy.md").contains(&quoted), "docs/accuracy.md does not say '{quoted}'");
}
