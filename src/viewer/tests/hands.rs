//! What presses and drags in the picture do.

use super::*;

#[test]
fn dragging_turns_or_pans_and_the_wheel_zooms() {
    let mut window = Window::new(scene(1.0));
    let (from, to) = (pos2(300.0, 300.0), pos2(400.0, 320.0));
    let camera = |window: &Window| window.state.orbit().camera().world_from_camera;
    let start = camera(&window);
    assert_eq!(window.drag(PointerButton::Primary, from, to), Change::Drawn);
    let turned = camera(&window);
    assert!(!turned.z_axis.abs_diff_eq(start.z_axis, 0.1));
    assert_eq!(window.drag(PointerButton::Secondary, from, to), Change::Drawn);
    let panned = camera(&window);
    assert!(panned.z_axis.abs_diff_eq(turned.z_axis, 1e-6) && !panned.w_axis.abs_diff_eq(turned.w_axis, 0.01));
    let wheel = Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        delta: vec2(0.0, 3.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    };
    let changes = (0..20).map(|k| if k == 0 { vec![wheel.clone()] } else { vec![] });
    assert_eq!(changes.map(|events| window.pass(events)).max(), Some(Change::Drawn));
    assert!(!camera(&window).w_axis.abs_diff_eq(panned.w_axis, 0.01));
}

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
