//! The lights of a scene as it is drawn, with their emitters.

use std::borrow::Cow;

use glam::{DAffine3, Mat4, Vec3};

use super::drawn::{Drawn, LightState};
use super::edits::{AddedLight, AddedPunctual, LightEdits, LightShape, PunctualEdits, PunctualShape};
use super::light_frame::placed;
use super::{Edits, Instance, Light, LightFrame, Material, Polygon, PunctualKind, PunctualLight, Scene, emitter};

/// The angles between which an added spot falls to nothing, radians: 30 and 45 degrees.
const SPOT: [f32; 2] = [std::f32::consts::FRAC_PI_6, std::f32::consts::FRAC_PI_4];

impl Scene {
    /// The polygon light of this index without what is changed in it: those of the scene come first, then those that are added.
    pub fn base_light(&self, edits: &Edits, index: usize) -> Light {
        match index.checked_sub(self.lights.len()).map(|added| &edits.added_lights[added]) {
            None => self.lights[index].clone(),
            Some(AddedLight { name, shape: LightShape::Copy(of), .. }) => {
                Light { name: name.clone(), ..self.lights[*of].clone() }
            }
            Some(AddedLight { name, shape, .. }) => {
                let outline = shape.corners().unwrap_or_default().iter().map(|corner| corner.extend(0.0)).collect();
                let polygons = vec![Polygon { contours: vec![outline], normal: Vec3::Z, pattern: None }];
                Light { name: name.clone(), radiance: Vec3::ONE, polygons, ..Light::default() }
            }
        }
    }

    /// Where the polygon light of this index stands without what is changed in it.
    pub fn base_frame(&self, edits: &Edits, index: usize) -> LightFrame {
        match index.checked_sub(self.lights.len()).map(|added| edits.added_lights[added].shape) {
            None => self.lights[index].frame(),
            Some(LightShape::Copy(of)) => self.lights[of].frame(),
            Some(_) => LightFrame::UNIT,
        }
    }

    /// The light without extent of this index without what is changed in it: those of the scene come first, then those that are added.
    pub fn base_punctual(&self, edits: &Edits, index: usize) -> PunctualLight {
        match index.checked_sub(self.punctual_lights.len()).map(|added| &edits.added_punctual[added]) {
            None => self.punctual_lights[index].clone(),
            Some(AddedPunctual { name, shape, .. }) => {
                let range = f32::INFINITY;
                let kind = match *shape {
                    PunctualShape::Copy(of) => {
                        return PunctualLight { name: name.clone(), ..self.punctual_lights[of].clone() };
                    }
                    PunctualShape::Point => PunctualKind::Point { range },
                    PunctualShape::Spot => PunctualKind::Spot { range, inner: SPOT[0], outer: SPOT[1] },
                    PunctualShape::Directional => PunctualKind::Directional,
                };
                let (position, direction) = (Vec3::ZERO, Vec3::NEG_Z);
                PunctualLight { name: name.clone(), kind, intensity: Vec3::ONE, position, direction }
            }
        }
    }
}

/// Whether a light is lit, by what is said of it.
fn is_lit(any_solo: bool, [on, solo, removed]: [Option<bool>; 3]) -> bool {
    on != Some(false) && removed != Some(true) && (!any_solo || solo == Some(true))
}

impl Drawn<'_> {
    /// Adds lights and changes those that are there.
    pub(super) fn edit_lights(&mut self, edits: &Edits) {
        let scene = self.scene;
        if !edits.added_lights.is_empty() {
            self.materials.push(Material::matte("added lights", Vec3::ZERO));
        }
        for (index, added) in (scene.lights.len()..).zip(&edits.added_lights) {
            let light = scene.base_light(edits, index);
            self.add_light(light, added);
        }
        self.states = vec![LightState::default(); self.lights.len()];
        let any_solo = edits.any_solo();
        let is_plain = edits.lights.is_empty() && edits.added_lights.is_empty() && !any_solo;
        for index in (0..self.lights.len()).filter(|_| !is_plain) {
            let own = edits.of_light(scene, index);
            if own != LightEdits::default() || any_solo {
                self.edit_light(scene.base_frame(edits, index), index, &own, any_solo);
            }
        }
        if edits.punctual.is_empty() && edits.added_punctual.is_empty() && !any_solo {
            return;
        }
        let count = scene.punctual_lights.len() + edits.added_punctual.len();
        let punctual = |index: usize| {
            let own: PunctualEdits = edits.of_punctual(scene, index);
            let light = own.applied(&scene.base_punctual(edits, index));
            let is_lit = is_lit(any_solo, [own.on, own.solo, own.removed]);
            PunctualLight { intensity: if is_lit { light.intensity } else { Vec3::ZERO }, ..light }
        };
        self.punctual_lights = Cow::Owned((0..count).map(punctual).collect());
    }

    /// Adds a light with the emitter that is drawn for it.
    fn add_light(&mut self, mut light: Light, added: &AddedLight) {
        let index = self.lights.len();
        let mut add = |instance: Instance, copied: Option<usize>| {
            self.instances.to_mut().push(instance);
            self.light_of.push(Some(index));
            self.copies.push(copied);
            self.instances.len() - 1
        };
        match (added.shape, added.shape.corners()) {
            (LightShape::Copy(_), _) | (_, None) => {
                let copies = light.emitters().map(|of| add(self.scene.instances[of].clone(), Some(of)));
                let copies: Vec<usize> = copies.collect();
                (light.instance, light.doubles) = (copies[0], copies[1..].to_vec());
            }
            (shape, Some(corners)) => {
                // The same for all of a shape, whatever else there is: what is on the device stays right.
                let mesh = self.scene.meshes.len() + usize::from(shape.code());
                let (name, world_from_mesh) = (added.name.clone(), Mat4::IDENTITY);
                light.instance = add(Instance { name, mesh, world_from_mesh }, None);
                let material = self.scene.materials.len();
                self.shapes.entry(mesh).or_insert_with(|| emitter::mesh("added light", &corners, material));
            }
        }
        self.lights.push(light);
    }

    /// Changes a light, and moves the emitter that is drawn for it along.
    fn edit_light(&mut self, frame: LightFrame, index: usize, edits: &LightEdits, any_solo: bool) {
        let light = &mut self.lights[index];
        let place = frame.moved(edits.position, edits.rotation, edits.size);
        if place != DAffine3::IDENTITY {
            light.transform(&place);
            let instances = self.instances.to_mut();
            for emitter in light.emitters() {
                instances[emitter].world_from_mesh = placed(instances[emitter].world_from_mesh, &place);
            }
        }
        light.two_sided = edits.two_sided.unwrap_or(light.two_sided);
        let is_off = !is_lit(any_solo, [edits.on, edits.solo, edits.removed]);
        light.radiance = if is_off { Vec3::ZERO } else { edits.radiance(light) };
        self.states[index] = LightState { is_off, two_sided: edits.two_sided };
    }
}
