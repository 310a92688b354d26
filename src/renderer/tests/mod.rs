//! On a device.

mod enlargement;
mod numbers;
mod outline;
mod reprojection;
mod traversal;
