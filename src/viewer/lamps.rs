//! Lights of all kinds as the hands and the panel have them: by one name, in one place.

use glam::{Quat, Vec2, Vec3};

use super::state::State;
use crate::scene::{LightEdits, PunctualEdits, PunctualKind};

/// A light of the scene, or one that is added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LightId {
    /// Index into `Drawn::lights`.
    Area(usize),
    /// Index into `Drawn::punctual_lights`.
    Punctual(usize),
}

/// What is changed in a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Changes {
    Area(LightEdits),
    Punctual(PunctualEdits),
}

/// Where a light stands, and what can be done about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placing {
    /// Metres; of a light from infinitely far away: where its direction is shown.
    pub position: Vec3,
    /// Turns the light's own axes into the world's; it shines along z.
    pub rotation: Quat,
    /// Along its own x and y, metres; none without extent.
    pub size: Option<Vec2>,
    /// Whether both are changed each for itself.
    pub is_flat: bool,
    pub can_move: bool,
    pub can_turn: bool,
}

impl Placing {
    /// The direction in which it shines, unit.
    pub fn normal(&self) -> Vec3 {
        self.rotation * Vec3::Z
    }
}

impl State {
    /// All lights that have not been taken away: those with an area first.
    pub fn lights(&self) -> impl Iterator<Item = LightId> {
        let area = (0..self.edits.light_count(&self.scene)).map(LightId::Area);
        let punctual = (0..self.edits.punctual_count(&self.scene)).map(LightId::Punctual);
        area.chain(punctual).filter(|id| !self.is_removed(*id))
    }

    /// Whether a light is there no more: taken away, or undone.
    pub fn is_removed(&self, id: LightId) -> bool {
        match id {
            LightId::Area(index) if index >= self.edits.light_count(&self.scene) => true,
            LightId::Punctual(index) if index >= self.edits.punctual_count(&self.scene) => true,
            _ => match self.changes(id) {
                Changes::Area(own) => own.removed == Some(true),
                Changes::Punctual(own) => own.removed == Some(true),
            },
        }
    }

    /// The light that is chosen, if it is still there.
    pub fn chosen(&self) -> Option<LightId> {
        self.chosen_light.filter(|id| !self.is_removed(*id))
    }

    /// Chooses a light, and shows its section in the panel.
    pub fn choose(&mut self, id: LightId) {
        self.chosen_light = Some(id);
        self.reveal_chosen();
    }

    /// Has the panel show the section of the light that is chosen.
    pub fn reveal_chosen(&mut self) {
        self.hands.revealed = self.chosen_light;
    }

    /// Whether the panel is to show a light's section.
    pub fn reveals(&self, id: LightId) -> bool {
        self.hands.revealed == Some(id)
    }

    /// What users call a light; may be empty.
    pub fn light_name(&self, id: LightId) -> &str {
        let (scene, edits) = (&self.scene, &self.edits);
        match id {
            LightId::Area(index) => match index.checked_sub(scene.lights.len()) {
                Some(added) => &edits.added_lights[added].name,
                None => &scene.lights[index].name,
            },
            LightId::Punctual(index) => match index.checked_sub(scene.punctual_lights.len()) {
                Some(added) => &edits.added_punctual[added].name,
                None => &scene.punctual_lights[index].name,
            },
        }
    }

    pub fn changes(&self, id: LightId) -> Changes {
        match id {
            LightId::Area(index) => Changes::Area(self.edits.of_light(&self.scene, index)),
            LightId::Punctual(index) => Changes::Punctual(self.edits.of_punctual(&self.scene, index)),
        }
    }

    /// Changes a light: these are all its changes from now on.
    pub fn set_changes(&mut self, id: LightId, changes: Changes) {
        match (id, changes) {
            (LightId::Area(index), Changes::Area(own)) => self.edits.set_light(&self.scene, index, own),
            (LightId::Punctual(index), Changes::Punctual(own)) => self.edits.set_punctual(&self.scene, index, own),
            _ => unreachable!("changes are of their light's kind"),
        }
    }

    /// Where a light stands.
    pub fn placing(&self, id: LightId) -> Placing {
        match id {
            LightId::Area(index) => {
                let own = self.edits.of_light(&self.scene, index);
                let frame = self.scene.base_frame(&self.edits, index).with(own.position, own.rotation, own.size);
                Placing {
                    position: frame.position,
                    rotation: frame.rotation,
                    size: Some(frame.size),
                    is_flat: frame.is_flat,
                    can_move: true,
                    can_turn: true,
                }
            }
            LightId::Punctual(index) => {
                let own = self.edits.of_punctual(&self.scene, index);
                let light = own.applied(&self.scene.base_punctual(&self.edits, index));
                let is_far = light.kind == PunctualKind::Directional;
                Placing {
                    position: if is_far { self.foreground().center() } else { light.position },
                    rotation: Quat::from_rotation_arc(Vec3::Z, light.direction),
                    size: None,
                    is_flat: false,
                    can_move: !is_far,
                    can_turn: !matches!(light.kind, PunctualKind::Point { .. }),
                }
            }
        }
    }

    /// Moves a light to a place, metres.
    pub fn move_light(&mut self, id: LightId, to: Vec3) {
        let to = to.clamp(Vec3::splat(-crate::scene::FARTHEST), Vec3::splat(crate::scene::FARTHEST));
        let changes = match self.changes(id) {
            Changes::Area(own) => Changes::Area(LightEdits { position: Some(to), ..own }),
            Changes::Punctual(own) => Changes::Punctual(PunctualEdits { position: Some(to), ..own }),
        };
        self.set_changes(id, changes);
    }

    /// Turns a light about its place by so much.
    pub fn turn_light(&mut self, id: LightId, by: Quat) {
        let direction = self.placing(id).normal();
        let changes = match self.changes(id) {
            Changes::Area(own) => {
                let rotation = (by * own.rotation.unwrap_or(Quat::IDENTITY)).normalize();
                Changes::Area(LightEdits { rotation: Some(rotation), ..own })
            }
            Changes::Punctual(own) => {
                Changes::Punctual(PunctualEdits { direction: Some((by * direction).normalize()), ..own })
            }
        };
        self.set_changes(id, changes);
    }

    /// Gives a light with an area this size, metres; one that is not flat is made larger by the mean of both.
    pub fn resize_light(&mut self, id: LightId, to: Vec2) {
        let to = to.clamp(Vec2::splat(1e-9), Vec2::splat(crate::scene::FARTHEST));
        if let Changes::Area(own) = self.changes(id) {
            self.set_changes(id, Changes::Area(LightEdits { size: Some(to), ..own }));
        }
    }

    /// Takes a light away.
    pub fn remove_light(&mut self, id: LightId) {
        match id {
            LightId::Area(index) => self.edits.remove_light(&self.scene, index),
            LightId::Punctual(index) => self.edits.remove_punctual(&self.scene, index),
        }
        self.chosen_light = None;
    }
}
