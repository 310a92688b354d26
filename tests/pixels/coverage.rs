//! What is cut out (alphaMode MASK) covers of a picture what it covers of the surface, from near and from afar.

use glam::{Affine2, DVec2, Mat4, Vec2, Vec3};
use velour::picture::LinearImage;
use velour::renderer::Offscreen;
use velour::scene::{AlphaMode, Edits, Material, Projection, Scene, TextureSlot, linear_from_srgb};
use velour::table::SheenTable;

use super::compare::{GPU, linear};
use super::run::unshadowed;
use super::stage::{Stage, Thing, looking, plain};
use super::textures::textured;

/// Texels a side of the nets.
const SIDE: u32 = 64;

/// Half of the net's height that is seen, in metres.
const HALF_SEEN: f64 = 0.6;

/// How far a net is turned in its plane, so that samples fall on all places of texels alike: by 1 in 3, for what is seen is then a
/// whole number of copies of its texture, of sqrt(10) a side.
fn turn() -> f64 {
    f64::atan2(1.0, 3.0)
}

/// How many copies there are on the net where sqrt(10) times `seen` of them are seen.
fn copies(seen: f64) -> f64 {
    10.0_f64.sqrt() * seen / HALF_SEEN
}

/// A white, unlit net of two metres a side, in `copies(seen)` of its texture, whose middle is the origin; it faces +z.
fn net(texels: Vec<[u8; 4]>, seen: f64) -> Scene {
    let cut = AlphaMode::Mask { cutoff: 0.5 };
    let material = Material { unlit: true, double_sided: true, alpha_mode: cut, ..plain() };
    let mut stage = Stage::new(vec![Thing::rectangle([1.0, 1.0], material)], looking([0.0, 0.0, 3.0], [0.0; 3]));
    stage.projection = Projection::Orthographic { ymag: 0.98, near: 0.1, far: 100.0 };
    let mut scene = stage.scene();
    let mesh = &mut scene.meshes[0];
    mesh.tex_coords[0] = mesh.positions.iter().map(|at| 0.5 * at.truncate() + 0.5).collect();
    textured(&mut scene, TextureSlot::BaseColor, [SIDE, SIDE], texels);
    let texture = scene.materials[0].textures[TextureSlot::BaseColor as usize].as_mut().unwrap();
    texture.uv_from_tex_coord = Affine2::from_scale(Vec2::splat(copies(seen) as f32));
    scene
}

fn filtered(scene: &Scene, size: [u32; 2]) -> LinearImage {
    let drawn = unshadowed(scene, &Edits::default());
    let mut renderer = Offscreen::for_linear(&GPU, 4, &SheenTable::embedded(), &drawn).unwrap();
    GPU.block_on(renderer.linear(&GPU, &scene.cameras[0], size, &drawn.settings)).unwrap()
}

fn mean(picture: &LinearImage) -> f64 {
    picture.pixels.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / picture.pixels.len() as f64
}

/// White where something is there.
fn texels(is_there: impl Fn(u32, u32) -> bool) -> Vec<[u8; 4]> {
    let alpha = |at: u32| if is_there(at % SIDE, at / SIDE) { 255 } else { 0 };
    (0..SIDE * SIDE).map(|at| [255, 255, 255, alpha(at)]).collect()
}

/// A number in [0, 1) for each index, without order.
fn scattered(index: u32) -> f64 {
    let mixed = (index + 1).wrapping_mul(0x9e37_79b9);
    let mixed = (mixed ^ (mixed >> 15)).wrapping_mul(0x2545_f491);
    f64::from(mixed ^ (mixed >> 13)) / f64::from(u32::MAX)
}

/// The alpha between texels, by bilinear interpolation of a texture that is repeated.
fn alpha(texels: &[[u8; 4]], u: f64, v: f64) -> f64 {
    let [x, y] = [u, v].map(|at| at * f64::from(SIDE) - 0.5);
    let texel = |column: f64, row: f64| {
        let [column, row] = [column, row].map(|at| (at as i64).rem_euclid(SIDE.into()) as usize);
        f64::from(texels[row * SIDE as usize + column][3]) / 255.0
    };
    let (left, above) = (x.floor(), y.floor());
    let row = |row: f64| texel(left, row) * (1.0 - x + left) + texel(left + 1.0, row) * (x - left);
    row(above) * (1.0 - y + above) + row(above + 1.0) * (y - above)
}

/// The share of the texture's area where the alpha passes the cutoff, from 20 x 20 points a texel.
fn share(texels: &[[u8; 4]]) -> f64 {
    let points = 20 * SIDE;
    // None lies where the alpha of texels of 0 and 1 is just a half.
    let at = |index: u32| (f64::from(index) + 0.49) / f64::from(points);
    let rows = (0..points).map(|row| (0..points).filter(|column| alpha(texels, at(*column), at(row)) >= 0.5).count());
    rows.sum::<usize>() as f64 / f64::from(points * points)
}

/// About a quarter, a tenth and nine tenths, in order and without.
fn nets() -> Vec<(&'static str, Vec<[u8; 4]>)> {
    let scattered = |side: u32, most: f64| texels(move |x, y| scattered(x / side + SIDE * (y / side)) < most);
    vec![
        ("squares, a quarter", texels(|x, y| x % 8 < 4 && y % 8 < 4)),
        ("stripes, an eighth", texels(|x, y| (x + y) % 32 < 4)),
        ("holes, nine tenths", texels(|x, y| x % 16 >= 5 || y % 16 >= 5)),
        ("single texels, a quarter", texels(|x, y| x % 2 == 0 && y % 2 == 0)),
        ("scattered, a quarter", scattered(2, 0.25)),
        ("scattered, a half", scattered(2, 0.5)),
        ("scattered, a tenth", scattered(2, 0.1)),
        ("scattered, nine tenths", scattered(1, 0.9)),
    ]
}

/// Seen at an elevation above its plane, and turned in it. What is seen of it is a square: the picture is as much wider than
/// high as that is foreshortened.
fn seen_at(mut scene: Scene, degrees: f32) -> Scene {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let half = HALF_SEEN as f32;
    scene.cameras[0].world_from_camera = looking([0.0, -3.0 * cosine, 3.0 * sine], [0.0; 3]);
    scene.cameras[0].projection = Projection::Orthographic { ymag: half * sine, near: 0.1, far: 100.0 };
    scene.instances[0].world_from_mesh = Mat4::from_rotation_z(turn() as f32);
    scene
}

/// Within 2% of the share that is there, from 12 texels a pixel to less than a half, seen from above and at 5 degrees; and within what
/// chance does: a pixel shows quarters, which err by an eighth on the mean, in a picture of n pixels by that over the root of n.
#[test]
fn nets_cover_the_same_from_near_and_from_afar() {
    for (name, texels) in nets() {
        let expected = share(&texels);
        // Drivers' filters have 8 bits: an alpha that is off by half a step moves the edge of a single texel by 1.5% of its size.
        let relative = if name.starts_with("single") { 0.05 } else { 0.02 };
        for (seen, degrees, widths) in [
            (2.0, 90.0, &[32, 64, 128, 256, 512][..]),
            (1.0, 90.0, &[32, 64, 128, 256, 512]),
            (2.0, 30.0, &[64, 256]),
            (2.0, 5.0, &[128, 512]),
        ] {
            let scene = seen_at(net(texels.clone(), seen), degrees);
            for width in widths {
                let height = (*width as f32 * degrees.to_radians().sin()).round() as u32;
                let off = mean(&filtered(&scene, [*width, height])) - expected;
                println!("{name}, {seen} at {degrees} degrees, {width} pixels: {:+.2}%", 100.0 * off / expected);
                let allowed = relative * expected + 0.125 / f64::from(width * height).sqrt();
                assert!(
                    off.abs() < allowed,
                    "{name}, {seen} at {degrees} degrees, {width} pixels: {off} of {expected}"
                );
            }
        }
    }
}

/// A pixel's centre tells, and nothing else, where a pixel has one sample.
#[test]
fn with_one_sample_centres_tell() {
    let (name, texels) = nets().swap_remove(4);
    const SIZE: [u32; 2] = [64, 64];
    let picture = linear(&seen_at(net(texels.clone(), 2.0), 90.0), &SheenTable::embedded(), &Edits::default(), SIZE);
    let turn = DVec2::from_angle(-turn());
    let (mut off, mut seen) = (0, 0);
    for (index, pixel) in (0..).zip(&picture.pixels) {
        let at = DVec2::new((index % SIZE[0]).into(), (index / SIZE[0]).into()) + 0.5;
        let at = (at - 0.5 * DVec2::new(SIZE[0].into(), SIZE[1].into())) * DVec2::new(1.0, -1.0);
        let uv = copies(2.0) * (0.5 * turn.rotate(at / (0.5 * f64::from(SIZE[1])) * HALF_SEEN) + 0.5);
        let alpha = alpha(&texels, uv.x, uv.y);
        // Drivers' filters have 8 bits.
        let is_sure = (alpha - 0.5).abs() > 0.04;
        seen += u32::from(is_sure);
        off += u32::from(is_sure && (alpha >= 0.5) != (pixel[0] > 0.5));
    }
    assert!(off == 0 && seen > 4000, "{name}: {off} of {seen} are off");
}

/// The mean difference of pictures that are an eighth of a pixel apart, over a whole pixel.
fn shimmer(texels: Vec<[u8; 4]>, size: u32) -> f64 {
    let scene = seen_at(net(texels, 2.0), 90.0);
    let step = 2.0 * HALF_SEEN as f32 / size as f32 / 8.0;
    let moved = |steps: u8| {
        let mut scene = scene.clone();
        let way = Vec3::new(1.0, 0.6, 0.0) * step * f32::from(steps);
        scene.cameras[0].world_from_camera = Mat4::from_translation(way) * scene.cameras[0].world_from_camera;
        filtered(&scene, [size, size])
    };
    let pictures: Vec<LinearImage> = (0..9).map(moved).collect();
    let difference = |pair: &[LinearImage]| {
        let pixels = pair[0].pixels.iter().zip(&pair[1].pixels);
        let sum: f64 = pixels.map(|(one, next)| f64::from((one[0] - next[0]).abs())).sum();
        sum / pair[0].pixels.len() as f64
    };
    pictures.windows(2).map(difference).sum::<f64>() / 8.0
}

/// Measured: at most 0.04. Where a pixel is there or not by the mean of alpha, it is 0.05 to 0.09 of the net of
/// which half is there.
#[test]
fn nets_do_not_shimmer_as_the_camera_moves_by_fractions_of_a_pixel() {
    let mut worst = 0.0_f64;
    for (name, texels) in nets() {
        for size in [32, 64, 128, 256] {
            let found = shimmer(texels.clone(), size);
            println!("{name}, {size} pixels: {found:.4}");
            worst = worst.max(found);
        }
    }
    assert!(worst < 0.05, "{worst}");
}

/// Two layers of lace hide of each other what chance does: 1 - (1 - a)^2 is covered, wherever the other one is.
#[test]
fn layers_cover_what_chance_does() {
    for (name, texels) in nets() {
        for size in [64, 128] {
            let one = seen_at(net(texels.clone(), 4.0), 90.0);
            let share = mean(&filtered(&one, [size, size]));
            let mut two = one.clone();
            let mut behind = two.instances[0].clone();
            behind.world_from_mesh = Mat4::from_translation(Vec3::new(0.0137, 0.0071, -0.01)) * behind.world_from_mesh;
            two.instances.push(behind);
            let (found, expected) = (mean(&filtered(&two, [size, size])), 1.0 - (1.0 - share) * (1.0 - share));
            println!("{name}, two layers, {size} pixels: {found:.4} of {expected:.4}");
            assert!((found - expected).abs() < 0.01, "{name}, {size} pixels: {found} of {expected}");
        }
    }
}

/// A ramp of alpha is cut where it passes the cutoff, to a twentieth of a pixel.
#[test]
fn magnified_edges_lie_where_the_alpha_is_the_cutoff() {
    const WIDTH: u32 = 256;
    for (opacity, cutoff) in [(1.0_f32, 0.5), (1.0, 0.3), (0.8, 0.6)] {
        // From 0 at the first texel's centre to 252 at the last one's.
        let ramp = (0..SIDE * SIDE).map(|at| [255, 255, 255, (4 * (at % SIDE)) as u8]).collect();
        let mut scene = net(ramp, 1.0);
        let texture = scene.materials[0].textures[TextureSlot::BaseColor as usize].as_mut().unwrap();
        texture.uv_from_tex_coord = Affine2::IDENTITY;
        (scene.materials[0].opacity, scene.materials[0].alpha_mode) = (opacity, AlphaMode::Mask { cutoff });
        scene.cameras[0].projection = Projection::Orthographic { ymag: 0.8, near: 0.1, far: 100.0 };
        // Turned by little, so that rows of pixels meet the edge at places of their own.
        scene.instances[0].world_from_mesh = Mat4::from_rotation_z(0.05);
        let covered = mean(&filtered(&scene, [WIDTH, WIDTH])) * f64::from(WIDTH);
        // In metres to the right of the middle; the turned edge lies that far from it on the mean, over the cosine.
        let edge = (f64::from(cutoff / opacity) * 255.0 / 4.0 + 0.5) / f64::from(SIDE) * 2.0 - 1.0;
        let expected = (0.5 - 0.5 * edge / 0.05_f64.cos() / 0.8) * f64::from(WIDTH);
        println!("cutoff {cutoff} of {opacity}: {covered:.3} of {expected:.3} pixels");
        assert!((covered - expected).abs() < 0.05, "cutoff {cutoff}: {covered} of {expected} pixels a row");
    }
}

/// What is cut out is white, what is there is dark: from afar nothing white shows.
#[test]
fn colours_from_afar_are_of_what_is_there() {
    for (name, texels) in nets() {
        let painted = texels.iter().map(|texel| if texel[3] > 0 { [100, 100, 100, 255] } else { [255, 255, 255, 0] });
        let shares = mean(&filtered(&seen_at(net(texels.clone(), 4.0), 90.0), [64, 64]));
        let found = mean(&filtered(&seen_at(net(painted.collect(), 4.0), 90.0), [64, 64])) / shares;
        let expected = f64::from(linear_from_srgb(100));
        assert!((found / expected - 1.0).abs() < 0.02, "{name}: {found} of {expected}");
    }
}
