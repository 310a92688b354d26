//! The numbers of a layer of a .exr.

use std::io::{Read, Seek};

use exr::block::lines::LineRef;
use exr::block::reader::{ChunksReader, Reader};
use exr::error::Result;
use exr::math::Vec2;
use exr::meta::attribute::SampleType;
use half::f16;

use super::LinearImage;
use super::layers::Layer;

/// What the file shows of a layer, black where there is no data. Takes memory for that, and for a block of lines or a
/// tile of the layer's part: whether that is too much is the caller's to check before.
pub(super) fn read(reader: Reader<impl Read + Seek>, layer: &Layer) -> Result<LinearImage> {
    let part = &reader.headers()[layer.part];
    let (channels, shown) = (part.channels.clone(), part.shared_attributes.display_window);
    let position = part.own_attributes.layer_position;
    // From the data's first pixel to the first one that is shown.
    let offset = [position.0, position.1].map(i64::from);
    let offset = [offset[0] - i64::from(shown.position.0), offset[1] - i64::from(shown.position.1)];
    let (width, height) = (shown.size.0, shown.size.1);
    let mut pixels = vec![[0.0_f32; 3]; width * height];
    let is_wanted = |layer_index, level| layer_index == layer.part && level == Vec2(0, 0);
    let chunks = reader.filter_chunks(false, |_, _, block| is_wanted(block.layer, block.level))?;
    for block in chunks.sequential_decompressor(false) {
        let block = block?;
        for line in block.lines(&channels) {
            let place = line.location;
            let row = place.position.1 as i64 + offset[1];
            let is_shown = (0..height as i64).contains(&row);
            let targets = (0..3).filter(|&color| layer.channels[color] == place.channel);
            for color in targets.filter(|_| is_shown) {
                let samples = samples(&line, channels.list[place.channel].sample_type)?;
                for (column, sample) in (place.position.0 as i64 + offset[0]..).zip(samples) {
                    if (0..width as i64).contains(&column) {
                        pixels[row as usize * width + column as usize][color] = sample;
                    }
                }
            }
        }
    }
    Ok(LinearImage { width: width as u32, height: height as u32, pixels })
}

fn samples(line: &LineRef, kind: SampleType) -> Result<Vec<f32>> {
    match kind {
        SampleType::F16 => line.read_samples::<f16>().map(|sample| Ok(sample?.to_f32())).collect(),
        SampleType::F32 => line.read_samples::<f32>().collect(),
        SampleType::U32 => line.read_samples::<u32>().map(|sample| Ok(sample? as f32)).collect(),
    }
}
