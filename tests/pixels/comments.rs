//! Files of pictures say which command made them.

use super::run::Bench;

/// How often a text stands in a file.
fn count(file: &[u8], text: &str) -> usize {
    file.windows(text.len()).filter(|window| *window == text.as_bytes()).count()
}

/// But not where they were written: the same flags make the same bytes in any place.
#[test]
fn pictures_name_their_command_and_not_their_place() {
    let bench = Bench::new();
    for (command, format) in [("render", "png"), ("render", "exr"), ("reference", "png"), ("reference", "exr")] {
        let flags = format!("{command} scene.glb --size 16x9 --ambient 1,1,1");
        let (first, second) = (format!("first.{format}"), format!("second.{format}"));
        bench.run(&format!("{flags} -o {first}"));
        bench.run(&format!("{flags} --json --output={second}"));
        let [file, again] = [first, second].map(|name| std::fs::read(bench.path(&name)).unwrap());
        assert_eq!(count(&file, &format!("velour {flags}")), 1, "{command} {format}");
        assert_eq!(count(&file, "first"), 0, "{command} {format}");
        assert_eq!(file, again, "{command} {format}");
        let other = bench.path("other").with_extension(format);
        bench.run(&format!("{flags} --alpha 0.2 -o {}", other.display()));
        assert_eq!(count(&std::fs::read(other).unwrap(), "--ambient 1,1,1 --alpha 0.2"), 1, "{command} {format}");
    }
}

#[test]
fn pictures_without_a_command_of_their_own_name_what_was_typed() {
    let bench = Bench::new();
    bench.run("scene.glb");
    let file = std::fs::read(bench.path("velour.png")).unwrap();
    assert_eq!(count(&file, "velour scene.glb"), 1);
    bench.run("compare velour.png velour.png --heatmap heat.png");
    let file = std::fs::read(bench.path("heat.png")).unwrap();
    assert_eq!((count(&file, "velour compare velour.png velour.png"), count(&file, "heat.png")), (1, 0));
}
