//! Textures looked up.

use glam::DVec2;

use crate::scene::{Filter, Sampler, Wrap};

/// A texture of two by two texels, 1, 2, 4 and 8 in rows from the top.
fn look(sampler: Sampler, u: f64, v: f64) -> f64 {
    sampler.magnified([2, 2], DVec2::new(u, v), |at| [1.0, 2.0, 4.0, 8.0][at])
}

fn sampler(wrap: Wrap, magnify: Filter) -> Sampler {
    Sampler { wrap: [wrap; 2], magnify, ..Sampler::DEFAULT }
}

#[test]
fn centres_are_the_texels_and_between_them_it_is_bilinear() {
    for (u, v, expected) in [
        (0.25, 0.25, 1.0),
        (0.75, 0.25, 2.0),
        (0.25, 0.75, 4.0),
        (0.75, 0.75, 8.0),
        (0.375, 0.25, 1.25),
        (0.25, 0.625, 3.25),
        (0.375, 0.5, 0.5 * (1.25 + 5.0)),
    ] {
        assert_eq!(look(Sampler::DEFAULT, u, v), expected, "{u} {v}");
    }
}

#[test]
fn beyond_the_edges_the_image_is_repeated_mirrored_or_clamped() {
    for (wrap, at_edge, past_edge, far) in
        [(Wrap::Repeat, 1.5, 1.0, 2.0), (Wrap::Mirror, 2.0, 2.0, 2.0), (Wrap::Clamp, 2.0, 2.0, 2.0)]
    {
        for (u, expected) in [(1.0, at_edge), (1.25, past_edge), (4.75, far)] {
            assert_eq!(look(sampler(wrap, Filter::Linear), u, 0.25), expected, "{wrap:?} {u}");
        }
    }
    // Along u and v apart.
    let one_way = Sampler { wrap: [Wrap::Clamp, Wrap::Repeat], ..Sampler::DEFAULT };
    assert_eq!([look(one_way, 1.25, 0.25), look(one_way, 0.25, 1.25)], [2.0, 1.0]);
}

#[test]
fn the_nearest_texel_changes_in_the_middle_between_centres() {
    for (u, expected) in [(0.01, 1.0), (0.49, 1.0), (0.51, 2.0), (0.99, 2.0), (1.01, 1.0)] {
        assert_eq!(look(sampler(Wrap::Repeat, Filter::Nearest), u, 0.25), expected, "{u}");
    }
}

#[test]
fn coordinates_without_fractions_show_the_first_texel() {
    for odd in [f64::NAN, f64::INFINITY, -f64::INFINITY, 1e300, 1e15] {
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            for (u, v) in [(odd, 0.75), (0.75, odd)] {
                assert_eq!(look(sampler(wrap, Filter::Linear), u, v), 1.0, "{u} {v} {wrap:?}");
            }
        }
    }
    // A million tiles away they do have fractions.
    assert_eq!(look(Sampler::DEFAULT, 1_000_000.375, 0.25), 1.25);
}
