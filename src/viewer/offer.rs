//! Changes that an earlier run has left.

/// What is offered to the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Offer {
    /// A state as `--state` takes it.
    pub text: String,
    /// What there is to say of it.
    pub said: String,
}
