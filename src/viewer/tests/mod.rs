//! The user interface without a window: what presses, drags and keys make of the edits.

mod comparing;
mod controls;
mod files;
mod flight;
mod hands;
mod keyboard;
mod lights;
mod opening;
mod panel;
mod picking_colors;
mod saving;
mod sections;
mod undoing;

use egui::accesskit::{Node, Role};
use egui::{Event, Key, LayerId, Modifiers, Order, PointerButton, Pos2, RawInput, Rect, Vec2, ViewportId, pos2, vec2};
use glam::{Mat4, Vec3};

use super::change::Change;
use super::layout::{self, Layout};
use super::request::Request;
use super::state::State;
use crate::scene::{
    AlphaMode, Bounds, Camera, Edits, Instance, Layering, Light, Material, MaterialEdits, Mesh, Polygon, Projection,
    Scene, Sheen, TextureSlot, TextureUse,
};

/// The user interface of a state, and what it was laid out as last.
struct Window {
    context: egui::Context,
    state: State,
    nodes: Vec<Node>,
    layout: Layout,
    /// In points.
    size: Vec2,
    /// Those that are held.
    modifiers: Modifiers,
    /// Between two passes, seconds.
    pace: f64,
    /// After how many seconds egui wants the next pass.
    delay: f64,
    /// Of the last pass, in seconds.
    time: f64,
}

/// Between two passes at first, in seconds.
const PACE: f64 = 1.0 / 60.0;

impl Window {
    /// High enough for all of the panel.
    fn new(scene: Scene) -> Self {
        Self::of_size(scene, vec2(1280.0, 1400.0))
    }

    fn of_size(scene: Scene, size: egui::Vec2) -> Self {
        let context = egui::Context::default();
        context.enable_accesskit();
        super::theme::apply(&context);
        let state = State::new("test.glb", scene, Edits::default());
        let (modifiers, layout) = (Modifiers::NONE, Layout::default());
        let (pace, delay, time) = (PACE, 0.0, 0.0);
        let mut window = Self { context, state, nodes: vec![], layout, size, modifiers, pace, delay, time };
        // egui finds the sizes of things by laying them out.
        for _ in 0..3 {
            window.pass(vec![]);
        }
        window
    }

    /// A pass after these events; what it changes.
    fn pass(&mut self, mut events: Vec<Event>) -> Change {
        if self.context.input(|input| input.modifiers) != self.modifiers {
            events.insert(0, Event::ModifiersChanged(self.modifiers));
        }
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, self.size));
        self.time += self.pace;
        let (time, predicted_dt) = (Some(self.time), self.pace as f32);
        let input = RawInput { screen_rect, events, predicted_dt, time, ..RawInput::default() };
        let mut shown = Layout::default();
        let mut output = self.context.run_ui(input, |ui| shown = layout::show(ui, &mut self.state));
        self.delay = output.viewport_output[&ViewportId::ROOT].repaint_delay.as_secs_f64();
        if let Some(update) = output.platform_output.accesskit_update.take() {
            self.nodes = update.nodes.into_iter().map(|(_, node)| node).collect();
        }
        output.drop_without_applying_deltas();
        self.layout = shown;
        self.layout.change
    }

    /// So many passes in which nothing happens.
    fn rest(&mut self, passes: usize) {
        for _ in 0..passes {
            self.pass(vec![]);
        }
    }

    /// The greatest change that a drag brings about.
    fn drag(&mut self, button: PointerButton, from: Pos2, to: Pos2) -> Change {
        let modifiers = self.modifiers;
        let press = |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers };
        let passes = [
            vec![Event::PointerMoved(from)],
            vec![press(from, true)],
            vec![Event::PointerMoved(to)],
            vec![press(to, false)],
        ];
        passes.into_iter().map(|events| self.pass(events)).max().unwrap()
    }

    /// Passes for so many seconds in which nothing happens.
    fn wait(&mut self, seconds: f64) {
        self.time += seconds;
        self.pass(vec![]);
    }

    fn click(&mut self, at: Pos2) -> Change {
        self.drag(PointerButton::Primary, at, at)
    }

    /// Places of the widgets of a role, from the top, each row from the left.
    fn places(&self, role: Role) -> Vec<Rect> {
        let of_role = self.nodes.iter().filter(|node| node.role() == role);
        let mut places: Vec<Rect> = of_role.filter_map(place).collect();
        places.sort_by(|left, right| (left.min.y, left.min.x).partial_cmp(&(right.min.y, right.min.x)).unwrap());
        places
    }

    /// Where a widget of this role and text is.
    fn place(&self, role: Role, text: &str) -> Rect {
        let says = |node: &&Node| node.label().or(node.value()) == Some(text);
        let found = self.nodes.iter().filter(|node| node.role() == role).find(says);
        found.and_then(place).unwrap_or_else(|| panic!("no {role:?} says {text}"))
    }

    /// Where widgets of a role are in the row of a label.
    fn in_row(&self, label: &str, role: Role) -> Vec<Rect> {
        let row = self.place(Role::Label, label).y_range();
        let places = self.places(role).into_iter();
        places.filter(|place| row.contains(place.center().y)).collect()
    }

    /// Where the widgets of a role are in the row below that of a label.
    fn below(&self, label: &str, role: Role) -> Vec<Rect> {
        let bottom = self.place(Role::Label, label).max.y;
        let places = self.places(role).into_iter();
        places.filter(|place| (bottom..bottom + place.height() + 8.0).contains(&place.center().y)).collect()
    }

    /// What the tooltip says that comes up where the pointer rests on a place.
    fn hover_text(&mut self, at: Pos2) -> Option<String> {
        self.context.all_styles_mut(|style| {
            style.interaction.tooltip_delay = 0.0;
            style.interaction.show_tooltips_only_when_still = false;
        });
        let texts = |window: &Self| -> Vec<String> {
            let labels = window.nodes.iter().filter(|node| node.role() == Role::Label);
            labels.filter_map(|node| node.value().or(node.label()).map(str::to_owned)).collect()
        };
        // The tooltip of the last place goes first, and none comes up right after a click.
        self.pass(vec![Event::PointerMoved(pos2(300.0, 700.0))]);
        self.wait(1.0);
        let before = texts(self);
        self.pass(vec![Event::PointerMoved(at)]);
        self.rest(4);
        let is_shown = self.context.memory(|memory| {
            let layers: Vec<LayerId> = memory.areas().visible_layer_ids().into_iter().collect();
            layers.iter().any(|layer| layer.order == Order::Tooltip)
        });
        let found = texts(self).into_iter().find(|text| !before.contains(text));
        is_shown.then_some(found).flatten()
    }

    /// Clicks on a box and types into it, key by key, with a pass or two after each; leaves the box by Enter.
    fn type_into(&mut self, place: Rect, text: &str) {
        self.click(place.center());
        for character in text.chars() {
            self.pass(vec![Event::Text(character.to_string())]);
            self.pass(vec![]);
        }
        self.press(Key::Enter);
    }

    fn key(&self, key: Key, pressed: bool) -> Event {
        Event::Key { key, physical_key: None, pressed, repeat: false, modifiers: self.modifiers }
    }

    /// Presses and releases a key; what that changes.
    fn press(&mut self, key: Key) -> Change {
        let change = self.pass(vec![self.key(key, true)]);
        change.max(self.pass(vec![self.key(key, false)]))
    }

    /// The request of a key that is pressed and released.
    fn request(&mut self, key: Key) -> Option<Request> {
        self.pass(vec![self.key(key, true)]);
        let request = self.layout.request.clone();
        self.pass(vec![self.key(key, false)]);
        request
    }

    /// The camera's place.
    fn eye(&self) -> Vec3 {
        self.state.camera().world_from_camera.w_axis.truncate()
    }
}

fn place(node: &Node) -> Option<Rect> {
    let bounds = node.bounds()?;
    Some(Rect::from_min_max(pos2(bounds.x0 as f32, bounds.y0 as f32), pos2(bounds.x1 as f32, bounds.y1 as f32)))
}

/// A velvet triangle of this size in metres, under one light.
pub(super) fn scene(size: f32) -> Scene {
    let corners = vec![Vec3::ZERO, size * Vec3::X, size * Vec3::Y];
    let instance = |name: &str| Instance { name: name.into(), mesh: 0, world_from_mesh: Mat4::IDENTITY };
    let light = Light {
        name: "key".into(),
        radiance: Vec3::new(4.0, 2.0, 1.0),
        two_sided: false,
        polygons: vec![Polygon { contours: vec![corners.clone()], normal: Vec3::Z, pattern: None }],
        instance: 1,
        ..Light::default()
    };
    let camera = Camera {
        name: "camera".into(),
        world_from_camera: Mat4::from_translation(size * Vec3::Z),
        projection: Projection::Perspective { yfov: 0.7, near: 0.1 * size, far: f32::INFINITY },
    };
    Scene {
        meshes: vec![Mesh { positions: corners, indices: vec![0, 1, 2], ..Mesh::default() }],
        instances: vec![instance("cloth"), instance("key")],
        materials: vec![Material { sheen: Some(Sheen::new(Vec3::ONE, 0.3)), ..Material::matte("velvet", Vec3::ZERO) }],
        lights: vec![light],
        cameras: vec![camera],
        ..Scene::default()
    }
}

/// A window in which the panel shows everything it can show of materials; both materials have the same name.
fn full() -> Window {
    let mut scene = scene(1.0);
    scene.materials.push(scene.materials[0].clone());
    let mut window = Window::new(scene);
    let manual = MaterialEdits { layering: Some(Layering::Manual(0.3)), ..MaterialEdits::default() };
    window.state.edits.materials.insert(0, manual);
    window.state.edits.ambient = Some(Vec3::new(0.1, 0.2, 0.3));
    window.pass(vec![]);
    window
}
