//! A scene that is quickly drawn.

use std::path::{Path, PathBuf};

/// A plate over a larger one, of felt, in the light of the rig, with shadows: few triangles, so that frames are quick.
pub fn plates(folder: &Path) -> PathBuf {
    let plate = |size: f32, height: f32| {
        let corner = |x: f32, z: f32| [size * x, height, size * z];
        let [a, b, c, d] = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
        [a, b, c, a, c, d]
    };
    let positions = [plate(1.0, 0.0), plate(0.5, 0.4)].concat();
    std::fs::write(folder.join("plates.bin"), bytemuck::cast_slice::<_, u8>(&positions)).unwrap();
    let path = folder.join("plates.gltf");
    std::fs::write(
        &path,
        r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "extensionsUsed": ["KHR_materials_sheen"],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
            "materials": [{"name": "felt", "doubleSided": true,
                "extensions": {"KHR_materials_sheen": {"sheenColorFactor": [1, 0.5, 0.4], "sheenRoughnessFactor": 0.5}}}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 12, "type": "VEC3", "min": [-1, 0, -1], "max": [1, 0.4, 1]}],
            "bufferViews": [{"buffer": 0, "byteLength": 144}], "buffers": [{"uri": "plates.bin", "byteLength": 144}]}"#,
    )
    .unwrap();
    path
}
