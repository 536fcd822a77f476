use super::*;

fn put(path: &Path, text: &str) {
    fs::create_dir_all(parent(path)).unwrap();
    fs::write(path, text).unwrap();
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap()
}

/// All files below a folder, relative, sorted.
fn listing(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for name in names_in(folder).unwrap() {
        if folder.join(&name).is_dir() {
            let below = listing(&folder.join(&name));
            found.extend(below.into_iter().map(|inner| format!("{name}/{inner}")));
        } else {
            found.push(name);
        }
    }
    found
}

fn result(target: &Path, report: &str, names: &[&str]) -> Result<(), OutputError> {
    let folder = WholeFolder::begin(target)?;
    put(&folder.path().join(REPORT), report);
    for name in names {
        put(&folder.path().join(name), report);
    }
    folder.commit()
}

#[test]
fn a_file_appears_whole_or_stays_as_it_was() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("history.csv");
    put(&path, "old");
    let failed = write_file(&path, |to| {
        to.write_all(b"half")?;
        Err(io::Error::other("no more"))
    });
    let error = failed.unwrap_err().to_string();
    assert!(error.starts_with("could not write ") && error.contains("history.csv: no more"));
    assert_eq!((read(&path).as_str(), listing(place.path()).len()), ("old", 1));
    write_file(&path, |to| to.write_all(b"new")).unwrap();
    assert_eq!(read(&path), "new");
    let missing = write_file(&place.path().join("no/such/file"), |_| Ok(())).unwrap_err();
    assert!(missing.to_string().contains("could not create"), "{missing}");
}

#[cfg(unix)]
#[test]
fn results_can_be_read_as_the_mask_allows() {
    use std::os::unix::fs::PermissionsExt;
    let place = tempfile::tempdir().unwrap();
    let plain = place.path().join("plain");
    put(&plain.join("file"), "");
    let target = place.path().join("run.out");
    let folder = WholeFolder::begin(&target).unwrap();
    write_file(&folder.path().join(REPORT), |_| Ok(())).unwrap();
    folder.commit().unwrap();
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&target), mode(&plain));
    assert_eq!(mode(&target.join(REPORT)), mode(&plain.join("file")));
}

#[test]
fn a_new_folder_appears_at_once_and_only_when_committed() {
    let place = tempfile::tempdir().unwrap();
    let target = place.path().join("deep/run.out");
    let folder = WholeFolder::begin(&target).unwrap();
    put(&folder.path().join(REPORT), "{}");
    assert!(!target.exists());
    drop(folder);
    assert_eq!(listing(&place.path().join("deep")), Vec::<String>::new());
    result(&target, "{}", &["fields/fields-000001.csv"]).unwrap();
    assert_eq!(listing(&target), ["fields/fields-000001.csv", REPORT]);
    assert_eq!(names_in(&place.path().join("deep")).unwrap(), ["run.out"]);
}

#[test]
fn a_later_result_replaces_an_earlier_one_and_keeps_what_is_not_its_own() {
    let place = tempfile::tempdir().unwrap();
    let target = place.path().join("run.out");
    result(&target, "first", &["plot.svg", "fields/fields-000001.vtp", "fields/fields.pvd"]).unwrap();
    put(&target.join("notes.txt"), "mine");
    put(&target.join("fields/view.pvsm"), "mine");
    result(&target, "second", &["history.csv"]).unwrap();
    assert_eq!(listing(&target), ["fields/view.pvsm", "history.csv", "notes.txt", REPORT]);
    assert_eq!(read(&target.join(REPORT)), "second");
    fs::remove_file(target.join("fields/view.pvsm")).unwrap();
    result(&target, "third", &[]).unwrap();
    assert_eq!(names_in(&target).unwrap(), ["notes.txt", REPORT], "no empty folder stays");
}

#[test]
fn a_checkpoint_stands_only_beside_the_fields_that_it_counts_on() {
    let place = tempfile::tempdir().unwrap();
    let target = place.path().join("run.out");
    let names = [CHECKPOINT, "fields/fields-1.vti", "fields/fields-2.vti", "history.csv"];
    result(&target, "old", &names).unwrap();
    let folder = WholeFolder::begin(&target).unwrap();
    for name in names.iter().chain(&[REPORT]) {
        put(&folder.path().join(name), "new");
    }
    let mut moves = Moves::default();
    folder.put(&mut moves).unwrap();
    // Whenever a run may be killed: after each rename, seen backwards from the last.
    let mut seen = 0;
    while let Some((from, to)) = moves.0.pop() {
        let whole =
            ["fields/fields-1.vti", "fields/fields-2.vti"].map(|name| fs::read_to_string(target.join(name)).ok());
        let stands = fs::read_to_string(target.join(CHECKPOINT)).ok();
        if stands.is_some() {
            assert_eq!(whole, [stands.clone(), stands], "after {} renames", moves.0.len() + 1);
            seen += 1;
        }
        fs::rename(to, from).unwrap();
    }
    assert!(seen > 1, "it stands before and after");
}

#[test]
fn a_failed_replacement_leaves_the_earlier_result() {
    let place = tempfile::tempdir().unwrap();
    let target = place.path().join("run.out");
    result(&target, "first", &["history.csv"]).unwrap();
    put(&target.join("extra.txt"), "mine");
    let error = result(&target, "second", &["history.csv", "extra.txt"]).unwrap_err();
    assert!(matches!(&error, OutputError::InTheWay { path } if path.ends_with("extra.txt")));
    assert_eq!(names_in(&target).unwrap(), ["extra.txt", "history.csv", REPORT]);
    assert_eq!((read(&target.join(REPORT)), read(&target.join("history.csv"))), ("first".into(), "first".into()));
    assert_eq!(read(&target.join("extra.txt")), "mine");
}

#[test]
fn a_folder_of_something_else_is_refused() {
    let place = tempfile::tempdir().unwrap();
    put(&place.path().join("thesis/chapter.tex"), "mine");
    let error = WholeFolder::begin(&place.path().join("thesis")).unwrap_err().to_string();
    assert!(error.contains("holds chapter.tex and no report.json"), "{error}");
    let error = WholeFolder::begin(&place.path().join("thesis/chapter.tex")).unwrap_err();
    assert!(matches!(error, OutputError::NotAFolder { .. }));
    fs::create_dir(place.path().join("empty")).unwrap();
    check_folder(&place.path().join("empty")).unwrap();
    check_folder(&place.path().join("new")).unwrap();
}

#[test]
fn an_interrupted_run_leaves_its_checkpoint_and_can_be_followed() {
    let place = tempfile::tempdir().unwrap();
    let target = place.path().join("run.out");
    let folder = WholeFolder::begin(&target).unwrap();
    folder.write_now(CHECKPOINT, |to| to.write_all(b"bits")).unwrap();
    drop(folder);
    assert_eq!(listing(place.path()), ["run.out/checkpoint"]);
    let folder = WholeFolder::begin(&target).unwrap();
    folder.write_now(CHECKPOINT, |to| to.write_all(b"more")).unwrap();
    put(&folder.path().join(REPORT), "{}");
    put(&folder.path().join(CHECKPOINT), "last");
    folder.commit().unwrap();
    assert_eq!(listing(&target), [CHECKPOINT, REPORT]);
    assert_eq!(read(&target.join(CHECKPOINT)), "last");
    // Killed between two renames: no report, and names of a run only.
    fs::remove_file(target.join(REPORT)).unwrap();
    fs::remove_file(target.join(CHECKPOINT)).unwrap();
    put(&target.join(".partial-abc/.replaced/report.json"), "{}");
    check_folder(&target).unwrap();
}

#[test]
fn a_resumed_run_keeps_the_fields_it_wrote_before() {
    let place = tempfile::tempdir().unwrap();
    let target = place.path().join("run.out");
    let names = ["fields/fields-000001.csv", "fields/fields-000002.csv"];
    result(&target, "first", &names).unwrap();
    let mut folder = WholeFolder::begin(&target).unwrap();
    folder.write_now("fields/fields-000003.csv", |_| Ok(())).unwrap();
    for step in 2..=3 {
        folder.keep(format!("fields/fields-{step:06}.csv"));
    }
    put(&folder.path().join(REPORT), "second");
    put(&folder.path().join(names[1]), "second");
    folder.commit().unwrap();
    assert_eq!(listing(&target), [names[1], "fields/fields-000003.csv", REPORT]);
    assert_eq!(read(&target.join(names[1])), "second");
}
