//! Where panel and picture are placed, and what dragging in the picture does.

use egui::{PointerButton, Rect, Sense, Ui};
use glam::Vec2;

use super::panel;
use super::state::{Change, State};

/// The outcome of a pass over the user interface.
pub struct Layout {
    /// Where the picture is, in points.
    pub picture: Rect,
    pub change: Change,
    pub screenshot: bool,
}

impl Default for Layout {
    fn default() -> Self {
        Self { picture: Rect::ZERO, change: Change::None, screenshot: false }
    }
}

/// Lays out the window's content and applies what the user does to `state`.
pub fn show(ui: &mut Ui, state: &mut State) -> Layout {
    let panel = egui::Panel::right("panel").exact_size(panel::WIDTH).resizable(false);
    let outcome = panel.show(ui, |ui| panel::show(ui, state)).inner;
    let picture = ui.available_rect_before_wrap();
    let change = outcome.change.max(navigate(ui, picture, state));
    Layout { picture, change, screenshot: outcome.screenshot }
}

fn navigate(ui: &mut Ui, picture: Rect, state: &mut State) -> Change {
    let response = ui.interact(picture, ui.scope_id().with("picture"), Sense::drag());
    let delta = response.drag_delta();
    let drag = Vec2::new(delta.x, delta.y) / picture.height().max(1.0);
    let (shift, scroll, pinch) =
        ui.input(|input| (input.modifiers.shift, input.smooth_scroll_delta(), input.zoom_delta()));
    let before = state.orbit.clone();
    if drag != Vec2::ZERO {
        if response.dragged_by(PointerButton::Primary) && !shift {
            state.orbit.turn(drag);
        } else {
            state.orbit.pan(drag);
        }
    }
    if response.hovered() {
        // A notch of a wheel is about 50 points.
        state.orbit.zoom((0.004 * scroll.y).clamp(-5.0, 5.0).exp() * pinch.clamp(0.1, 10.0));
    }
    if state.orbit == before { Change::None } else { Change::Drawn }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Camera, Instance, Layering, Material, Mesh, Overrides, Projection, Scene, Sheen};
    use egui::{Event, Modifiers, Pos2, RawInput, ViewportId, pos2, vec2};
    use glam::{Mat4, Vec3};

    fn state() -> State {
        let velvet = Material { sheen: Some(Sheen::new(Vec3::ONE, 0.3)), ..Material::matte("velvet", Vec3::ZERO) };
        let triangle = Mesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], ..Mesh::default() };
        let camera = Camera {
            name: "camera".into(),
            world_from_camera: Mat4::from_translation(Vec3::Z),
            projection: Projection::Perspective { yfov: 0.7, near: 0.1, far: f32::INFINITY },
        };
        let scene = Scene {
            meshes: vec![triangle],
            instances: vec![Instance { name: "cloth".into(), mesh: 0, world_from_mesh: Mat4::IDENTITY }],
            materials: vec![velvet],
            cameras: vec![camera],
            ..Scene::default()
        };
        State::new("test.glb", scene)
    }

    /// The outcome of a pass after these events, and after how many seconds egui wants the next one.
    fn pass(context: &egui::Context, state: &mut State, events: Vec<Event>) -> (Layout, f64) {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 720.0)));
        let input = RawInput { screen_rect, events, ..RawInput::default() };
        let mut layout = Layout::default();
        let output = context.run_ui(input, |ui| layout = show(ui, state));
        let delay = output.viewport_output[&ViewportId::ROOT].repaint_delay.as_secs_f64();
        output.drop_without_applying_deltas();
        (layout, delay)
    }

    fn press(pos: Pos2, button: PointerButton, pressed: bool) -> Event {
        Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }
    }

    /// The changes that a drag brings about, pass by pass.
    fn drag(context: &egui::Context, state: &mut State, button: PointerButton, from: Pos2, to: Pos2) -> Change {
        let passes = [
            vec![Event::PointerMoved(from)],
            vec![press(from, button, true)],
            vec![Event::PointerMoved(to)],
            vec![press(to, button, false)],
        ];
        passes.into_iter().map(|events| pass(context, state, events).0.change).max().unwrap()
    }

    /// A state in which the panel shows everything it can show of materials; both materials have the same name.
    fn full_state() -> State {
        let mut state = state();
        state.scene.materials.push(state.scene.materials[0].clone());
        let manual = Overrides { layering: Some(Layering::Manual(0.3)), ..Overrides::default() };
        state.settings.material_overrides.insert(0, manual);
        state.settings.ambient = Vec3::new(0.1, 0.2, 0.3);
        state
    }

    #[test]
    fn rests_while_nothing_happens() {
        rests(state());
        rests(full_state());
    }

    fn rests(mut state: State) {
        let (context, before) = (egui::Context::default(), state.settings.clone());
        for _ in 0..10 {
            pass(&context, &mut state, vec![]);
        }
        let (layout, delay) = pass(&context, &mut state, vec![]);
        assert_eq!(layout.change, Change::None);
        assert!(delay > 3600.0, "the next pass is wanted in {delay} s");
        assert_eq!(state.settings, before);
    }

    #[test]
    fn the_panel_leaves_the_picture_free() {
        let (layout, _) = pass(&egui::Context::default(), &mut state(), vec![]);
        assert!(layout.picture.min == Pos2::ZERO && layout.picture.width() > 950.0 && layout.picture.height() == 720.0);
    }

    #[test]
    fn dragging_turns_or_pans_and_the_wheel_zooms() {
        let (context, mut state) = (egui::Context::default(), state());
        let (from, to) = (pos2(300.0, 300.0), pos2(400.0, 320.0));
        let start = state.orbit.camera().world_from_camera;
        assert_eq!(drag(&context, &mut state, PointerButton::Primary, from, to), Change::Drawn);
        let turned = state.orbit.camera().world_from_camera;
        assert!(!turned.z_axis.abs_diff_eq(start.z_axis, 0.1));
        assert_eq!(drag(&context, &mut state, PointerButton::Secondary, from, to), Change::Drawn);
        let panned = state.orbit.camera().world_from_camera;
        assert!(panned.z_axis.abs_diff_eq(turned.z_axis, 1e-6) && !panned.w_axis.abs_diff_eq(turned.w_axis, 0.01));
        let wheel = Event::MouseWheel {
            unit: egui::MouseWheelUnit::Line,
            delta: vec2(0.0, 3.0),
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Wheel,
            modifiers: Modifiers::NONE,
        };
        let change = (0..20).map(|k| if k == 0 { vec![wheel.clone()] } else { vec![] });
        assert_eq!(change.map(|events| pass(&context, &mut state, events).0.change).max(), Some(Change::Drawn));
        assert!(!state.orbit.camera().world_from_camera.w_axis.abs_diff_eq(panned.w_axis, 0.01));
    }

    #[test]
    fn dragging_the_slider_makes_dust_of_fuzz_and_reset_takes_it_back() {
        let (context, mut state) = (egui::Context::default(), state());
        pass(&context, &mut state, vec![]);
        // The slider's row is found by trying: the panel's layout is egui's business.
        let roughness = |state: &State| state.scene.materials[0].sheen.map(|sheen| sheen.roughness);
        let rows = (0..200).step_by(4).map(|y| y as f32);
        let changed = rows.filter(|&y| {
            let before = roughness(&state);
            let change = drag(&context, &mut state, PointerButton::Primary, pos2(1140.0, y), pos2(1220.0, y));
            roughness(&state) != before && change == Change::Scene
        });
        assert!(changed.count() > 0);
        assert!(roughness(&state) > Some(0.6), "{:?}", roughness(&state));
        state.reset();
        assert_eq!(roughness(&state), Some(0.3));
    }

    #[test]
    fn what_is_set_for_a_material_is_for_it_alone() {
        let (context, mut state) = (egui::Context::default(), full_state());
        let (before, scene) = (state.settings.clone(), state.scene.materials.clone());
        pass(&context, &mut state, vec![]);
        let mut changes = Vec::new();
        for y in (0..400).step_by(4).map(|y| y as f32) {
            let last = state.settings.clone();
            let change = drag(&context, &mut state, PointerButton::Primary, pos2(1120.0, y), pos2(1150.0, y));
            if state.settings.layering_of(0) != last.layering_of(0) {
                changes.push(change);
            }
            if state.settings.ambient != last.ambient {
                assert_eq!(change, Change::Drawn);
                changes.push(change);
            }
        }
        assert!(changes.contains(&Change::Scene) && changes.contains(&Change::Drawn), "{changes:?}");
        assert!(matches!(state.settings.layering_of(0), Layering::Manual(share) if share != 0.3));
        assert_eq!(state.settings.overrides_of(1), before.overrides_of(1));
        assert_eq!(state.scene.materials[1], scene[1]);
        // The light keeps its hue.
        let hue = state.settings.ambient / state.settings.ambient.max_element();
        assert!(hue.abs_diff_eq(before.ambient / 0.3, 1e-4), "{hue}");
        state.reset();
        assert_eq!((state.settings.material_overrides.len(), state.settings.ambient), (0, Vec3::ZERO));
    }
}
