//! On a device.

mod outline;
mod traversal;
