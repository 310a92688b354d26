//! From numbers to colours.

use plotters::coord::ranged1d::Ranged;
use plotters::coord::types::RangedCoordf64;
use plotters::style::RGBColor;
use plotters::style::colors::colormaps::ViridisRGB;
use std::ops::Range;

/// The range of numbers that the colours stand for; both ends finite, the first below the last.
#[derive(Clone, Debug, PartialEq)]
pub enum Scale {
    /// Equal differences are equal steps.
    Linear(Range<f64>),
    /// Equal factors are equal steps; above 0.
    Log(Range<f64>),
}

impl Scale {
    /// The linear scale that spans all `values`; a wider one around them where they are all the same number.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
        assert!(low <= high, "a scale of no numbers");
        let spare = if low < high { 0.0 } else { f64::max(low.abs(), 1.0) / 2.0 };
        Self::Linear(low - spare..high + spare)
    }

    /// The place of `value` on the scale, in \[0, 1\]; the nearer end's where `value` is outside.
    pub fn place(&self, value: f64) -> f64 {
        let place = match self {
            Self::Linear(range) => (value - range.start) / (range.end - range.start),
            Self::Log(range) => (value / range.start).ln() / (range.end / range.start).ln(),
        };
        assert!(!place.is_nan(), "no place on {self:?}: {value}");
        place.clamp(0.0, 1.0)
    }

    /// The number that stands at `place` in \[0, 1\].
    pub fn value(&self, place: f64) -> f64 {
        match self {
            Self::Linear(range) => range.start + place * (range.end - range.start),
            Self::Log(range) => range.start * (range.end / range.start).powf(place),
        }
    }

    /// Round numbers on the scale, ascending, with which it is labelled.
    pub fn ticks(&self) -> Vec<f64> {
        match self {
            Self::Linear(range) => {
                let step = (range.end - range.start) / 8.0;
                // Where 0 is meant, sums of steps leave noise.
                let ticks = RangedCoordf64::from(range.clone()).key_points(8);
                ticks.into_iter().map(|tick| if tick.abs() < 1e-9 * step { 0.0 } else { tick }).collect()
            }
            Self::Log(range) => {
                let [first, last] = [range.start.log10().ceil(), range.end.log10().floor()].map(|power| power as i32);
                (first..=last).map(|power| 10.0_f64.powi(power)).collect()
            }
        }
    }

    /// The colour of `value`: viridis (Smith and van der Walt 2015), dark for low, in which equal steps look equal and
    /// brightness alone tells the order. plotters interpolates linearly between eight of its colours.
    pub fn color(&self, value: f64) -> RGBColor {
        ViridisRGB::get_color(self.place(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance of a colour of sRGB (IEC 61966-2-1).
    fn luminance(RGBColor(r, g, b): RGBColor) -> f64 {
        let linear = |channel: u8| {
            let x = f64::from(channel) / 255.0;
            if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b)
    }

    #[test]
    fn larger_numbers_are_brighter() {
        for scale in [Scale::Linear(-0.5..2.0), Scale::Log(1e-4..1.0)] {
            let colors: Vec<f64> = (0..=64).map(|k| luminance(scale.color(scale.value(f64::from(k) / 64.0)))).collect();
            for (k, pair) in colors.windows(2).enumerate() {
                assert!(pair[0] < pair[1], "{scale:?}, steps {k} and {}: {pair:?}", k + 1);
            }
        }
    }

    #[test]
    fn places_and_values_are_each_others_inverse_and_end_at_the_ends() {
        for (scale, middle) in [(Scale::Linear(-0.5..2.0), 0.75), (Scale::Log(1e-4..1.0), 1e-2)] {
            // Round-off of a logarithm and a power.
            assert!((scale.place(middle) - 0.5).abs() < 1e-12, "{scale:?}");
            assert!((scale.value(0.5) / middle - 1.0).abs() < 1e-12, "{scale:?}");
            assert_eq!([scale.place(scale.value(0.0)), scale.place(scale.value(1.0))], [0.0, 1.0]);
            assert_eq!(scale.color(1e9), scale.color(scale.value(1.0)));
        }
        // An error of 0 is off the lower end.
        assert_eq!(Scale::Log(1e-4..1.0).place(0.0), 0.0);
    }

    #[test]
    fn ticks_are_round_and_on_the_scale() {
        let ticks = Scale::Linear(-0.1742..0.0).ticks();
        assert!(ticks.len() >= 3 && ticks.last() == Some(&0.0), "{ticks:?}");
        let decades = Scale::Log(1e-4..1.0).ticks();
        assert_eq!(decades.len(), 5, "{decades:?}");
        for (tick, power) in decades.into_iter().zip(-4..) {
            assert!((tick / 10.0_f64.powi(power) - 1.0).abs() < 1e-12, "{tick}");
        }
    }

    #[test]
    fn a_scale_holds_its_numbers() {
        assert_eq!(Scale::of([0.3, -0.1, 0.2].into_iter()), Scale::Linear(-0.1..0.3));
        assert_eq!(Scale::of([0.0; 4].into_iter()).place(0.0), 0.5);
    }
}
