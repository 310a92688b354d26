//! On a device.

mod outline;
mod reprojection;
mod traversal;
