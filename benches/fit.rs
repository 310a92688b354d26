//! What the tables cost: the slab's solution for one alpha, the random walk to compare it with, the fits of both
//! tables.
//!
//! `cargo bench --no-default-features --bench fit`. Before the timings it prints, for some cells, how long the walk
//! takes to know R as well as the solver does: the paths that it needs grow with the inverse square of the error.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::{Duration, Instant};
use velour::fit;
use velour::physics::slab::Slab;
use velour::physics::transport::{Resolution, Transport};
use velour::physics::walk::{FirstFlight, Walk};

const ALPHAS: [f64; 5] = [1.0, 0.5, 0.2, 2.0 / 31.0, 1.0 / 31.0];
const ONE_MODE: Resolution = Resolution { modes: 1, refinement: 1.0, ridge: None };

fn walk(alpha: f64, mu: f64, paths: u64) -> Walk {
    Walk { slab: Slab::new(alpha), mu, first_flight: FirstFlight::Scattered, paths, seed: 1 }
}

/// Walk and solver on the same cells, one thread each: time for equal error of R.
fn equal_error() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool of one thread");
    println!("alpha   mu     R         solver: error, s     walk: paths and s for that error");
    for (alpha, mu) in [(1.0, 1.0), (0.5, 0.5), (0.2, 0.1), (0.1, 0.03), (1.0 / 31.0, 0.01)] {
        let truth = Transport::new(Slab::new(alpha), Resolution { refinement: 3.0, ..ONE_MODE }).albedo(mu);
        let start = Instant::now();
        let albedo = Transport::new(Slab::new(alpha), ONE_MODE).albedo(mu);
        let solving = start.elapsed().as_secs_f64();
        let error = (albedo / truth - 1.0).abs().max(1e-12);
        let few = walk(alpha, mu, 100_000);
        let start = Instant::now();
        let counts = pool.install(|| few.run());
        let walking = start.elapsed().as_secs_f64();
        // The standard error of a binomial distribution, of light that is scattered more than once; relative to R.
        let more = counts.reflected_more.total() as f64;
        let noise = few.share() * (more * (1.0 - more / few.paths as f64)).sqrt() / truth;
        let times = (noise / error).powi(2);
        let (paths, seconds) = (few.paths as f64 * times, walking * times);
        println!("{alpha:.4}  {mu:.3}  {truth:.3e}  {error:.1e}, {solving:.4}      {paths:.1e}, {seconds:.1e}");
    }
}

fn solver(criterion: &mut Criterion) {
    equal_error();
    let mut group = criterion.benchmark_group("solver");
    group.sample_size(10).measurement_time(Duration::from_secs(2));
    for alpha in ALPHAS {
        for modes in [1, 4] {
            let resolution = Resolution { modes, ..ONE_MODE };
            group.bench_function(BenchmarkId::new(format!("{modes} modes"), format!("alpha {alpha:.3}")), |bencher| {
                bencher.iter(|| Transport::new(Slab::new(black_box(alpha)), resolution));
            });
        }
    }
}

fn walks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("walk of 10000 paths");
    group.sample_size(10).measurement_time(Duration::from_secs(1));
    for (alpha, mu) in [(1.0, 1.0), (0.2, 0.1), (1.0 / 31.0, 0.01)] {
        group.bench_function(format!("alpha {alpha:.3}, mu {mu}"), |bencher| {
            bencher.iter(|| walk(black_box(alpha), mu, 10_000).run());
        });
    }
}

fn tables(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("fit");
    group.sample_size(10).measurement_time(Duration::from_secs(20));
    group.bench_function("sheen", |bencher| bencher.iter(|| fit::sheen::fit(fit::RESOLUTION, |_, _| ())));
    group.bench_function("slab", |bencher| bencher.iter(|| fit::slab::fit(|_, _| ())));
}

criterion_group!(benches, solver, walks, tables);
criterion_main!(benches);
