//! Pictures that are drawn in steps while somebody watches.

use velour::picture::ToneCurve;
use velour::renderer::{Offscreen, Progress, RenderError};
use velour::scene::assets::DRAPE;
use velour::scene::{Drawn, Edits, Settings};
use velour::table::SheenTable;

use super::compare::GPU;

/// Wider than a tile.
const SIZE: [u32; 2] = [2100, 37];

/// A renderer of the drape with these edits, for pictures that are shown or measured.
fn renderer(edits: &Edits, is_shown: bool) -> (Offscreen, velour::scene::Camera, Settings) {
    let scene = DRAPE.load().unwrap();
    let drawn = Drawn::new(&scene, edits);
    let prepare = if is_shown { Offscreen::nearest_for_display } else { Offscreen::nearest_for_linear };
    let renderer = prepare(&GPU, 4, &SheenTable::embedded(), &drawn).unwrap();
    (renderer, edits.camera(&scene), drawn.settings)
}

/// Steps of between 1 and 17 rows.
fn steps() -> impl FnMut(Progress) -> Option<u32> {
    let mut count = 0;
    move |_| {
        count += 1;
        Some(1 + count * 7 % 17)
    }
}

#[test]
fn in_any_steps_it_is_the_same_picture() {
    for shadows in [true, false] {
        let edits = Edits { shadows: Some(shadows), tone: Some(ToneCurve::Agx), ..Edits::default() };
        let mut told = Vec::new();
        let (mut shown, camera, settings) = renderer(&edits, true);
        let whole = GPU.block_on(shown.display(&GPU, &camera, SIZE, &settings)).unwrap();
        let mut step = steps();
        let mut watch = |progress| {
            told.push(progress);
            step(progress)
        };
        let stepped = GPU.block_on(shown.display_watched(&GPU, &camera, SIZE, &settings, &mut watch));
        assert!(stepped.unwrap() == whole, "shown, shadows {shadows}");
        // Neither is it what was left of the picture before.
        let (mut anew, ..) = renderer(&edits, true);
        let stepped = GPU.block_on(anew.display_watched(&GPU, &camera, SIZE, &settings, &mut steps()));
        assert!(stepped.unwrap() == whole, "drawn anew, shadows {shadows}");

        let samples = if shadows { 3 } else { 1 };
        assert!(told.len() > 4 * samples as usize, "{} steps", told.len());
        assert!(told.windows(2).all(|pair| pair[0].done < pair[1].done && pair[0].all == pair[1].all));
        assert_eq!((told[0].done, told[0].all), (0, u64::from(SIZE[0]) * u64::from(SIZE[1]) * samples));
        assert!(told.iter().all(|progress| progress.done < progress.all && progress.height == SIZE[1]));

        let (mut measured, camera, settings) = renderer(&edits, false);
        let whole = GPU.block_on(measured.linear(&GPU, &camera, SIZE, &settings)).unwrap();
        let stepped = GPU.block_on(measured.linear_watched(&GPU, &camera, SIZE, &settings, &mut steps()));
        let stepped = stepped.unwrap();
        let bits = |pixels: &[[f32; 3]]| pixels.iter().flatten().map(|number| number.to_bits()).collect::<Vec<_>>();
        assert!(bits(&stepped.pixels) == bits(&whole.pixels), "measured, shadows {shadows}");
    }
}

#[test]
fn who_watches_may_end_it() {
    let (mut renderer, camera, settings) = renderer(&Edits::default(), true);
    let before = GPU.block_on(renderer.display(&GPU, &camera, [64, 40], &settings)).unwrap();
    for most in [0, 1, 7] {
        let mut asked = 0;
        let mut watch = |_| {
            asked += 1;
            (asked <= most).then_some(9)
        };
        let stopped = GPU.block_on(renderer.display_watched(&GPU, &camera, [64, 40], &settings, &mut watch));
        assert!(matches!(stopped, Err(RenderError::Stopped)));
        assert_eq!(asked, most + 1);
        // It leaves nothing behind.
        assert!(GPU.block_on(renderer.display(&GPU, &camera, [64, 40], &settings)).unwrap() == before);
    }
}
