//! Images of all kinds, whole and broken.

use std::fs;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use image::{DynamicImage, GrayAlphaImage, GrayImage, ImageBuffer, ImageFormat, Luma, LumaA, Rgb, Rgba, RgbaImage};
use serde_json::json;

use super::builder::{Builder, encoded, picture, read};
use crate::scene::gltf::{Options, load};
use crate::scene::{Image, Scene};

/// The studio with this image in a texture of its felt.
fn with_image(bytes: &[u8]) -> Builder {
    let mut file = Builder::textured_studio();
    file.texture(bytes);
    file.json["images"][0]["name"] = json!("weave");
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": 0 });
    file
}

fn image(bytes: &[u8]) -> Image {
    let Scene { mut images, .. } = with_image(bytes).read();
    images.pop().unwrap()
}

fn error(bytes: &[u8]) -> String {
    let error = read(&with_image(bytes).glb()).expect_err("this is read");
    assert_eq!(error.lines().count(), 1, "{error}");
    error
}

/// A PNG file of these chunks.
fn png(chunks: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    for (kind, data) in chunks {
        let body = [&kind[..], data].concat();
        bytes.extend((data.len() as u32).to_be_bytes());
        bytes.extend(&body);
        bytes.extend(crc32fast::hash(&body).to_be_bytes());
    }
    bytes
}

/// The head of a PNG file.
fn ihdr(width: u32, height: u32, bits: u8, color: u8) -> Vec<u8> {
    [&width.to_be_bytes()[..], &height.to_be_bytes(), &[bits, color, 0, 0, 0]].concat()
}

/// zlib data that is stored as it is.
fn stored(data: &[u8]) -> Vec<u8> {
    let length = data.len() as u16;
    let (a, b) = data
        .iter()
        .fold((1u32, 0u32), |(a, b), &byte| ((a + u32::from(byte)) % 65521, (a + u32::from(byte) + b) % 65521));
    [&[0x78, 1, 1][..], &length.to_le_bytes(), &(!length).to_le_bytes(), data, &(b << 16 | a).to_be_bytes()].concat()
}

#[test]
fn every_kind_of_texel_becomes_four_bytes() {
    let grey = GrayImage::from_fn(2, 1, |x, _| Luma([10 + 20 * x as u8]));
    let grey_alpha = GrayAlphaImage::from_fn(2, 1, |x, _| LumaA([10 + 20 * x as u8, 7]));
    let rgba = RgbaImage::from_fn(2, 1, |x, _| Rgba([1, 2, 3 + x as u8, 4]));
    let rgb16 = ImageBuffer::from_fn(2, 1, |x, _| Rgb([257 * 9, 257 * 8 + 100, 65535 - x as u16]));
    let grey16 = ImageBuffer::from_fn(2, 1, |x, _| Luma([257 * 9 * x as u16]));
    for (kind, expected) in [
        (DynamicImage::from(grey), [[10, 10, 10, 255], [30, 30, 30, 255]]),
        (grey_alpha.into(), [[10, 10, 10, 7], [30, 30, 30, 7]]),
        (rgba.into(), [[1, 2, 3, 4], [1, 2, 4, 4]]),
        (DynamicImage::ImageRgb16(rgb16), [[9, 8, 255, 255], [9, 8, 255, 255]]),
        (DynamicImage::ImageLuma16(grey16), [[0, 0, 0, 255], [9, 9, 9, 255]]),
    ] {
        let read = image(&encoded(kind, ImageFormat::Png));
        assert_eq!((read.name.as_str(), read.width, read.height), ("weave", 2, 1));
        assert_eq!(read.texels, expected);
    }
    // Colours by number, the second of them half transparent; and one bit a texel.
    let chunks = |head: &[u8], data: &[u8]| {
        png(&[
            (b"IHDR", head),
            (b"PLTE", &[1, 2, 3, 4, 5, 6]),
            (b"tRNS", &[255, 128]),
            (b"IDAT", &stored(data)),
            (b"IEND", &[]),
        ])
    };
    let palette = image(&chunks(&ihdr(2, 1, 8, 3), &[0, 1, 0]));
    assert_eq!(palette.texels, [[4, 5, 6, 128], [1, 2, 3, 255]]);
    let bits = png(&[(b"IHDR", &ihdr(2, 1, 1, 0)), (b"IDAT", &stored(&[0, 0b0100_0000])), (b"IEND", &[])]);
    assert_eq!(image(&bits).texels, [[0, 0, 0, 255], [255, 255, 255, 255]]);
}

#[test]
fn the_bytes_tell_the_format_whatever_the_file_says() {
    for (format, tolerance) in [(ImageFormat::Png, 0), (ImageFormat::WebP, 0), (ImageFormat::Jpeg, 25)] {
        let read = image(&picture(format, 32, 16));
        assert_eq!((read.width, read.height), (32, 16));
        let exact = image(&picture(ImageFormat::Png, 32, 16));
        let channels = read.texels.as_flattened().iter().zip(exact.texels.as_flattened());
        let off = channels.map(|(read, exact)| read.abs_diff(*exact)).max().unwrap();
        assert!(off <= tolerance, "{format:?}: {off}");
        // Rows from the top.
        assert!(read.texels[0][1] < 30 && read.texels[15 * 32][1] > 200, "{format:?}");
    }
    assert_eq!(image(&picture(ImageFormat::Jpeg, 1, 1)).texels.len(), 1);
}

#[test]
fn images_beside_the_scene_and_in_its_uris() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = picture(ImageFormat::Png, 3, 2);
    let load_with = |uri: &str| {
        let mut file = with_image(&bytes);
        file.json["images"] = json!([{ "uri": uri, "name": "weave" }]);
        let path = folder.path().join("scene.gltf");
        fs::write(&path, file.gltf()).unwrap();
        load(&path, &Options::default()).map_err(|error| error.to_string())
    };
    fs::write(folder.path().join("two words.png"), &bytes).unwrap();
    fs::write(folder.path().join("text.png"), "a weave").unwrap();
    let data = format!("data:image/jpeg;base64,{}", STANDARD.encode(&bytes));
    for uri in ["two%20words.png", "two words.png", data.as_str()] {
        assert_eq!(load_with(uri).unwrap().images, [image(&bytes)], "{uri}");
    }
    for (uri, what) in [
        ("gone.png", "gone.png: can't be read"),
        ("text.png", "is no PNG, JPEG, WebP or KTX 2.0 image"),
        ("../weave.png", "leads out of the scene's folder"),
        ("https://example.com/weave.png", "scheme"),
        (".", "is a folder"),
        ("data:image/png;base64,AAAA", "is no PNG, JPEG, WebP or KTX 2.0 image"),
    ] {
        let error = load_with(uri).unwrap_err();
        assert!(error.contains("scene.gltf: image 0 \"weave\": ") && error.contains(what), "{uri}: {error}");
        assert_eq!(error.lines().count(), 1, "{error}");
    }
    let mut file = with_image(&bytes);
    file.json["images"] = json!([{}]);
    assert!(read(&file.glb()).unwrap_err().contains("image 0: has neither a uri nor a bufferView"));
    file.json["images"] = json!([{ "uri": "weave.png" }]);
    assert!(read(&file.glb()).unwrap_err().contains("image 0: its URI 'weave.png' names a file"));
}

#[test]
fn images_that_are_cut_short() {
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::WebP] {
        let bytes = picture(format, 40, 30);
        let step = (bytes.len() / 40).max(1);
        for length in (12..bytes.len() - 12).step_by(step) {
            let error = error(&bytes[..length]);
            assert!(error.contains("image 0 \"weave\": is "), "{format:?} {length}: {error}");
        }
    }
    for bytes in [
        &b"x"[..],
        b"\x89PNG\r\n\x1a\n",
        b"\xff\xd8\xff",
        b"RIFF\x04\0\0\0WEBP",
        b"GIF89a",
        b"\xabKTX 20\xbb\r\n\x1a\n",
    ] {
        error(bytes);
    }
}

#[test]
fn images_larger_than_memory_are_refused_by_their_heads() {
    for (width, height) in [(100_000, 100_000), (u32::MAX >> 1, 1), (1, 16_385)] {
        let bytes = png(&[(b"IHDR", &ihdr(width, height, 8, 6)), (b"IDAT", &stored(&[0; 8])), (b"IEND", &[])]);
        let error = error(&bytes);
        assert!(error.contains("image 0 \"weave\": is "), "{error}");
    }
    // Each may be, all together may not.
    let bytes = png(&[(b"IHDR", &ihdr(8192, 8192, 8, 6)), (b"IDAT", &stored(&[0; 8])), (b"IEND", &[])]);
    let mut file = Builder::textured_studio();
    let slots = ["normalTexture", "occlusionTexture", "emissiveTexture"];
    for (index, slot) in slots.into_iter().enumerate() {
        file.texture(&bytes);
        file.json["materials"][0][slot] = json!({ "index": index });
        file.texture(&bytes);
        file.json["materials"][1][slot] = json!({ "index": index + 1 });
    }
    for (index, texture) in file.json["textures"].as_array_mut().unwrap().iter_mut().enumerate() {
        texture["source"] = json!(index);
    }
    file.json["materials"][1]["normalTexture"]["index"] = json!(3);
    file.json["materials"][1]["occlusionTexture"]["index"] = json!(4);
    let error = read(&file.glb()).unwrap_err();
    assert!(error.contains("image 4: the images up to here hold 335544320 texels"), "{error}");
}

/// The felt's material, whose members of these names have the image of these bytes as their texture, is read.
fn shown_as(members: &[&str], bytes: &[u8]) -> Scene {
    let mut file = with_image(bytes);
    file.json["materials"][0]["pbrMetallicRoughness"] = json!({});
    for member in members {
        file.set(&format!("/materials/0/{member}"), json!({ "index": 0 }));
    }
    file.read()
}

#[test]
fn large_images_are_halved_with_one_notice() {
    // Sides are odd: texels that lie on the border of two of the half count in both by their areas.
    let columns = |x: u32| if x == 0 || x == 8192 { 150 } else { 0 };
    let lines = GrayImage::from_fn(8193, 3, |x, y| Luma([columns(x) + 90 * (y % 2) as u8]));
    let bytes = encoded(lines.into(), ImageFormat::Png);
    let scene = shown_as(&["pbrMetallicRoughness/metallicRoughnessTexture"], &bytes);
    assert_eq!(scene.notices, ["images of more than 8192 texels a side are reduced: image 0 \"weave\""]);
    let image = &scene.images[0];
    assert_eq!((image.width, image.height), (4096, 1));
    // 30 is a third of 90; the outer columns cover 4096 of the 8193 parts of their texels: 150 * 4096 / 8193 = 74.99.
    assert_eq!([0, 1, 2048, 4095].map(|at| image.texels[at][0]), [105, 30, 30, 105]);
    assert_eq!(image.texels[0][3], 255);
}

#[test]
fn large_images_are_halved_in_linear_light() {
    const BASE_COLOR: &str = "pbrMetallicRoughness/baseColorTexture";
    const SHEEN_COLOR: &str = "extensions/KHR_materials_sheen/sheenColorTexture";
    const SHEEN_ROUGHNESS: &str = "extensions/KHR_materials_sheen/sheenRoughnessTexture";
    let checker = GrayAlphaImage::from_fn(8194, 2, |x, y| LumaA([255 * ((x + y) % 2) as u8; 2]));
    let bytes = encoded(checker.into(), ImageFormat::Png);
    for (members, expected) in [
        // Half the light is 188 in sRGB; numbers, opacity among them, have their plain mean.
        (&[BASE_COLOR][..], [188, 188, 188, 128]),
        (&["emissiveTexture"], [188, 188, 188, 128]),
        (&["occlusionTexture"], [128; 4]),
        (&["normalTexture"], [128; 4]),
        (&[SHEEN_ROUGHNESS], [128; 4]),
        // One image for both, as the extension has it.
        (&[SHEEN_ROUGHNESS, SHEEN_COLOR], [188, 188, 188, 128]),
        (&[SHEEN_COLOR, "occlusionTexture"], [188, 188, 188, 128]),
    ] {
        let image = &shown_as(members, &bytes).images[0];
        assert_eq!((image.width, image.height), (4097, 1));
        assert!(image.texels.iter().all(|texel| *texel == expected), "{members:?}: {:?}", image.texels[0]);
    }
}
