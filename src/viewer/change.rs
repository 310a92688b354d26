//! What a change of the edits makes necessary.

use crate::scene::{Edits, Settings};

/// What a change makes necessary, from least to most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Change {
    #[default]
    None,
    /// The tone curve has changed: what was drawn is shown again.
    Shown,
    /// The exposure has changed: without shadows the scene is drawn again, with them shown again.
    Exposed,
    /// The view, the ambient light, or which lobes are summed has changed, or whether there are shadows: the scene is drawn
    /// again.
    Drawn,
    /// Materials have changed: they are sent to the device first.
    Materials,
    /// Lights have changed, or whether they are visible: they are sent to the device first, and shadows lie elsewhere.
    Lights,
}

impl Change {
    /// What it takes to show `after` where `before` is shown.
    pub fn between(before: &Edits, after: &Edits) -> Self {
        let are_seen = |edits: &Edits| edits.settings().lights_visible;
        let drawn = |edits: &Edits| Settings { tone: Default::default(), exposure: 0.0, ..edits.settings() };
        if are_seen(before) != are_seen(after) || !before.has_lights_of(after) {
            Self::Lights
        } else if before.every_material != after.every_material || before.materials != after.materials {
            Self::Materials
        } else if before.camera != after.camera || drawn(before) != drawn(after) {
            Self::Drawn
        } else if before.exposure != after.exposure {
            Self::Exposed
        } else if before.tone != after.tone {
            Self::Shown
        } else {
            Self::None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Exposure, ToneCurve};
    use crate::scene::{CameraEdit, LightEdits, Lobes, MaterialEdits};
    use glam::Vec3;

    #[test]
    fn no_more_is_done_than_a_change_makes_necessary() {
        let material = MaterialEdits { alpha: Some(0.5), ..MaterialEdits::default() };
        let light = LightEdits { strength: Some(2.0), ..LightEdits::default() };
        let edits = Edits::default;
        for (change, after) in [
            (Change::None, edits()),
            (Change::Shown, Edits { tone: Some(ToneCurve::Agx), ..edits() }),
            (Change::Drawn, Edits { camera: Some(CameraEdit::Loaded(1)), ..edits() }),
            (Change::Exposed, Edits { exposure: Some(1.0.into()), ..edits() }),
            (Change::Exposed, Edits { exposure: Some(Exposure::Auto), ..edits() }),
            (Change::Drawn, Edits { shadows: Some(false), ..edits() }),
            (Change::Drawn, Edits { ambient: Some(Vec3::ONE), ..edits() }),
            (Change::Drawn, Edits { lobes: Some(Lobes::NONE), ..edits() }),
            (Change::Lights, Edits { lights_visible: Some(false), ..edits() }),
            (Change::Materials, Edits { every_material: material, ..edits() }),
            (Change::Materials, Edits { materials: [(0, material)].into(), ..edits() }),
            (Change::Lights, Edits { lights: [(0, light)].into(), ..edits() }),
        ] {
            assert_eq!(Change::between(&edits(), &after), change, "{after:?}");
            assert_eq!(Change::between(&after, &edits()), change, "{after:?}");
            assert_eq!(Change::between(&after, &after), Change::None);
        }
        // A hue that nobody sees changes nothing.
        let dark = Edits { ambient_strength: Some(0.0), ..edits() };
        let hue = Edits { ambient: Some(Vec3::X), ..dark.clone() };
        assert_eq!(Change::between(&dark, &hue), Change::None);
    }
}
