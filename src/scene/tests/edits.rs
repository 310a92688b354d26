//! What edits make of a scene.

use std::collections::BTreeMap;

use glam::{Mat4, Vec3};

use crate::picture::Exposure;

use super::shapes::{grid, scene};
use crate::scene::notices::Notices;
use crate::scene::{
    Drawn, Edits, Layering, LightEdits, Material, MaterialEdits, RoughnessMap, Scene, Sheen, SheenModel, TextureSlot,
    TextureUse, lights,
};

fn of(sheens: &[Option<Sheen>]) -> Scene {
    let materials = sheens.iter().map(|&sheen| Material { sheen, ..Material::matte("felt", Vec3::ONE) });
    Scene { materials: materials.collect(), ..Scene::default() }
}

fn every(every_material: MaterialEdits) -> Edits {
    Edits { every_material, ..Edits::default() }
}

fn one(index: usize, edits: MaterialEdits) -> Edits {
    Edits { materials: BTreeMap::from([(index, edits)]), ..Edits::default() }
}

fn given(alpha: Option<f32>, sheen_color: Option<Vec3>) -> MaterialEdits {
    MaterialEdits { alpha, sheen_color, ..MaterialEdits::default() }
}

fn sheens(scene: &Scene, edits: &Edits) -> Vec<Option<Sheen>> {
    Drawn::new(scene, edits).materials.iter().map(|material| material.sheen).collect()
}

#[test]
fn a_given_alpha_or_colour_makes_the_sheen() {
    let red = Sheen::new(Vec3::X, 0.25);
    let black = Sheen::new(Vec3::ZERO, 0.25);
    for (alpha, color, own, expected) in [
        (None, None, Some(red), Some(red)),
        (None, None, Some(black), None),
        (None, None, None, None),
        (Some(0.75), None, Some(red), Some(Sheen { roughness: 0.75, ..red })),
        (Some(0.0), None, Some(red), Some(Sheen { roughness: 0.0, ..red })),
        (None, Some(Vec3::Y), Some(red), Some(Sheen { color: Vec3::Y, ..red })),
        (Some(0.75), None, None, Some(Sheen::new(Vec3::ONE, 0.75))),
        (Some(0.75), None, Some(black), Some(Sheen::new(Vec3::ONE, 0.75))),
        (None, Some(Vec3::Y), None, Some(Sheen::new(Vec3::Y, 0.5))),
        (None, Some(Vec3::ZERO), Some(red), Some(Sheen::new(Vec3::ZERO, 0.25))),
    ] {
        for edits in [every(given(alpha, color)), one(0, given(alpha, color))] {
            assert_eq!(sheens(&of(&[own]), &edits), [expected], "{alpha:?} {color:?} {own:?}");
        }
    }
}

#[test]
fn edits_of_all_are_for_those_with_a_sheen_unless_none_has_one() {
    let red = Sheen::new(Vec3::X, 0.25);
    let rough = |sheen: Sheen| Some(Sheen { roughness: 0.7, ..sheen });
    let alpha = every(given(Some(0.7), None));
    assert_eq!(sheens(&of(&[None, Some(red), None]), &alpha), [None, rough(red), None]);
    let white = Sheen::new(Vec3::ONE, 0.7);
    assert_eq!(sheens(&of(&[None, None]), &alpha), [Some(white); 2]);
    // What the file has decides: a sheen that one is given takes none from the others.
    let both = alpha.then(&one(0, given(None, Some(Vec3::Y))));
    assert_eq!(sheens(&of(&[None, None]), &both), [rough(Sheen::new(Vec3::Y, 0.5)), Some(white)]);
    assert_eq!(sheens(&of(&[None, Some(red), None]), &both), [rough(Sheen::new(Vec3::Y, 0.5)), rough(red), None]);
    // Rules are no sheens.
    let rules = MaterialEdits { layering: Some(Layering::None), ..MaterialEdits::default() };
    assert_eq!(sheens(&of(&[None]), &every(rules)), [None]);
}

#[test]
fn alpha_is_alpha_whatever_the_roughness_map() {
    let felt = Sheen { roughness_map: RoughnessMap::Sqrt, ..Sheen::new(Vec3::X, 0.25) };
    let scene = of(&[Some(felt)]);
    let alpha = |alpha, roughness_map| {
        let edits = every(MaterialEdits { alpha, roughness_map, ..MaterialEdits::default() });
        sheens(&scene, &edits)[0].unwrap().alpha()
    };
    assert_eq!(alpha(None, None), 0.5);
    for (map, expected) in [(RoughnessMap::Identity, 0.25), (RoughnessMap::Square, 0.0625), (RoughnessMap::Sqrt, 0.5)] {
        assert_eq!(alpha(None, Some(map)), expected, "{map:?}");
        assert_eq!(alpha(Some(0.3), Some(map)), 0.3, "{map:?}");
    }
}

#[test]
fn what_is_given_stands_whatever_the_material_has_there() {
    let mut scene = of(&[Some(Sheen { weight: 0.5, ..Sheen::new(Vec3::X, 0.3) })]);
    let texture = TextureUse { texture: 0, tex_coord: 0, uv_from_tex_coord: Default::default() };
    scene.materials[0].textures = [Some(texture); TextureSlot::COUNT];
    for (alpha, color) in [(None, None), (Some(0.7), None), (None, Some(Vec3::Y)), (Some(0.7), Some(Vec3::Y))] {
        let drawn = Drawn::new(&scene, &every(given(alpha, color)));
        // A given colour covers all of the surface; textures of what is given do not count, and no others are lost.
        assert_eq!(drawn.materials[0].sheen.unwrap().weight, if color.is_some() { 1.0 } else { 0.5 });
        for slot in TextureSlot::ALL {
            let is_replaced = match slot {
                TextureSlot::SheenColor | TextureSlot::SheenWeight => color.is_some(),
                TextureSlot::SheenRoughness => alpha.is_some(),
                _ => false,
            };
            assert_eq!(drawn.materials[0].texture(slot).is_none(), is_replaced, "{slot:?} {alpha:?} {color:?}");
        }
    }
}

#[test]
fn a_sheen_goes_off_and_comes_back_as_it_was() {
    let red = Sheen { weight: 0.5, ..Sheen::new(Vec3::X, 0.25) };
    let switched = |sheen, edits| MaterialEdits { sheen: Some(sheen), ..edits };
    for edits in [given(None, None), given(Some(0.7), None), given(None, Some(Vec3::Y))] {
        for own in [Some(red), None] {
            let scene = of(&[own]);
            assert_eq!(sheens(&scene, &one(0, switched(false, edits))), [None], "{edits:?}");
            let on = sheens(&scene, &one(0, switched(true, edits)));
            let added = Some(Sheen::new(Vec3::ONE, 0.5)).filter(|_| own.is_none() && !edits.gives_sheen());
            assert_eq!(on[0], added.or(sheens(&scene, &one(0, edits))[0]), "{edits:?}");
        }
    }
    // Of all materials off is for all, on for those that have one, unless none has.
    let all = |sheen| every(switched(sheen, MaterialEdits::default()));
    assert_eq!(sheens(&of(&[None, Some(red)]), &all(false)), [None; 2]);
    assert_eq!(sheens(&of(&[None, Some(red)]), &all(true)), [None, Some(red)]);
    assert_eq!(sheens(&of(&[None, None]), &all(true)), [Some(Sheen::new(Vec3::ONE, 0.5)); 2]);
}

#[test]
fn a_weight_scales_what_is_there_and_stands_beside_a_colour() {
    let weighted = |weight, edits| MaterialEdits { sheen_weight: Some(weight), ..edits };
    let red = Sheen { weight: 0.5, ..Sheen::new(Vec3::X, 0.25) };
    let mut scene = of(&[Some(red)]);
    let texture = TextureUse { texture: 0, tex_coord: 0, uv_from_tex_coord: Default::default() };
    scene.materials[0].textures = [Some(texture); TextureSlot::COUNT];
    // 0 stays a sheen, so that it can be turned up again.
    for weight in [0.0, 0.25, 1.0] {
        let drawn = Drawn::new(&scene, &one(0, weighted(weight, given(None, None))));
        assert_eq!(drawn.materials[0].sheen, Some(Sheen { weight, ..red }));
        let lost = TextureSlot::ALL.into_iter().filter(|&slot| drawn.materials[0].texture(slot).is_none());
        assert_eq!(lost.collect::<Vec<_>>(), [TextureSlot::SheenWeight]);
        let colored = sheens(&scene, &one(0, weighted(weight, given(None, Some(Vec3::Y)))));
        assert_eq!(colored, [Some(Sheen { weight, color: Vec3::Y, ..red })]);
    }
    let added = sheens(&of(&[None]), &one(0, weighted(0.25, given(None, None))));
    assert_eq!(added, [Some(Sheen { weight: 0.25, ..Sheen::new(Vec3::ONE, 0.5) })]);
}

#[test]
fn black_fibres_count_where_they_hide_the_base() {
    let fuzz = Sheen { weight: 0.5, ..Sheen::new(Vec3::ZERO, 0.3) };
    assert_eq!(sheens(&of(&[Some(fuzz)]), &Edits::default()), [None]);
    let openpbr = every(MaterialEdits { layering: Some(Layering::OpenPbr), ..MaterialEdits::default() });
    let hiding = Sheen { layering: Layering::OpenPbr, ..fuzz };
    assert_eq!(sheens(&of(&[Some(fuzz)]), &openpbr), [Some(hiding)]);
    // Another alpha leaves it black, and as thin as it was.
    let smoother = openpbr.clone().then(&every(given(Some(0.1), None)));
    assert_eq!(sheens(&of(&[Some(fuzz)]), &smoother), [Some(Sheen { roughness: 0.1, ..hiding })]);
    assert_eq!(sheens(&of(&[Some(Sheen { weight: 0.0, ..fuzz })]), &openpbr), [None]);
}

#[test]
fn later_edits_win_and_those_of_one_material_go_before_those_of_all() {
    let all = MaterialEdits { alpha: Some(0.1), layering: Some(Layering::None), ..MaterialEdits::default() };
    let edits = every(all).then(&one(1, given(Some(0.9), None)));
    let own = |edits: &Edits| [0, 1, 2].map(|index| edits.of_material(index));
    assert_eq!(own(&edits), [all, MaterialEdits { alpha: Some(0.9), ..all }, all]);
    // What is said later of all is said of that one, too; and nothing else of it is lost.
    let model = MaterialEdits { sheen_model: Some(SheenModel::Burley), ..given(Some(0.9), Some(Vec3::Y)) };
    let later = one(1, model).then(&every(given(Some(0.4), None)));
    assert_eq!(later.of_material(1), MaterialEdits { alpha: Some(0.4), ..model });
    assert_eq!(later.of_material(0), given(Some(0.4), None));
    // A material that has got its sheen by its alpha keeps it.
    assert_eq!(later.materials[&1].alpha, Some(0.4));
    let base = Edits { exposure: Some(1.0.into()), lights_visible: Some(false), ..Edits::default() };
    let merged = base.clone().then(&Edits { exposure: Some(Exposure::Auto), ..Edits::default() });
    assert_eq!(merged, Edits { exposure: Some(Exposure::Auto), ..base.clone() });
    assert_eq!(base.clone().then(&Edits::default()), base);
    assert_eq!(Edits::default().then(&base), base);
}

#[test]
fn lights_move_with_their_emitters_and_the_loaded_scene_stays() {
    let mut scene = scene(grid(1, |_, _| true, |_, _| 0.0), Mat4::IDENTITY);
    scene.materials[0].emission = Vec3::new(4.0, 2.0, 1.0);
    lights::add_lights(&mut scene, 0, &mut Notices::default());
    let place = scene.lights[0].position();
    let offset = Vec3::new(1.0, 2.0, -3.0);
    let light = |edits: LightEdits| Edits { lights: BTreeMap::from([(0, edits)]), ..Edits::default() };
    let moved = light(LightEdits { position: Some(place + offset), ..LightEdits::default() });
    let drawn = Drawn::new(&scene, &moved);
    assert_eq!(drawn.lights[0].position(), place + offset);
    assert_eq!(drawn.instances[0].world_from_mesh, Mat4::from_translation(offset));
    assert_eq!((scene.lights[0].position(), scene.instances[0].world_from_mesh), (place, Mat4::IDENTITY));
    // A place that is the light's own moves nothing, not even by a rounding.
    let unmoved = light(LightEdits { position: Some(place), ..LightEdits::default() });
    assert!(matches!(Drawn::new(&scene, &unmoved).instances, std::borrow::Cow::Borrowed(_)));
    for (radiance, strength, expected) in [
        (None, None, Vec3::new(4.0, 2.0, 1.0)),
        (None, Some(0.5), Vec3::new(2.0, 1.0, 0.5)),
        (Some(Vec3::X), None, Vec3::X),
        (Some(Vec3::X), Some(0.0), Vec3::ZERO),
        (Some(Vec3::MAX), Some(2.0), Vec3::MAX),
    ] {
        let drawn = light(LightEdits { radiance, strength, ..LightEdits::default() });
        let drawn = Drawn::new(&scene, &drawn);
        assert_eq!((drawn.lights[0].radiance, drawn.emission(0)), (expected, expected));
    }
}

#[test]
fn the_base_is_changed_under_its_textures() {
    let mut scene = of(&[None, None]);
    let texture = TextureUse { texture: 0, tex_coord: 0, uv_from_tex_coord: Default::default() };
    scene.materials[1].textures[TextureSlot::BaseColor as usize] = Some(texture);
    let (base_color, metallic, roughness) = (Some(Vec3::Y), Some(0.25), Some(0.75));
    let edits = MaterialEdits { base_color, metallic, roughness, ..MaterialEdits::default() };
    let drawn = Drawn::new(&scene, &one(1, edits));
    let expected = Material { base_color: Vec3::Y, metallic: 0.25, roughness: 0.75, ..scene.materials[1].clone() };
    assert_eq!(drawn.materials, [scene.materials[0].clone(), expected]);
}
