//! The book: its commands run in the order in which they stand, its scene and its law do what the text says, its links lead
//! somewhere. The Rust program of its page on embedding is a test of the crate's documentation.

#[path = "support/scene_runs.rs"]
mod scene_runs;

use std::path::{Path, PathBuf};
use std::process::Command;

use scene_runs::read;

fn book() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("book")
}

fn pages() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(book()).expect("the folder of the book");
    let mut pages: Vec<PathBuf> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    pages.sort();
    assert!(pages.len() >= 6, "{pages:?}");
    pages
}

/// The blocks of a language on a page.
fn blocks(page: &str, language: &str) -> Vec<String> {
    let text = read(&book().join(page));
    let begin = format!("```{language}\n");
    let parts = text.split(&begin).skip(1);
    parts.map(|rest| rest.split("```").next().expect("a block ends").to_owned()).collect()
}

/// Calls the program in a folder; it has to end with 0.
fn wearlaw(line: &str, folder: &Path) -> String {
    let words: Vec<&str> = line.split_whitespace().skip(1).collect();
    let output = Command::new(env!("CARGO_BIN_EXE_wearlaw")).args(words).current_dir(folder).output();
    let output = output.expect("the program starts");
    let said = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "`{line}`: {said}");
    said
}

#[test]
fn the_first_law_is_made_as_the_page_says() {
    let room = tempfile::tempdir().expect("a temporary folder");
    let here = room.path();
    let commands: Vec<String> =
        blocks("law.md", "sh").iter().flat_map(|block| block.lines().map(str::to_owned).collect::<Vec<_>>()).collect();
    assert_eq!(commands.len(), 4, "{commands:?}");
    for command in &commands {
        wearlaw(command, here);
    }
    let [scene] = &blocks("law.md", "toml")[..] else { panic!("one scene") };
    std::fs::write(here.join("scene.toml"), scene).expect("a writable folder");
    wearlaw("wearlaw plan scene.toml", here);
    let said = wearlaw("wearlaw run scene.toml --html", here);
    assert!(said.contains("estimated error   wear L2") && said.contains("grid"), "{said}");
    assert!(here.join("scene.out/report.html").exists());
    wearlaw("wearlaw stability scene.toml", here);
    // The law of the page in the place of the first one, with a value of its own: 1e-12 (3e6 - 1e6) 0.5.
    let [law] = &blocks("law.md", "c")[..] else { panic!("one law") };
    std::fs::write(here.join("my-law/my-law.c"), law).expect("a writable folder");
    let values = "k,p0,pressure,slip,increment\n1e-12,1e6,3e6,0.5,1e-6\n1e-12,1e6,1e6,0.5,0\n";
    std::fs::write(here.join("my-law/expected.csv"), values).expect("a writable folder");
    wearlaw(&commands[1], here);
    wearlaw(&commands[3], here);
}

#[test]
fn links_lead_to_files_and_headings() {
    let mut seen = 0;
    for page in pages() {
        let text = read(&page);
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { page.clone() } else { book().join(file) };
            assert!(target.exists(), "{} links to {link}, which is not there", page.display());
            let anchor = |line: &str| {
                let letters = line.trim_start_matches('#').trim().to_lowercase();
                letters
                    .chars()
                    .filter(|c| c.is_alphanumeric() || *c == ' ' || *c == '-')
                    .collect::<String>()
                    .replace(' ', "-")
            };
            let found = heading.is_empty()
                || read(&target).lines().filter(|line| line.starts_with('#')).any(|line| anchor(line) == heading);
            assert!(found, "{} links to {link}: no such heading", page.display());
            seen += 1;
        }
    }
    assert!(seen >= 10, "{seen} links");
}

#[test]
fn every_page_is_in_the_contents() {
    let contents = read(&book().join("README.md"));
    for page in pages() {
        let name = page.file_name().expect("a name").to_string_lossy().into_owned();
        assert!(name == "README.md" || contents.contains(&format!("]({name})")), "{name}");
    }
}
