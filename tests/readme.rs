//! README and the pages beside it: their commands run, their links lead somewhere, their tables are complete.

use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn readme() -> String {
    std::fs::read_to_string(root().join("README.md")).expect("README.md is there")
}

/// The program, in a folder of its own, with the arguments of a `wearlaw` line of README.
fn run(line: &str, folder: &Path) -> (bool, String) {
    let words: Vec<String> = line.split_whitespace().skip(1).map(str::to_owned).collect();
    let words = words.iter().map(|word| match root().join(word).exists() {
        true => root().join(word).display().to_string(),
        false => word.clone(),
    });
    let output = Command::new(env!("CARGO_BIN_EXE_wearlaw"))
        .args(words)
        .current_dir(folder)
        .output()
        .expect("the program starts");
    let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    (output.status.success(), text)
}

#[test]
fn the_first_command_gives_the_printed_depth() {
    let text = readme();
    assert!(text.contains("cargo run --release -- run host/scenes/pin_on_disc.toml"));
    let shown = text.split("```text\n").nth(1).and_then(|rest| rest.split("```").next()).expect("what it prints");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (done, said) = run("wearlaw run host/scenes/pin_on_disc.toml", folder.path());
    assert!(done && said.contains("7.3227993251e-6 m at time 1 s, slid 0.2 m"), "{said}");
    // Where the library lies, rounding and the run time are a machine's own.
    let changing = ["  law ", "  error, run time "];
    let fixed = |line: &&str| !changing.iter().any(|label| line.starts_with(label));
    for line in shown.lines().filter(fixed) {
        assert!(said.lines().any(|own| own == line), "README shows `{line}`, which is not in: {said}");
    }
    for label in changing {
        assert!(shown.contains(label) && said.contains(label), "{label} in {shown} and in {said}");
    }
}

#[test]
fn every_command_line_of_the_readme_runs() {
    let text = readme();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut seen = 0;
    for line in text.lines().flat_map(|line| line.split('`')).filter(|part| part.starts_with("wearlaw ")) {
        // Lines with placeholders are forms, not commands.
        if line.chars().any(|c| c.is_ascii_uppercase()) || line == "wearlaw run" {
            continue;
        }
        let (done, said) = run(line, folder.path());
        assert!(done, "`{line}`: {said}");
        seen += 1;
    }
    assert!(seen >= 2, "README shows {seen} commands that can be typed");
}

#[test]
fn links_lead_to_files() {
    for page in
        ["README.md", "CONTRIBUTING.md", "DESIGN.md", "CHANGELOG.md", "include/README.md", "host/scenes/README.md"]
    {
        let path = root().join(page);
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{page}: {error}"));
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if link.starts_with("http") || link.starts_with('#') {
                continue;
            }
            let target = path.parent().expect("pages lie in folders").join(link.split('#').next().unwrap_or(link));
            assert!(target.exists(), "{page} links to {link}, which is not there");
        }
    }
}

#[test]
fn every_scene_and_every_law_is_listed() {
    let text = readme();
    let names = |folder: &str| {
        let entries = std::fs::read_dir(root().join(folder)).expect("the folder is there");
        entries
            .map(|entry| entry.expect("it can be read").file_name().to_string_lossy().into_owned())
            .collect::<Vec<_>>()
    };
    for scene in names("host/scenes").iter().filter(|name| name.ends_with(".toml")) {
        assert!(text.contains(&format!("`{scene}`")), "README does not list {scene}");
    }
    for law in names("plugins") {
        assert!(text.contains(&format!("(plugins/{law}/README.md)")), "README does not list {law}");
    }
}

#[test]
fn exit_codes_are_those_of_the_program() {
    let text = readme();
    for code in wearlaw::ExitCode::ALL {
        assert!(text.contains(&format!("| {} | ", code.number())), "README does not list exit code {}", code.number());
    }
}

#[test]
fn the_keys_on_the_page_about_scenes_are_those_of_the_program() {
    let page = std::fs::read_to_string(root().join("host/scenes/README.md")).expect("the page is there");
    let read = |text: &str| wearlaw::scene::Scene::parse(text, "page.toml", &[]).map(|_| ()).map_err(|e| e.to_string());
    let blocks: Vec<&str> = page.split("```").filter_map(|part| part.strip_prefix("toml")).collect();
    assert_eq!(blocks.len(), 2, "a prescribed scene and a solved one");
    for scene in blocks {
        assert_eq!(read(scene), Ok(()));
    }
    let help = Command::new(env!("CARGO_BIN_EXE_wearlaw")).args(["run", "--help"]).output().expect("it starts");
    let help = String::from_utf8_lossy(&help.stdout).into_owned();
    // As it stands, so that what is cut out of it is a scene.
    let broken: Vec<&str> = page.lines().filter(|line| !help.contains(line)).collect();
    assert!(broken.is_empty() && help.contains("## Histories"), "{broken:#?}");
}
