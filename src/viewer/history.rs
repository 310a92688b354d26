//! Undo and redo: the edits after each change of the user's, a drag being one change. Where the scene is seen from is no
//! part of it: undoing never moves the view.

use egui::Context;

use crate::scene::{Carrier, Edits};

/// Most steps that can be undone.
const MOST: usize = 1000;

/// The edits as they were, and as they were before something was undone.
pub struct History {
    /// At least one.
    steps: Vec<Step>,
    /// The one that is shown.
    now: usize,
}

/// The edits after a change.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Whose camera is of no account.
    pub edits: Edits,
    /// What metering took, where the exposure is automatic.
    pub metered: Option<f32>,
}

impl History {
    /// These edits are the first step.
    pub fn new(edits: &Edits) -> Self {
        Self { steps: vec![Step { edits: edits.clone(), metered: None }], now: 0 }
    }

    /// Keeps what the user has made of the edits as a step, where it differs from the step before. What had been undone is
    /// then forgotten. What metering takes is no change, but belongs to the step.
    pub fn keep(&mut self, edits: &Edits, metered: Option<f32>) {
        let shown = &mut self.steps[self.now];
        shown.edits.camera = edits.camera;
        if shown.edits == *edits {
            shown.metered = metered;
            return;
        }
        self.steps.truncate(self.now + 1);
        self.steps.push(Step { edits: edits.clone(), metered });
        self.steps.drain(..self.steps.len().saturating_sub(MOST + 1));
        self.now = self.steps.len() - 1;
    }

    /// The same steps of another version of the scene. What has nothing to apply to there is no change any more.
    pub fn carried(&self, carrier: &Carrier) -> Self {
        let mut steps: Vec<Step> = Vec::new();
        let mut now = 0;
        for (index, step) in self.steps.iter().enumerate() {
            let step = Step { edits: carrier.carry(&step.edits).0, metered: step.metered };
            let is_other = steps.last().is_none_or(|last| *last != step);
            steps.extend(is_other.then_some(step));
            if index == self.now {
                now = steps.len() - 1;
            }
        }
        Self { steps, now }
    }

    /// Whether there is a step before this one.
    pub fn can_undo(&self) -> bool {
        self.now > 0
    }

    /// Whether a step has been undone.
    pub fn can_redo(&self) -> bool {
        self.now + 1 < self.steps.len()
    }

    /// Goes a step back; none where there is none.
    pub fn undo(&mut self) -> Option<&Step> {
        self.can_undo().then(|| {
            self.now -= 1;
            &self.steps[self.now]
        })
    }

    /// Goes a step on again; none where there is none.
    pub fn redo(&mut self) -> Option<&Step> {
        self.can_redo().then(|| {
            self.now += 1;
            &self.steps[self.now]
        })
    }
}

/// Whether a change has come to its end: nothing is held or typed.
pub fn is_settled(context: &Context) -> bool {
    !context.input(|input| input.pointer.any_down()) && !context.text_edit_focused()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Exposure;
    use crate::scene::CameraEdit;

    fn exposed(stops: f32) -> Edits {
        Edits { exposure: Some(stops.into()), ..Edits::default() }
    }

    #[test]
    fn steps_are_undone_and_done_again() {
        let mut history = History::new(&Edits::default());
        assert!(history.undo().is_none() && history.redo().is_none());
        for stops in [1.0, 2.0, 2.0, 3.0] {
            history.keep(&exposed(stops), None);
        }
        let edits = |step: Option<&Step>| step.map(|step| step.edits.clone());
        assert_eq!(edits(history.undo()), Some(exposed(2.0)));
        assert_eq!(edits(history.undo()), Some(exposed(1.0)));
        assert_eq!(edits(history.undo()), Some(Edits::default()));
        assert!(!history.can_undo() && history.undo().is_none());
        assert_eq!(edits(history.redo()), Some(exposed(1.0)));
        assert_eq!(edits(history.redo()), Some(exposed(2.0)));
        // What is seen again is no change.
        history.keep(&exposed(2.0), None);
        assert!(history.can_redo());
        history.keep(&exposed(5.0), None);
        assert!(!history.can_redo() && history.redo().is_none());
        assert_eq!(edits(history.undo()), Some(exposed(2.0)));
    }

    #[test]
    fn the_camera_is_no_change() {
        let mut history = History::new(&Edits::default());
        history.keep(&Edits { camera: Some(CameraEdit::Loaded(1)), ..Edits::default() }, None);
        assert!(!history.can_undo());
        history.keep(&Edits { camera: Some(CameraEdit::Loaded(1)), ..exposed(1.0) }, None);
        history.keep(&Edits { camera: Some(CameraEdit::Loaded(2)), ..exposed(1.0) }, None);
        assert!(history.undo().is_some() && !history.can_undo());
        // Nor does a view that is turned meanwhile make what was undone be forgotten.
        history.keep(&Edits { camera: Some(CameraEdit::Loaded(3)), ..Edits::default() }, None);
        assert!(history.can_redo());
    }

    #[test]
    fn an_automatic_exposure_comes_back_as_it_was_metered() {
        let mut history = History::new(&Edits::default());
        let auto = Edits { exposure: Some(Exposure::Auto), ..Edits::default() };
        history.keep(&auto, None);
        history.keep(&auto, Some(-3.0));
        history.keep(&exposed(1.0), Some(-3.0));
        assert_eq!(history.undo(), Some(&Step { edits: auto, metered: Some(-3.0) }));
    }

    #[test]
    fn so_many_steps_and_no_more() {
        let mut history = History::new(&Edits::default());
        (0..1500).for_each(|step| history.keep(&exposed(step as f32), None));
        let undone = std::iter::from_fn(|| history.undo().cloned()).last();
        assert_eq!(undone.map(|step| step.edits), Some(exposed(499.0)));
        assert_eq!(std::iter::from_fn(|| history.redo().map(|_| ())).count(), MOST);
    }
}
