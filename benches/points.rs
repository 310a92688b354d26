//! The time to draw points of lights by projected solid angle, as the reference does for shadows: making a polygon ready, and
//! each point.

use std::f64::consts::TAU;
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec3;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use velour::math::warp::uniform;
use velour::reference::convex::Convex;

/// Number of different places and pairs of numbers, taken in turn, so that the processor cannot learn their branches by heart.
const CALLS: usize = 4096;

/// A regular polygon of radius 1 that is level, one or two above some place near it.
fn polygon(corners: usize, [right, ahead, up]: [f64; 3]) -> Vec<DVec3> {
    let place = DVec3::new(4.0 * right - 2.0, 4.0 * ahead - 2.0, 1.0 + up);
    let angles = (0..corners).map(|corner| TAU * corner as f64 / corners as f64);
    angles.map(|angle| place + DVec3::new(angle.cos(), angle.sin(), 0.0)).collect()
}

fn bench(criterion: &mut Criterion) {
    let mut rng = Pcg64::seed_from_u64(1);
    let mut numbers = || [(); 3].map(|()| uniform(&mut rng));
    for corners in [3, 4, 8] {
        let polygons: Vec<Vec<DVec3>> = (0..CALLS).map(|_| polygon(corners, numbers())).collect();
        let ready: Vec<Convex> = polygons.iter().map(|polygon| Convex::new(polygon)).collect();
        let pairs: Vec<[f64; 2]> =
            (0..CALLS).map(|_| numbers()).map(|[azimuth, height, _]| [azimuth, height]).collect();
        let mut bench = |what: &str, call: &dyn Fn(usize) -> Option<DVec3>| {
            let mut at = 0;
            criterion.bench_function(&format!("{corners} corners, {what}"), |bencher| {
                bencher.iter(|| {
                    at = (at + 1) % CALLS;
                    call(black_box(at))
                })
            });
        };
        bench("a point", &|at| ready[at].sample(pairs[at]));
        bench("made ready, and a point", &|at| Convex::new(&polygons[at]).sample(pairs[at]));
    }
}

criterion_group!(benches, bench);
criterion_main!(benches);
