//! What presses and drags in the picture do.

use super::*;

/// On the triangle, in a window of 1280 by 1400 points.
const ON: Pos2 = pos2(620.0, 620.0);
/// Beside it.
const BESIDE: Pos2 = pos2(300.0, 300.0);

fn camera(window: &Window) -> Mat4 {
    window.state.orbit().camera().world_from_camera
}

fn wheel(notches: f32) -> Event {
    Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        delta: vec2(0.0, notches),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    }
}

/// Turns the wheel over a point, and waits until nothing moves any more.
fn roll(window: &mut Window, at: Pos2, notches: f32) {
    window.pass(vec![Event::PointerMoved(at)]);
    window.pass(vec![wheel(notches)]);
    while window.pass(vec![]) > Change::None {}
}

/// The scene seen without perspective.
fn orthographic() -> Scene {
    let mut scene = scene(1.0);
    scene.cameras[0].projection = Projection::Orthographic { ymag: 0.4, near: 0.01, far: 10.0 };
    scene
}

/// Where a point of the world is in the picture, in points, by the camera's definition.
fn seen(window: &Window, point: Vec3) -> Pos2 {
    let (camera, picture) = (window.state.camera(), window.layout.picture);
    let p_camera = camera.world_from_camera.inverse().transform_point3(point);
    let half = match camera.projection {
        Projection::Perspective { yfov, .. } => -p_camera.z * (0.5 * yfov).tan(),
        Projection::Orthographic { ymag, .. } => ymag,
    };
    let points = 0.5 * picture.height() / half;
    picture.center() + vec2(p_camera.x, -p_camera.y) * points
}

/// The point of the triangle's plane, z = 0, that is seen at a point of the picture.
fn on_plane(window: &Window, at: Pos2) -> Vec3 {
    // The camera looks down at first: x and y of the picture are those of the plane.
    let scale = seen(window, Vec3::ZERO) - seen(window, Vec3::new(-1.0, 1.0, 0.0));
    let from = (at - seen(window, Vec3::ZERO)) / scale;
    Vec3::new(from.x, -from.y, 0.0)
}

#[test]
fn dragging_turns_pans_and_zooms() {
    let to = BESIDE + vec2(100.0, 20.0);
    for (button, modifiers, expected) in [
        (PointerButton::Primary, Modifiers::NONE, "turn"),
        (PointerButton::Primary, Modifiers::SHIFT, "pan"),
        (PointerButton::Middle, Modifiers::NONE, "pan"),
        (PointerButton::Secondary, Modifiers::NONE, "pan"),
        (PointerButton::Middle, Modifiers::CTRL | Modifiers::COMMAND, "zoom"),
        (PointerButton::Secondary, Modifiers::ALT, "zoom"),
    ] {
        let mut window = Window::new(scene(1.0));
        let (start, distance) = (camera(&window), window.state.orbit().distance);
        window.modifiers = modifiers;
        assert_eq!(window.drag(button, BESIDE, to), Change::Drawn);
        let (after, nearer) = (camera(&window), window.state.orbit().distance != distance);
        let (turns, moves) = (!after.z_axis.abs_diff_eq(start.z_axis, 1e-5), after.w_axis != start.w_axis);
        let found = match (turns, moves, nearer) {
            (true, _, false) => "turn",
            (false, true, false) => "pan",
            (false, true, true) => "zoom",
            _ => "nothing",
        };
        assert_eq!(found, expected, "{button:?} with {modifiers:?}");
        assert_eq!((window.state.outlined, window.state.clicked_bounds()), (None, None));
    }
}

#[test]
fn what_is_grabbed_follows_the_pointer() {
    for mut window in [Window::new(scene(1.0)), Window::new(orthographic())] {
        window.drag(PointerButton::Primary, BESIDE, BESIDE + vec2(30.0, 12.0));
        // The target is not where the triangle is.
        window.press(Key::F);
        let corner = Vec3::new(0.3, 0.2, 0.0);
        let from = seen(&window, corner);
        window.drag(PointerButton::Secondary, from, from + vec2(90.0, -70.0));
        let off = seen(&window, corner) - (from + vec2(90.0, -70.0));
        assert!(off.length() < 1.0, "{off}");
    }
}

#[test]
fn what_the_wheel_zooms_to_stays_under_the_pointer() {
    for at in [ON, BESIDE] {
        for scene in [scene(1.0), orthographic()] {
            let mut window = Window::new(scene);
            let (point, start) = (on_plane(&window, at), camera(&window));
            for notches in [1.0, 3.0, 10.0, -2.0, -20.0] {
                roll(&mut window, at, notches);
                let off = seen(&window, point) - at;
                assert!(off.length() < 1.0, "{off} after {notches} at {at}");
                assert!(!camera(&window).w_axis.abs_diff_eq(start.w_axis, 1e-4));
            }
            roll(&mut window, at, 8.0);
            assert!(camera(&window).w_axis.abs_diff_eq(start.w_axis, 1e-4), "{}", camera(&window).w_axis);
        }
    }
}

#[test]
fn zooming_is_never_stuck() {
    for at in [ON, BESIDE] {
        let mut window = Window::new(scene(1.0));
        window.pass(vec![Event::PointerMoved(at)]);
        for notch in 0..200 {
            let before = window.eye();
            // As much as a notch; a wheel's comes in many small parts.
            window.pass(vec![Event::Zoom(1.22)]);
            let moved = window.eye().distance(before);
            assert!(moved > 5e-6, "{moved} m with notch {notch} at {at}");
        }
        assert!(window.state.orbit().camera().world_from_camera.is_finite());
    }
}

#[test]
fn a_pinch_zooms_to_where_it_is() {
    let mut window = Window::new(scene(1.0));
    let point = on_plane(&window, ON);
    let start = window.eye();
    window.pass(vec![Event::PointerMoved(ON)]);
    assert_eq!(window.pass(vec![Event::Zoom(1.5)]), Change::Drawn);
    let (before, after) = (start.distance(point), window.eye().distance(point));
    assert!((before / after - 1.5).abs() < 1e-4 && (seen(&window, point) - ON).length() < 1.0);
}

/// Two triangles side by side of different materials.
fn pair() -> Scene {
    let mut scene = scene(1.0);
    scene.materials.push(Material::matte("stone", Vec3::ONE));
    let mirrored = Vec3::new(-1.0, 1.0, 1.0);
    scene.meshes.push(Mesh { material: 1, ..scene.meshes[0].clone() });
    scene.instances.push(Instance { name: "stone".into(), mesh: 1, world_from_mesh: Mat4::from_scale(mirrored) });
    scene
}

#[test]
fn a_click_picks_the_material_and_outlines_it_for_a_moment() {
    let mut window = Window::new(pair());
    let left = pos2(400.0, 620.0);
    assert_eq!(window.click(left), Change::Shown);
    assert_eq!((window.state.material, window.state.outlined), (1, Some(1)));
    // A pass is wanted when it ends, and none before.
    while window.delay < 0.1 {
        window.pass(vec![]);
    }
    assert!(window.delay < 0.8, "{}", window.delay);
    assert_eq!(window.pass(vec![]), Change::None);
    let changes: Vec<Change> = (0..60).map(|_| window.pass(vec![])).collect();
    assert_eq!(window.state.outlined, None);
    assert_eq!(changes.iter().filter(|change| **change == Change::Shown).count(), 1);
    assert!(window.delay > 3600.0);
    // The other one, and nothing.
    assert_eq!(window.click(ON), Change::Shown);
    assert_eq!((window.state.material, window.state.outlined), (0, Some(0)));
    assert_eq!(window.click(pos2(5.0, 1390.0)), Change::Shown);
    assert_eq!((window.state.material, window.state.outlined), (0, None));
    assert_eq!(window.state.edits, Edits::default());
}

#[test]
fn a_double_click_centres_on_what_is_there() {
    for mut window in [Window::new(scene(1.0)), Window::new(orthographic())] {
        let point = on_plane(&window, ON);
        let before = window.state.orbit();
        window.click(ON);
        assert_eq!(window.state.edits.camera, None);
        assert_eq!(window.click(ON), Change::Drawn);
        let orbit = window.state.orbit();
        assert!(
            orbit.target.distance(point) < 1e-3
                && (seen(&window, point) - window.layout.picture.center()).length() < 1.0
        );
        assert!(orbit.distance <= before.distance && orbit.azimuth == before.azimuth);
    }
}

/// Wherever in the picture it is, and however the view has been turned.
#[test]
fn what_is_double_clicked_is_in_the_middle_afterwards() {
    use super::super::pick::{Picked, Ray, pick};
    let drape = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/drape.glb");
    let scene = crate::scene::gltf::load(drape.as_ref(), &crate::scene::gltf::Options::default()).unwrap();
    let picked = |window: &Window, at: Pos2| -> Option<Picked> {
        let picture = window.layout.picture;
        let share = (at - picture.min) / picture.size();
        let ray = Ray::new(&window.state.camera(), picture.aspect_ratio(), glam::Vec2::new(share.x, share.y));
        pick(&window.state.drawn(), &ray)
    };
    for projection in [scene.cameras[0].projection, Projection::Orthographic { ymag: 1.5, near: 0.01, far: 100.0 }] {
        for (right, down) in [(0.3, 0.2), (0.45, 0.5), (0.6, 0.8), (0.1, 0.9)] {
            let mut turned = scene.clone();
            turned.cameras[0].projection = projection;
            let mut window = Window::of_size(turned, vec2(1280.0, 720.0));
            window.drag(PointerButton::Primary, pos2(300.0, 300.0), pos2(360.0, 330.0));
            window.wait(2.0);
            let picture = window.layout.picture;
            let at = picture.min + picture.size() * vec2(right, down);
            let before = picked(&window, at).unwrap();
            let off = seen(&window, before.point) - at;
            assert!(off.length() < 1.0, "{off} before, at {at}");
            window.click(at);
            assert_eq!(window.click(at), Change::Drawn);
            let off = seen(&window, before.point) - picture.center();
            assert!(off.length() < 1.0, "{off} after a double-click at {at}, {projection:?}");
            // The other way round: what a ray through the middle meets. A pixel of it may be much of what is seen askance.
            let after = picked(&window, picture.center()).unwrap();
            let off = seen(&window, after.point) - seen(&window, before.point);
            assert!(off.length() < 1.0 && after.instance == before.instance, "{off}, {after:?} for {before:?}");
        }
    }
}

#[test]
fn f_frames_what_was_clicked_or_all() {
    let mut window = Window::new(pair());
    let bounds = |window: &Window, from: Vec3, to: Vec3| {
        let place = Rect::from_two_pos(seen(window, from), seen(window, to));
        let (room, picture) = (place.size() / window.layout.picture.size(), window.layout.picture);
        assert!(picture.contains_rect(place) && room.max_elem() > 0.7, "{place} in {picture}");
        assert!((place.center() - picture.center()).length() < 1.0);
    };
    assert_eq!(window.press(Key::F), Change::Drawn);
    bounds(&window, Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 0.0));
    let right = seen(&window, Vec3::new(0.2, 0.2, 0.0));
    window.click(right);
    window.press(Key::F);
    bounds(&window, Vec3::ZERO, Vec3::new(1.0, 1.0, 0.0));
    // A click beside everything lets go of it.
    window.click(pos2(5.0, 5.0));
    window.press(Key::F);
    bounds(&window, Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 0.0));
}

/// The default scene stands on the sweep of a studio, in which the camera stands, too.
#[test]
fn f_frames_what_stands_before_a_backdrop() {
    let drape = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/drape.glb");
    let scene = crate::scene::gltf::load(drape.as_ref(), &crate::scene::gltf::Options::default()).unwrap();
    let cloth = scene.instances.iter().find(|instance| instance.name == "cloth").unwrap().clone();
    let bounds = Bounds::of_points(&scene.meshes[cloth.mesh].positions).transformed(cloth.world_from_mesh);
    let mut window = Window::of_size(scene, vec2(1280.0, 720.0));
    for from in [Key::Home, Key::Num3] {
        window.press(from);
        window.press(Key::F);
        let corners = bounds.corners().map(|corner| seen(&window, corner));
        let (place, picture) = (Rect::from_points(&corners), window.layout.picture);
        let filled = place.height() / picture.height();
        assert!(picture.contains_rect(place) && filled > 0.7, "{place} in {picture}: {filled} of its height");
        assert!((place.center() - picture.center()).length() < 0.1 * picture.height(), "{place} in {picture}");
    }
    // What was clicked is framed, even if it is the backdrop.
    window.press(Key::Home);
    window.click(pos2(20.0, 20.0));
    assert!(window.state.clicked_bounds().is_some());
    window.press(Key::F);
    assert!(window.state.orbit().distance > 10.0);
}

/// Seen from the front it would be a line without a width.
#[test]
fn f_frames_a_floor_so_that_it_is_seen() {
    let mut floor = scene(1.0);
    let lying = Mat4::from_rotation_x(-0.5 * std::f32::consts::PI);
    floor.instances.iter_mut().for_each(|instance| instance.world_from_mesh = lying);
    let mut window = Window::new(floor);
    window.press(Key::Num1);
    window.press(Key::F);
    let [origin, right, far] =
        [Vec3::ZERO, Vec3::X, Vec3::NEG_Z].map(|corner| seen(&window, corner) - window.layout.picture.center());
    let picture = window.layout.picture.size();
    assert!([origin, right, far].iter().all(|at| at.x.abs() < 0.5 * picture.x && at.y.abs() < 0.5 * picture.y));
    assert!((right - origin).x > 0.7 * picture.x && (origin - far).y > 0.03 * picture.y, "{origin} {right} {far}");
    assert_eq!(window.state.orbit().azimuth, 0.0);
    // From above it is seen as it is.
    window.press(Key::Num7);
    let before = window.state.orbit();
    window.press(Key::F);
    let after = window.state.orbit();
    assert!((after.elevation - before.elevation).abs() < 1e-6 && after.azimuth == before.azimuth);
}

/// A scene of one point has no size to go by.
#[test]
fn a_scene_without_extent_leaves_the_view_sound() {
    for at in [Vec3::ZERO, Vec3::new(3.0, 1.0, -2.0)] {
        let mut point = scene(1.0);
        point.meshes[0].positions = vec![at; 3];
        point.lights.clear();
        let mut window = Window::new(point);
        for key in [Key::F, Key::Num1, Key::F, Key::Num7, Key::F, Key::ArrowUp] {
            window.press(key);
            roll(&mut window, BESIDE, 1.0);
            roll(&mut window, BESIDE, -2.0);
            let (camera, orbit) = (camera(&window), window.state.orbit());
            assert!(camera.is_finite() && orbit.target.is_finite(), "{key:?}: {orbit:?}");
            // Squares of such distances are still numbers.
            assert!(orbit.distance > 1e-17, "{key:?}: {orbit:?}");
            let inverse = camera.inverse();
            assert!(inverse.is_finite() && inverse.transform_point3(at).z < 0.0, "{key:?}: {orbit:?}");
        }
    }
}

#[test]
fn the_view_turns_about_what_is_in_its_middle() {
    // A cloth in front of a wall that is far larger.
    let mut scene = pair();
    scene.cameras[0].world_from_camera.w_axis += Vec3::splat(0.2).extend(0.0);
    scene.instances[2].world_from_mesh =
        Mat4::from_translation(Vec3::new(-50.0, -50.0, -20.0)) * Mat4::from_scale(Vec3::splat(200.0));
    let target = |scene: &Scene| Window::new(scene.clone()).state.orbit().target;
    assert!(target(&scene).abs_diff_eq(Vec3::new(0.2, 0.2, 0.0), 1e-5));
    // From within the box of what is seen, about the place where it is seen.
    scene.instances.truncate(2);
    scene.meshes[0].positions.push(Vec3::new(5.0, 5.0, 5.0));
    scene.meshes[0].positions.push(Vec3::new(-5.0, -5.0, -5.0));
    assert!(target(&scene).abs_diff_eq(Vec3::new(0.2, 0.2, 0.0), 1e-5));
}

/// The window shows the scene through its camera, as `velour render` does, until it is turned.
#[test]
fn a_camera_that_leans_is_shown_as_it_is() {
    let mut scene = scene(1.0);
    scene.cameras[0].world_from_camera *= Mat4::from_rotation_z(0.4);
    let loaded = scene.cameras[0].clone();
    let mut window = Window::new(scene);
    let shown = window.state.camera();
    assert_eq!((shown.world_from_camera, shown.projection), (loaded.world_from_camera, loaded.projection));
    assert_eq!(window.state.edits, Edits::default());
    window.drag(PointerButton::Primary, pos2(300.0, 300.0), pos2(400.0, 320.0));
    assert_eq!(window.state.camera().world_from_camera, window.state.orbit().camera().world_from_camera);
}
