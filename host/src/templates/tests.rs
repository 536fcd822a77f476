use super::*;
use crate::scene::Scene;

const LANGUAGES: [Language; 4] = [Language::C, Language::Cpp, Language::Fortran, Language::Rust];

fn wanted(folder: &Path, language: Language) -> NewLaw {
    NewLaw { folder: folder.to_path_buf(), language, program: "wearlaw".into() }
}

#[test]
fn every_language_gives_a_whole_folder_without_open_places() {
    let home = tempfile::tempdir().unwrap();
    for language in LANGUAGES {
        let folder = home.path().join(format!("law-in-{}", language.debian_package().replace('+', "p")));
        let created = create(&wanted(&folder, language)).unwrap();
        for file in &created.files {
            let text = fs::read_to_string(folder.join(file)).unwrap();
            assert!(!text.contains("{{") && !text.contains("}}"), "{file}: {text}");
            assert!(text.lines().all(|line| line.len() <= 132) || file == "README.md", "{file}");
        }
        let law = fs::read_to_string(folder.join(&created.files[0])).unwrap();
        assert!(law.contains(&created.name));
        let scene = Scene::read(folder.join("scene.toml"), &[]).unwrap();
        assert!(scene.resolve(&scene.law.plugin).ends_with(format!("lib{}.so", created.name)));
        assert!(created.commands[0].starts_with("wearlaw build ") && created.commands[2].ends_with("/scene.toml"));
        let carried = if language == Language::Rust { "wearlaw-plugin-api/src/lib.rs" } else { "include/wearlaw.h" };
        assert!(folder.join(carried).is_file());
    }
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), LANGUAGES.len(), "nothing is left beside the folders");
}

#[test]
fn a_folder_with_something_in_it_stays_as_it_is() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("mine");
    fs::create_dir(&folder).unwrap();
    fs::write(folder.join("notes"), "mine").unwrap();
    let error = create(&wanted(&folder, Language::C)).unwrap_err();
    assert!(error.to_string().contains("not empty") && error.to_string().contains("`notes`"), "{error}");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
    let file = folder.join("notes");
    assert!(matches!(create(&wanted(&file, Language::C)), Err(TemplateError::NotAFolder { .. })));
    fs::remove_file(&file).unwrap();
    create(&wanted(&folder, Language::C)).unwrap();
    assert!(folder.join("mine.c").is_file());
}

#[test]
fn names_that_no_law_can_have_are_refused() {
    let home = tempfile::tempdir().unwrap();
    for name in ["1law", "my law", "läw", ".hidden", "a.b", "-x", &"a".repeat(61)] {
        let error = create(&wanted(&home.path().join(name), Language::C)).unwrap_err();
        assert!(matches!(error, TemplateError::Name { .. }), "{name}: {error}");
    }
    assert!(matches!(create(&wanted(Path::new(".."), Language::C)), Err(TemplateError::Name { .. })));
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 0);
}
