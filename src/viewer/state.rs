//! What the window shows and the user changes.

use std::time::Duration;

use super::orbit::Orbit;
use crate::picture::ToneCurve;
use crate::scene::{Instance, Light, Material, Scene, Settings, Sheen};

/// What a change makes necessary, from least to most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Change {
    #[default]
    None,
    /// The tone curve has changed: what was drawn is shown again.
    Shown,
    /// The view, the exposure, the ambient light, or which lobes are summed has changed: the scene is drawn again.
    Drawn,
    /// Materials, what the settings change in them, or lights have changed: they are sent to the device first.
    Scene,
}

/// The scene as it is now, and what it was when loaded.
pub struct State {
    /// The file's name.
    pub name: String,
    pub scene: Scene,
    pub settings: Settings,
    pub tone: ToneCurve,
    pub orbit: Orbit,
    /// The material that the panel shows.
    pub material: usize,
    /// How long the last drawn frame took.
    pub frame_time: Option<Duration>,
    /// What became of the last command: a screenshot's name, or why there is none.
    pub message: String,
    loaded: Loaded,
}

/// Those parts of the scene that the user may change, as they were loaded.
struct Loaded {
    materials: Vec<Material>,
    lights: Vec<Light>,
    instances: Vec<Instance>,
}

impl State {
    /// The state right after loading. Panics where the scene has no camera or no material.
    pub fn new(name: &str, scene: Scene) -> Self {
        assert!(!scene.cameras.is_empty() && !scene.materials.is_empty(), "{name}: a scene without camera or material");
        let has_sheen = |sheen: Option<Sheen>| sheen.is_some_and(|sheen| sheen.color.max_element() > 0.0);
        Self {
            name: name.to_owned(),
            settings: Settings::default(),
            tone: ToneCurve::default(),
            orbit: Orbit::new(&scene.cameras[0], scene.subject().center()),
            material: scene.materials.iter().position(|material| has_sheen(material.sheen)).unwrap_or(0),
            frame_time: None,
            message: String::new(),
            loaded: Loaded {
                materials: scene.materials.clone(),
                lights: scene.lights.clone(),
                instances: scene.instances.clone(),
            },
            scene,
        }
    }

    /// Puts everything back as it was loaded.
    pub fn reset(&mut self) {
        let mut scene = std::mem::take(&mut self.scene);
        let Loaded { materials, lights, instances } = &self.loaded;
        (scene.materials, scene.lights, scene.instances) = (materials.clone(), lights.clone(), instances.clone());
        *self = Self { frame_time: self.frame_time, ..Self::new(&self.name, scene) };
    }
}
