//! Textures, vertex colours, opacity: what counts where, and which way up.

use glam::{Affine2, Vec2, Vec3, Vec4};
use velour::picture::LinearImage;
use velour::renderer::Offscreen;
use velour::scene::{
    AlphaMode, Edits, Image, Layering, Lobes, Material, MaterialEdits, PunctualKind, PunctualLight, Sampler, Scene,
    Sheen, Texture, TextureSlot, TextureUse, linear_from_srgb,
};
use velour::table::SheenTable;

use super::compare::{GPU, SIZE, linear};
use super::run::unshadowed;
use super::stage::{Stage, Thing, facing, glow, looking, plain};

const UP: [f32; 3] = [0.0, 1.0, 0.0];
const ORIGIN: [f32; 3] = [0.0; 3];

/// A scene whose first thing is a square floor with texture coordinates (u to the right, v towards the viewer), and a
/// window.
pub fn floor(material: Material) -> Scene {
    let floor = Thing::rectangle([1.5, 1.5], material).placed(facing(ORIGIN, UP));
    let window = Thing::rectangle([0.6, 0.4], glow([4.0, 3.0, 2.0])).placed(facing([0.7, 0.8, -1.3], ORIGIN));
    let mut scene = Stage::new(vec![floor, window], looking([0.0, 1.4, 2.2], ORIGIN)).scene();
    let mesh = &mut scene.meshes[0];
    // The place turns its x to the left, and its y towards the viewer.
    let uv = |position: &Vec3| Vec2::new(-position.x, position.y) / 3.0 + 0.5;
    mesh.tex_coords[0] = mesh.positions.iter().map(uv).collect();
    mesh.tex_coords[1] = mesh.tex_coords[0].iter().map(|uv| Vec2::new(uv.y, uv.x)).collect();
    mesh.tangents = vec![Vec4::new(1.0, 0.0, 0.0, 1.0); mesh.positions.len()];
    scene
}

pub fn textured(scene: &mut Scene, slot: TextureSlot, size: [u32; 2], texels: Vec<[u8; 4]>) {
    let [width, height] = size;
    scene.images.push(Image { name: "test".into(), width, height, texels });
    scene.textures.push(Texture { image: scene.images.len() - 1, sampler: Sampler::DEFAULT });
    let texture = scene.textures.len() - 1;
    let uv_from_tex_coord = Affine2::IDENTITY;
    scene.materials[0].textures[slot as usize] = Some(TextureUse { texture, tex_coord: 0, uv_from_tex_coord });
}

fn picture(scene: &Scene) -> LinearImage {
    let edits = Edits { lights_visible: Some(false), ..Edits::default() };
    linear(scene, &SheenTable::embedded(), &edits, SIZE)
}

/// The greatest difference over all pixels, as a share of the brightest.
fn difference(left: &LinearImage, right: &LinearImage) -> f32 {
    let channels = |picture: &LinearImage| picture.pixels.iter().flatten().copied().collect::<Vec<f32>>();
    let greatest = channels(left).into_iter().fold(0.0, f32::max);
    assert!(greatest > 1e-3 && channels(left).iter().all(|channel| channel.is_finite()));
    channels(left).iter().zip(channels(right)).map(|(left, right)| (left - right).abs()).fold(0.0, f32::max) / greatest
}

pub fn rich() -> Material {
    Material {
        base_color: Vec3::new(0.8, 0.6, 0.9),
        metallic: 0.4,
        roughness: 0.6,
        specular: 0.7,
        specular_color: Vec3::new(1.2, 0.8, 1.0),
        sheen: Some(Sheen { weight: 0.8, ..Sheen::new(Vec3::new(0.9, 0.5, 0.3), 0.5) }),
        emission: Vec3::ZERO,
        ..plain()
    }
}

#[test]
fn one_texel_is_a_factor_in_the_right_channel_and_encoding() {
    let texel = [180, 120, 60, 200];
    let color = Vec3::new(linear_from_srgb(180), linear_from_srgb(120), linear_from_srgb(60));
    let plain_share = |channel: usize| f32::from(texel[channel]) / 255.0;
    let base = rich();
    let sheen = base.sheen.unwrap();
    let with_sheen = |sheen| Material { sheen: Some(sheen), ..base.clone() };
    for (slot, expected) in [
        (TextureSlot::BaseColor, Material { base_color: base.base_color * color, ..base.clone() }),
        (
            TextureSlot::MetallicRoughness,
            Material {
                roughness: base.roughness * plain_share(1),
                metallic: base.metallic * plain_share(2),
                ..base.clone()
            },
        ),
        (TextureSlot::Occlusion, base.clone()),
        (TextureSlot::Specular, Material { specular: base.specular * plain_share(3), ..base.clone() }),
        (TextureSlot::SpecularColor, Material { specular_color: base.specular_color * color, ..base.clone() }),
        (TextureSlot::SheenColor, with_sheen(Sheen { color: sheen.color * color, ..sheen })),
        (TextureSlot::SheenRoughness, with_sheen(Sheen { roughness: sheen.roughness * plain_share(3), ..sheen })),
        (TextureSlot::SheenWeight, with_sheen(Sheen { weight: sheen.weight * plain_share(0), ..sheen })),
    ] {
        let mut scene = floor(base.clone());
        textured(&mut scene, slot, [1, 1], vec![texel]);
        let (found, expected) = (picture(&scene), picture(&floor(expected)));
        assert!(difference(&found, &expected) < 1e-3, "{slot:?}: {}", difference(&found, &expected));
        if slot != TextureSlot::Occlusion {
            assert!(difference(&found, &picture(&floor(base.clone()))) > 5e-3, "{slot:?} makes no difference");
        }
    }
}

/// OpenPBR's rule looks at the weight alone: it is the texture's too.
#[test]
fn a_textured_weight_hides_as_much_of_the_base_as_a_factor() {
    let overrides = MaterialEdits { layering: Some(Layering::OpenPbr), ..MaterialEdits::default() };
    let lobes = Lobes { sheen: false, diffuse: true, specular: false, emission: false };
    let edits =
        Edits { lobes: Some(lobes), every_material: overrides, lights_visible: Some(false), ..Edits::default() };
    let base = |scene: &Scene| linear(scene, &SheenTable::embedded(), &edits, SIZE);
    let of_weight = |weight: f32| {
        let sheen = rich().sheen.map(|sheen| Sheen { weight, ..sheen });
        floor(Material { sheen, ..rich() })
    };
    let mut scene = of_weight(0.8);
    textured(&mut scene, TextureSlot::SheenWeight, [1, 1], vec![[51, 255, 255, 255]]);
    assert!(difference(&base(&scene), &base(&of_weight(0.8 * 0.2))) < 1e-5);
    assert!(difference(&base(&scene), &base(&of_weight(0.8))) > 0.05, "the weight makes no difference");
}

#[test]
fn occlusion_weakens_the_environment_alone() {
    let edits = Edits { lights_visible: Some(false), ambient: Some(Vec3::ONE), ..Edits::default() };
    let lit = |scene: &Scene| linear(scene, &SheenTable::embedded(), &edits, SIZE);
    let mut scene = floor(rich());
    scene.materials[0].occlusion_strength = 0.5;
    textured(&mut scene, TextureSlot::Occlusion, [1, 1], vec![[51, 255, 255, 255]]);
    let weakened = Edits { ambient: Some(Vec3::splat(1.0 - 0.5 * 0.8)), ..edits.clone() };
    let expected = linear(&floor(rich()), &SheenTable::embedded(), &weakened, SIZE);
    assert!(difference(&lit(&scene), &expected) < 1e-3);
}

/// The emitted colour at the centre of a quarter of the floor: right, near.
fn quarter(picture: &LinearImage, right: bool, near: bool) -> [u8; 3] {
    let x = if right { 58 } else { 38 };
    let y = if near { 44 } else { 24 };
    picture.pixels[y * SIZE[0] as usize + x].map(|channel| (channel * 255.0).round() as u8)
}

/// Red, green, blue, white: by rows from the top.
fn four() -> Vec<[u8; 4]> {
    vec![[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255, 255, 255, 255]]
}

/// Shows a texture as emission, and nothing else.
fn shown(change: impl Fn(&mut Scene)) -> [[u8; 3]; 4] {
    let mut scene = floor(Material { base_color: Vec3::ZERO, emission: Vec3::ONE, ..plain() });
    textured(&mut scene, TextureSlot::Emission, [2, 2], four());
    scene.textures[0].sampler.magnify = velour::scene::Filter::Nearest;
    change(&mut scene);
    let lobes = Lobes { sheen: false, diffuse: false, specular: false, emission: true };
    let picture = linear(&scene, &SheenTable::embedded(), &Edits { lobes: Some(lobes), ..Edits::default() }, SIZE);
    [(false, false), (true, false), (false, true), (true, true)].map(|(right, near)| quarter(&picture, right, near))
}

#[test]
fn textures_are_the_right_way_up_and_transformed() {
    const RED: [u8; 3] = [255, 0, 0];
    const GREEN: [u8; 3] = [0, 255, 0];
    const BLUE: [u8; 3] = [0, 0, 255];
    const WHITE: [u8; 3] = [255; 3];
    assert_eq!(shown(|_| {}), [RED, GREEN, BLUE, WHITE]);
    let used = |scene: &mut Scene, change: &dyn Fn(&mut TextureUse)| {
        change(scene.materials[0].textures[TextureSlot::Emission as usize].as_mut().unwrap());
    };
    assert_eq!(shown(|scene| used(scene, &|texture| texture.tex_coord = 1)), [RED, BLUE, GREEN, WHITE]);
    let half_right = Affine2::from_translation(Vec2::new(0.5, 0.0));
    let shifted = shown(|scene| used(scene, &|texture| texture.uv_from_tex_coord = half_right));
    assert_eq!(shifted, [GREEN, RED, WHITE, BLUE]);
    let clamped = shown(|scene| {
        used(scene, &|texture| texture.uv_from_tex_coord = half_right);
        scene.textures[0].sampler.wrap[0] = velour::scene::Wrap::Clamp;
    });
    assert_eq!(clamped, [GREEN, GREEN, WHITE, WHITE]);
    let mirrored = shown(|scene| {
        used(scene, &|texture| texture.uv_from_tex_coord = Affine2::from_translation(Vec2::new(1.0, 0.0)));
        scene.textures[0].sampler.wrap[0] = velour::scene::Wrap::Mirror;
    });
    assert_eq!(mirrored, [GREEN, RED, WHITE, BLUE]);
}

#[test]
fn far_textures_are_their_mean_in_linear_light() {
    let checker: Vec<[u8; 4]> =
        (0..64 * 64).map(|at| if (at % 64 + at / 64) % 2 == 0 { [255; 4] } else { [0, 0, 0, 255] }).collect();
    let mut scene = floor(Material { base_color: Vec3::ZERO, emission: Vec3::ONE, ..plain() });
    textured(&mut scene, TextureSlot::Emission, [64, 64], checker);
    let repeated = Affine2::from_scale(Vec2::splat(40.0));
    scene.materials[0].textures[TextureSlot::Emission as usize].as_mut().unwrap().uv_from_tex_coord = repeated;
    let lobes = Lobes { sheen: false, diffuse: false, specular: false, emission: true };
    let picture = linear(&scene, &SheenTable::embedded(), &Edits { lobes: Some(lobes), ..Edits::default() }, SIZE);
    for near in [false, true] {
        let [r, ..] = quarter(&picture, false, near);
        assert!((120..=135).contains(&r), "{r}");
    }
}

/// Pixels at the edge of two triangles take part in the derivatives of both: a wrong one shows as a seam of another
/// mipmap.
#[test]
fn triangles_leave_no_seams_in_textures() {
    let texels: Vec<[u8; 4]> =
        (0..64 * 64).map(|at| if (at % 64 / 8 + at / 512) % 2 == 0 { [255; 4] } else { [0; 4] }).collect();
    let shown = |parts: u32| {
        let mut scene = floor(Material { base_color: Vec3::ZERO, emission: Vec3::ONE, ..plain() });
        textured(&mut scene, TextureSlot::Emission, [64, 64], texels.clone());
        // The same floor in this many parts a side.
        let corners =
            || (0..=parts).flat_map(|y| (0..=parts).map(move |x| Vec2::new(x as f32, y as f32) / parts as f32));
        let mesh = &mut scene.meshes[0];
        mesh.positions = corners().map(|at| (3.0 * at - 1.5).extend(0.0)).collect();
        mesh.tex_coords[0] = corners().collect();
        (mesh.tex_coords[1], mesh.tangents) = (Vec::new(), Vec::new());
        mesh.normals = vec![Vec3::Z; mesh.positions.len()];
        let quad = |x: u32, y: u32| {
            let at = y * (parts + 1) + x;
            [at, at + 1, at + parts + 2, at, at + parts + 2, at + parts + 1]
        };
        mesh.indices = (0..parts).flat_map(|y| (0..parts).flat_map(move |x| quad(x, y))).collect();
        let lobes = Lobes { sheen: false, diffuse: false, specular: false, emission: true };
        linear(&scene, &SheenTable::embedded(), &Edits { lobes: Some(lobes), ..Edits::default() }, SIZE)
    };
    let (whole, parts) = (shown(1), shown(23));
    let far = |(left, right): &(&[f32; 3], &[f32; 3])| (left[0] - right[0]).abs() > 0.1;
    let seams = whole.pixels.iter().zip(&parts.pixels).filter(far).count();
    assert!(seams == 0, "{seams} pixels differ");
}

#[test]
fn vertex_colours_multiply_the_base() {
    let mut colored = floor(plain());
    colored.meshes[0].colors = vec![[32768, 65535, 16384, 65535]; 4];
    let expected = Vec3::new(32768.0, 65535.0, 16384.0) / 65535.0;
    assert!(difference(&picture(&colored), &picture(&floor(Material { base_color: expected, ..plain() }))) < 1e-4);
}

#[test]
fn a_mapped_normal_is_one_that_the_mesh_might_have() {
    // Leaning to the right and away from the viewer, by what a byte can hold.
    let texel = [180_u8, 150, 230, 255];
    let mapped = Vec3::new(f32::from(texel[0]), f32::from(texel[1]), f32::from(texel[2])) / 127.5 - 1.0;
    for mirrored in [false, true] {
        let mut scene = floor(rich());
        textured(&mut scene, TextureSlot::Normal, [1, 1], vec![texel]);
        let mut expected = floor(rich());
        if mirrored {
            // The floor's own tangents are mirrored with it, and so are the texture's normals.
            for scene in [&mut scene, &mut expected] {
                let flip = glam::Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0));
                scene.instances[0].world_from_mesh *= flip;
            }
        }
        expected.meshes[0].normals = vec![mapped.normalize(); 4];
        let (found, expected) = (picture(&scene), picture(&expected));
        assert!(difference(&found, &expected) < 1e-3, "mirrored {mirrored}: {}", difference(&found, &expected));
    }
}

/// Filtering widens the lobe by what a mipmap has averaged, and by nothing else.
#[test]
fn flat_normal_maps_leave_sharp_reflections_sharp() {
    let edits = Edits { lights_visible: Some(false), ..Edits::default() };
    let filtered = |scene: &Scene| {
        let drawn = unshadowed(scene, &edits);
        let mut renderer = Offscreen::for_linear(&GPU, 4, &SheenTable::embedded(), &drawn).unwrap();
        GPU.block_on(renderer.linear(&GPU, &scene.cameras[0], SIZE, &drawn.settings)).unwrap()
    };
    let polished = Material { roughness: 0.15, metallic: 1.0, sheen: None, ..rich() };
    let bare = filtered(&floor(polished.clone()));
    // A byte's rounding leans by half a step, which moves a reflection's edge.
    for (texel, scale, most) in [([128, 128, 255, 255], 1.0, 0.2), ([156, 100, 248, 255], 0.0, 1e-2)] {
        let mut scene = floor(polished.clone());
        scene.materials[0].normal_scale = scale;
        textured(&mut scene, TextureSlot::Normal, [4, 4], vec![texel; 16]);
        let difference = difference(&filtered(&scene), &bare);
        assert!(difference < most, "{texel:?} scaled by {scale}: {difference}");
    }
}

#[test]
fn tints_past_one_are_cut_after_their_texture() {
    let glass = |tint: f32| Material { ior: 2.0, specular_color: Vec3::splat(tint), specular: 1.0, ..plain() };
    let mut scene = floor(glass(36.0));
    textured(&mut scene, TextureSlot::SpecularColor, [1, 1], vec![[188, 188, 188, 255]]);
    let expected = picture(&floor(glass(36.0 * linear_from_srgb(188))));
    assert!(difference(&picture(&scene), &expected) < 1e-4);
    assert!(difference(&picture(&floor(glass(9.0))), &picture(&floor(glass(4.0)))) > 1e-2);
}

#[test]
fn textures_without_mipmaps_are_made_smaller_as_they_say() {
    use velour::scene::Filter::{Linear, Nearest};
    let checker = (0..256 * 256).map(|at| if (at % 256 + at / 256) % 2 == 0 { [255; 4] } else { [0; 4] });
    let texels: Vec<[u8; 4]> = checker.collect();
    let greys = |magnify, minify| {
        let mut scene = floor(Material { base_color: Vec3::ZERO, emission: Vec3::ONE, ..plain() });
        textured(&mut scene, TextureSlot::Emission, [256, 256], texels.clone());
        scene.textures[0].sampler = Sampler { magnify, minify, mipmaps: None, ..Sampler::DEFAULT };
        let lobes = Lobes { sheen: false, diffuse: false, specular: false, emission: true };
        let picture = linear(&scene, &SheenTable::embedded(), &Edits { lobes: Some(lobes), ..Edits::default() }, SIZE);
        picture.pixels.iter().filter(|pixel| (0.02..0.98).contains(&pixel[0])).count()
    };
    assert_eq!(greys(Linear, Nearest), 0);
    assert!(greys(Nearest, Linear) > 500);
}

#[test]
fn light_from_below_the_surface_reaches_no_mapped_normal() {
    // A wall of light that stands on the floor and reaches as far below it as above.
    let tall = |half_height: f32, y: f32| {
        let floor = Thing::rectangle([1.5, 1.5], rich()).placed(facing(ORIGIN, UP));
        let wall =
            Thing::rectangle([1.0, half_height], glow([4.0, 3.0, 2.0])).placed(facing([0.0, y, -1.0], [0.0, y, 0.0]));
        let mut scene = Stage::new(vec![floor, wall], looking([0.0, 1.4, 2.2], ORIGIN)).scene();
        let mesh = &mut scene.meshes[0];
        mesh.tex_coords[0] = vec![Vec2::ZERO; 4];
        mesh.tangents = vec![Vec4::new(1.0, 0.0, 0.0, 1.0); 4];
        // Leaning towards the wall: its horizon is far below the floor there.
        textured(&mut scene, TextureSlot::Normal, [1, 1], vec![[128, 36, 200, 255]]);
        picture(&scene)
    };
    let (whole, upper) = (tall(1.0, 0.0), tall(0.5, 0.5));
    assert!(difference(&whole, &upper) < 1e-3, "{}", difference(&whole, &upper));
    assert!(difference(&tall(1.0, 0.5), &upper) > 0.05, "more light above the floor is told");
}

#[test]
fn lights_without_extent_below_the_surface_reach_no_mapped_normal() {
    let lit_from = |y: f32| {
        let mut scene = floor(rich());
        textured(&mut scene, TextureSlot::Normal, [1, 1], vec![[128, 36, 200, 255]]);
        // The window goes dark.
        scene.lights.clear();
        scene.materials[1].emission = Vec3::ZERO;
        scene.punctual_lights.push(PunctualLight {
            name: String::new(),
            kind: PunctualKind::Point { range: f32::INFINITY },
            intensity: Vec3::ONE,
            position: Vec3::new(0.0, y, -3.0),
            direction: Vec3::NEG_Y,
        });
        let edits = Edits { lights_visible: Some(false), ..Edits::default() };
        linear(&scene, &SheenTable::embedded(), &edits, SIZE).pixels.into_iter().flatten().fold(0.0, f32::max)
    };
    assert!(lit_from(0.3) > 0.01, "the normal leans towards the light");
    assert_eq!(lit_from(-0.1), 0.0);
}

#[test]
fn what_is_masked_is_not_there_and_what_is_blended_shows_what_is_behind() {
    let curtain = |alpha_mode, opacity: f32| {
        let floor = Thing::rectangle([1.5, 1.5], plain()).placed(facing(ORIGIN, UP));
        let material = Material { base_color: Vec3::X, unlit: true, alpha_mode, opacity, ..plain() };
        let near = Thing::rectangle([3.0, 3.0], material.clone()).placed(facing([0.0, 1.05, 1.65], [0.0, 1.4, 2.2]));
        let far = Thing::rectangle([3.0, 3.0], Material { base_color: Vec3::Y, ..material })
            .placed(facing([0.0, 0.84, 1.32], [0.0, 1.4, 2.2]));
        let window = Thing::rectangle([0.6, 0.4], glow([4.0, 3.0, 2.0])).placed(facing([0.7, 0.8, -1.3], ORIGIN));
        // The nearer curtain comes first in the file.
        picture(&Stage::new(vec![near, far, floor, window], looking([0.0, 1.4, 2.2], ORIGIN)).scene())
    };
    let bare = curtain(AlphaMode::Mask { cutoff: 0.5 }, 0.4);
    assert!(difference(&bare, &picture(&floor(plain()))) < 1e-6, "masked away");
    let solid = curtain(AlphaMode::Mask { cutoff: 0.5 }, 0.6);
    assert!(solid.pixels.iter().all(|pixel| *pixel == [1.0, 0.0, 0.0]), "unlit, and not masked");
    assert_eq!(curtain(AlphaMode::Opaque, 0.3), solid);
    assert_eq!(curtain(AlphaMode::Mask { cutoff: 0.5 }, 0.5), solid, "what is as opaque as the cutoff is there");
    let blended = curtain(AlphaMode::Blend, 0.25);
    for (blended, bare) in blended.pixels.iter().zip(&bare.pixels) {
        let expected = Vec3::new(0.25, 0.75 * 0.25, 0.0) + 0.75 * 0.75 * Vec3::from(*bare);
        assert!((Vec3::from(*blended) - expected).abs().max_element() < 1e-3, "{blended:?} is not {expected}");
    }
}
