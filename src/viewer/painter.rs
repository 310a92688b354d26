//! What draws the window, on a thread of its own, so that the window answers however long a frame takes.

use std::sync::Arc;

use super::ViewerError;
use super::frame::Frame;
use super::native;
use super::order::{Order, Report, Shot, Work};
use super::picture::Picture;
use super::sheet::Tile;
use crate::renderer::Gpu;
use crate::table::SheenTable;

/// The device, and what is on it.
pub(super) struct Painter {
    gpu: Gpu,
    frame: Frame,
    context: egui::Context,
    table: Arc<SheenTable>,
    picture: Option<Picture>,
}

impl Painter {
    /// `context` is that of the passes whose shapes orders bring.
    pub fn new(gpu: Gpu, frame: Frame, context: egui::Context, table: Arc<SheenTable>) -> Self {
        Self { gpu, frame, context, table, picture: None }
    }

    /// Does what is asked for, and says what became of it.
    pub fn obey(&mut self, order: Order) -> Result<Report, ViewerError> {
        let Order { size, place, pixels_per_point, shapes, mut textures, dropped, shot, work, stale, announced } =
            order;
        self.frame.resize(&self.gpu, size);
        self.frame.update_textures(&self.gpu, std::mem::take(&mut textures.0));
        dropped.into_iter().for_each(|id| self.frame.remove_texture(id));
        if let Some(shapes) = shapes {
            self.frame.take(self.context.tessellate(shapes, pixels_per_point), pixels_per_point);
        }
        let mut report = Report::default();
        let Some(shot) = shot else {
            self.present(None, place, &mut report)?;
            return Ok(report);
        };
        // Another scene's goes before this one's comes: there may be no room for both.
        self.picture.take_if(|picture| !picture.is_of(&shot));
        if announced {
            self.present(Some(&shot), place, &mut report)?;
        }
        match work {
            Work::Frame => self.draw(&shot, place, (stale, announced), &mut report)?,
            Work::Present => self.present(Some(&shot), place, &mut report)?,
            Work::Tile(index, size) => self.tile(&shot, index, size, &mut report)?,
        }
        if let Some(picture) = &self.picture {
            picture.tell(&shot, &mut report);
        }
        Ok(report)
    }

    /// Draws what there is to draw of the picture, and presents it.
    fn draw(
        &mut self,
        shot: &Shot,
        place: egui::Rect,
        (stale, announced): (bool, bool),
        report: &mut Report,
    ) -> Result<(), ViewerError> {
        let in_pixels = self.frame.in_pixels(place);
        let picture = match &mut self.picture {
            Some(picture) => picture,
            None if !announced => {
                report.about_to = Some("preparing the scene");
                return Ok(());
            }
            None => {
                let format = self.frame.format(&self.gpu)?;
                match Picture::new(&self.gpu, format, &self.table, shot) {
                    Ok(picture) => self.picture.insert(picture),
                    Err(error) => {
                        report.refused = Some(error);
                        return Ok(());
                    }
                }
            }
        };
        picture.receive(&self.gpu, shot, [in_pixels.width, in_pixels.height])?;
        report.about_to = picture.about_to(shot).filter(|_| !announced);
        if report.about_to.is_none() && (picture.advance(&self.gpu, shot, report)? || stale) {
            self.present(Some(shot), place, report)?;
        }
        Ok(())
    }

    /// Shows the picture as far as it has come, and egui's part.
    fn present(&mut self, shot: Option<&Shot>, place: egui::Rect, report: &mut Report) -> Result<(), ViewerError> {
        let canvas = match self.frame.begin(&self.gpu)? {
            Ok(canvas) => canvas,
            Err(unseen) => {
                report.unseen = Some(unseen);
                return Ok(());
            }
        };
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let output = (&canvas.view, self.frame.in_pixels(place));
        let is_drawn = match (shot, &mut self.picture) {
            (Some(shot), Some(picture)) => picture.show(&self.gpu, &mut encoder, output, (shot, report.metered)),
            _ => false,
        };
        self.frame.end(&self.gpu, encoder, canvas, is_drawn);
        // Never more than one frame ahead, so that a slow driver still answers to the latest drag.
        native::finish(&self.gpu);
        Ok(())
    }

    /// One picture of the sheet.
    fn tile(&mut self, shot: &Shot, index: usize, size: [u32; 2], report: &mut Report) -> Result<(), ViewerError> {
        if let Some(picture) = &mut self.picture {
            let (texture, view) = self.frame.add_texture(&self.gpu, size);
            picture.aside(&self.gpu, (&view, size), shot)?;
            report.tile = Some((index, Tile { texture, size }));
        }
        Ok(())
    }
}
