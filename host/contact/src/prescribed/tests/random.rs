use super::file;
use crate::prescribed::{Column, History, Needs};
use proptest::prelude::*;

fn all() -> Needs {
    let mut needs = Needs::of(&[Column::Pressure, Column::Slip, Column::Area]);
    Column::NORMAL.iter().for_each(|column| needs.add(*column));
    needs
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..300), npz in any::<bool>()) {
        let (_folder, path) = file(if npz { "h.npz" } else { "h.csv" }, &bytes);
        let _ = History::read(&path, &all());
        let _ = History::read(&path, &Needs::none());
    }

    #[test]
    fn random_rows_are_read_or_refused(rows in "([0-3],[0-3],[0-9-]{1,2}(,[0-9.e]{1,4})?\n){0,12}") {
        let (_folder, path) = file("h.csv", format!("time,point,pressure,slip\n{rows}").as_bytes());
        if let Ok(history) = History::read(&path, &Needs::of(&[Column::Pressure, Column::Slip])) {
            prop_assert_eq!(history.times().len() * history.points(), rows.lines().count());
        }
    }

    #[test]
    fn a_damaged_archive_never_panics(at in any::<prop::sample::Index>(), byte in any::<u8>(), cut in any::<prop::sample::Index>()) {
        let good = super::arrays::small_archive();
        let mut bytes = good.clone();
        let at = at.index(bytes.len());
        bytes[at] = byte;
        let (_folder, path) = file("h.npz", &bytes);
        if let Ok(history) = History::read(&path, &Needs::of(&[Column::Pressure])) {
            prop_assert!(history.times().iter().all(|t| t.is_finite()));
        }
        let cut = cut.index(good.len());
        let (_folder, path) = file("h.npz", &good[..cut]);
        prop_assert!(History::read(&path, &Needs::of(&[Column::Pressure])).is_err());
    }
}
