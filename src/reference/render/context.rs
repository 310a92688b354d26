//! What light meets in a scene, and how it is to be followed.

use super::error::ReferenceError;
use super::lights::Lights;
use super::models::Models;
use super::options::Options;
use super::world::World;
use crate::scene::{Scene, Settings};
use crate::table::SheenTable;

/// A scene as paths go through it.
pub(super) struct Context<'a> {
    pub world: World<'a>,
    pub lights: Lights<'a>,
    pub models: Models,
    pub settings: &'a Settings,
    pub options: Options,
}

impl<'a> Context<'a> {
    pub fn new(
        scene: &'a Scene,
        settings: &'a Settings,
        table: &SheenTable,
        options: Options,
    ) -> Result<Self, ReferenceError> {
        Ok(Self {
            world: World::new(scene, settings)?,
            lights: Lights::new(scene),
            models: Models::new(scene, settings, table, options.specular),
            settings,
            options,
        })
    }
}
