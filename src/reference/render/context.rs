//! What light meets in a scene, and how it is to be followed.

use super::error::ReferenceError;
use super::lights::Lights;
use super::models::Models;
use super::options::Options;
use super::world::World;
use crate::scene::{Drawn, Settings};
use crate::table::SheenTable;

/// A scene as paths go through it.
pub(super) struct Context<'a> {
    pub world: World<'a>,
    pub lights: Lights<'a>,
    pub models: Models,
    pub settings: Settings,
    pub options: Options,
}

impl<'a> Context<'a> {
    pub fn new(drawn: &'a Drawn, table: &SheenTable, options: Options) -> Result<Self, ReferenceError> {
        Ok(Self {
            world: World::new(drawn)?,
            lights: Lights::new(drawn),
            models: Models::new(drawn, table, options.specular),
            settings: drawn.settings,
            options,
        })
    }
}
