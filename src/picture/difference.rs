use super::Picture;

/// How far a picture is from a reference, over all pixels and channels. Values are the pictures' own: linear radiance
/// for two .exr, shown values in [0, 1] for two .png. Sums are in `f64`.
#[derive(Clone, Debug, PartialEq)]
pub struct Differences {
    /// Mean of |test - reference|.
    pub mean_absolute: f64,
    /// Mean of |test - reference| over the mean of |reference|: 0 for equal pictures, `None` where only the
    /// reference is black.
    pub relative_mean_absolute: Option<f64>,
    /// Mean of test - reference, the bias: positive where the test is too bright.
    pub mean: f64,
    /// Where |test - reference| is greatest.
    pub largest: LargestDifference,
}

/// The channel of a pixel where |test - reference| is greatest; the first such one, in rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct LargestDifference {
    /// Pixels from the left, and rows from the top, both counted from 0.
    pub at: [u32; 2],
    /// 0 for red, 1 for green, 2 for blue.
    pub channel: usize,
    /// The test's value there.
    pub test: f32,
    /// The reference's value there.
    pub reference: f32,
}

impl LargestDifference {
    /// test - reference.
    pub fn error(&self) -> f64 {
        f64::from(self.test) - f64::from(self.reference)
    }
}

impl Differences {
    /// Compares two pictures of the same kind and size, all of whose numbers are finite; panics where they are not.
    pub fn between(test: &Picture, reference: &Picture) -> Self {
        test.assert_comparable(reference);
        let mut largest =
            LargestDifference { at: [0, 0], channel: 0, test: test.pixels[0][0], reference: reference.pixels[0][0] };
        let [mut absolute, mut signed, mut of_reference] = [0.0; 3];
        for (index, (tested, wanted)) in test.pixels.iter().zip(&reference.pixels).enumerate() {
            for (channel, (&test_value, &reference_value)) in tested.iter().zip(wanted).enumerate() {
                let difference = f64::from(test_value) - f64::from(reference_value);
                absolute += difference.abs();
                signed += difference;
                of_reference += f64::from(reference_value).abs();
                if difference.abs() > largest.error().abs() {
                    let at = test.place(index);
                    largest = LargestDifference { at, channel, test: test_value, reference: reference_value };
                }
            }
        }
        let count = 3.0 * test.pixels.len() as f64;
        let relative_mean_absolute = match (absolute > 0.0, of_reference > 0.0) {
            (false, _) => Some(0.0),
            (true, true) => Some(absolute / of_reference),
            (true, false) => None,
        };
        Self { mean_absolute: absolute / count, relative_mean_absolute, mean: signed / count, largest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Format, LinearImage};

    fn linear(width: u32, pixels: Vec<[f32; 3]>) -> Picture {
        LinearImage { width, height: pixels.len() as u32 / width, pixels }.into()
    }

    /// Six numbers; the sums are 0.25 + 0.5 + 2 + 0.25 = 3 of differences, -1.5 with signs, and 12 of the reference.
    #[test]
    fn a_sum_by_hand() {
        let reference = linear(1, vec![[1.0, 2.0, 4.0], [0.0, 3.0, -2.0]]);
        let test = linear(1, vec![[1.25, 2.5, 2.0], [0.0, 3.0, -2.25]]);
        let differences = Differences::between(&test, &reference);
        assert_eq!(differences.mean_absolute, 0.5);
        assert_eq!(differences.relative_mean_absolute, Some(0.25));
        assert_eq!(differences.mean, -0.25);
        let largest = LargestDifference { at: [0, 0], channel: 2, test: 2.0, reference: 4.0 };
        assert_eq!(differences.largest, largest);
        assert_eq!(differences.largest.error(), -2.0);
        // Not symmetric: B is what the error is relative to, 10.5 = 1.25 + 2.5 + 2 + 3 + 2.25 less 0.5.
        let swapped = Differences::between(&reference, &test);
        assert_eq!(swapped.relative_mean_absolute, Some(3.0 / 11.0));
        assert_eq!(swapped.mean, 0.25);
    }

    #[test]
    fn the_largest_is_found_where_it_is() {
        let reference = linear(4, vec![[0.5; 3]; 12]);
        for (index, channel) in [(0, 0), (3, 1), (4, 2), (11, 2), (6, 1)] {
            let mut test = reference.clone();
            test.pixels[index][channel] += 0.25;
            let largest = Differences::between(&test, &reference).largest;
            assert_eq!((largest.at, largest.channel), ([index as u32 % 4, index as u32 / 4], channel));
            assert_eq!(largest.error(), 0.25);
        }
    }

    #[test]
    fn against_black() {
        let black = linear(2, vec![[0.0; 3]; 4]);
        let grey = linear(2, vec![[0.5; 3]; 4]);
        assert_eq!(Differences::between(&black, &black).relative_mean_absolute, Some(0.0));
        assert_eq!(Differences::between(&grey, &black).relative_mean_absolute, None);
        assert_eq!(Differences::between(&black, &grey).relative_mean_absolute, Some(1.0));
    }

    /// The greatest floats: neither sums nor differences overflow.
    #[test]
    fn extremes_stay_finite() {
        let [test, reference] = [f32::MAX, -f32::MAX].map(|value| linear(2, vec![[value; 3]; 4]));
        let differences = Differences::between(&test, &reference);
        assert_eq!(differences.relative_mean_absolute, Some(2.0));
        assert_eq!(differences.mean, 2.0 * f64::from(f32::MAX));
    }

    #[test]
    #[should_panic(expected = "1 pixels are infinite or not a number, the first at [1, 0]")]
    fn what_is_not_a_number_is_no_picture() {
        let picture = linear(2, vec![[0.0; 3], [0.0, f32::NAN, 0.0]]);
        Differences::between(&picture, &picture);
    }

    #[test]
    #[should_panic(expected = "of one kind and one size")]
    fn kinds_are_not_mixed() {
        let radiance = linear(1, vec![[0.0; 3]]);
        Differences::between(&radiance, &Picture { format: Format::Png, ..radiance.clone() });
    }
}
