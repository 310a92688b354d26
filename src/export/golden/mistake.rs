//! What is done wrong when these shaders are carried over to another language: pictures often look right all the same.

/// A mistake that golden numbers tell from others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mistake {
    /// x and y of a table exchanged.
    TableTransposed,
    /// Rows taken for columns where the lobe's matrix is made or its entries are read.
    MInvTransposed,
    /// world_from_local in place of local_from_world.
    FrameTransposed,
    /// The frame's x axis towards the light, not towards the view.
    FrameAboutLight,
    /// The lean of the lobe has the wrong sign.
    BSign,
    /// A roughness that is squared once too often.
    AlphaSquared,
    /// A sampler's centres of texels taken for the nodes of a table.
    NoHalfTexel,
    /// Outlines that cross the horizon are not closed along it.
    TurnForgotten,
    /// Clockwise where counter-clockwise is meant.
    WindingReversed,
}

impl Mistake {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::TableTransposed,
        Self::MInvTransposed,
        Self::FrameTransposed,
        Self::FrameAboutLight,
        Self::BSign,
        Self::AlphaSquared,
        Self::NoHalfTexel,
        Self::TurnForgotten,
        Self::WindingReversed,
    ];

    /// The name that it has in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::TableTransposed => "table_transposed",
            Self::MInvTransposed => "m_inv_transposed",
            Self::FrameTransposed => "frame_transposed",
            Self::FrameAboutLight => "frame_about_light",
            Self::BSign => "b_sign",
            Self::AlphaSquared => "alpha_squared",
            Self::NoHalfTexel => "no_half_texel",
            Self::TurnForgotten => "turn_forgotten",
            Self::WindingReversed => "winding_reversed",
        }
    }

    /// What it is, and what to do about it.
    pub fn advice(self) -> &'static str {
        match self {
            Self::TableTransposed => {
                "a table is read with its axes exchanged: x is the roughness and y the view's cosine; look up (alpha, mu), or \
                 swap width and height where the texture is filled"
            }
            Self::MInvTransposed => {
                "m_inv has rows where columns belong: WGSL's m[2].x is the third column's first number, so an HLSL matrix, \
                 whose m[2] is a row, holds b at m[0].z; where lights_factors is right, only the matrix was printed row by row"
            }
            Self::FrameTransposed => {
                "the frame is transposed: its rows are x, y and the normal, so that frame * v takes v from the world into it; where \
                 lights_factors is right, only the matrix was printed row by row"
            }
            Self::FrameAboutLight => {
                "the frame's x axis points to the light: it is the view projected on the surface, for every light the same"
            }
            Self::BSign => {
                "b has the wrong sign: keep the sign of the table, and let the frame's x axis point to the view's side, not away"
            }
            Self::AlphaSquared => {
                "the roughness is squared before the lookup: the sheen's table goes by alpha as it is, the specular base's by \
                 the user's roughness, not by its square"
            }
            Self::NoHalfTexel => {
                "a sampler is given node coordinates: node k of n sits at (k + 0.5) / n, so sample at (x * (n - 1) + 0.5) / n, \
                 or read texels without a sampler"
            }
            Self::TurnForgotten => {
                "the turn is not accumulated: turn = ltc_turn(turn, outline, m_inv) belongs in the loop over the corners, and \
                 what it gives into ltc_form_factor"
            }
            Self::WindingReversed => {
                "the corners go round the wrong way: counter-clockwise as seen from the lit side, with a normal towards it"
            }
        }
    }
}
