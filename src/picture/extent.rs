//! What the head of a .exr claims, read before memory is taken for any of it.

use exr::meta::BlockDescription;
use exr::meta::header::Header;

/// How much a .exr claims to hold. A decoder takes memory for all of it, however short the file is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Extent {
    /// Width and height in pixels of what is shown and, for each part of the file, of what there is data for.
    pub windows: Vec<[u64; 2]>,
    /// Bytes of the largest piece that is decoded at once: some lines, or a tile.
    pub piece_bytes: u64,
}

impl Extent {
    /// What the heads of all parts claim.
    pub fn of(parts: &[Header]) -> Self {
        let window = |size: exr::math::Vec2<usize>| [size.0 as u64, size.1 as u64];
        let windows = parts
            .iter()
            .flat_map(|part| [window(part.shared_attributes.display_window.size), window(part.layer_size)])
            .collect();
        let piece_bytes = parts.iter().map(piece_bytes).max().unwrap_or(0);
        Self { windows, piece_bytes }
    }
}

fn piece_bytes(part: &Header) -> u64 {
    let [width, height] = match part.blocks {
        BlockDescription::ScanLines => [part.layer_size.0, part.compression.scan_lines_per_block()],
        BlockDescription::Tiles(tiles) => [tiles.tile_size.0, tiles.tile_size.1],
    };
    (width as u64).saturating_mul(height as u64).saturating_mul(part.channels.bytes_per_pixel as u64)
}
