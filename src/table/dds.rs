//! Tables as textures.

use super::TableError;
use super::grid::{Grid, MAX_SIDE};
use ddsfile::{AlphaMode, Caps2, D3D10ResourceDimension, Dds, DxgiFormat, FourCC, MiscFlag, NewDxgiParams};
use half::f16;

/// A 2D texture of RGBA16F or RGBA32F that was read.
pub(super) struct Texture {
    /// Nodes along x and y; each has a texel in every part.
    size: [usize; 2],
    /// Row by row.
    texels: Vec<[f64; 4]>,
    header_bytes: usize,
    texel_bytes: usize,
}

impl Texture {
    /// Reads a texture as high as `parts` tables, one above the other, of up to [`MAX_SIDE`] nodes a side.
    pub fn read(bytes: &[u8], parts: usize) -> Result<Self, TableError> {
        read(bytes, parts).map_err(|problem| TableError::Dds { problem })
    }

    /// The numbers of each node, made from its texels in all parts; an error where `wrong` finds a defect in one.
    pub fn grid<const PARTS: usize, const N: usize>(
        &self,
        numbers: fn([[f64; 4]; PARTS]) -> [f64; N],
        wrong: fn([f64; N]) -> Option<String>,
    ) -> Result<Grid<N>, TableError> {
        let [width, height] = self.size;
        let mut cells = Vec::with_capacity(width * height);
        for x in 0..width {
            for y in 0..height {
                let at = |part: usize| (part * height + y) * width + x;
                let cell = numbers(std::array::from_fn(|part| self.texels[at(part)]));
                if let Some(defect) = wrong(cell) {
                    let byte = self.header_bytes + at(0) * self.texel_bytes;
                    return Err(TableError::Dds { problem: format!("byte {byte}, texel ({x}, {y}): {defect}") });
                }
                cells.push(cell);
            }
        }
        Ok(Grid { size: self.size, cells })
    }
}

/// A texture of RGBA16F, DX10 header, no mips, from its texels row by row.
pub(super) fn write([width, height]: [usize; 2], texels: impl Iterator<Item = [f64; 4]>) -> Vec<u8> {
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
    // Processors convert to halves by way of f32, so a number midway between two halves may round to either.
    dds.data = texels.flatten().flat_map(|value| f16::from_f64(value).to_le_bytes()).collect();
    let mut bytes = Vec::new();
    dds.write(&mut bytes).expect("writing to memory does not fail");
    bytes
}

fn read(bytes: &[u8], parts: usize) -> Result<Texture, String> {
    // The crate reads the fixed-size headers and copies what follows them: memory stays within twice the input. Its
    // derived sizes multiply unchecked, so none of them is asked for.
    let dds = Dds::read(bytes).map_err(|error| format!("no .dds texture ({error})"))?;
    let texel_bytes = texel_bytes(&dds)?;
    let [width, height] = [dds.header.width, dds.header.height].map(|side| side as usize);
    let size = [width, height / parts];
    if height % parts != 0 || !size.iter().all(|side| (2..=MAX_SIDE).contains(side)) {
        let stacked = if parts == 1 { String::new() } else { format!(", height over {parts}") };
        return Err(format!("{width} x {height} texels, where each side{stacked} must be in [2, {MAX_SIDE}]"));
    }
    let expected = width * height * texel_bytes;
    if dds.data.len() != expected {
        let found = dds.data.len();
        return Err(format!("{found} bytes of texels, where {width} x {height} take {expected}"));
    }
    let texels = dds.data.chunks_exact(texel_bytes).map(texel).collect();
    Ok(Texture { size, texels, header_bytes: bytes.len() - expected, texel_bytes })
}

/// The bytes of a texel, if the headers describe one plain 2D texture in a format that is read.
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

/// The numbers of a texel of 4 halves or 4 floats.
fn texel(bytes: &[u8]) -> [f64; 4] {
    let channel_bytes = bytes.len() / 4;
    std::array::from_fn(|channel| {
        let bytes = &bytes[channel * channel_bytes..][..channel_bytes];
        match *bytes {
            [low, high] => f16::from_le_bytes([low, high]).to_f64(),
            [b0, b1, b2, b3] => f32::from_le_bytes([b0, b1, b2, b3]).into(),
            _ => unreachable!("channels have 2 or 4 bytes: {channel_bytes}"),
        }
    })
}
