use super::*;
use crate::picture::ToneCurve;
use crate::scene::{
    Added, Camera, Layering, Light, LightEdits, LightShape, Lobes, Material, Polygon, PunctualEdits, PunctualKind,
    PunctualLight, PunctualShape, RoughnessMap, SheenModel,
};
use glam::{Mat4, Quat, Vec2, Vec3};

/// Materials, lights and cameras whose names repeat, are empty, are numbers, or need care.
fn scene() -> Scene {
    let names = ["velvet", "", "felt", "felt", "2", "a \"b\"\n= [c]"];
    let polygon = Polygon { contours: vec![vec![Vec3::ZERO, Vec3::X, Vec3::Y]], normal: Vec3::Z, pattern: None };
    let light = |name: &str| Light {
        name: name.to_owned(),
        radiance: Vec3::ONE,
        two_sided: false,
        polygons: vec![polygon.clone()],
        instance: 0,
        ..Light::default()
    };
    let projection = Projection::Perspective { yfov: 0.7, near: 0.1, far: 100.0 };
    let bulb = |name: &str| PunctualLight {
        name: name.to_owned(),
        kind: PunctualKind::Point { range: f32::INFINITY },
        intensity: Vec3::ONE,
        position: Vec3::ZERO,
        direction: Vec3::NEG_Z,
    };
    let camera = |name: &str| Camera { name: name.to_owned(), world_from_camera: Mat4::IDENTITY, projection };
    Scene {
        materials: names.map(|name| Material::matte(name, Vec3::ONE)).to_vec(),
        lights: ["key", "", "key"].map(light).to_vec(),
        punctual_lights: ["bulb", "bulb"].map(bulb).to_vec(),
        cameras: ["eye", "eye", "1"].map(camera).to_vec(),
        ..Scene::default()
    }
}

/// Edits in which everything that can be set is set.
fn full() -> Edits {
    let material = MaterialEdits {
        sheen: Some(false),
        alpha: Some(0.3),
        sheen_weight: Some(0.25),
        sheen_color: Some(Vec3::new(0.1, 1.0 / 3.0, 1.0)),
        roughness_map: Some(RoughnessMap::Sqrt),
        sheen_model: Some(SheenModel::ContyKulla),
        layering: Some(Layering::Manual(0.7)),
        base_color: Some(Vec3::new(1e-7, 0.0, 0.123_456_79)),
        metallic: Some(1.0),
        roughness: Some(f32::EPSILON),
    };
    let light = LightEdits {
        radiance: Some(Vec3::new(1e30, 16_777_216.0, 0.1)),
        strength: Some(0.0),
        temperature: Some(2700.5),
        power: Some(1e-7),
        position: Some(Vec3::new(-1e-30, 1e9, -2.5)),
        rotation: Some(Quat::from_rotation_y(1.1)),
        size: Some(Vec2::new(0.1, 1e6)),
        two_sided: Some(true),
        on: Some(false),
        solo: Some(true),
        removed: Some(false),
    };
    let punctual = PunctualEdits {
        intensity: Some(Vec3::new(0.1, 0.2, 1e9)),
        strength: Some(1.0 / 3.0),
        temperature: Some(40000.0),
        power: Some(0.0),
        position: Some(Vec3::new(0.1, -1e9, 0.0)),
        direction: Some(Vec3::new(0.0, -3.0, 1e-3)),
        range: Some(f32::INFINITY),
        inner: Some(0.0),
        outer: Some(1.5),
        on: Some(true),
        solo: Some(false),
        removed: Some(true),
    };
    let shapes = [LightShape::Rectangle, LightShape::Disk, LightShape::Polygon(7), LightShape::Copy(2)];
    let added = |shape| Added { name: format!("a \"{shape:?}\""), shape, changes: light };
    let bare = |shape| Added { name: String::new(), shape, changes: PunctualEdits::default() };
    use PunctualShape::{Copy, Directional, Point, Spot};
    let orbit = Orbit {
        target: Vec3::new(0.1, -0.2, 3e8),
        azimuth: 6.234_567,
        elevation: -Orbit::STEEPEST,
        distance: 1e-9,
        projection: Projection::Perspective { yfov: 0.6, near: 1e-5, far: f32::INFINITY },
    };
    Edits {
        lobes: Some(Lobes { sheen: true, ..Lobes::NONE }),
        lights_visible: Some(false),
        shadows: Some(false),
        ambient: Some(Vec3::new(0.1, 0.2, 0.3)),
        ambient_strength: Some(1.5),
        exposure: Some((-2.0).into()),
        tone: Some(ToneCurve::Agx),
        camera: Some(CameraEdit::Orbit(orbit)),
        every_material: material,
        materials: (0..6).map(|index| (index, MaterialEdits { alpha: Some(index as f32 / 7.0), ..material })).collect(),
        lights: (0..3).map(|index| (index, light)).collect(),
        added_lights: shapes.map(added).to_vec(),
        punctual: (0..2).map(|index| (index, punctual)).collect(),
        added_punctual: [Point, Spot, Directional, Copy(1)].map(bare).to_vec(),
    }
}

fn read(text: &str) -> Result<Edits, String> {
    Edits::from_text(text, &scene()).map_err(|error| error.to_string())
}

#[test]
fn what_is_written_is_read_back_to_the_last_bit() {
    let orthographic = Projection::Orthographic { ymag: 2.5, near: 0.0, far: 1e6 };
    let orbit = Orbit::new(&scene().cameras[0], Vec3::ONE);
    let with = |camera| Edits { camera: Some(camera), ..full() };
    for edits in [
        Edits::default(),
        full(),
        with(CameraEdit::Loaded(0)),
        with(CameraEdit::Loaded(1)),
        with(CameraEdit::Loaded(2)),
        with(CameraEdit::Orbit(Orbit { projection: orthographic, ..orbit })),
    ] {
        let text = edits.to_text(&scene());
        assert_eq!(read(&text).as_ref(), Ok(&edits), "{text}");
    }
    assert_eq!(Edits::default().to_text(&scene()), "");
}

#[test]
fn a_file_reads_like_the_flags() {
    let velvet = MaterialEdits { alpha: Some(0.7), layering: Some(Layering::Manual(0.5)), ..MaterialEdits::default() };
    let edits = Edits {
        exposure: Some(0.5.into()),
        lobes: Some(Lobes::default()),
        materials: [(0, velvet)].into(),
        lights: [(2, LightEdits { strength: Some(2.0), ..LightEdits::default() })].into(),
        ..Edits::default()
    };
    let text = "\
lobes = \"sheen,diffuse,specular,emission\"
exposure = 0.5

[[material]]
name = \"velvet\"
alpha = 0.7
layering = \"manual=0.5\"

[[light]]
index = 2
strength = 2
";
    assert_eq!(edits.to_text(&scene()), text);
    assert_eq!(read(text), Ok(edits));
}

#[test]
fn a_name_stands_for_all_that_bear_it_and_later_tables_win() {
    let text = "[[material]]\nname = 'felt'\nalpha = 0.1\nmetallic = 1\n[[material]]\nindex = 0x3\nalpha = 1_0e-1\n";
    let felt = MaterialEdits { alpha: Some(0.1), metallic: Some(1.0), ..MaterialEdits::default() };
    let expected = [(2, felt), (3, MaterialEdits { alpha: Some(1.0), ..felt })];
    assert_eq!(read(text).unwrap().materials, expected.into());
    assert_eq!(read("camera = 2").unwrap().camera, Some(CameraEdit::Loaded(2)));
    assert_eq!(read("camera = 'eye'").unwrap().camera, Some(CameraEdit::Loaded(0)));
    // What a view leaves open is the first camera's.
    let Ok(Edits { camera: Some(CameraEdit::Orbit(orbit)), .. }) = read("[view]\nazimuth = 1") else { panic!() };
    let first = Orbit::new(&scene().cameras[0], scene().subject().center());
    assert_eq!(orbit, Orbit { azimuth: 1.0, ..first });
}

#[test]
fn errors_name_line_and_key() {
    for (text, expected) in [
        ("exposure = 1\nalpha = 2", "line 2, alpha: give a number in [0,1]"),
        ("\n\n[[material]]\nname = 'velvet'\nalpha = 'x'", "line 5, alpha of material \"velvet\": give a number"),
        (
            "[[material]]\nindex = 9\nalpha = 0.5",
            "line 2, index of a material: the scene has no such material; it has 0",
        ),
        ("[[material]]\nname = 'silk'", "line 2, name of a material: the scene has no such material"),
        ("[[light]]\nindex = 0\nrotation = [0, 0, 0, 2]", "line 3, rotation of light 0: give a unit quaternion"),
        ("[[light]]\nindex = 0\nsize = [1, 0]", "line 3, size of light 0: give width and height in metres, above 0"),
        ("[[light]]\nindex = 0\ntemperature = 999", "line 3, temperature of light 0: give kelvin in [1000,40000]"),
        (
            "[[punctual-light]]\nindex = 0\ndirection = [0, 0, 0]",
            "line 3, direction of punctual-light 0: give three numbers that are not all 0",
        ),
        ("[[punctual-light]]\nindex = 0\nouter = 2", "line 3, outer of punctual-light 0: give an angle in radians"),
        ("[[added-light]]\nname = 'x'", "line 1, added-light: give one of shape, copy-of and copy-of-punctual"),
        ("[[added-light]]\nshape = 'star'", "line 2, added-light: give one of polygon, rectangle, disk"),
        (
            "[[added-light]]\nshape = 'polygon'\ncorners = 65",
            "line 2, added-light: give the polygon's corners, a whole",
        ),
        ("[[added-light]]\ncopy-of = 'lamp'", "line 2, added-light: the scene has no such light; it has 0 (key)"),
        (
            "[[added-light]]\nshape = 'point'\nradiance = [1, 1, 1]",
            "line 3, radiance of an added-light: the keys are in",
        ),
        ("[added-light]\nshape = 'disk'", "line 1, added-light: give tables: [[added-light]]"),
        ("[[material]]\nalpha = 0.5", "line 1, material: give either its name or its index"),
        ("[[material]]\nname = 'felt'\nindex = 2", "line 1, material: give either its name or its index"),
        ("[[material]]\nindex = 1.5", "line 2, index of a material: give a whole number from 0 up"),
        ("[[light]]\nname = 3", "line 2, name of a light: give a name in quotes"),
        (
            "[[light]]\nindex = 1\ncolour = [1, 1, 1]",
            "line 3, colour of light 1: the keys are radiance, strength, temperature",
        ),
        ("[[light]]\nindex = 1\nradiance = [1, -1, 1]", "line 3, radiance of light 1: give three finite numbers"),
        ("[light]\nindex = 1", "line 1, light: give tables: [[light]]"),
        ("light = [1]", "line 1, light: give tables: [[light]]"),
        ("view = 1", "line 1, view: give a table: [view]"),
        ("[view]\nfar = 0.01", "line 1, view: give near above 0, and far above near"),
        ("[view]\nymag = 1\nfar = inf", "line 1, view: give far above near, and finite"),
        ("[view]\nyfov = 1\nymag = 1", "line 1, view: yfov and ymag exclude each other"),
        ("[[light]]\nindex = 0\nposition = [0, 1e11, 0]", "line 3, position of light 0: give three numbers in [-1e10,"),
        ("[view]\nelevation = 2", "line 2, elevation of the view: give an angle in radians in [-1.56"),
        ("[view]\nroll = 1", "line 2, roll of the view: the keys are target"),
        ("camera = 'eye'\n[view]\n", "line 1, camera: [view] says from where, too; keep one of them"),
        ("camera = 'tele'", "line 1, camera: the scene has no such camera; it has 0 (eye), 1 (eye), 2 (1)"),
        ("camera = -1", "line 1, camera: give a name, or an index from 0 up"),
        ("ambient = [1, 1, nan]", "line 1, ambient: give three finite numbers"),
        ("exposure = 1979-05-27", "line 1, exposure: give a number, a list of numbers, or a text"),
        ("lights-visible = 'on'", "line 1, lights-visible: give true or false"),
        ("exposer = 1", "line 1, exposer: the keys are lobes, lights-visible, shadows, ambient"),
        ("exposure = 1\nexposure = 2", "line 2: "),
        ("exposure = = 2", "line 1: "),
        ("alpha = 0.5\n\u{1}", "line 2: "),
    ] {
        let error = read(text).unwrap_err();
        assert!(error.starts_with(expected), "{text}\n{error}");
        assert!(!error.contains(char::is_control), "{error}");
    }
}

#[test]
fn hostile_texts_end_in_an_error() {
    let nested = "a = ".to_owned() + &"[".repeat(100_000);
    let tables = "[[material]]\nindex = 0\n".repeat(10_000) + "alpha = 2";
    let long = format!("{} = 1", "k".repeat(1_000_000));
    for text in [nested, tables, long, "index = 99999999999999999999999".to_owned()] {
        assert!(read(&text).is_err());
    }
    assert!(read("[[light]]\nindex = 99999999999999999999999").is_err());
}

#[test]
fn more_lights_than_there_is_room_for_are_refused() {
    let disks = |count: usize| "[[added-light]]\nshape = \"disk\"\n".repeat(count);
    // The scene's three have three corners each, a disk 32.
    assert_eq!(read(&disks(255)).unwrap().added_lights.len(), 255);
    let refused = read(&disks(256)).unwrap_err();
    assert_eq!(refused, "line 511, added-light: all lights have at most 8192 corners together; leave some out");
    assert!(read(&"[[added-light]]\nshape = \"spot\"\n".repeat(1025)).unwrap_err().contains("at most 1024"));
}

/// A shell that reads a state up to a line of its own must not find that line in a name.
#[test]
fn no_name_makes_lines_of_its_own() {
    let mut scene = scene();
    scene.materials[0].name = "a\nEND\nb\r\n\"'''\u{2028}\u{85}x".to_owned();
    scene.lights[1].name = "'''\nEND\n".to_owned();
    let material = MaterialEdits { alpha: Some(0.5), ..MaterialEdits::default() };
    let light = LightEdits { strength: Some(0.5), ..LightEdits::default() };
    let added = Added { name: "\nEND\n".to_owned(), shape: LightShape::Disk, changes: light };
    let edits = Edits {
        materials: [(0, material)].into(),
        lights: [(1, light)].into(),
        added_lights: vec![added],
        ..Edits::default()
    };
    let text = edits.to_text(&scene);
    assert!(text.lines().all(|line| line.is_empty() || line.starts_with('[') || line.contains(" = ")), "{text}");
    assert_eq!(Edits::from_text(&text, &scene), Ok(edits));
}
