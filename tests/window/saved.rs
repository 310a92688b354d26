//! The state, as the program has saved it.

/// What the program has saved of its state.
pub struct State(pub String);

impl State {
    /// The text after a key.
    pub fn get(&self, key: &str) -> Option<&str> {
        self.0.lines().find_map(|line| line.strip_prefix(key)?.trim_start().strip_prefix('=')).map(str::trim)
    }

    /// The numbers after a key, one or in brackets.
    pub fn numbers(&self, key: &str) -> Vec<f64> {
        let list = self.get(key).unwrap_or_else(|| panic!("no {key} in\n{}", self.0));
        list.trim_matches(['[', ']']).split(',').map(|number| number.trim().parse().unwrap()).collect()
    }

    pub fn number(&self, key: &str) -> f64 {
        self.numbers(key)[0]
    }

    /// Whether the view is another than the file's.
    pub fn has_view(&self) -> bool {
        self.0.contains("[view]")
    }
}
