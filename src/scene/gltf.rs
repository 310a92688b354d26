//! glTF 2.0 in (.gltf and .glb).
