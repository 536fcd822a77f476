//! The law section as TOML: it parses, and holds the same numbers to the bit.

use super::super::to_toml;
use super::super::{LawOption, LowerError, Scaling, ScalingKind, Span, TableRow, WearMaterial};
use super::only;
use proptest::prelude::*;

fn lowered(text: &str) -> String {
    to_toml(&only(text)).unwrap()
}

fn float(value: &toml::Value) -> f64 {
    value.as_float().expect("a float")
}

#[test]
fn plain_archard() {
    let text = lowered("TB,WEAR,1,,,ARCD\nTBDATA,1,1e-4,1e10,1,1\n");
    assert_eq!(
        text,
        "# material 1, TB,WEAR with ARCD\n[law]\nuse = \"archard\"\n\
         constants = { K = 1e-4, H = 1e10, m = 1.0, n = 1.0 }\n"
    );
}

#[test]
fn every_documented_control() {
    let keys = |c5: &str| {
        let text = lowered(&format!("TB,WEAR,1,,,ARCD\nTBDATA,1,1,1,1,1,{c5}\n"));
        let lines: Vec<String> = text.lines().skip(4).map(str::to_owned).collect();
        lines.join("; ")
    };
    assert_eq!(keys(""), "");
    assert_eq!(keys("0"), "");
    assert_eq!(keys("1"), "basis = \"nodal-stress\"; average = false");
    assert_eq!(keys("10"), "basis = \"pressure\"; average = true");
    assert_eq!(keys("11"), "basis = \"nodal-stress\"; average = true");
    assert_eq!(keys("-99"), "mode = \"post\"");
    assert_eq!(keys(",0\nTBDATA,8,-1"), "direction = [0.0, 0.0, -1.0]");
    assert_eq!(
        keys("-99,\nTBDATA,7,-2"),
        "mode = \"post\"; # C6 to C8 were 0.0, -2.0, 0.0, scaled to length 1; direction = [0.0, -1.0, 0.0]"
    );
}

#[test]
fn tables_and_scaling() {
    let text = lowered(
        "TB,WEAR,5,,,ARCD\nTBFIELD,TIME,0\nTBDATA,1,1e-4,1e10,1,1,1\nTBFIELD,TIME,1\nTBDATA,1,3e-4,1e10,1,1,1\n\
         TB,WEAR,5,,,CBCS\nTBDATA,1,0.25\n",
    );
    assert_eq!(
        text,
        "# material 5, TB,WEAR with ARCD\n[law]\nuse = \"archard\"\nbasis = \"nodal-stress\"\naverage = false\n\
         \n[[law.table]]\ntime = 0.0\nconstants = { K = 1e-4, H = 1e10, m = 1.0, n = 1.0 }\n\
         \n[[law.table]]\ntime = 1.0\nconstants = { K = 3e-4, H = 1e10, m = 1.0, n = 1.0 }\n\
         \n[scaling]\nkind = \"cycle\"\nsafety = 0.25\nmaximum = 100000.0\n"
    );
    let parsed: toml::Table = text.parse().unwrap();
    assert_eq!(parsed["law"]["table"].as_array().unwrap().len(), 2);
}

#[test]
fn a_user_law_asks_for_its_path() {
    let text = lowered("TB,WEAR,1,,2,USER\nTBDATA,1,0.1,-3\n");
    assert!(text.contains("# name the law: a library, or a source file or crate"));
    let parsed: toml::Table = text.parse().unwrap();
    assert_eq!(parsed["law"]["use"].as_str(), Some("PATH-TO-YOUR-LAW"));
    let constants = parsed["law"]["constants"].as_array().unwrap();
    assert_eq!(constants.iter().map(float).collect::<Vec<_>>(), [0.1, -3.0]);
    let none: toml::Table = lowered("TB,WEAR,1,,,USER").parse().unwrap();
    assert!(none["law"].get("constants").is_none());
}

fn material(option: LawOption, rows: Vec<TableRow>) -> WearMaterial {
    WearMaterial { id: 1, option, tables: rows, scaling: None, span: HERE }
}

const HERE: Span = Span { line: 1, start: 0, end: 0 };

fn row(time: Option<f64>, constants: &[Option<f64>]) -> TableRow {
    TableRow { time, temperature: None, constants: constants.to_vec(), span: HERE }
}

#[test]
fn a_material_made_by_hand_is_checked_too() {
    let refused = |m: WearMaterial| to_toml(&m).unwrap_err();
    let full = [Some(1.0); 4];
    let with_flag = |flag| [full.as_slice(), &[Some(flag)]].concat();
    assert_eq!(
        refused(material(LawOption::Archard, vec![row(None, &full[..3])])),
        LowerError::MissingConstant { material: 1, row: 1, location: 4 }
    );
    assert_eq!(refused(material(LawOption::Archard, vec![])), LowerError::NoPoint { material: 1, rows: 0 });
    assert_eq!(
        refused(material(LawOption::Archard, vec![row(None, &full), row(None, &full)])),
        LowerError::NoPoint { material: 1, rows: 2 }
    );
    let infinite = [Some(f64::INFINITY)];
    assert_eq!(
        refused(material(LawOption::User { constants: 1 }, vec![row(None, &infinite)])),
        LowerError::NotFinite { material: 1, value: f64::INFINITY }
    );
    let differ = vec![row(Some(0.0), &with_flag(1.0)), row(Some(1.0), &full)];
    assert_eq!(refused(material(LawOption::Archard, differ)), LowerError::ControlsDiffer { material: 1, row: 2 });
    let wrong = refused(material(LawOption::Archard, vec![row(None, &with_flag(3.0))]));
    assert!(wrong.to_string().contains("material 1, row 1: C5 = 3 is not a documented flag"));
}

fn finite() -> impl Strategy<Value = f64> {
    any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite())
}

proptest! {
    #[test]
    fn any_number_comes_back_to_the_bit(values in prop::collection::vec(finite(), 1..9), times in (finite(), finite())) {
        let constants = values.len();
        let given: Vec<_> = values.iter().copied().map(Some).collect();
        let rows = vec![row(Some(times.0), &given), row(Some(times.1), &given)];
        let mut material = material(LawOption::User { constants }, rows);
        material.scaling = Some(Scaling { kind: ScalingKind::Auto, safety: values[0], maximum: 3e5 });
        let parsed: toml::Table = to_toml(&material).unwrap().parse().unwrap();
        prop_assert_eq!(float(&parsed["scaling"]["safety"]).to_bits(), values[0].to_bits());
        let rows = parsed["law"]["table"].as_array().unwrap();
        for (row, time) in rows.iter().zip([times.0, times.1]) {
            prop_assert_eq!(float(&row["time"]).to_bits(), time.to_bits());
            let found = row["constants"].as_array().unwrap().iter().map(|v| float(v).to_bits());
            prop_assert!(found.eq(values.iter().map(|v| v.to_bits())));
        }
    }

    #[test]
    fn a_deck_and_its_toml_hold_the_same_bits(k in finite(), h in finite(), m in finite(), n in finite()) {
        let text = lowered(&format!("TB,WEAR,1,,,ARCD\nTBDATA,1,{k:e},{h:?}\nTBDATA,3,{m:e},{n}\n"));
        let parsed: toml::Table = text.parse().unwrap();
        for (name, value) in [("K", k), ("H", h), ("m", m), ("n", n)] {
            let found = float(&parsed["law"]["constants"][name]);
            prop_assert_eq!(found.to_bits(), value.to_bits(), "{} = {:e}", name, value);
        }
    }
}
