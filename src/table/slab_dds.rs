//! The slab's table as a volume.

use super::TableError;
use super::slab::{SLAB_SIDE, SlabTable};
use ddsfile::{AlphaMode, Caps2, D3D10ResourceDimension, Dds, DxgiFormat, MiscFlag, NewDxgiParams};
use half::f16;

/// Bytes of a texel: four halves.
const TEXEL_BYTES: usize = 8;

impl SlabTable {
    /// Reads a volume of 32 x 32 x 32 texels of RGBA16F, x = alpha, y = mu_i, z = mu_o; its A is ignored.
    pub fn from_dds(bytes: &[u8]) -> Result<Self, TableError> {
        from_dds(bytes).map_err(|problem| TableError::Volume { problem })
    }

    /// The table as a volume: RGBA16F, DX10 header, no mips, x = alpha, y = mu_i, z = mu_o; v0, v1, v2, 1.
    pub fn to_dds(&self) -> Vec<u8> {
        let side = SLAB_SIDE as u32;
        let mut dds = Dds::new_dxgi(NewDxgiParams {
            height: side,
            width: side,
            depth: Some(side),
            format: DxgiFormat::R16G16B16A16_Float,
            mipmap_levels: None,
            array_layers: None,
            caps2: Some(Caps2::VOLUME),
            is_cubemap: false,
            resource_dimension: D3D10ResourceDimension::Texture3D,
            alpha_mode: AlphaMode::Custom,
        })
        .expect("RGBA16F is a format that the crate lays out");
        dds.data.clear();
        for (x, y, z) in texels() {
            let [v0, v1, v2] = self.halves(x, y, z);
            dds.data.extend([v0, v1, v2, f16::ONE].into_iter().flat_map(f16::to_le_bytes));
        }
        let mut bytes = Vec::new();
        dds.write(&mut bytes).expect("writing to memory does not fail");
        bytes
    }
}

/// All texels in the order of the file.
fn texels() -> impl Iterator<Item = (usize, usize, usize)> {
    let side = SLAB_SIDE;
    (0..side.pow(3)).map(move |index| (index % side, index / side % side, index / (side * side)))
}

fn from_dds(bytes: &[u8]) -> Result<SlabTable, String> {
    // As for the table of lobes: the crate copies what follows the headers, and none of its derived sizes is asked for.
    let dds = Dds::read(bytes).map_err(|error| format!("no .dds texture ({error})"))?;
    check(&dds)?;
    let expected = SLAB_SIDE.pow(3) * TEXEL_BYTES;
    let found = dds.data.len();
    if found != expected {
        return Err(format!("{found} bytes of texels, where {SLAB_SIDE} x {SLAB_SIDE} x {SLAB_SIDE} take {expected}"));
    }
    let place = |x: usize, y: usize, z: usize| ((z * SLAB_SIDE + y) * SLAB_SIDE + x) * TEXEL_BYTES;
    let mut cells = Vec::with_capacity(SLAB_SIDE.pow(3));
    // In memory alpha is slowest: the file's order with x and z exchanged.
    for (z, y, x) in texels() {
        let texel = &dds.data[place(x, y, z)..][..TEXEL_BYTES];
        cells.push(std::array::from_fn(|m| f16::from_le_bytes([texel[2 * m], texel[2 * m + 1]])));
    }
    let header_bytes = bytes.len() - expected;
    SlabTable::from_halves(cells).map_err(|([x, y, z], defect)| {
        format!("byte {}, texel ({x}, {y}, {z}): {defect}", header_bytes + place(x, y, z))
    })
}

/// Checks that the headers describe one plain volume of the right size and format.
fn check(dds: &Dds) -> Result<(), String> {
    let header = &dds.header;
    let Some(header10) = &dds.header10 else {
        return Err("a format without a DX10 header".to_owned());
    };
    let volume = header10.resource_dimension == D3D10ResourceDimension::Texture3D;
    let cube = header.caps2.contains(Caps2::CUBEMAP) || header10.misc_flag.contains(MiscFlag::TEXTURECUBE);
    if !volume || cube || header10.array_size != 1 {
        return Err("no volume but a flat texture, a cube or an array".to_owned());
    }
    if header.mip_map_count.is_some_and(|levels| levels > 1) {
        return Err("a texture with mips".to_owned());
    }
    if header10.dxgi_format != DxgiFormat::R16G16B16A16_Float {
        return Err(format!("format {:?}", header10.dxgi_format));
    }
    let sides = [Some(header.width), Some(header.height), header.depth];
    if sides != [Some(SLAB_SIDE as u32); 3] {
        let [width, height, depth] = sides.map(Option::unwrap_or_default);
        return Err(format!("{width} x {height} x {depth} texels"));
    }
    Ok(())
}
