//! What there is to know of a scene, in a few numbers.

use super::native;
use crate::scene::Scene;

/// A row: what it is, how much of it there is, and what that counts.
pub type Fact = (&'static str, String, &'static str);

/// All rows.
pub fn of(scene: &Scene) -> Vec<Fact> {
    let drawn = |instance: &crate::scene::Instance| scene.meshes[instance.mesh].indices.len() / 3;
    let triangles = scene.instances.iter().map(drawn).sum();
    let texels = |image: &crate::scene::Image| u64::from(image.width) * u64::from(image.height);
    // Four bytes a texel, and a third more for the mipmaps.
    let memory = scene.images.iter().map(texels).sum::<u64>() * 16 / 3;
    let diagonal = scene.bounds().diagonal();
    let mut facts = vec![
        ("triangles", grouped(triangles), "Triangles that are drawn: those of a mesh count as often as it is placed."),
        (
            "meshes",
            format!("{}, placed {} times", grouped(scene.meshes.len()), grouped(scene.instances.len())),
            "Meshes of the file, each of one material.",
        ),
        ("materials", grouped(scene.materials.len()), "Materials of the file."),
        (
            "images",
            format!("{}, {}", grouped(scene.images.len()), bytes(memory)),
            "Images that materials look up, and the memory that they take on the device with their mipmaps.",
        ),
        (
            "lights",
            format!("{} of an area, {} without", scene.lights.len(), scene.punctual_lights.len()),
            "Lights of the file: polygons, and points, spots and suns, which have no extent.",
        ),
        ("size", format!("{diagonal:.3} m"), "The diagonal of the box around the scene, metres."),
    ];
    if let Some(length) = scene.files.first().and_then(|path| native::length(path)) {
        facts.push(("file", bytes(length), "How long the scene's file is, without those that it names."));
    }
    facts
}

/// A count with its thousands apart.
fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

fn bytes(count: u64) -> String {
    match count as f64 {
        count if count < 1e3 => format!("{count} bytes"),
        count if count < 1e6 => format!("{:.1} kB", count / 1e3),
        count if count < 1e9 => format!("{:.1} MB", count / 1e6),
        count => format!("{:.1} GB", count / 1e9),
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::scene;
    use super::*;
    use crate::scene::Image;

    #[test]
    fn a_mesh_counts_as_often_as_it_is_placed() {
        let mut scene = scene(1.0);
        let image = Image { name: String::new(), width: 512, height: 256, texels: vec![] };
        scene.images = vec![image; 3];
        let facts = of(&scene);
        let fact = |name: &str| facts.iter().find(|(found, ..)| *found == name).map(|(_, value, _)| value.as_str());
        assert_eq!(fact("triangles"), Some("2"));
        assert_eq!(fact("meshes"), Some("1, placed 2 times"));
        // 3 x 512 x 256 x 4 x 4/3 bytes.
        assert_eq!(fact("images"), Some("3, 2.1 MB"));
        assert_eq!(fact("lights"), Some("1 of an area, 0 without"));
        assert_eq!(fact("size"), Some("1.414 m"));
        assert_eq!(fact("file"), None);
    }

    #[test]
    fn numbers_are_grouped_and_scaled() {
        assert_eq!([0, 999, 1000, 1_234_567].map(grouped), ["0", "999", "1 000", "1 234 567"]);
        assert_eq!([999, 1000, 12_345_678, 3_000_000_000].map(bytes), ["999 bytes", "1.0 kB", "12.3 MB", "3.0 GB"]);
    }
}
