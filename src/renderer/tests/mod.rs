//! On a device.

mod traversal;
