//! The lobes that are fitted.

use super::hemisphere::{AZIMUTHS, Hemisphere};
use crate::math::{fourier::cosine_sum, sine};
use crate::physics::transport::{MOST_MODES, Transport};
use glam::DVec3;

/// A solved slab, and the quadrature on which its lobes are known.
pub struct Lobes {
    /// The solved slab.
    pub transport: Transport,
    /// The quadrature, on the cosines of that solution.
    pub hemisphere: Hemisphere,
}

impl Lobes {
    /// The lobes of a solved slab.
    pub fn new(transport: Transport) -> Self {
        let hemisphere = Hemisphere::new(transport.cosines());
        Self { transport, hemisphere }
    }

    /// The reflected lobe f_r(wi, wo) mu_o over its albedo, for `wi` of cosine `mu` in \[0, 1\], at the nodes of the hemisphere.
    pub fn shape(&self, mu: f64) -> Vec<f64> {
        let Self { transport, hemisphere } = self;
        let (slab, albedo) = (transport.slab(), transport.albedo(mu));
        let wi = DVec3::new(sine(mu), 0.0, mu);
        let mut modes = [0.0; MOST_MODES];
        let modes = &mut modes[..transport.modes()];
        let mut shape = Vec::with_capacity(hemisphere.nodes.len());
        for ring in hemisphere.nodes.chunks_exact(AZIMUTHS) {
            let mu_o = ring[0].z;
            transport.multiple_modes(mu, mu_o, modes);
            shape.extend(ring.iter().map(|&wo| {
                let multiple = cosine_sum(modes, -wo.x / sine(mu_o)) * mu_o;
                (slab.single_scattering(wi, wo) + multiple) / albedo
            }));
        }
        shape
    }
}
