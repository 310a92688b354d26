//! Tables as textures.

use super::{LtcTable, MAX_SIDE, TableError, cell_defect};
use ddsfile::{AlphaMode, Caps2, D3D10ResourceDimension, Dds, DxgiFormat, FourCC, MiscFlag, NewDxgiParams};
use half::f16;

impl LtcTable {
    /// Reads a 2D texture of RGBA16F or RGBA32F, x = alpha, y = mu; its A is not looked at.
    pub fn from_dds(bytes: &[u8]) -> Result<Self, TableError> {
        from_dds(bytes).map_err(|problem| TableError::Dds { problem })
    }

    /// The table as a texture: RGBA16F, DX10 header, no mips, x = alpha, y = mu, A = 1.
    pub fn to_dds(&self) -> Vec<u8> {
        let [width, height] = self.size;
        let mut dds = Dds::new_dxgi(NewDxgiParams {
            height: height as u32,
            width: width as u32,
            depth: None,
            format: DxgiFormat::R16G16B16A16_Float,
            mipmap_levels: None,
            array_layers: None,
            caps2: None,
            is_cubemap: false,
            resource_dimension: D3D10ResourceDimension::Texture2D,
            alpha_mode: AlphaMode::Custom,
        })
        .expect("RGBA16F is a format that the crate lays out");
        dds.data.clear();
        for y in 0..height {
            for x in 0..width {
                let [a, b, r] = self.cell(x, y);
                // Straight from f64: by way of f32, rounding twice could miss the nearest half.
                dds.data.extend([a, b, r, 1.0].into_iter().flat_map(|value| f16::from_f64(value).to_le_bytes()));
            }
        }
        let mut bytes = Vec::new();
        dds.write(&mut bytes).expect("writing to memory does not fail");
        bytes
    }
}

fn from_dds(bytes: &[u8]) -> Result<LtcTable, String> {
    // The crate reads the fixed-size headers and copies what follows them: memory stays within twice the input. Its
    // derived sizes multiply unchecked, so none of them is asked for.
    let dds = Dds::read(bytes).map_err(|error| format!("no .dds texture ({error})"))?;
    let texel_bytes = texel_bytes(&dds)?;
    let [width, height] = [dds.header.width, dds.header.height].map(|side| side as usize);
    if ![width, height].iter().all(|side| (2..=MAX_SIDE).contains(side)) {
        return Err(format!("{width} x {height} texels, where each side must be in [2, {MAX_SIDE}]"));
    }
    let expected = width * height * texel_bytes;
    if dds.data.len() != expected {
        let found = dds.data.len();
        return Err(format!("{found} bytes of texels, where {width} x {height} take {expected}"));
    }
    let header_bytes = bytes.len() - expected;
    let mut cells = Vec::with_capacity(width * height);
    for x in 0..width {
        for y in 0..height {
            let at = (y * width + x) * texel_bytes;
            let cell = cell(&dds.data[at..at + texel_bytes]);
            if let Some(defect) = cell_defect(cell) {
                return Err(format!("byte {}, texel ({x}, {y}): {defect}", header_bytes + at));
            }
            cells.push(cell);
        }
    }
    Ok(LtcTable { size: [width, height], cells })
}

/// Bytes of a texel, once the headers are seen to describe one plain 2D texture of a format that is read.
fn texel_bytes(dds: &Dds) -> Result<usize, String> {
    let header = &dds.header;
    if header.depth.is_some_and(|depth| depth > 1) || header.caps2.intersects(Caps2::VOLUME | Caps2::CUBEMAP) {
        return Err("a volume or a cube".to_owned());
    }
    if header.mip_map_count.is_some_and(|levels| levels > 1) {
        return Err("a texture with mips".to_owned());
    }
    let Some(header10) = &dds.header10 else {
        // Direct3D 9 gave the two formats codes of their own.
        return match header.spf.fourcc {
            Some(FourCC(FourCC::R16G16B16A16_FLOAT)) => Ok(8),
            Some(FourCC(FourCC::R32G32B32A32_FLOAT)) => Ok(16),
            _ => Err("a format without a DX10 header".to_owned()),
        };
    };
    let flat = header10.resource_dimension == D3D10ResourceDimension::Texture2D;
    if !flat || header10.array_size != 1 || header10.misc_flag.contains(MiscFlag::TEXTURECUBE) {
        return Err("a volume, a cube or an array".to_owned());
    }
    match header10.dxgi_format {
        DxgiFormat::R16G16B16A16_Float => Ok(8),
        DxgiFormat::R32G32B32A32_Float => Ok(16),
        other => Err(format!("format {other:?}")),
    }
}

/// `[a, b, r]` of a texel of 4 halves or 4 floats.
fn cell(texel: &[u8]) -> [f64; 3] {
    let channel_bytes = texel.len() / 4;
    std::array::from_fn(|channel| {
        let bytes = &texel[channel * channel_bytes..][..channel_bytes];
        match *bytes {
            [low, high] => f16::from_le_bytes([low, high]).to_f64(),
            [b0, b1, b2, b3] => f32::from_le_bytes([b0, b1, b2, b3]).into(),
            _ => unreachable!("channels have 2 or 4 bytes: {channel_bytes}"),
        }
    })
}
