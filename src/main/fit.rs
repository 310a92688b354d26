use crate::{Failure, args::Fit};
pub fn fit(_arguments: &Fit) -> Result<(), Failure> {
    Ok(())
}
