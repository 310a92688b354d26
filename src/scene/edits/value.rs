//! Values of edits as flags and files write them, and their ranges.

use glam::Vec3;

use crate::picture::{Exposure, ToneCurve};
use crate::scene::{FARTHEST, Layering, Lobes, RoughnessMap, SheenModel};

/// A value as flags and files write it.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `0.3`
    Number(f32),
    /// `0.8,0.1,0.1` in flags, `[0.8, 0.1, 0.1]` in files.
    Numbers(Vec<f32>),
    /// A name, say `sqrt`; quoted in files.
    Text(String),
    /// `true` or `false`, in files alone.
    Switch(bool),
}

/// What is wrong with a value, as advice: "give a number in \[0,1\]".
type Checked<T> = Result<T, String>;

impl Value {
    /// The value that a flag's text stands for.
    pub fn of_flag(text: &str) -> Self {
        let number = |text: &str| text.trim().parse::<f32>().ok();
        if let Some(number) = number(text) {
            return Self::Number(number);
        }
        let numbers = text.split(',').map(number).collect::<Option<Vec<f32>>>();
        numbers.map_or_else(|| Self::Text(text.to_owned()), Self::Numbers)
    }

    /// A number in [0, 1].
    pub fn share(&self) -> Checked<f32> {
        let share = self.number().filter(|share| (0.0..=1.0).contains(share));
        share.ok_or_else(|| "give a number in [0,1]".to_owned())
    }

    /// A colour: three numbers in [0, 1].
    pub fn color(&self) -> Checked<Vec3> {
        let in_range = |color: &Vec3| color.cmpge(Vec3::ZERO).all() && color.cmple(Vec3::ONE).all();
        self.triple().filter(in_range).ok_or_else(|| "give three numbers in [0,1], say 0.8,0.1,0.1".to_owned())
    }

    /// A radiance: three finite numbers from 0 up.
    pub fn radiance(&self) -> Checked<Vec3> {
        let radiance = self.triple().filter(|radiance| radiance.cmpge(Vec3::ZERO).all());
        radiance.ok_or_else(|| "give three finite numbers from 0 up, say 0.1,0.1,0.2".to_owned())
    }

    /// A factor: a finite number from 0 up.
    pub fn strength(&self) -> Checked<f32> {
        self.number().filter(|number| *number >= 0.0).ok_or_else(|| "give a finite number from 0 up".to_owned())
    }

    /// A length: metres above 0, up to [`FARTHEST`].
    pub fn length(&self) -> Checked<f32> {
        let length = self.number().filter(|number| *number > 0.0 && *number <= FARTHEST);
        length.ok_or_else(|| format!("give a number above 0, up to {FARTHEST:e}"))
    }

    /// A number above 0 that may be infinite.
    pub fn far(&self) -> Checked<f32> {
        match self {
            Self::Number(number) if *number > 0.0 => Ok(*number),
            _ => Err("give a number above 0, or inf".to_owned()),
        }
    }

    /// Any finite number: an angle in radians.
    pub fn finite(&self) -> Checked<f32> {
        self.number().ok_or_else(|| "give a finite number".to_owned())
    }

    /// A point: three coordinates in metres, up to [`FARTHEST`] either way.
    pub fn point(&self) -> Checked<Vec3> {
        let point = self.triple().filter(|point| point.abs().max_element() <= FARTHEST);
        point.ok_or_else(|| format!("give three numbers in [-{FARTHEST:e},{FARTHEST:e}], say 0,1.5,-2"))
    }

    /// An exposure value, or `auto`. Past 100 stops either way a float has nothing left to show.
    pub fn exposure(&self) -> Checked<Exposure> {
        if self.text() == Some(AUTO) {
            return Ok(Exposure::Auto);
        }
        let stops = self.number().filter(|number| number.abs() <= 100.0);
        stops.map(Exposure::Stops).ok_or_else(|| "give a number in [-100,100], or auto".to_owned())
    }

    /// True or false.
    pub fn switch(&self) -> Checked<bool> {
        match self {
            Self::Switch(switch) => Ok(*switch),
            _ => Err("give true or false".to_owned()),
        }
    }

    /// True or false, or in words, as flags have it: `on` or `off`.
    pub fn on_or_off(&self) -> Checked<bool> {
        match (self, self.text()) {
            (Self::Switch(switch), _) => Ok(*switch),
            (_, Some("on")) => Ok(true),
            (_, Some("off")) => Ok(false),
            _ => Err("give on or off (in a file true or false)".to_owned()),
        }
    }

    /// The name of a tone curve.
    pub fn tone(&self) -> Checked<ToneCurve> {
        self.one_of(&ToneCurve::NAMES)
    }

    /// The name of a roughness map.
    pub fn roughness_map(&self) -> Checked<RoughnessMap> {
        self.one_of(&RoughnessMap::NAMES)
    }

    /// The name of a sheen's model.
    pub fn sheen_model(&self) -> Checked<SheenModel> {
        self.one_of(&SheenModel::NAMES)
    }

    /// The name of a layering rule, or `manual=S`.
    pub fn layering(&self) -> Checked<Layering> {
        let text = self.text().unwrap_or_default();
        match text.strip_prefix("manual=") {
            Some(share) => Self::of_flag(share).share().map(Layering::Manual).ok(),
            None => named(&Layering::NAMES, text),
        }
        .ok_or_else(|| "give gltf, openpbr, reciprocal, none, walk, or manual=S with S in [0,1]".to_owned())
    }

    /// A list of lobes, or `none`.
    pub fn lobes(&self) -> Checked<Lobes> {
        let mut lobes = Lobes::NONE;
        let text = self.text().unwrap_or_default();
        if text == NO_LOBES {
            return Ok(lobes);
        }
        for name in text.split(',') {
            let found = lobes.switches().into_iter().find(|(known, _)| *known == name.trim());
            let Some((_, switch)) = found else {
                return Err("give a list of sheen, diffuse, specular and emission, say sheen,diffuse".to_owned());
            };
            *switch = true;
        }
        Ok(lobes)
    }

    fn number(&self) -> Option<f32> {
        match self {
            Self::Number(number) => Some(*number).filter(|number| number.is_finite()),
            _ => None,
        }
    }

    fn triple(&self) -> Option<Vec3> {
        self.numbers().map(Vec3::from_array)
    }

    /// So many finite numbers.
    pub(super) fn numbers<const COUNT: usize>(&self) -> Option<[f32; COUNT]> {
        match self {
            Self::Numbers(numbers) => {
                <[f32; COUNT]>::try_from(numbers.as_slice()).ok().filter(|all| all.iter().all(|one| one.is_finite()))
            }
            _ => None,
        }
    }

    fn text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            _ => None,
        }
    }

    fn one_of<T: Copy>(&self, names: &[(&'static str, T)]) -> Checked<T> {
        let list = || names.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
        self.text().and_then(|text| named(names, text)).ok_or_else(|| format!("give one of {}", list()))
    }
}

/// What a metered exposure is called.
const AUTO: &str = "auto";

impl From<Exposure> for Value {
    fn from(exposure: Exposure) -> Self {
        match exposure {
            Exposure::Stops(stops) => stops.into(),
            Exposure::Auto => AUTO.into(),
        }
    }
}

/// What a list of lobes without any is called.
const NO_LOBES: &str = "none";

/// The list that `Value::lobes` reads.
impl From<Lobes> for Value {
    fn from(mut lobes: Lobes) -> Self {
        let on = lobes.switches().into_iter().filter(|(_, switch)| **switch).map(|(name, _)| name);
        let on = on.collect::<Vec<_>>().join(",");
        Self::Text(if on.is_empty() { NO_LOBES.to_owned() } else { on })
    }
}

impl From<f32> for Value {
    fn from(number: f32) -> Self {
        Self::Number(number)
    }
}

impl From<Vec3> for Value {
    fn from(triple: Vec3) -> Self {
        Self::Numbers(triple.to_array().into())
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

fn named<T: Copy>(names: &[(&'static str, T)], text: &str) -> Option<T> {
    names.iter().find(|(name, _)| *name == text).map(|(_, value)| *value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flag(text: &str) -> Value {
        Value::of_flag(text)
    }

    #[test]
    fn values_in_range_are_taken() {
        assert_eq!(flag("0").share(), Ok(0.0));
        assert_eq!(flag("1, 0.5,0").color(), Ok(Vec3::new(1.0, 0.5, 0.0)));
        assert_eq!(flag("0, 0.5,30").radiance(), Ok(Vec3::new(0.0, 0.5, 30.0)));
        assert_eq!(flag("0,-0.5,30").point(), Ok(Vec3::new(0.0, -0.5, 30.0)));
        for exposure in [Exposure::Stops(-2.5), Exposure::Auto] {
            assert_eq!(Value::from(exposure).exposure(), Ok(exposure));
        }
        assert_eq!((flag("-2.5").exposure(), flag("auto").exposure()), (Ok((-2.5).into()), Ok(Exposure::Auto)));
        assert_eq!((flag("0").strength(), flag("inf").far()), (Ok(0.0), Ok(f32::INFINITY)));
        assert_eq!((flag("on").on_or_off(), flag("off").on_or_off()), (Ok(true), Ok(false)));
        assert_eq!(Value::Switch(true).on_or_off(), Ok(true));
        assert_eq!(flag("sheen").lobes(), Ok(Lobes { sheen: true, ..Lobes::NONE }));
        assert_eq!(flag("none").lobes(), Ok(Lobes::NONE));
        assert_eq!(flag("manual=0.25").layering(), Ok(Layering::Manual(0.25)));
    }

    #[test]
    fn names_are_read_as_they_are_written() {
        for (name, model) in SheenModel::NAMES {
            assert_eq!((flag(name).sheen_model(), model.name()), (Ok(model), name));
        }
        for (name, map) in RoughnessMap::NAMES {
            assert_eq!((flag(name).roughness_map(), map.name()), (Ok(map), name));
        }
        for (name, tone) in ToneCurve::NAMES {
            assert_eq!((flag(name).tone(), tone.name()), (Ok(tone), name));
        }
        for rule in Layering::NAMES.map(|(_, rule)| rule).into_iter().chain([Layering::Manual(1e-7)]) {
            assert_eq!(flag(&rule.name()).layering(), Ok(rule));
        }
        for lobes in [Lobes::default(), Lobes::NONE, Lobes { sheen: true, emission: true, ..Lobes::NONE }] {
            assert_eq!(Value::from(lobes).lobes(), Ok(lobes));
        }
    }

    #[test]
    fn values_out_of_range_are_refused() {
        for text in ["", "-0.1", "1.1", "nan", "inf", "word", "1e40", "1,1,1"] {
            assert!(flag(text).share().is_err(), "{text}");
            assert!(flag(&format!("{text},0,0")).color().is_err(), "{text}");
            assert!(flag(&format!("manual={text}")).layering().is_err(), "{text}");
            let value = flag(text);
            assert!(value.roughness_map().is_err() && value.sheen_model().is_err() && value.layering().is_err());
            assert!(value.tone().is_err() && value.switch().is_err() && value.lobes().is_err(), "{text}");
            assert!(value.on_or_off().is_err(), "{text}");
        }
        for text in ["", "1,1", "1,1,1,1", ",,", "1,1,nan", "1,inf,0", "1e40,0,0", "1"] {
            assert!(flag(text).color().is_err() && flag(text).radiance().is_err() && flag(text).point().is_err());
        }
        assert!(flag("1,1,-0.1").radiance().is_err() && flag("manual").layering().is_err());
        for text in ["nan", "inf", "101", "x", "Auto", "auto "] {
            assert!(flag(text).exposure().is_err(), "{text}");
        }
        for text in ["", "shadow", "sheen,", "all"] {
            assert!(flag(text).lobes().is_err(), "{text}");
        }
        assert!(
            flag("0").length().is_err()
                && flag("1e13").length().is_err()
                && flag("0,0,1e13").point().is_err()
                && flag("-1").strength().is_err()
                && flag("nan").far().is_err()
        );
    }
}
