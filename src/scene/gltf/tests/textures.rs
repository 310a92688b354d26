//! Samplers, and which image a texture shows.

use image::ImageFormat;
use serde_json::{Value, json};

use super::builder::{Builder, picture, read};
use crate::scene::{Filter, Sampler, TextureSlot, Wrap};

/// The studio with images of 1, 2, ... texels, as many as there are textures, and these textures in a material's slots.
fn with_textures(textures: &[Value]) -> Builder {
    let mut file = Builder::textured_studio();
    for (index, texture) in textures.iter().enumerate() {
        file.texture(&picture(ImageFormat::Png, index as u32 + 1, 1));
        file.json["textures"][index] = texture.clone();
    }
    let names = ["normalTexture", "occlusionTexture", "emissiveTexture"];
    for (index, name) in names.iter().take(textures.len()).enumerate() {
        file.json["materials"][0][name] = json!({ "index": index });
    }
    file
}

#[test]
fn samplers_are_read() {
    let default = Sampler::DEFAULT;
    for (json, expected) in [
        (json!({}), default),
        (json!({ "wrapS": 33071, "wrapT": 33648 }), Sampler { wrap: [Wrap::Clamp, Wrap::Mirror], ..default }),
        (json!({ "wrapS": 10497, "magFilter": 9728 }), Sampler { magnify: Filter::Nearest, ..default }),
        (json!({ "minFilter": 9728 }), Sampler { minify: Filter::Nearest, mipmaps: None, ..default }),
        (json!({ "minFilter": 9729 }), Sampler { mipmaps: None, ..default }),
        (json!({ "minFilter": 9984 }), Sampler { minify: Filter::Nearest, mipmaps: Some(Filter::Nearest), ..default }),
        (json!({ "minFilter": 9985 }), Sampler { mipmaps: Some(Filter::Nearest), ..default }),
        (json!({ "minFilter": 9986 }), Sampler { minify: Filter::Nearest, ..default }),
        (json!({ "minFilter": 9987, "magFilter": 9729 }), default),
    ] {
        let mut file = with_textures(&[json!({ "source": 0, "sampler": 0 })]);
        file.push("samplers", json.clone());
        let scene = file.read();
        let texture = scene.materials[0].texture(TextureSlot::Normal).unwrap();
        assert_eq!(scene.textures[texture.texture].sampler, expected, "{json}");
    }
    assert_eq!(with_textures(&[json!({ "source": 0 })]).read().textures[0].sampler, default);
}

#[test]
fn samplers_that_are_none() {
    for member in ["wrapS", "wrapT", "minFilter", "magFilter"] {
        for (value, place) in
            [(json!(7), "sampler 1 \"grain\""), (json!(10497 + (1_u64 << 32)), member), (json!("x"), "samplers[1]")]
        {
            let mut file = with_textures(&[]);
            file.json["samplers"] = json!([{}, { "name": "grain" }]);
            file.json["samplers"][1][member] = value;
            let error = read(&file.glb()).unwrap_err();
            assert!(error.contains(place) && error.lines().count() == 1, "{error}");
        }
    }
}

#[test]
fn what_is_used_is_read_and_no_more() {
    // The first is not used, the second and third show the same image, once with a sampler of its own.
    let mut file =
        with_textures(&[json!({ "source": 0 }), json!({ "source": 2 }), json!({ "source": 2, "sampler": 0 })]);
    file.push("samplers", json!({ "wrapS": 33071 }));
    file.json["materials"][0].as_object_mut().unwrap().remove("normalTexture");
    // Nobody looks at what it is.
    let view = file.view(b"no image at all");
    file.json["images"][0]["bufferView"] = json!(view);
    let scene = file.read();
    assert_eq!((scene.textures.len(), scene.images.len()), (2, 1));
    assert_eq!((scene.images[0].width, scene.images[0].height), (3, 1));
    let material = &scene.materials[0];
    let [occlusion, emission] =
        [TextureSlot::Occlusion, TextureSlot::Emission].map(|slot| material.texture(slot).unwrap());
    assert_eq!(scene.textures[occlusion.texture].sampler, Sampler::DEFAULT);
    assert_eq!(scene.textures[emission.texture].sampler.wrap[0], Wrap::Clamp);
}

#[test]
fn formats_that_are_served_go_before_the_source_and_others_do_not() {
    let extension = |name: &str, source: u32| json!({ name: { "source": source } });
    let file = with_textures(&[
        json!({ "source": 0, "extensions": extension("EXT_texture_webp", 1) }),
        json!({ "source": 2, "extensions": extension("EXT_texture_avif", 0) }),
        json!({ "source": 2, "extensions": extension("KHR_texture_basisu", 0) }),
    ]);
    let scene = file.read();
    let width = |slot| {
        let texture = scene.materials[0].texture(slot).unwrap();
        scene.images[scene.textures[texture.texture].image].width
    };
    let slots = [TextureSlot::Normal, TextureSlot::Occlusion, TextureSlot::Emission];
    assert_eq!(slots.map(width), [2, 3, 1]);
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
}

#[test]
fn textures_without_an_image_are_left_out() {
    let avif = json!({ "EXT_texture_avif": { "source": 0 } });
    let mut file = with_textures(&[json!({ "extensions": avif }), json!({ "name": "grain" }), json!({ "source": 2 })]);
    let scene = file.read();
    assert_eq!(
        scene.notices,
        [
            "textures in formats that are not served are left out: EXT_texture_avif of texture 0",
            "textures without an image are left out: texture 1 \"grain\"",
        ]
    );
    let material = &scene.materials[0];
    assert_eq!(TextureSlot::ALL.into_iter().filter(|&slot| material.texture(slot).is_some()).count(), 1);
    assert_eq!((scene.textures.len(), scene.images.len()), (1, 1));
    file.json["extensionsRequired"] = json!(["EXT_texture_avif"]);
    assert!(read(&file.glb()).unwrap_err().contains("requires EXT_texture_avif"));
}

#[test]
fn textures_that_name_what_is_not_there() {
    let webp = |value: Value| json!({ "source": 0, "extensions": { "EXT_texture_webp": value } });
    for (texture, what) in [
        (json!({ "source": 1 }), "texture 0: there is no image 1"),
        (json!({ "source": 1_u64 << 32 }), "source: the index 4294967296 is out of range"),
        (json!({ "source": 0, "sampler": 0 }), "texture 0: there is no sampler 0"),
        (webp(json!({ "source": 1 })), "texture 0: EXT_texture_webp: there is no image 1"),
        (webp(json!({ "source": -1 })), "texture 0: EXT_texture_webp: source"),
        (webp(json!({})), "texture 0: EXT_texture_webp: missing field `source`"),
        (webp(json!(0)), "texture 0: EXT_texture_webp must be an object"),
    ] {
        let error = read(&with_textures(&[texture]).glb()).unwrap_err();
        assert!(error.contains(what) && error.lines().count() == 1, "{error}");
    }
}

#[test]
fn an_emissive_texture_dims_the_light() {
    let mut file = with_textures(&[json!({ "source": 0 })]);
    file.json["materials"][1]["emissiveTexture"] = json!({ "index": 0 });
    let scene = file.read();
    // The one texel is 0, 0, 100, sRGB.
    let radiance = scene.lights[0].radiance;
    assert!(radiance.abs_diff_eq(glam::Vec3::new(0.0, 0.0, 4.0 * 0.127_438), 1e-5), "{radiance}");
    assert_eq!(scene.materials[1].emission, glam::Vec3::splat(4.0));
}
