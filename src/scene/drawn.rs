//! The scene as it is drawn: a function of the scene as loaded and of what a user changes.

use std::borrow::Cow;
use std::collections::BTreeMap;

use glam::Vec3;

use super::{
    Edits, Instance, Layering, Light, Material, MaterialEdits, Mesh, PunctualLight, RoughnessMap, Scene, Settings,
    Sheen, TextureSlot,
};

/// A scene as edits draw it. Textures and cameras are those of the scene as loaded.
///
/// Emitters and lights belong together: an emitter moves with its light, and glows as its light says, whatever has
/// become of that since the scene was loaded. One that is a lamp is hidden with the lights, and when its light is not lit.
#[derive(Clone, Debug)]
pub struct Drawn<'a> {
    /// As loaded.
    pub scene: &'a Scene,
    /// Instead of `Scene::materials`. What an edit has replaced has no texture any more; a sheen that nobody could see
    /// is left out. The one past those of the scene, if there is one, is that of added lights' emitters.
    pub materials: Vec<Material>,
    /// Instead of `Scene::lights`; those that are added follow. One that is not lit is black.
    pub lights: Vec<Light>,
    /// Instead of `Scene::punctual_lights`; those that are added follow. One that is not lit is black.
    pub punctual_lights: Cow<'a, [PunctualLight]>,
    /// Instead of `Scene::instances`; the emitters of lights that are added follow.
    pub instances: Cow<'a, [Instance]>,
    /// What is no part of the scene.
    pub settings: Settings,
    /// By instance, the index of the light that it is the emitter of.
    pub(super) light_of: Vec<Option<usize>>,
    /// Of instances past those of the scene: what each is a copy of.
    pub(super) copies: Vec<Option<usize>>,
    /// By light: whether it is lit, and whether both faces shine where that is changed.
    pub(super) states: Vec<LightState>,
    /// The meshes of added lights, by their index.
    pub(super) shapes: BTreeMap<usize, Mesh>,
}

/// What a light's edits make of how its emitter is drawn.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LightState {
    pub is_off: bool,
    pub two_sided: Option<bool>,
}

/// The roughness of a sheen of which only the colour is given.
const ROUGHNESS: f32 = 0.5;

impl<'a> Drawn<'a> {
    /// What `edits` make of `scene`. Panics where they name what the scene does not have.
    pub fn new(scene: &'a Scene, edits: &Edits) -> Self {
        let mut light_of = vec![None; scene.instances.len()];
        for (index, light) in scene.lights.iter().enumerate() {
            light.emitters().for_each(|emitter| light_of[emitter] = Some(index));
        }
        let mut drawn = Self {
            scene,
            materials: materials(scene, edits),
            lights: scene.lights.clone(),
            punctual_lights: Cow::Borrowed(&scene.punctual_lights),
            instances: Cow::Borrowed(&scene.instances),
            settings: edits.settings(),
            light_of,
            copies: Vec::new(),
            states: Vec::new(),
            shapes: BTreeMap::new(),
        };
        drawn.edit_lights(edits);
        drawn
    }

    /// The material of this index as it is drawn, found without all the others.
    pub fn material(scene: &Scene, edits: &Edits, index: usize) -> Material {
        edited_material(scene, edits, index, none_has_sheen(scene))
    }

    /// The light whose emitter the instance of this index is, if there is one.
    pub fn light(&self, instance: usize) -> Option<&Light> {
        self.light_index(instance).map(|index| &self.lights[index])
    }

    /// Its index in `lights`.
    pub fn light_index(&self, instance: usize) -> Option<usize> {
        self.light_of[instance]
    }

    /// The mesh of this index: the scene's, or the shape of a light that is added.
    pub fn mesh(&self, index: usize) -> &Mesh {
        self.scene.meshes.get(index).unwrap_or_else(|| &self.shapes[&index])
    }

    /// The mesh of the instance of this index.
    pub fn mesh_of(&self, instance: usize) -> &Mesh {
        self.mesh(self.instances[instance].mesh)
    }

    /// The material of the instance of this index, as it is drawn.
    pub fn material_of(&self, instance: usize) -> &Material {
        &self.materials[self.mesh_of(instance).material]
    }

    /// The instance of the scene that the instance of this index is, or is a copy of; none where it is an added shape.
    pub fn loaded_instance(&self, instance: usize) -> Option<usize> {
        let loaded = self.scene.instances.len();
        if instance < loaded { Some(instance) } else { self.copies[instance - loaded] }
    }

    /// The light of the scene that the light of this index is, or is a copy of; none where it is an added shape.
    pub fn loaded_light(&self, light: usize) -> Option<usize> {
        if light < self.scene.lights.len() {
            Some(light)
        } else {
            self.loaded_instance(self.lights[light].instance).and_then(|instance| self.light_of[instance])
        }
    }

    /// Whether both faces of the instance of this index are drawn: as its light shines where that is changed, else as its material says.
    pub fn is_double_sided(&self, instance: usize) -> bool {
        let by_light = self.light_index(instance).and_then(|light| self.states[light].two_sided);
        by_light.unwrap_or(self.material_of(instance).double_sided)
    }

    /// Whether the instance of this index is drawn: all are, but lamps where lights are not visible, or where theirs is not lit.
    pub fn is_drawn(&self, instance: usize) -> bool {
        let Some(light) = self.light_index(instance).filter(|&light| self.lights[light].is_lamp()) else { return true };
        self.settings.lights_visible && !self.states[light].is_off
    }

    /// The radiance that the surface of the instance of this index emits where its emissive texture is white: its
    /// light's, else its material's. Linear Rec. 709, >= 0.
    pub fn emission(&self, instance: usize) -> Vec3 {
        self.light(instance).map_or(self.material_of(instance).emission, Light::emission)
    }
}

/// Whether a sheen can be seen. Black fibres scatter nothing; they still hide the base under a rule by which their
/// colour does not count.
fn is_seen(sheen: &Sheen) -> bool {
    sheen.weight > 0.0 && (sheen.color != Vec3::ZERO || sheen.layering == Layering::OpenPbr)
}

fn materials(scene: &Scene, edits: &Edits) -> Vec<Material> {
    let none_has = none_has_sheen(scene);
    (0..scene.materials.len()).map(|index| edited_material(scene, edits, index, none_has)).collect()
}

/// Whether a material has a sheen by the file that can be seen.
fn is_loaded(material: &Material) -> bool {
    material.sheen.as_ref().is_some_and(is_seen)
}

/// What the file has decides: a sheen that one material is given takes none from the others.
fn none_has_sheen(scene: &Scene) -> bool {
    !scene.materials.iter().any(is_loaded)
}

fn edited_material(scene: &Scene, edits: &Edits, index: usize, none_has: bool) -> Material {
    let material = &scene.materials[index];
    let own = edits.materials.get(&index).copied().unwrap_or_default();
    let mut changes = edits.of_material(index);
    if !is_loaded(material) && !own.gives_sheen() && !none_has {
        // What is said of the sheens of all materials is none of this one's business.
        (changes.alpha, changes.sheen_color, changes.sheen_weight) = (None, None, None);
        changes.sheen = changes.sheen.filter(|is_on| !is_on);
    }
    edited(material.clone(), &changes)
}

fn edited(mut material: Material, edits: &MaterialEdits) -> Material {
    material.base_color = edits.base_color.unwrap_or(material.base_color);
    material.metallic = edits.metallic.unwrap_or(material.metallic);
    material.roughness = edits.roughness.unwrap_or(material.roughness);
    let layered = material.sheen.map(|sheen| Sheen { layering: edits.layering.unwrap_or(sheen.layering), ..sheen });
    if edits.gives_sheen() && !layered.as_ref().is_some_and(is_seen) {
        // Whatever textures there are belong to a sheen that nobody saw.
        for slot in [TextureSlot::SheenColor, TextureSlot::SheenRoughness, TextureSlot::SheenWeight] {
            material.textures[slot as usize] = None;
        }
        material.sheen = Some(Sheen::new(Vec3::ONE, ROUGHNESS));
    }
    if let Some(sheen) = &mut material.sheen {
        sheen.roughness_map = edits.roughness_map.unwrap_or(sheen.roughness_map);
        sheen.model = edits.sheen_model.unwrap_or(sheen.model);
        sheen.layering = edits.layering.unwrap_or(sheen.layering);
        if let Some(alpha) = edits.alpha {
            (sheen.roughness, sheen.roughness_map) = (alpha, RoughnessMap::Identity);
            material.textures[TextureSlot::SheenRoughness as usize] = None;
        }
        if let Some(color) = edits.sheen_color {
            (sheen.color, sheen.weight) = (color, 1.0);
            material.textures[TextureSlot::SheenColor as usize] = None;
            material.textures[TextureSlot::SheenWeight as usize] = None;
        }
        if let Some(weight) = edits.sheen_weight {
            sheen.weight = weight;
            material.textures[TextureSlot::SheenWeight as usize] = None;
        }
    }
    // A black or a weight of 0 that is given stays a sheen.
    let is_given = edits.sheen_color.is_some() || edits.sheen_weight.is_some();
    let is_off = edits.sheen == Some(false);
    material.sheen = material.sheen.filter(|sheen| !is_off && (is_given || is_seen(sheen)));
    material
}
