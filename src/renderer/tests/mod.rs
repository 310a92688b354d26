//! On a device.

mod enlargement;
mod outline;
mod reprojection;
mod traversal;
