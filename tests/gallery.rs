//! The gallery of README: its pictures are what the scenes leave, and its words are the first two lines of each scene.
//!
//! `WEARLAW_REGENERATE=1 cargo test --test gallery` makes pictures and text anew.

#[path = "support/scene_runs.rs"]
mod scene_runs;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use scene_runs::{read, run, scenes};

/// The scenes that are shown, in their order.
const SHOWN: [&str; 10] = [
    "pin_on_disc",
    "ball_on_flat",
    "fretting_cylinder",
    "deck_temperature",
    "rough_running_in",
    "punch_edge",
    "stick_limit",
    "cycles_scaled",
    "deck_user",
    "post_halfspace",
];
const BEGIN: &str = "<!-- the gallery: WEARLAW_REGENERATE=1 cargo test --test gallery -->\n";
const END: &str = "<!-- end of the gallery -->\n";
/// How far a point of a picture may move on another machine, in the units of the file, of which eight make a pixel.
const SHIFT: f64 = 16.0;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn is_regenerated() -> bool {
    std::env::var_os("WEARLAW_REGENERATE").is_some()
}

fn picture(scene: &str) -> PathBuf {
    scenes().join("pictures").join(scene).with_extension("svg")
}

/// Title, and the two sentences: what it is, and what to look at.
fn words(scene: &str) -> [String; 3] {
    let text = read(&scenes().join(scene).with_extension("toml"));
    let mut lines = text.lines();
    let mut line = |begin: &str, end: &str| {
        let line = lines.find(|line| line.starts_with(begin)).unwrap_or_else(|| panic!("{scene}: no line {begin}"));
        line[begin.len()..].trim_end_matches(end).to_owned()
    };
    let what = line("# ", "");
    let look = line("# What to look at: ", "");
    let title = line("title = \"", "\"");
    let mut first = look.chars();
    let look =
        first.next().map_or_else(String::new, |letter| letter.to_uppercase().collect::<String>() + first.as_str());
    [title, what, look]
}

/// The section of README as the scenes say it: two pictures in a row.
fn section() -> String {
    let mut text = String::new();
    text.push_str("<table>\n");
    for row in SHOWN.chunks(2) {
        text.push_str("<tr>\n");
        for scene in row {
            let [title, what, look] = words(scene);
            let _ = writeln!(
                text,
                "<td width=\"50%\" valign=\"top\"><img src=\"host/scenes/pictures/{scene}.svg\" alt=\"{title}\"><br>\n\
                 <b>{title}</b> (<a href=\"host/scenes/{scene}.toml\">{scene}.toml</a>). {what} {look}</td>"
            );
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</table>\n");
    text
}

#[test]
fn the_text_of_the_gallery_is_that_of_the_scenes() {
    let path = root().join("README.md");
    let readme = read(&path);
    let (before, rest) = readme.split_once(BEGIN).expect("README has a gallery");
    let (found, after) = rest.split_once(END).expect("the gallery ends");
    let section = section();
    if is_regenerated() {
        std::fs::write(&path, format!("{before}{BEGIN}{section}{END}{after}")).expect("README can be written");
    } else {
        assert_eq!(found, section, "README's gallery is old: WEARLAW_REGENERATE=1 cargo test --test gallery");
    }
}

/// A picture with its numbers apart: the words between them, and them.
fn parts(svg: &str) -> (Vec<String>, Vec<f64>) {
    let (mut words, mut numbers) = (vec![String::new()], Vec::new());
    let mut rest = svg;
    while let Some(first) = rest.chars().next() {
        let length = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len());
        if length > 0 && first.is_ascii_digit() {
            numbers.push(rest[..length].trim_end_matches('.').parse().expect("digits"));
            words.push(String::new());
            rest = &rest[length..];
        } else {
            words.last_mut().expect("there is one").push(first);
            rest = &rest[first.len_utf8()..];
        }
    }
    (words, numbers)
}

#[test]
fn the_pictures_of_the_gallery_are_what_the_scenes_leave() {
    let room = tempfile::tempdir().expect("a temporary folder");
    for scene in SHOWN {
        let ran = run(&scenes().join(scene).with_extension("toml"), &room.path().join(scene), &[]);
        println!("{scene}: {:.3} s", ran.number("/cost/run_time_s"));
        let made = read(&ran.folder.join("plot.svg"));
        if is_regenerated() {
            std::fs::write(picture(scene), &made).expect("the picture can be written");
            continue;
        }
        let kept = read(&picture(scene));
        let ((words, numbers), (other_words, others)) = (parts(&made), parts(&kept));
        assert_eq!(words, other_words, "{scene}: WEARLAW_REGENERATE=1 cargo test --test gallery");
        let far = numbers.iter().zip(&others).find(|(a, b)| (*a - *b).abs() > SHIFT);
        assert_eq!(far, None, "{scene}: WEARLAW_REGENERATE=1 cargo test --test gallery");
    }
}

#[test]
fn another_curve_is_another_picture() {
    let (words, numbers) = parts("<path d=\"M 10.5,20 L 3,4\"/>");
    assert_eq!((words.len(), numbers), (5, vec![10.5, 20.0, 3.0, 4.0]));
}
