// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! Sheen over a diffuse base as a path tracer on the processor uses it: `cargo run --no-default-features --example brdf`.

use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use velour::models::{Bsdf, Lambert, LtcSheen};
use velour::table::SheenTable;

/// Where a path goes on from a surface, and what its light is multiplied by. `wi` points back along the path, z is the normal.
fn scatter(sheen: &LtcSheen, [c_sheen, base]: [DVec3; 2], wi: DVec3, random: &mut Pcg64) -> Option<(DVec3, DVec3)> {
    // glTF's layering: what the strongest channel of the sheen sends back no longer reaches the base.
    let strongest = c_sheen.max_element() * sheen.albedo(wi.z);
    let through = base * (1.0 - strongest);
    if strongest + through.max_element() <= 0.0 {
        return None;
    }
    // Either lobe is sampled by the share of light that it sends back; both together are the density.
    let share = strongest / (strongest + through.max_element());
    let uniforms = [random.random(), random.random()];
    let sampled = if random.random_bool(share) { sheen.sample(wi, uniforms) } else { Lambert.sample(wi, uniforms) };
    let wo = sampled?.wo;
    let pdf = share * sheen.pdf(wi, wo) + (1.0 - share) * Lambert.pdf(wi, wo);
    Some((wo, (c_sheen * sheen.evaluate(wi, wo) + through * Lambert.evaluate(wi, wo)) / pdf))
}

fn main() {
    let sheen = LtcSheen::new(&SheenTable::embedded(), 0.5);
    let [c_sheen, base] = [DVec3::new(0.9, 0.8, 0.7), DVec3::new(0.1, 0.2, 0.3)];
    let wi = DVec3::new(0.96, 0.0, 0.28);
    let (mut random, count) = (Pcg64::seed_from_u64(1), 100_000);
    let sum: DVec3 =
        (0..count).filter_map(|_| scatter(&sheen, [c_sheen, base], wi, &mut random)).map(|(_, weight)| weight).sum();
    // In uniform light of radiance 1 a surface shows its albedo.
    let r = sheen.albedo(wi.z);
    println!("by {count} paths: {:.4}", sum / f64::from(count));
    println!("exactly:         {:.4}", c_sheen * r + base * (1.0 - c_sheen.max_element() * r));
}
