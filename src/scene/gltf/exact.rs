//! Numbers of the file whose 64 bits count, which `Root` rounds to 32: places, and ranges that are compared.

use serde::Deserialize;

/// What is read besides `Root`; lists are as long as those in it.
#[derive(Default, Deserialize)]
#[serde(default)]
pub struct Exact {
    pub nodes: Vec<Node>,
    pub cameras: Vec<Camera>,
}

/// The transform of a node.
#[derive(Deserialize)]
pub struct Node {
    pub matrix: Option<[f64; 16]>,
    pub translation: Option<[f64; 3]>,
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
}

/// The projections of a camera.
#[derive(Deserialize)]
pub struct Camera {
    pub perspective: Option<Perspective>,
    pub orthographic: Option<Orthographic>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Perspective {
    pub aspect_ratio: Option<f64>,
    pub yfov: f64,
    pub znear: f64,
    pub zfar: Option<f64>,
}

#[derive(Deserialize)]
pub struct Orthographic {
    pub xmag: f64,
    pub ymag: f64,
    pub znear: f64,
    pub zfar: f64,
}
