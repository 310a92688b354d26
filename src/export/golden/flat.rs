//! Values as plain numbers: the fields of structs in their order, vectors from x on, matrices column by column.

use glam::{DMat3, DVec2, DVec3};

/// What a shader function takes or gives, as numbers that have names.
pub(super) trait Flat: Clone {
    /// Visits all numbers in order, with their names, which begin with `name`.
    fn each(&mut self, name: &str, visit: &mut dyn FnMut(&str, &mut f64));

    /// The numbers.
    fn flat(&self) -> Vec<f64> {
        let mut numbers = Vec::new();
        self.clone().each("", &mut |_, number| numbers.push(*number));
        numbers
    }

    /// Their names.
    fn names(&self, name: &str) -> Vec<String> {
        let mut names = Vec::new();
        self.clone().each(name, &mut |name, _| names.push(name.to_owned()));
        names
    }

    /// The same with each number rounded to `f32`.
    fn rounded(mut self) -> Self {
        self.each("", &mut |_, number| *number = f64::from(*number as f32));
        self
    }
}

impl Flat for f64 {
    fn each(&mut self, name: &str, visit: &mut dyn FnMut(&str, &mut f64)) {
        visit(name, self);
    }
}

impl Flat for DVec2 {
    fn each(&mut self, name: &str, visit: &mut dyn FnMut(&str, &mut f64)) {
        visit(&member(name, "x"), &mut self.x);
        visit(&member(name, "y"), &mut self.y);
    }
}

impl Flat for DVec3 {
    fn each(&mut self, name: &str, visit: &mut dyn FnMut(&str, &mut f64)) {
        visit(&member(name, "x"), &mut self.x);
        visit(&member(name, "y"), &mut self.y);
        visit(&member(name, "z"), &mut self.z);
    }
}

impl Flat for DMat3 {
    fn each(&mut self, name: &str, visit: &mut dyn FnMut(&str, &mut f64)) {
        self.x_axis.each(&format!("{name}[0]"), visit);
        self.y_axis.each(&format!("{name}[1]"), visit);
        self.z_axis.each(&format!("{name}[2]"), visit);
    }
}

impl<T: Flat, const N: usize> Flat for [T; N] {
    fn each(&mut self, name: &str, visit: &mut dyn FnMut(&str, &mut f64)) {
        for (k, value) in self.iter_mut().enumerate() {
            value.each(&format!("{name}[{k}]"), visit);
        }
    }
}

/// The name of a member of what has the name `of`; that of a struct may be empty.
pub(super) fn member(of: &str, name: &str) -> String {
    if of.is_empty() { name.to_owned() } else { format!("{of}.{name}") }
}

/// A struct whose numbers are those of its fields.
macro_rules! flat {
    ($(#[$meta:meta])* $name:ident { $($field:ident: $type:ty),* $(,)? }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(super) struct $name {
            $(pub $field: $type),*
        }

        impl $crate::export::golden::flat::Flat for $name {
            fn each(&mut self, name: &str, visit: &mut dyn FnMut(&str, &mut f64)) {
                $(self.$field.each(&$crate::export::golden::flat::member(name, stringify!($field)), visit);)*
            }
        }
    };
}
pub(super) use flat;

#[cfg(test)]
mod tests {
    use super::*;

    flat!(Pair { v: DVec2, m: DMat3 });

    #[test]
    fn numbers_come_in_the_order_of_fields_and_columns() {
        let m = DMat3::from_cols_array(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 0.1]);
        let pair = Pair { v: DVec2::new(-1.0, -2.0), m };
        assert_eq!(pair.flat(), [-1.0, -2.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 0.1]);
        let names = pair.names("");
        assert_eq!((&*names[1], &*names[2], &*names[10]), ("v.y", "m[0].x", "m[2].z"));
        assert_eq!(pair.names("pair")[0], "pair.v.x");
        assert_eq!(pair.rounded().m.z_axis.z, f64::from(0.1_f32));
    }
}
