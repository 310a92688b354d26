//! A table's file in any form.

use super::form::Form;
use super::texture::Texture;
use super::{exr, ktx2, npy, source};

impl Texture {
    /// The file.
    pub fn file(&self, form: Form) -> Vec<u8> {
        match form {
            Form::Dds => self.dds.clone(),
            Form::Ktx2 => ktx2::write(self),
            Form::Csv => self.csv.clone().into_bytes(),
            Form::Npy => npy::write(self),
            Form::Exr => exr::write(self),
            Form::Bin => self.half_bytes(),
            Form::Js => source::js(self).into_bytes(),
            Form::C => source::c(self).into_bytes(),
            Form::Rust => source::rust(self).into_bytes(),
            Form::Glsl => source::glsl(self).into_bytes(),
        }
    }
}
