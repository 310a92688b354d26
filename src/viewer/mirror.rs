//! egui's textures as they are by now. egui tells only what changes; a device that comes in place of another one has nothing yet.

use std::collections::HashMap;

use egui::TextureId;
use egui::epaint::ImageData;
use egui::epaint::image::ImageDelta;
use egui::epaint::textures::TexturesDelta;

/// All textures that egui has, whole.
#[derive(Default)]
pub struct Mirror(HashMap<TextureId, ImageDelta>);

impl Mirror {
    /// Takes in what a pass has changed.
    pub fn follow(&mut self, changes: &TexturesDelta) {
        for (id, deltas) in &changes.set {
            for delta in deltas {
                match (delta.pos, self.0.get_mut(id)) {
                    (Some(at), Some(whole)) => put(&mut whole.image, at, &delta.image),
                    _ => _ = self.0.insert(*id, delta.clone()),
                }
            }
        }
        changes.free.iter().for_each(|id| _ = self.0.remove(id));
    }

    /// What makes all of them from nothing.
    pub fn all(&self) -> TexturesDelta {
        let mut all = TexturesDelta::default();
        all.set.extend(self.0.iter().map(|(id, delta)| (*id, [delta.clone()].into_iter().collect())));
        all
    }
}

/// Puts a part of an image in its place, which egui keeps within the whole.
fn put(ImageData::Color(whole): &mut ImageData, [x, y]: [usize; 2], ImageData::Color(part): &ImageData) {
    let whole = std::sync::Arc::make_mut(whole);
    let ([width, _], [part_width, _]) = (whole.size, part.size);
    for (row, pixels) in part.pixels.chunks_exact(part_width.max(1)).enumerate() {
        let first = (y + row) * width + x;
        whole.pixels[first..first + part_width].copy_from_slice(pixels);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Color32, ColorImage, TextureOptions};

    fn image(size: [usize; 2], level: u8) -> ColorImage {
        ColorImage::filled(size, Color32::from_gray(level))
    }

    /// A pass that does this to a texture.
    fn pass(mirror: &mut Mirror, id: u64, delta: Option<ImageDelta>) {
        let mut changes = TexturesDelta::default();
        match delta {
            Some(delta) => changes.set.entry(TextureId::Managed(id)).or_default().push(delta),
            None => _ = changes.free.insert(TextureId::Managed(id)),
        }
        mirror.follow(&changes);
        changes.clear();
    }

    #[test]
    fn parts_are_put_where_they_belong() {
        let mut mirror = Mirror::default();
        let options = TextureOptions::NEAREST;
        pass(&mut mirror, 0, Some(ImageDelta::full(image([4, 3], 1), options)));
        pass(&mut mirror, 1, Some(ImageDelta::full(image([2, 2], 9), options)));
        pass(&mut mirror, 0, Some(ImageDelta::partial([1, 1], image([2, 2], 7), options)));
        pass(&mut mirror, 1, None);
        let mut all = mirror.all();
        assert_eq!(all.set.len(), 1);
        let [delta] = &all.set[&TextureId::Managed(0)][..] else { panic!("one whole image") };
        let ImageData::Color(whole) = &delta.image;
        let levels: Vec<u8> = whole.pixels.iter().map(|pixel| pixel.r()).collect();
        assert_eq!((delta.pos, delta.options, whole.size), (None, options, [4, 3]));
        assert_eq!(levels, [1, 1, 1, 1, 1, 7, 7, 1, 1, 7, 7, 1]);
        all.clear();
        // Another size is another texture.
        pass(&mut mirror, 0, Some(ImageDelta::full(image([1, 1], 3), options)));
        let mut all = mirror.all();
        let ImageData::Color(whole) = &all.set[&TextureId::Managed(0)][0].image;
        assert_eq!(whole.size, [1, 1]);
        all.clear();
    }
}
