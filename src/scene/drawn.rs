//! Which of a scene's instances are drawn, and what each of them emits.

use glam::Vec3;

use super::{Light, Scene, Settings};

/// A scene's instances as settings draw them. Emitters and lights belong together: an emitter is hidden with the
/// lights, and its surface glows as its light says, whatever has become of that light since the scene was loaded.
pub struct DrawnInstances<'a> {
    scene: &'a Scene,
    /// By instance.
    lights: Vec<Option<&'a Light>>,
    lights_visible: bool,
}

impl<'a> DrawnInstances<'a> {
    /// What `settings` draw of `scene`.
    pub fn new(scene: &'a Scene, settings: &Settings) -> Self {
        let mut lights = vec![None; scene.instances.len()];
        scene.lights.iter().for_each(|light| lights[light.instance] = Some(light));
        Self { scene, lights, lights_visible: settings.lights_visible }
    }

    /// The light whose emitter the instance of this index is, if there is one.
    pub fn light(&self, instance: usize) -> Option<&'a Light> {
        self.lights[instance]
    }

    /// Whether the instance of this index is drawn: all are, but lights' emitters where lights are not visible.
    pub fn is_drawn(&self, instance: usize) -> bool {
        self.lights_visible || self.light(instance).is_none()
    }

    /// The radiance that the surface of the instance of this index emits where its emissive texture is white: its
    /// light's, else its material's. Linear Rec. 709, >= 0.
    pub fn emission(&self, instance: usize) -> Vec3 {
        let material = self.scene.meshes[self.scene.instances[instance].mesh].material;
        self.light(instance).map_or(self.scene.materials[material].emission, Light::emission)
    }
}
