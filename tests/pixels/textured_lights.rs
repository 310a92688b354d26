//! Textured lights in real time, against the closed form of their texels as lights of their own.

use std::sync::Arc;

use glam::{DVec3, Mat4, Vec3};
use velour::picture::LinearImage;
use velour::scene::{Edits, LightEdits, Material, MaterialEdits, Pattern, PatternImage, SheenModel, linear_from_srgb};
use velour::table::SheenTable;

use super::compare::{GPU, differences, moves_corners};
use super::obstacles::{Case, cloth, floor};
use super::shadows::{centred, offscreen, pictured};
use super::stage::{Stage, Thing, facing, glow, looking, plain};
use super::truth::Truth;

const SIZE: [u32; 2] = [40, 30];
/// Half of the window's sides.
const HALF: [f32; 2] = [0.6, 0.4];

/// A window above and beyond a floor, which alone is seen.
struct Window {
    size: [u32; 2],
    texels: Vec<Vec3>,
    floor: Material,
}

fn place() -> Mat4 {
    facing([0.1, 0.8, -0.9], [0.0, 0.1, 0.3])
}

impl Window {
    fn new(size: [u32; 2], floor: Material, texel: impl Fn(u32, u32) -> [f32; 3]) -> Self {
        let texels = (0..size[0] * size[1]).map(|at| texel(at % size[0], at / size[0]).into()).collect();
        Self { size, texels, floor }
    }

    fn stage(&self, lights: Vec<Thing>) -> Stage {
        let things = [vec![floor(self.floor.clone())], lights].concat();
        Stage::new(things, looking([0.1, 0.7, 0.7], [0.0, 0.0, -0.1]))
    }

    /// Each texel a light.
    fn panes(&self) -> Stage {
        let [columns, rows] = self.size;
        let pane = |(at, color): (usize, &Vec3)| {
            let place = |column: u32, row: u32| {
                let share = [column as f32 / columns as f32, row as f32 / rows as f32];
                [0, 1].map(|axis: usize| (2.0 * share[axis] - 1.0) * HALF[axis])
            };
            let (column, row) = (at as u32 % columns, at as u32 / columns);
            let [low, high] = [place(column, row), place(column + 1, row + 1)];
            let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
            let glow = glow(color.to_array());
            Thing::flat(&corners, &[[0, 1, 2], [0, 2, 3]], &[&[0, 1, 2, 3]], glow).placed(self::place())
        };
        let lit = self.texels.iter().enumerate().filter(|(_, texel)| **texel != Vec3::ZERO);
        self.stage(lit.map(pane).collect())
    }

    /// All of them one light.
    fn case(&self) -> Case {
        let mean = self.texels.iter().sum::<Vec3>() / self.texels.len() as f32;
        let window = Thing::rectangle(HALF, glow(mean.to_array())).placed(place());
        let mut scene = self.stage(vec![window]).scene();
        let texels = self.texels.iter().map(|texel| *texel / mean).collect();
        let [x, y] = HALF;
        scene.lights[0].polygons[0].pattern = Some(Pattern {
            origin: place().transform_point3(Vec3::new(-x, -y, 0.0)),
            axes: [2.0 * x * Vec3::X, 2.0 * y * Vec3::Y].map(|axis| place().transform_vector3(axis)),
            image: Arc::new(PatternImage { size: self.size, texels }),
        });
        Case { name: "window", scene, edits: Edits::default() }
    }

    /// The radiance of each pixel in closed form.
    fn expected(&self) -> Vec<DVec3> {
        let (stage, edits, table) = (self.panes(), Edits::default(), SheenTable::embedded());
        let truth = Truth::new(&stage, &table, &edits, SIZE);
        let at = |index: u32| [index % SIZE[0], index / SIZE[0]].map(|at| f64::from(at) + 0.5);
        (0..SIZE[0] * SIZE[1]).map(|index| truth.at(at(index)).map_or(DVec3::ZERO, |hit| hit.radiance)).collect()
    }
}

/// The mean absolute error of a picture, and its mean error, over the mean of what is expected.
fn errors(picture: &LinearImage, expected: &[DVec3]) -> [f64; 2] {
    let differences =
        || picture.pixels.iter().zip(expected).map(|(found, expected)| Vec3::from(*found).as_dvec3() - expected);
    let sum = expected.iter().sum::<DVec3>().element_sum();
    let off = differences().map(|difference| difference.abs().element_sum()).sum::<f64>();
    [off, differences().sum::<DVec3>().element_sum()].map(|error| error / sum)
}

fn without_shadows(case: &Case) -> LinearImage {
    let edits = Edits { shadows: Some(false), ..case.edits.clone() };
    pictured(&Case { scene: case.scene.clone(), edits, ..*case }, SIZE, centred(1, 0))
}

fn gloss() -> Material {
    Material { specular: 1.0, roughness: 0.25, base_color: Vec3::new(0.3, 0.2, 0.1), ..plain() }
}

/// 5 x 4 panes, of which neighbours are alike or black here and there.
fn panes(floor: Material) -> Window {
    Window::new([10, 8], floor, |x, y| {
        let (x, y) = (x / 2, y / 2);
        [((x + y) % 3) as f32, (x * y % 4) as f32, ((2 * x + y) % 5 / 3) as f32]
    })
}

/// What is even piece by piece is exact, in all lobes, from the first sample on, and with no noise.
#[test]
fn even_panes_light_exactly() {
    if moves_corners() {
        return;
    }
    for floor in [cloth(), gloss()] {
        let window = panes(floor);
        let (case, stage) = (window.case(), window.panes());
        let (table, edits) = (SheenTable::embedded(), Edits::default());
        let truth = Truth::new(&stage, &table, &edits, SIZE);
        let picture = without_shadows(&case);
        differences(&picture, &truth).unwrap_or_else(|what| panic!("{what}"));
        assert!(pictured(&case, SIZE, centred(1, 3)) == picture);
    }
}

/// 12 x 9 texels, no two alike.
fn uneven(floor: Material) -> Window {
    let level = |at: u32, step: u32| (at * step % 97) as f32 / 97.0;
    Window::new([12, 9], floor, |x, y| {
        [61, 29, 43].map(|step| (4.0 * level(x * 7 + y * 211 + x * y, step)).exp2() - 1.0)
    })
}

/// What no closed form has: without samples it is nearly right, with many of them the more so.
#[test]
fn uneven_windows_converge_to_their_texels() {
    for floor in [cloth(), gloss()] {
        let window = uneven(floor);
        let (case, expected) = (window.case(), window.expected());
        let errors = |picture: LinearImage| errors(&picture, &expected);
        let plain = errors(without_shadows(&case));
        let [some, many] = [16, 1024].map(|samples| errors(pictured(&case, SIZE, centred(samples, 2))));
        println!("without shadows {plain:?}, 16 samples {some:?}, 1024 {many:?}");
        assert!(plain[0] < 0.08 && plain[0] > 2.0 * many[0], "{plain:?} {some:?} {many:?}");
        assert!(many[0] < 0.02 && many[1].abs() < 1e-3, "{plain:?} {some:?} {many:?}");
        // To a slope of -0.45 at least.
        assert!(many[0] < some[0] * 64.0_f64.powf(-0.45), "{plain:?} {some:?} {many:?}");
    }
}

/// A light that is moved takes its pattern along: the floor is lit as it was under the window that stood there at first.
#[test]
fn patterns_move_with_their_lights() {
    let window = uneven(cloth());
    let shift = Vec3::new(0.2, 0.3, -0.1);
    let mut case = window.case();
    let moved = LightEdits { position: Some(case.scene.lights[0].position() + shift), ..LightEdits::default() };
    case.edits.lights = [(0, moved)].into();
    let found = pictured(&case, SIZE, centred(4, 1));
    let mut there = window.case();
    let mesh = there.scene.instances.len() - 1;
    there.scene.instances[mesh].world_from_mesh =
        Mat4::from_translation(shift) * there.scene.instances[mesh].world_from_mesh;
    let light = &mut there.scene.lights[0].polygons[0];
    light.contours.iter_mut().flatten().for_each(|vertex| *vertex += shift);
    light.pattern.as_mut().unwrap().origin += shift;
    let expected = pictured(&there, SIZE, centred(4, 1));
    for (found, expected) in found.pixels.as_flattened().iter().zip(expected.pixels.as_flattened()) {
        assert!((found - expected).abs() < 1e-3 * expected + 1e-5, "{found}, not {expected}");
    }
}

/// Sheens that are summed over points on the light have the light's factor at each of them.
#[test]
fn prior_sheens_see_the_texels() {
    for (window, limit) in [(panes(cloth()), 0.005), (uneven(cloth()), 0.05)] {
        let mut case = window.case();
        let every_material = MaterialEdits { sheen_model: Some(SheenModel::ContyKulla), ..MaterialEdits::default() };
        case.edits.every_material = every_material;
        let panes = Case { name: "panes", scene: window.panes().scene(), edits: case.edits.clone() };
        let expected: Vec<DVec3> =
            without_shadows(&panes).pixels.iter().map(|pixel| Vec3::from(*pixel).as_dvec3()).collect();
        let [off, more] = errors(&pictured(&case, SIZE, centred(64, 1)), &expected);
        assert!(off < limit && more.abs() < 0.005, "{off} {more}");
    }
}

/// The mean of what is shown of few samples, filtered, is that of what is shown of many: nothing is cut off on the way.
#[test]
fn filtered_pictures_are_as_bright_as_others() {
    let case = uneven(cloth()).case();
    let shown = |samples: u32| {
        let effort = centred(samples, 5);
        let mut offscreen = offscreen(&case, true, effort);
        let (camera, settings) = (&case.scene.cameras[0], case.edits.settings());
        let picture = GPU.block_on(offscreen.display(&GPU, camera, SIZE, &settings)).unwrap();
        picture.pixels.as_flattened().iter().map(|&value| f64::from(linear_from_srgb(value))).sum::<f64>()
    };
    let [few, many] = [shown(1), shown(256)];
    assert!((few / many - 1.0).abs() < 0.02, "{few} {many}");
}

/// What is lit by a window in the shape of an L, from the side to which it shines and from behind one that shines both ways.
#[test]
fn windows_of_any_outline_show_their_texels() {
    let mut window = uneven(cloth());
    let is_out = |at: u32| at % 12 >= 6 && at / 12 >= 5;
    (0..108).filter(|&at| is_out(at)).for_each(|at| window.texels[at as usize] = Vec3::ZERO);
    let expected = window.expected();
    let mut case = window.case();
    let [x, y] = HALF;
    let step = y * (10.0 / 9.0 - 1.0);
    let corners = [[-x, -y], [x, -y], [x, step], [0.0, step], [0.0, y], [-x, y]];
    let polygon = &mut case.scene.lights[0].polygons[0];
    let mean = window.texels.iter().sum::<Vec3>() / 108.0;
    polygon.contours = vec![corners.map(|[x, y]: [f32; 2]| place().transform_point3(Vec3::new(x, y, 0.0))).to_vec()];
    assert!(case.scene.lights[0].radiance.abs_diff_eq(mean, 1e-5));
    let [off, more] = errors(&pictured(&case, SIZE, centred(1024, 1)), &expected);
    assert!(off < 0.06 && more.abs() < 4e-3, "{off} {more}");
    // Turned about, it shines to the other side as well.
    let light = &mut case.scene.lights[0];
    light.two_sided = true;
    light.polygons[0].contours[0].reverse();
    light.polygons[0].normal *= -1.0;
    let behind = errors(&pictured(&case, SIZE, centred(1024, 1)), &expected);
    assert!(behind[0] < 0.06 && behind[1].abs() < 4e-3, "{behind:?}");
}
