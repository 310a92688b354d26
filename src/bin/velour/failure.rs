//! How a run ends that does not succeed.

/// The exit code, and the line that says why.
pub struct Failure {
    pub code: u8,
    pub message: String,
}

impl Failure {
    /// A comparison or check fell short.
    pub fn check(message: impl ToString) -> Self {
        Self { code: 1, message: message.to_string() }
    }

    /// Bad usage or bad input.
    pub fn input(message: impl ToString) -> Self {
        Self { code: 2, message: message.to_string() }
    }

    /// No graphics device, or no display for a window.
    #[cfg(feature = "gpu")]
    pub fn device(message: impl ToString) -> Self {
        Self { code: 3, message: message.to_string() }
    }
}
