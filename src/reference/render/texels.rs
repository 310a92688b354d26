//! Textures looked up in `f64`, in the full image, without mipmaps: a pixel that sees many texels averages them by its
//! samples.

use std::sync::LazyLock;

use glam::{DVec2, DVec4};

use crate::scene::{Image, Sampler, linear_from_srgb};

/// Linear light of the sRGB codes.
static LINEAR: LazyLock<[f64; 256]> = LazyLock::new(|| std::array::from_fn(|code| linear_from_srgb(code as u8).into()));

/// A texture's red, green, blue and alpha at (u, v), filtered as where it is magnified, each in [0, 1]. `is_color` says
/// that the first three are stored in sRGB; they come out linear.
pub(super) fn texel(image: &Image, sampler: Sampler, is_color: bool, uv: DVec2) -> DVec4 {
    sampler.magnified([image.width, image.height], uv, |at| decoded(image.texels[at], is_color))
}

fn decoded(codes: [u8; 4], is_color: bool) -> DVec4 {
    let plain = |code: u8| f64::from(code) / 255.0;
    let color = |code: u8| if is_color { LINEAR[usize::from(code)] } else { plain(code) };
    let [red, green, blue, alpha] = codes;
    DVec4::new(color(red), color(green), color(blue), plain(alpha))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image() -> Image {
        let texels = vec![[0, 0, 0, 255], [255, 0, 0, 255], [0, 255, 0, 0], [188, 0, 255, 0]];
        Image { name: String::new(), width: 2, height: 2, texels }
    }

    #[test]
    fn centres_are_the_texels_and_between_them_lies_their_mean() {
        let look = |u: f64, v: f64, is_color: bool| texel(&image(), Sampler::DEFAULT, is_color, DVec2::new(u, v));
        assert_eq!(look(0.75, 0.25, false), DVec4::new(1.0, 0.0, 0.0, 1.0));
        assert_eq!(look(0.5, 0.25, false), DVec4::new(0.5, 0.0, 0.0, 1.0));
        assert_eq!(look(0.25, 0.5, false), DVec4::new(0.0, 0.5, 0.0, 0.5));
        // sRGB's 188 is half the light (0.5029).
        assert!((look(0.75, 0.75, true).x - 0.503).abs() < 1e-3);
        // Repeated: half of the last column, half of the first.
        assert_eq!(look(1.0, 0.25, false), look(0.0, 0.25, false));
        assert!(look(f64::NAN, f64::INFINITY, false).is_finite());
    }
}
