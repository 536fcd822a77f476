//! Whatever the text: an error that can be shown or a scene that can be written and read again, never a panic.

use proptest::prelude::*;

use super::whole::EXAMPLE;
use super::*;

/// Scraps that scenes are made of, and some that they are not.
const SCRAPS: &[&str] = &[
    "[",
    "]",
    "[[",
    "{",
    "}",
    "=",
    ".",
    "\"",
    "'''",
    "\n",
    "\r\n",
    "\r",
    "#",
    ",",
    "nan",
    "-inf",
    "1e999",
    "-1",
    "0",
    "µ",
    "\u{feff}",
    "\u{0}",
    "9999999999999999999999",
    "0xff",
    "true",
    "step",
    "[[step]]",
    "[[cycle]]",
    "[law]",
    "constants",
    "load",
    "2020-01-01",
    "\t",
    "😀",
];

fn survives(text: &str, overrides: &[String]) {
    let overrides: Vec<Override> = overrides.iter().map(|text| Override(text.clone())).collect();
    match Scene::parse(text, "a.toml", &overrides) {
        Ok(scene) => {
            let again = Scene::parse(&scene.toml(), "a.toml", &[]);
            assert_eq!(again.as_ref(), Ok(&scene), "{}", scene.toml());
        }
        Err(error) => {
            assert!(!error.to_string().is_empty());
            assert!(error.render(false).contains("error"));
            assert!(error.render(true).contains("error"));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_scenes(cuts in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..12, 0..SCRAPS.len()), 1..4)) {
        let mut text: Vec<char> = EXAMPLE.chars().collect();
        for (index, length, scrap) in cuts {
            let start = index.index(text.len());
            let end = (start + length).min(text.len());
            text.splice(start..end, SCRAPS[scrap].chars());
        }
        survives(&text.into_iter().collect::<String>(), &[]);
    }

    #[test]
    fn arbitrary_text(text in any::<String>()) {
        survives(&text, &[]);
    }

    #[test]
    fn arbitrary_overrides(key in "(step|law|cycle|contact|output)(\\.[0-2]|\\.[a-z]{1,6}| ){0,3}", value in any::<String>()) {
        survives(EXAMPLE, &[format!("{key}={value}")]);
        survives(EXAMPLE, &[value]);
    }

    #[test]
    fn values_of_any_kind(line in 0..EXAMPLE.lines().count(), scrap in 0..SCRAPS.len()) {
        let lines = EXAMPLE.lines().enumerate().map(|(index, text)| match text.split_once('=') {
            Some((key, _)) if index == line => format!("{key}= {}\n", SCRAPS[scrap]),
            _ => format!("{text}\n"),
        });
        survives(&lines.collect::<String>(), &[]);
    }
}
