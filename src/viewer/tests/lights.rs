//! Lights in the panel and in the hand.

use super::super::lamps::LightId;
use super::super::lens::Lens;
use super::*;
use crate::scene::{LightEdits, LightShape, PunctualKind, PunctualLight, PunctualShape, black_body};
use glam::Quat;

const KEY: LightId = LightId::Area(0);

/// A triangle in the plane z = 0 below the eye, and a square light beside it, which shines down on it.
fn lit() -> Scene {
    let mut scene = scene(1.0);
    let place = Mat4::from_rotation_translation(Quat::from_rotation_x(std::f32::consts::PI), Vec3::new(0.1, 0.05, 0.1));
    let corners = [[-0.04, -0.04], [0.04, -0.04], [0.04, 0.04], [-0.04, 0.04]].map(|[x, y]| Vec3::new(x, y, 0.0));
    scene.meshes.push(Mesh { positions: corners.to_vec(), indices: vec![0, 1, 2, 0, 2, 3], ..Mesh::default() });
    scene.instances[1] = Instance { name: "key".into(), mesh: 1, world_from_mesh: place };
    let contour = corners.map(|corner| place.transform_point3(corner)).to_vec();
    scene.lights[0].polygons = vec![Polygon { contours: vec![contour], normal: Vec3::NEG_Z, pattern: None }];
    scene
}

fn window() -> Window {
    let mut window = Window::new(lit());
    window.state.choose(KEY);
    window.rest(3);
    window
}

fn lens(window: &Window) -> Lens {
    Lens::new(window.state.camera(), window.layout.picture)
}

fn place(window: &Window) -> Vec3 {
    window.state.placing(KEY).position
}

/// Types a text with the light in the hand.
fn type_text(window: &mut Window, text: &str) {
    for character in text.chars() {
        window.pass(vec![Event::Text(character.to_string())]);
    }
}

fn drag_light(window: &mut Window, from: Pos2, to: Pos2) {
    window.drag(PointerButton::Primary, from, to);
    window.rest(2);
    assert_eq!(window.state.hands.grab, None);
}

/// By the menu, each kind; each is one step that can be undone.
#[test]
fn lights_are_added_by_the_menu() {
    use PunctualShape::{Directional, Point, Spot};
    let mut window = Window::of_size(lit(), vec2(1280.0, 4000.0));
    let names = ["rectangle", "disk", "triangle", "pentagon", "point", "spot", "sun", "polygon"];
    for name in names {
        window.wait(1.0);
        let menu = window.place(Role::Button, "Add light").center();
        window.click(menu);
        window.rest(3);
        let entry = window.place(Role::Button, name).center();
        window.click(entry);
        // The panel scrolls to its section.
        window.rest(40);
    }
    let edits = &window.state.edits;
    let shapes = edits.added_lights.iter().map(|light| light.shape).collect::<Vec<_>>();
    let polygon = LightShape::Polygon;
    assert_eq!(shapes, [LightShape::Rectangle, LightShape::Disk, polygon(3), polygon(5), polygon(6)]);
    assert_eq!(edits.added_punctual.iter().map(|light| light.shape).collect::<Vec<_>>(), [Point, Spot, Directional]);
    // Each shines at what is seen.
    let drawn = window.state.drawn();
    let middle = window.state.foreground().center();
    for light in &drawn.lights[1..] {
        let to_middle = (middle - light.position()).normalize();
        assert!(light.polygons[0].normal.dot(to_middle) > 0.999, "{}", light.name);
    }
    for light in drawn.punctual_lights.iter().filter(|light| !matches!(light.kind, PunctualKind::Point { .. })) {
        assert!(light.direction.dot((middle - Vec3::Z).normalize()) > -1.0 && light.intensity.max_element() > 0.0);
    }
    drop(drawn);
    for left in (0..names.len()).rev() {
        window.state.undo();
        let edits = &window.state.edits;
        assert_eq!(edits.added_lights.len() + edits.added_punctual.len(), left);
    }
}

#[test]
fn a_light_is_dragged_by_its_handles() {
    let mut window = window();
    let (before, lens) = (place(&window), lens(&window));
    let metres = lens.metres_a_point(before);
    let middle = lens.project(before).unwrap();
    // In the view's plane.
    drag_light(&mut window, middle, middle + vec2(40.0, -20.0));
    let expected = before + metres * Vec3::new(40.0, 20.0, 0.0);
    assert!(place(&window).distance(expected) < 1e-4, "{} {expected}", place(&window));
    window.state.undo();
    assert!(place(&window) == before && window.state.edits.lights.is_empty());
    // Along y by its arrow, whatever the pointer does across it.
    window.rest(2);
    let tip = middle - vec2(0.0, 52.0);
    drag_light(&mut window, tip, tip + vec2(25.0, -30.0));
    let moved = place(&window) - before;
    assert!(moved.x == 0.0 && moved.z == 0.0 && (moved.y - 30.0 * metres).abs() < 0.02 * moved.y, "{moved}");
    window.state.undo();
    window.rest(2);
    // A corner drawn to twice as far in x and half as far in y from the middle.
    let corner = lens.project(before + Vec3::new(0.04, 0.04, 0.0)).unwrap();
    drag_light(&mut window, corner, middle + (corner - middle) * vec2(2.0, 0.5));
    let size = window.state.placing(KEY).size.unwrap();
    let mut sides = size.to_array();
    sides.sort_by(f32::total_cmp);
    assert!((sides[0] - 0.04).abs() < 1e-3 && (sides[1] - 0.16).abs() < 1e-3, "{size}");
    let extent = window.state.drawn().lights[0].polygons[0].contours[0]
        .iter()
        .fold(Vec3::ZERO, |most, vertex| most.max((*vertex - before).abs()));
    assert!((extent.x - 0.08).abs() < 5e-4 && (extent.y - 0.02).abs() < 5e-4, "{extent}");
    // None of it turned the view, or showed another material.
    assert_eq!(window.state.edits.camera, None);
}

#[test]
fn the_arrow_of_a_light_follows_the_pointer() {
    let mut window = window();
    // From the side the arrow is seen in full.
    window.press(Key::Num3);
    window.rest(2);
    let (before, lens) = (place(&window), lens(&window));
    let middle = lens.project(before).unwrap();
    let tip = middle + 70.0 * (lens.project(before + 0.01 * Vec3::NEG_Z).unwrap() - middle).normalized();
    drag_light(&mut window, tip, middle - vec2(0.0, 70.0));
    let normal = window.state.placing(KEY).normal();
    assert!(normal.dot(Vec3::Y) > 0.99, "{normal}");
    assert!(place(&window) == before && window.state.drawn().lights[0].polygons[0].normal.dot(normal) > 0.9999);
}

#[test]
fn keys_take_a_light_in_the_hand() {
    let mut window = window();
    let before = place(&window);
    window.pass(vec![Event::PointerMoved(pos2(300.0, 300.0))]);
    // By a number along an axis.
    window.press(Key::G);
    type_text(&mut window, "z-0.25");
    window.press(Key::Enter);
    assert!(place(&window).distance(before - 0.25 * Vec3::Z) < 1e-6);
    window.press(Key::R);
    type_text(&mut window, "x90");
    window.press(Key::Enter);
    assert!(window.state.placing(KEY).normal().distance(Vec3::Y) < 1e-5, "{}", window.state.placing(KEY).normal());
    window.press(Key::S);
    type_text(&mut window, "1,5");
    window.press(Key::Enter);
    assert!((window.state.placing(KEY).size.unwrap() - 0.12).abs().max_element() < 1e-5);
    // What is typed wrong is taken back; one step each.
    window.press(Key::G);
    type_text(&mut window, "y7");
    window.press(Key::Backspace);
    type_text(&mut window, "2");
    window.press(Key::Enter);
    assert!((place(&window).y - before.y - 2.0).abs() < 1e-5);
    for _ in 0..4 {
        assert!(window.state.can_undo());
        window.state.undo();
    }
    assert!(window.state.edits.lights.is_empty() && !window.state.can_undo());
}

#[test]
fn a_light_in_the_hand_follows_the_pointer_until_it_is_put_down() {
    let mut window = window();
    let (before, lens) = (place(&window), lens(&window));
    let at = pos2(300.0, 300.0);
    for ends_by in [Key::Escape, Key::Enter, Key::G] {
        window.state.choose(KEY);
        window.pass(vec![Event::PointerMoved(at)]);
        window.press(Key::G);
        assert_eq!(place(&window), before);
        window.pass(vec![Event::PointerMoved(at + vec2(50.0, 0.0))]);
        window.rest(1);
        let moved = before + 50.0 * lens.metres_a_point(before) * Vec3::X;
        assert!(place(&window).distance(moved) < 1e-5);
        // Nothing is kept before it is over.
        assert!(!window.state.can_undo());
        match ends_by {
            Key::G => _ = window.click(at + vec2(50.0, 0.0)),
            key => _ = window.press(key),
        }
        window.rest(2);
        assert_eq!(window.state.hands.grab, None);
        assert_eq!(window.state.can_undo(), ends_by != Key::Escape, "{ends_by:?}");
        // The click that puts it down is no click on what is there.
        assert_eq!((window.state.chosen_light, window.state.edits.camera), (Some(KEY), None));
        if ends_by != Key::Escape {
            window.state.undo();
        }
        assert_eq!(place(&window), before);
        window.state.hands.revealed = None;
    }
    // A right click puts it back.
    window.press(Key::G);
    window.pass(vec![Event::PointerMoved(at)]);
    window.drag(PointerButton::Secondary, at, at);
    window.rest(2);
    assert!(place(&window) == before && window.state.hands.grab.is_none());
}

/// The eye sees the light's middle in a mirror at the point: by the law of reflection.
#[test]
fn a_drag_with_l_puts_the_reflection_below_the_pointer() {
    let mut window = window();
    let (before, lens) = (place(&window), lens(&window));
    let surface = Vec3::new(0.25, 0.3, 0.0);
    let to = lens.project(surface).unwrap();
    window.pass(vec![Event::PointerMoved(to + vec2(-60.0, 20.0))]);
    window.pass(vec![window.key(Key::L, true)]);
    window.drag(PointerButton::Primary, to + vec2(-60.0, 20.0), to);
    window.pass(vec![window.key(Key::L, false)]);
    window.rest(2);
    let placing = window.state.placing(KEY);
    let [to_eye, to_light] = [window.eye() - surface, placing.position - surface].map(Vec3::normalize);
    // A mirror whose normal is +z turns x and y around.
    let mirrored = Vec3::new(-to_eye.x, -to_eye.y, to_eye.z);
    assert!(to_light.distance(mirrored) < 1e-3, "{to_light} {mirrored}");
    assert!(placing.normal().distance(-mirrored) < 1e-3 && placing.position != before);
    assert_eq!(window.state.edits.camera, None);
    window.state.undo();
    assert!(place(&window) == before && !window.state.can_undo());
}

#[test]
fn lights_are_chosen_where_they_are_seen() {
    let mut window = window();
    window.state.chosen_light = None;
    // The light shines down: from below its face is seen.
    window.state.edits.camera = Some(crate::scene::CameraEdit::Orbit(crate::scene::Orbit {
        target: Vec3::new(0.1, 0.05, 0.1),
        elevation: 0.2,
        azimuth: std::f32::consts::PI,
        ..window.state.orbit()
    }));
    window.rest(2);
    let at = lens(&window).project(place(&window)).unwrap();
    window.click(at);
    window.rest(2);
    assert_eq!(window.state.chosen_light, Some(KEY));
    window.wait(2.0);
    window.click(pos2(30.0, 30.0));
    assert_eq!(window.state.chosen_light, None);
}

#[test]
fn switches_mute_lights_and_show_some_alone() {
    let mut window = window();
    window.state.duplicate_light(KEY);
    window.rest(3);
    let lit = |window: &Window| {
        window.state.drawn().lights.iter().map(|light| light.radiance != Vec3::ZERO).collect::<Vec<_>>()
    };
    let press = |window: &mut Window, text: &str, which: usize| {
        window.wait(1.0);
        let says = |node: &&Node| node.role() == Role::Button && node.label() == Some(text);
        let mut places: Vec<Rect> = window.nodes.iter().filter(says).filter_map(super::place).collect();
        places.sort_by(|one, other| one.min.y.total_cmp(&other.min.y));
        window.click(places[which].center());
        window.rest(2);
    };
    press(&mut window, "M", 0);
    assert_eq!(lit(&window), [false, true]);
    press(&mut window, "S", 0);
    assert_eq!(lit(&window), [false, false]);
    press(&mut window, "M", 0);
    assert_eq!(lit(&window), [true, false]);
    press(&mut window, "S", 0);
    assert_eq!(lit(&window), [true, true]);
    assert!(window.state.edits.lights.is_empty());
}

#[test]
fn power_temperature_and_places_are_typed_key_by_key() {
    let mut window = Window::new(lit());
    let number = |window: &mut Window, row: &str, index: usize, text: &str| {
        let place = window.in_row(row, Role::SpinButton)[index];
        window.type_into(place, text);
        window.wait(1.0);
    };
    let radiance = |window: &Window| window.state.drawn().lights[0].radiance;
    // pi times an area of .0064 m^2.
    number(&mut window, "power", 0, "12.5");
    let expected = 12.5 / (0.0064 * std::f32::consts::PI);
    assert!((radiance(&window) / expected).distance(Vec3::new(1.0, 0.5, 0.25)) < 1e-4, "{}", radiance(&window));
    // It stays, however large the light is.
    number(&mut window, "size", 0, "0.16");
    assert!((radiance(&window).x / expected - 0.5).abs() < 1e-4);
    number(&mut window, "radiance", 0, "7");
    assert_eq!(radiance(&window), 7.0 * Vec3::new(1.0, 0.5, 0.25));
    let switch = window.in_row("temperature", Role::CheckBox)[0];
    window.click(switch.center());
    window.rest(2);
    number(&mut window, "temperature", 0, "2700");
    assert!(radiance(&window).distance(7.0 * black_body::color(2700.0)) < 1e-5);
    number(&mut window, "direction", 1, "-30");
    number(&mut window, "direction", 0, "90");
    let normal = window.state.drawn().lights[0].polygons[0].normal;
    assert!(normal.distance(Vec3::new(0.75f32.sqrt(), -0.5, 0.0)) < 1e-4, "{normal}");
    let both = window.place(Role::Button, "both").center();
    window.click(both);
    assert!(window.state.drawn().lights[0].two_sided);
}

#[test]
fn the_studio_comes_and_goes() {
    let mut window = window();
    let at = window.place(Role::CheckBox, "studio rig").center();
    window.click(at);
    window.rest(3);
    assert!(window.state.has_rig() && window.state.edits.added_lights.len() == 3);
    window.wait(1.0);
    let at = window.place(Role::CheckBox, "studio rig").center();
    window.click(at);
    window.rest(3);
    assert!(!window.state.has_rig() && window.state.edits.added_lights.is_empty());
    // Those that a scene was loaded with are taken away, and come back.
    let mut loaded = lit();
    loaded.rig = 0..1;
    let mut window = Window::new(loaded);
    assert!(window.state.has_rig());
    window.state.set_rig(false);
    assert!(!window.state.has_rig() && window.state.drawn().lights[0].radiance == Vec3::ZERO);
    window.state.set_rig(true);
    assert!(window.state.has_rig() && window.state.edits == Edits::default());
}

/// Lights without extent have what they need, and no more.
#[test]
fn lights_without_extent_have_their_own_rows() {
    let bulb = |kind| PunctualLight {
        name: "bulb".into(),
        kind,
        intensity: Vec3::ONE,
        position: Vec3::ONE,
        direction: Vec3::NEG_Y,
    };
    let range = f32::INFINITY;
    for (kind, rows) in [
        (PunctualKind::Point { range }, vec!["intensity", "power", "position"]),
        (
            PunctualKind::Spot { range, inner: 0.1, outer: 0.5 },
            vec!["intensity", "power", "position", "direction", "cone"],
        ),
        (PunctualKind::Directional, vec!["irradiance", "direction"]),
    ] {
        let mut scene = lit();
        scene.lights.clear();
        scene.punctual_lights = vec![bulb(kind)];
        let mut window = Window::new(scene);
        let labels: Vec<String> =
            window.nodes.iter().filter_map(|node| node.value().or(node.label()).map(str::to_owned)).collect();
        for row in ["intensity", "irradiance", "power", "position", "direction", "cone"] {
            assert_eq!(labels.iter().any(|label| label == row), rows.contains(&row), "{kind:?}: {row}");
        }
        window.state.choose(LightId::Punctual(0));
        window.rest(2);
        window.press(Key::R);
        type_text(&mut window, "x90");
        window.press(Key::Enter);
        let direction = window.state.drawn().punctual_lights[0].direction;
        let is_turned = direction.distance(Vec3::NEG_Z) < 1e-5;
        assert_eq!(is_turned, !matches!(kind, PunctualKind::Point { .. }), "{kind:?}: {direction}");
    }
}

#[test]
fn what_is_searched_is_shown_alone() {
    let mut many = lit();
    many.lights = vec![many.lights[0].clone(); 1000];
    (many.lights[700].name, many.lights[701].name) = ("Window".into(), "window 2".into());
    let mut window = Window::new(many);
    window.rest(2);
    let count = |window: &Window| window.nodes.iter().filter(|node| node.label() == Some("S")).count();
    assert!((2..200).contains(&count(&window)), "{}", count(&window));
    let place = window.places(Role::TextInput)[0];
    window.type_into(place, "WINDOW");
    window.rest(2);
    assert_eq!(count(&window), 2);
    let header = window.place(Role::DisclosureTriangle, "window 2 (702)");
    window.click(header.center());
    window.rest(20);
    assert_eq!(window.state.chosen_light, Some(LightId::Area(701)));
    window.press(Key::Delete);
    window.rest(2);
    assert_eq!(window.state.edits.lights[&701], LightEdits { removed: Some(true), ..LightEdits::default() });
    assert_eq!(count(&window), 1);
}
