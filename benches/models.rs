//! What a path tracer pays for a sheen: making it for a roughness, and each call.

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec3;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::hint::black_box;
use velour::math::warp::{cosine_hemisphere, uniform};
use velour::models::{Bsdf, Burley, ContyKulla, LtcSheen, NeubeltPettineo, Patry, SlabSheen, Terminator};
use velour::table::{SheenTable, SlabTable};

/// Number of different calls, made in turn, so that the processor cannot learn their branches by heart.
const CALLS: usize = 4096;

fn calls(c: &mut Criterion, name: &str, model: &dyn Bsdf) {
    let mut rng = Pcg64::seed_from_u64(1);
    let mut pair = || [(); 2].map(|()| uniform(&mut rng));
    let cases: Vec<([DVec3; 2], [f64; 2])> =
        (0..CALLS).map(|_| ([cosine_hemisphere(pair()), cosine_hemisphere(pair())], pair())).collect();
    let mut bench = |what: &str, call: &dyn Fn([DVec3; 2], [f64; 2]) -> f64| {
        let mut at = 0;
        c.bench_function(&format!("{name} {what}"), |b| {
            b.iter(|| {
                at = (at + 1) % CALLS;
                let (directions, uniforms) = cases[at];
                call(black_box(directions), black_box(uniforms))
            })
        });
    };
    bench("evaluate", &|[wi, wo], _| model.evaluate(wi, wo));
    bench("sample", &|[wi, _], uniforms| model.sample(wi, uniforms).map_or(0.0, |sample| sample.weight));
    bench("pdf", &|[wi, wo], _| model.pdf(wi, wo));
    bench("albedo", &|[wi, _], _| model.albedo(wi.z));
}

fn models(c: &mut Criterion) {
    let (ltc, slab) = (SheenTable::embedded(), SlabTable::embedded());
    calls(c, "ltc", &LtcSheen::new(&ltc, 0.3));
    calls(c, "slab", &SlabSheen::new(&slab, 0.3));
    calls(c, "burley", &Burley::new());
    calls(c, "neubelt_pettineo", &NeubeltPettineo::new(0.3));
    calls(c, "conty_kulla", &ContyKulla::new(0.3, Terminator::Physical));
    calls(c, "patry", &Patry::new(0.3));
    c.bench_function("ltc new", |b| b.iter(|| LtcSheen::new(&ltc, black_box(0.3))));
    c.bench_function("slab new", |b| b.iter(|| SlabSheen::new(&slab, black_box(0.3))));
    c.bench_function("burley new", |b| b.iter(Burley::new));
    c.bench_function("neubelt_pettineo new", |b| b.iter(|| NeubeltPettineo::new(black_box(0.3))));
    c.bench_function("conty_kulla new", |b| b.iter(|| ContyKulla::new(black_box(0.3), Terminator::Physical)));
    c.bench_function("patry new", |b| b.iter(|| Patry::new(black_box(0.3))));
}

criterion_group!(benches, models);
criterion_main!(benches);
