//! Pictures that are saved: how, where, and how far one is that is being drawn.

mod bar;
mod form;
mod settings;

pub use bar::show as show_bar;
pub use form::{Form, show as show_form};
pub use settings::{LONGEST, MOST_SAMPLES, Settings, extension};

/// What the window knows of pictures that are saved.
#[derive(Default)]
pub struct Saving {
    /// As the last one was, in an earlier run too.
    pub last: Settings,
    /// What the box says, while it is open.
    pub form: Option<Form>,
    /// How far the one is that is being saved.
    pub progress: Option<Progress>,
    /// The longest side that the device draws, in pixels; none before it is known.
    pub longest: Option<u32>,
}

impl Saving {
    /// Opens the box; one that is open already stays as it is.
    pub fn open(&mut self) {
        if self.form.is_none() {
            self.form = Some(Form::new(&self.last));
        }
    }

    /// The longest side that can be asked for, in pixels.
    pub fn longest(&self) -> u32 {
        // What every device draws.
        self.longest.unwrap_or(2048)
    }
}

/// A picture that is wanted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wish {
    pub settings: Settings,
    /// Without its folder; none for the first of `velour-001` to `velour-999` that is free.
    pub name: Option<String>,
}

/// How far a picture is that is being saved.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// What its file will be called.
    pub name: String,
    /// What is being done.
    pub doing: &'static str,
    /// The share that is done, in [0, 1].
    pub share: f32,
    /// How many are to be saved after it.
    pub waiting: usize,
}
