//! The time of a frame of the default scene without shadows, and of a sample of one with them, on this machine's adapter.

use criterion::{Criterion, criterion_group, criterion_main};
use velour::renderer::device::open_offscreen;
use velour::renderer::{Gpu, Offscreen};
use velour::scene::assets::DRAPE;
use velour::scene::{Drawn, Edits};
use velour::table::SheenTable;

const SIZE: [u32; 2] = [320, 180];

fn frames(criterion: &mut Criterion, gpu: &Gpu) {
    let scene = DRAPE.load().expect("the asset is read");
    let mut group = criterion.benchmark_group("frame");
    group.sample_size(20);
    for (name, shadows) in [("without shadows", false), ("with shadows, a sample", true)] {
        let edits = Edits { shadows: Some(shadows), ..Edits::default() };
        let drawn = Drawn::new(&scene, &edits);
        let mut renderer =
            Offscreen::for_linear(gpu, 1, &SheenTable::embedded(), &drawn).expect("the adapter draws the scene");
        assert_eq!(renderer.has_shadows(&drawn.settings), shadows, "{name}");
        renderer.effort.samples = 1;
        let mut draw = || gpu.block_on(renderer.linear(gpu, &scene.cameras[0], SIZE, &drawn.settings));
        // Drivers compile at the first.
        draw().expect("a picture");
        group.bench_function(name, |bencher| bencher.iter(&mut draw));
    }
    group.finish();
}

fn bench(criterion: &mut Criterion) {
    match pollster::block_on(open_offscreen(None)) {
        Ok(gpu) => frames(criterion, &gpu),
        Err(error) => println!("no frame is drawn: {error}"),
    }
}

criterion_group!(benches, bench);
criterion_main!(benches);
