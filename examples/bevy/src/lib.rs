// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! Velour's sheen in Bevy, under rectangle lights. `sheen` is what to copy.

pub mod cloth;
pub mod headless;
pub mod panel;
pub mod sheen;
pub mod velvet;
