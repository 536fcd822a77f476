//! What is written reads back to the bit, and nothing else passes for it.

use super::*;
use crate::record::LawIdentity;

fn stored() -> Stored {
    let law = LawIdentity { name: "archard".to_owned(), version: "1".to_owned(), sha256: None };
    let scene = serde_json::json!({ "step": [{ "duration": 0.1 }] });
    let identity = Identity {
        program: "0.1.0".to_owned(),
        law,
        scene,
        contents: Default::default(),
        instructions: "avx2".to_owned(),
    };
    let mut row = HistoryRow::at(0.1 + 0.2);
    (row.load, row.approach, row.wear_volume, row.cycle) = (Some(1.0 / 3.0), None, Some(-0.0), 7.5);
    let mut checkpoint = Checkpoint {
        time: 0.1 + 0.2,
        history: Cow::Owned(History { rows: vec![HistoryRow::at(0.0), row] }),
        warnings: vec!["the contact reaches the rim".to_owned()].into(),
        asides: vec!["on standard error".to_owned()].into(),
        cost: Cost { steps: 3, run_time_s: 0.7, ..Cost::default() },
        ..Checkpoint::default()
    };
    checkpoint.set("at", 5e-324);
    checkpoint.set("hint", f64::INFINITY);
    checkpoint.put("wear", vec![1.0, f64::MAX, -0.0]);
    checkpoint.put("none", Vec::new());
    let files = vec![EarlierFile { name: "fields-000003.csv".to_owned(), time: 0.25, bytes: 99 }];
    Stored { identity, fields: EarlierFields { place: ".".to_owned(), files }, ended: true, checkpoint }
}

fn bytes_of(stored: &Stored) -> Vec<u8> {
    let mut bytes = Vec::new();
    encode(&mut bytes, &stored.identity, &stored.fields, stored.ended, &stored.checkpoint).unwrap();
    bytes
}

#[test]
fn a_checkpoint_reads_back_to_the_bit() {
    let stored = stored();
    let bytes = bytes_of(&stored);
    let back = decode(&bytes).unwrap();
    assert_eq!(back, stored);
    assert_eq!(bytes_of(&back), bytes, "negative zeros too");
}

#[test]
fn every_cut_and_every_changed_byte_is_found() {
    let bytes = bytes_of(&stored());
    for length in 0..bytes.len() {
        assert!(decode(&bytes[..length]).is_err(), "cut to {length}");
    }
    let mut changed = bytes.clone();
    for at in 0..bytes.len() {
        changed[at] ^= 1 << (at % 8);
        assert!(decode(&changed).is_err(), "byte {at}");
        changed[at] = bytes[at];
    }
    let longer = [&bytes[..], &[0]].concat();
    assert!(matches!(decode(&longer), Err(Problem::Damaged(_))));
}

#[test]
fn other_files_and_other_versions_are_told_apart_from_damage() {
    assert_eq!(decode(b"PK\x03\x04 an archive of some length"), Err(Problem::Other));
    let mut bytes = bytes_of(&stored());
    bytes[MAGIC.len()] = 9;
    assert_eq!(decode(&bytes), Err(Problem::Version(9)));
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("checkpoint");
    fs::write(&path, &bytes).unwrap();
    let text = read_checkpoint(&path).unwrap_err().to_string();
    assert!(text.contains("checkpoint") && text.contains("layout 9, expected 1"), "{text}");
    fs::write(&path, &bytes_of(&stored())[..100]).unwrap();
    let text = read_checkpoint(&path).unwrap_err().to_string();
    assert!(text.contains("is damaged"), "{text}");
}
