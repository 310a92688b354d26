//! Linear pictures against the design's sum, pixel by pixel.

use glam::{Mat4, Quat, Vec3};
use velour::picture::LinearImage;
use velour::scene::{Edits, Lobes, Material, Projection};
use velour::table::SheenTable;

use super::compare::{SIZE, changed, differences, hold, linear, sheen_alone};
use super::stage::{Stage, Thing, facing, glow, looking, velvet};
use super::truth::Truth;

const UP: [f32; 3] = [0.0, 1.0, 0.0];
const ORIGIN: [f32; 3] = [0.0; 3];

fn cloth() -> Material {
    velvet([0.9, 0.5, 0.2], 0.4)
}

/// A floor that fills the lower part of the picture.
fn floor(material: Material) -> Thing {
    Thing::rectangle([1.5, 1.5], material).placed(facing(ORIGIN, UP))
}

/// A rectangle that lights the floor from the right.
fn window() -> Thing {
    Thing::rectangle([0.5, 0.3], glow([4.0, 3.0, 2.0])).placed(facing([1.0, 1.2, -1.0], ORIGIN))
}

/// An L with its outer corner at the lower left, and a square ring: what no quad light can be.
fn letter(material: Material) -> Thing {
    let corners = [[0.0, 0.0], [0.9, 0.0], [0.9, 0.3], [0.3, 0.3], [0.3, 0.8], [0.0, 0.8]];
    Thing::flat(&corners, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]], &[&[0, 1, 2, 3, 4, 5]], material)
}

fn ring(material: Material) -> Thing {
    let square = |half: f32| [[-half, -half], [half, -half], [half, half], [-half, half]];
    let corners: Vec<[f32; 2]> = square(0.5).into_iter().chain(square(0.25)).collect();
    let triangles: Vec<[u32; 3]> =
        (0..4).flat_map(|i| [[i, (i + 1) % 4, 4 + i], [(i + 1) % 4, 4 + (i + 1) % 4, 4 + i]]).collect();
    Thing::flat(&corners, &triangles, &[&[0, 1, 2, 3], &[7, 6, 5, 4]], material)
}

fn eye() -> Mat4 {
    looking([0.4, 1.1, 2.6], ORIGIN)
}

/// A part of a cylinder about the y axis that bulges towards +z; its normals are the cylinder's, bent further by a
/// factor.
fn bulge(material: Material, bend: f32) -> Thing {
    let column = |i: u32| (i as f32 / 8.0 - 0.5) * 2.0;
    let corners: Vec<(f32, f32)> = (0..=8).flat_map(|i| [(column(i), -0.8), (column(i), 0.8)]).collect();
    let place = |&(angle, y): &(f32, f32)| Vec3::new(angle.sin(), y, angle.cos() - 0.7);
    let normal = |&(angle, _): &(f32, f32)| Vec3::new((bend * angle).sin(), 0.0, (bend * angle).cos());
    let triangles = (0..8).flat_map(|i| [[2 * i, 2 * i + 2, 2 * i + 3], [2 * i, 2 * i + 3, 2 * i + 1]]);
    Thing {
        positions: corners.iter().map(place).collect(),
        normals: corners.iter().map(normal).collect(),
        triangles: triangles.collect(),
        contours: Vec::new(),
        world_from_mesh: Mat4::IDENTITY,
        material,
    }
}

#[test]
fn a_rectangle_lights_a_floor() {
    for roughness in [0.2, 0.4, 1.0] {
        hold(&Stage::new(vec![floor(velvet([0.9, 0.5, 0.2], roughness)), window()], eye()), &sheen_alone());
    }
}

#[test]
fn lights_add_up() {
    let mut other = Thing::rectangle([0.2, 0.7], glow([0.5, 2.0, 6.0])).placed(facing([-1.2, 0.4, -0.5], ORIGIN));
    other.material.double_sided = true;
    hold(&Stage::new(vec![floor(cloth()), window(), other], eye()), &sheen_alone());
}

#[test]
fn outlines_may_be_concave_and_have_holes() {
    let letter = letter(glow([3.0; 3])).placed(facing([-0.6, 0.9, -1.0], ORIGIN));
    let ring = ring(glow([1.0, 2.0, 5.0])).placed(facing([0.9, 0.5, 0.2], ORIGIN));
    for light in [letter, ring] {
        hold(&Stage::new(vec![floor(cloth()), light], eye()), &sheen_alone());
    }
}

#[test]
fn lights_reach_below_the_horizon() {
    let wall = Thing::rectangle([0.9, 0.6], glow([4.0, 3.0, 2.0])).placed(facing([-0.4, 0.1, -1.3], [0.0, 0.1, 0.0]));
    let letter = letter(glow([3.0; 3])).placed(facing([0.2, -0.5, -1.0], [0.0, 0.2, 0.6]));
    hold(&Stage::new(vec![floor(cloth()), wall, letter], eye()), &sheen_alone());
}

#[test]
fn one_sided_lights_are_dark_behind() {
    // The plane of the light cuts the floor: one part is lit, the other black.
    let upright = |double_sided| {
        let mut light = window().placed(facing([0.2, 0.4, -0.3], [1.0, 0.4, 0.1]));
        light.material.double_sided = double_sided;
        light
    };
    hold(&Stage::new(vec![floor(cloth()), upright(false)], eye()), &sheen_alone());
    hold(&Stage::new(vec![floor(cloth()), upright(true)], eye()), &sheen_alone());
}

#[test]
fn back_faces_are_lit_where_the_material_has_two_sides() {
    let turned = |double_sided| {
        let mut floor = floor(cloth()).placed(facing(ORIGIN, [0.0, -1.0, 0.0]));
        floor.material.double_sided = double_sided;
        floor
    };
    let lower = Thing::rectangle([1.0, 0.5], cloth()).placed(facing([0.0, -0.3, 0.5], [0.0, 1.0, 1.0]));
    hold(&Stage::new(vec![turned(true), window()], eye()), &sheen_alone());
    // Culled, it lets the lower one be seen.
    hold(&Stage::new(vec![turned(false), lower, window()], eye()), &sheen_alone());
}

#[test]
fn transforms_mirror_shear_and_stretch() {
    let mirror = Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    let floor = |material| floor(material).placed(facing(ORIGIN, UP) * mirror);
    let mirrored = letter(glow([3.0; 3])).placed(facing([-0.6, 0.9, -1.0], ORIGIN) * mirror);
    hold(&Stage::new(vec![floor(cloth()), mirrored.clone()], eye()), &sheen_alone());
    let flipped = mirrored.placed(Mat4::from_scale(Vec3::new(1.0, 1.0, -1.0)) * facing([-0.6, 0.9, 1.0], ORIGIN));
    hold(&Stage::new(vec![floor(cloth()), flipped], eye()), &sheen_alone());
    let mut sheared = Mat4::from_scale_rotation_translation(
        Vec3::new(1.3, 0.7, -0.4),
        Quat::from_euler(glam::EulerRot::XYZ, 0.3, 2.6, 0.2),
        Vec3::new(0.1, 0.2, 0.3),
    );
    sheared.y_axis.x += 0.4;
    let mut bulge = bulge(cloth(), 1.0).placed(sheared);
    bulge.material.double_sided = true;
    let light = window().placed(facing([0.3, 1.0, 2.0], ORIGIN));
    hold(&Stage::new(vec![bulge, light], eye()), &sheen_alone());
}

#[test]
fn normals_are_interpolated_and_may_face_away() {
    let light = || window().placed(facing([0.3, 1.0, 2.0], ORIGIN));
    hold(&Stage::new(vec![bulge(cloth(), 1.0), light()], looking([0.3, 0.5, 2.6], ORIGIN)), &sheen_alone());
    // Bent half as far again, the normals near the rims point behind what is seen.
    hold(&Stage::new(vec![bulge(cloth(), 1.5), light()], looking([0.9, 0.2, 2.4], ORIGIN)), &sheen_alone());
}

#[test]
fn parallel_projection_has_one_view_direction() {
    let projection = Projection::Orthographic { ymag: 1.2, near: 0.0, far: 50.0 };
    let stage = Stage { projection, ..Stage::new(vec![floor(cloth()), window()], eye()) };
    hold(&stage, &sheen_alone());
    // Straight down the view is the normal, which leaves the frame's x open.
    let above = looking([0.0, 3.0, 0.0], ORIGIN);
    hold(&Stage { world_from_camera: above, ..stage }, &sheen_alone());
}

#[test]
fn lobes_are_summed_as_asked() {
    let stage = Stage::new(vec![floor(cloth()), window()], looking([0.4, 1.3, 3.4], [0.2, 0.4, 0.0]));
    for bits in 1..8 {
        let lobes = Lobes { sheen: bits & 1 != 0, diffuse: bits & 2 != 0, specular: false, emission: bits & 4 != 0 };
        let lights_visible = bits & 4 != 0;
        hold(&stage, &Edits { lobes: Some(lobes), lights_visible: Some(lights_visible), ..Edits::default() });
    }
}

#[test]
fn a_bare_base_is_not_weakened() {
    let mut bare = cloth();
    bare.sheen = None;
    hold(&Stage::new(vec![floor(bare), window()], eye()), &Edits::default());
}

#[test]
fn hidden_lights_shine_and_hide_nothing() {
    // The light stands before the floor, with its back to the camera or not.
    for double_sided in [false, true] {
        let mut light = window().placed(facing([0.0, 0.4, 1.0], [0.0, 0.0, -1.0]));
        light.material.double_sided = double_sided;
        let stage = Stage::new(vec![floor(cloth()), light], eye());
        for lights_visible in [false, true] {
            hold(&stage, &Edits { lights_visible: Some(lights_visible), ..Edits::default() });
        }
    }
}

#[test]
fn one_sheen_may_be_given_to_all() {
    let mut bare = cloth();
    bare.sheen = None;
    let stage = Stage::new(vec![floor(cloth()), bulge(bare, 1.0), window()], eye());
    let color = Some(Vec3::new(0.1, 0.9, 0.4));
    hold(&stage, &changed(Some(0.7), None, Edits::default()));
    hold(&stage, &changed(None, color, Edits::default()));
    hold(&stage, &changed(Some(0.0), color, Edits::default()));
}

/// A table as unlike the shipped one as possible: every node has its own numbers, and the sides differ.
fn odd_table() -> SheenTable {
    let mut seed = 7u32;
    let mut random = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / f64::from(1 << 24)
    };
    SheenTable::new([5, 9], (0..45).map(|_| [0.2 + random(), random() - 0.7, random()]).collect())
}

#[test]
fn another_table_gives_its_own_sum() {
    let table = odd_table();
    let edits = sheen_alone();
    let stage = Stage::new(vec![floor(velvet([0.9, 0.5, 0.2], 0.63)), window()], eye());
    let picture = linear(&stage.scene(), &table, &edits, SIZE);
    differences(&picture, &Truth::new(&stage, &table, &edits, SIZE)).unwrap();
    let shipped = SheenTable::embedded();
    assert!(differences(&picture, &Truth::new(&stage, &shipped, &edits, SIZE)).is_err());
}

#[test]
fn wrong_pictures_are_rejected() {
    let (table, edits) = (SheenTable::embedded(), sheen_alone());
    let stage = Stage::new(vec![floor(cloth()), window()], eye());
    let truth = Truth::new(&stage, &table, &edits, SIZE);
    let right = linear(&stage.scene(), &table, &edits, SIZE);
    differences(&right, &truth).unwrap();
    let middle = (SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) as usize;
    let changed = |change: &dyn Fn(&mut LinearImage)| {
        let mut picture = right.clone();
        change(&mut picture);
        differences(&picture, &truth).is_err()
    };
    assert!(changed(&|picture| picture.pixels.rotate_right(1)));
    assert!(changed(&|picture| picture.pixels[middle][1] *= 1.01));
    assert!(changed(&|picture| picture.pixels[middle][2] = f32::NAN));
    assert!(changed(&|picture| picture.pixels.iter_mut().flatten().for_each(|channel| *channel *= 1.01)));
    for other in [
        Stage::new(vec![floor(velvet([0.9, 0.5, 0.2], 0.41)), window()], eye()),
        Stage::new(vec![floor(velvet([0.9, 0.5, 0.21], 0.4)), window()], eye()),
        Stage::new(vec![floor(cloth()), window().placed(facing([1.0, 1.21, -1.0], ORIGIN))], eye()),
    ] {
        assert!(differences(&right, &Truth::new(&other, &table, &edits, SIZE)).is_err());
    }
}
