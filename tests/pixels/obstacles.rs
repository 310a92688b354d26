//! Scenes in which something stands in the way of light.

use std::sync::Arc;

use glam::{Affine2, Mat4, Vec2, Vec3, Vec4};
use velour::scene::{
    AlphaMode, Edits, Image, Layering, Material, MaterialEdits, Pattern, PatternImage, Polygon, PunctualKind,
    PunctualLight, Sampler, Scene, Sheen, Texture, TextureSlot, TextureUse,
};

use super::modelling::ball;
use super::stage::{Stage, Thing, facing, glow, looking, plain, velvet};

const UP: [f32; 3] = [0.0, 1.0, 0.0];
const ORIGIN: [f32; 3] = [0.0; 3];
/// The middle of the window.
const WINDOW: [f32; 3] = [0.9, 1.5, -1.0];
/// The middle of what stands before it.
const BETWEEN: [f32; 3] = [0.4, 0.7, -0.4];

/// A scene, and what is changed in it.
pub struct Case {
    pub name: &'static str,
    pub scene: Scene,
    pub edits: Edits,
}

impl Case {
    fn new(name: &'static str, scene: Scene) -> Self {
        Self { name, scene, edits: Edits::default() }
    }

    fn of(name: &'static str, things: Vec<Thing>) -> Self {
        Self::new(name, seen(things))
    }

    /// The case of this name.
    pub fn named(name: &str) -> Self {
        all().into_iter().find(|case| case.name == name).unwrap_or_else(|| panic!("there is no case {name}"))
    }
}

/// As they are seen from before and above.
fn seen(things: Vec<Thing>) -> Scene {
    Stage::new(things, looking([0.4, 1.1, 2.6], ORIGIN)).scene()
}

/// Fibres over a glossy base.
pub fn cloth() -> Material {
    Material { specular: 1.0, roughness: 0.4, ..velvet([0.9, 0.5, 0.2], 0.4) }
}

/// A floor of 3 m that faces up.
pub fn floor(material: Material) -> Thing {
    Thing::rectangle([1.5, 1.5], material).placed(facing(ORIGIN, UP))
}

pub fn window() -> Thing {
    Thing::rectangle([0.5, 0.3], glow([8.0, 6.0, 4.0])).placed(facing(WINDOW, ORIGIN))
}

/// Before the window, to which it shows its front: the floor and the camera are behind it.
fn board() -> Thing {
    Thing::rectangle([0.3, 0.2], plain()).placed(facing(BETWEEN, WINDOW))
}

/// A ball on the floor.
fn round(material: Material) -> Thing {
    let place = Mat4::from_translation(Vec3::new(0.1, 0.35, 0.2)) * Mat4::from_scale(Vec3::splat(0.35));
    ball(material, 32).placed(place)
}

/// Whatever can be in the way, in all ways.
pub fn all() -> Vec<Case> {
    vec![
        Case::of("board", vec![floor(cloth()), window(), board()]),
        Case::of("ball", vec![floor(cloth()), window(), round(cloth())]),
        concave(),
        two_sided(),
        mask(),
        blend(),
        moved(),
        box_of_light(),
        normals(),
        reciprocal(),
        glossy(),
        panels(),
        punctual(),
        stained_glass(),
    ]
}

/// A window like a U, and a board before it.
fn concave() -> Case {
    let corners =
        [[-0.6, -0.4], [0.6, -0.4], [0.6, 0.4], [0.3, 0.4], [0.3, -0.1], [-0.3, -0.1], [-0.3, 0.4], [-0.6, 0.4]];
    let triangles = [[0, 1, 4], [0, 4, 5], [1, 2, 3], [1, 3, 4], [0, 5, 6], [0, 6, 7]];
    let light = Thing::flat(&corners, &triangles, &[&[0, 1, 2, 3, 4, 5, 6, 7]], glow([8.0, 6.0, 4.0]));
    Case::of("concave light", vec![floor(cloth()), light.placed(facing(WINDOW, ORIGIN)), board()])
}

/// A window whose back is towards the floor and which shines from there as well.
fn two_sided() -> Case {
    let mut light = window().placed(facing(WINDOW, [2.0, 3.0, -2.0]));
    light.material.double_sided = true;
    Case::of("two-sided light", vec![floor(cloth()), light, board()])
}

/// Texture coordinates from 0 to 1 over a rectangle of these half sides, and tangents along u.
fn mapped(scene: &mut Scene, mesh: usize, [x, y]: [f32; 2]) {
    let mesh = &mut scene.meshes[mesh];
    let uv = |position: &Vec3| Vec2::new(position.x / x, position.y / y) / 2.0 + 0.5;
    mesh.tex_coords[0] = mesh.positions.iter().map(uv).collect();
    mesh.tangents = vec![Vec4::new(1.0, 0.0, 0.0, 1.0); mesh.positions.len()];
}

fn textured(scene: &mut Scene, material: usize, slot: TextureSlot, size: u32, texel: impl Fn(u32, u32) -> [u8; 4]) {
    let texels = (0..size * size).map(|at| texel(at % size, at / size)).collect();
    scene.images.push(Image { name: "texels".into(), width: size, height: size, texels });
    scene.textures.push(Texture { image: scene.images.len() - 1, sampler: Sampler::DEFAULT });
    let used = TextureUse {
        texture: scene.textures.len() - 1,
        tex_coord: 0,
        uv_from_tex_coord: Affine2::from_scale(Vec2::new(1.5, 1.0)),
    };
    scene.materials[material].textures[slot as usize] = Some(used);
}

/// A board with holes.
fn mask() -> Case {
    let mut board = board();
    board.material.alpha_mode = AlphaMode::Mask { cutoff: 0.4 };
    let mut scene = seen(vec![floor(cloth()), window(), board]);
    mapped(&mut scene, 2, [0.3, 0.2]);
    // Other in each row and column, so that it matters which way round it is.
    textured(&mut scene, 2, TextureSlot::BaseColor, 8, |x, y| {
        [255, 255, 255, ((x * 5 + y * 3 + x * y) % 8 * 36) as u8]
    });
    Case::new("mask", scene)
}

/// A veil, which the camera sees, before the window.
fn blend() -> Case {
    let mut veil = board().placed(facing(BETWEEN, ORIGIN));
    veil.material = Material { alpha_mode: AlphaMode::Blend, opacity: 0.6, double_sided: true, ..cloth() };
    Case::of("blend", vec![floor(cloth()), window(), veil, round(cloth())])
}

/// Floor, window and board, each under a transform that scales or mirrors.
fn moved() -> Case {
    let scaled = |thing: Thing, scale: Vec3| {
        let place = thing.world_from_mesh * Mat4::from_scale(scale);
        thing.placed(place)
    };
    let things = vec![
        scaled(floor(Material { double_sided: true, ..cloth() }), Vec3::new(-1.0, 0.8, 3.0)),
        scaled(window(), Vec3::new(1.0, -1.4, 0.5)),
        scaled(board(), Vec3::new(1.2, 0.7, -2.0)),
        scaled(round(cloth()), Vec3::new(-1.0, 1.3, 0.7)),
    ];
    Case::of("moved", things)
}

/// A box of 0.4 m that glows on all sides, outwards and inwards. Its far sides are behind the near ones.
fn box_of_light() -> Case {
    let cube = cube();
    let mut scene = seen(vec![floor(cloth()), cube.clone(), board()]);
    let side = |corners: &[Vec3]| {
        let corners: Vec<Vec3> = corners.iter().map(|&corner| cube.world_from_mesh.transform_point3(corner)).collect();
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        Polygon { contours: vec![corners], normal, pattern: None }
    };
    scene.lights[0].polygons = cube.positions.chunks(4).map(side).collect();
    Case::new("box of light", scene)
}

fn cube() -> Thing {
    let turned = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let side = |way: Vec3| {
        let place = facing((0.2 * way).to_array(), way.to_array());
        [[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]]
            .map(|[x, y]: [f32; 2]| (place.transform_point3(Vec3::new(x, y, 0.0)), way))
    };
    let (positions, normals) = turned.iter().flat_map(|&way| side(way)).unzip();
    let material = Material { double_sided: true, ..glow([5.0, 4.0, 3.0]) };
    Thing {
        positions,
        normals,
        triangles: (0..6).flat_map(|k| [[0, 1, 2], [0, 2, 3]].map(|of: [u32; 3]| of.map(|at| 4 * k + at))).collect(),
        contours: Vec::new(),
        world_from_mesh: Mat4::from_translation(Vec3::new(0.8, 1.1, -0.8)) * Mat4::from_rotation_y(0.5),
        material,
    }
}

/// A floor whose normals lean, all alike: what lies between texels is another matter.
fn normals() -> Case {
    let mut scene = seen(vec![floor(cloth()), window(), board()]);
    mapped(&mut scene, 0, [1.5, 1.5]);
    textured(&mut scene, 0, TextureSlot::Normal, 1, |_, _| [165, 90, 225, 255]);
    Case::new("normal map", scene)
}

/// A window of 8 by 5 panes of many colours, some dark, under which a ball stands, and a plain one on the other side.
fn stained_glass() -> Case {
    let mut lamp = window().placed(facing([-0.9, 1.2, -0.8], ORIGIN));
    lamp.material.emission = Vec3::splat(2.0);
    let mut scene = seen(vec![floor(cloth()), window(), lamp, round(cloth())]);
    let pane = |at: u32| [at % 3, at * at % 4, at % 5 / 2].map(|step| step as f32);
    let panes: Vec<Vec3> = (0..40).map(|at| pane(at).into()).collect();
    let mean = panes.iter().sum::<Vec3>() / 40.0;
    let image = PatternImage { size: [8, 5], texels: panes.into_iter().map(|pane| pane / mean).collect() };
    let place = facing(WINDOW, ORIGIN);
    scene.lights[0].polygons[0].pattern = Some(Pattern {
        origin: place.transform_point3(Vec3::new(-0.5, -0.3, 0.0)),
        axes: [Vec3::X, 0.6 * Vec3::Y].map(|axis| place.transform_vector3(axis)),
        image: Arc::new(image),
    });
    Case::new("stained glass", scene)
}

fn reciprocal() -> Case {
    let every_material = MaterialEdits { layering: Some(Layering::Reciprocal), ..MaterialEdits::default() };
    let edits = Edits { every_material, ..Edits::default() };
    Case { edits, ..Case::of("reciprocal layering", vec![floor(cloth()), window(), board(), round(cloth())]) }
}

/// Lobes of other shapes and other colours on one surface: a white gloss, red below it, a blue sheen on top.
fn glossy() -> Case {
    let gloss = Material {
        base_color: Vec3::new(0.5, 0.1, 0.05),
        specular: 1.0,
        roughness: 0.3,
        ior: 1.8,
        sheen: Some(Sheen::new(Vec3::new(0.02, 0.1, 1.0), 0.5)),
        ..plain()
    };
    Case::of("gloss and blue sheen", vec![floor(gloss), window(), board()])
}

/// A ring of 64 panels of many colours about the floor, some turned away, some two-sided.
fn panels() -> Case {
    let panel = |k: usize| {
        let angle = k as f32 * 2.4;
        let eye = [1.7 * angle.cos(), 1.3 - k as f32 / 64.0, 1.7 * angle.sin()];
        let target = if k.is_multiple_of(3) { eye.map(|at| 2.0 * at) } else { ORIGIN };
        let color = [1.0 + (k % 5) as f32, 1.0 + (k % 3) as f32, 2.0].map(|radiance| radiance / 4.0);
        let mut panel = Thing::rectangle([0.2, 0.1], glow(color)).placed(facing(eye, target));
        panel.material.double_sided = k.is_multiple_of(7);
        panel
    };
    let things = [vec![floor(cloth()), round(cloth())], (0..64).map(panel).collect()].concat();
    let edits = Edits { lights_visible: Some(false), ..Edits::default() };
    Case { edits, ..Case::of("64 lights", things) }
}

/// Lights without extent, of each kind, beside the window.
fn punctual() -> Case {
    let mut case = Case::of("punctual lights", vec![floor(cloth()), window(), round(cloth()), board()]);
    let light = |kind, intensity: [f32; 3], position: [f32; 3]| PunctualLight {
        name: String::new(),
        kind,
        intensity: intensity.into(),
        position: position.into(),
        direction: -Vec3::from(position).normalize(),
    };
    case.scene.punctual_lights = vec![
        light(PunctualKind::Point { range: f32::INFINITY }, [3.0, 1.0, 1.0], [-0.8, 1.5, -0.3]),
        light(PunctualKind::Spot { range: 4.0, inner: 0.2, outer: 0.5 }, [1.0, 4.0, 1.0], [0.2, 1.9, -0.9]),
        light(PunctualKind::Directional, [0.2, 0.3, 1.0], [-1.0, 1.0, 0.4]),
    ];
    case
}
