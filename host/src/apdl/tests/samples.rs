//! The sample inputs of the page "Contact Surface Wear" with numbers put in.

use super::super::{LawOption, ScalingKind};
use super::{deck, only};

const BY_TIME: &str = "\
TB,WEAR,1,,,ARCD   ! Activate Archard wear model
TBFIELD,TIME,0     ! Define the first value of time
TBDATA,1,1e-4,1e10,1,1     ! Define wear material constants for the first value of time
TBFIELD,TIME,1     ! Define the second value of time
TBDATA,1,2e-4,1.2e10,1.1,0.9
";

const BY_TEMPERATURE: &str = "\
TB,WEAR,1,,,ARCD   ! Activate Archard wear model
TBTEMP,100         ! Define the first value of temperature
TBDATA,1,1e-4,1e10,1,1
TBTEMP,200         ! Define the second value of temperature
TBDATA,1,2e-4,1.2e10,1.1,0.9
";

fn rows() -> [Vec<Option<f64>>; 2] {
    [[1e-4, 1e10, 1.0, 1.0], [2e-4, 1.2e10, 1.1, 0.9]].map(|row| row.map(Some).to_vec())
}

#[test]
fn archard_by_time() {
    let material = only(BY_TIME);
    assert_eq!(material.id, 1);
    assert_eq!(material.option, LawOption::Archard);
    assert_eq!(material.scaling, None);
    assert_eq!(material.tables.len(), 2);
    for ((row, time), constants) in material.tables.iter().zip([0.0, 1.0]).zip(rows()) {
        assert_eq!((row.time, row.temperature), (Some(time), None));
        assert_eq!(row.constants, constants);
    }
    assert_eq!(material.tables[1].span.line, 5);
    assert_eq!(deck(BY_TIME).notes, []);
}

#[test]
fn archard_by_temperature() {
    let material = only(BY_TEMPERATURE);
    assert_eq!(material.tables.len(), 2);
    for ((row, temperature), constants) in material.tables.iter().zip([100.0, 200.0]).zip(rows()) {
        assert_eq!((row.time, row.temperature), (None, Some(temperature)));
        assert_eq!(row.constants, constants);
    }
}

#[test]
fn a_user_law_with_four_constants() {
    let material = only(
        "TB,WEAR,1,,4,USER     ! Activate user defined wear model that requires 4 (NPTS = 4) constants\n\
         TBDATA,1,0.5,-2,3e3,4  ! Define the wear model constants\n",
    );
    assert_eq!(material.option, LawOption::User { constants: 4 });
    let expected = [0.5, -2.0, 3e3, 4.0].map(Some);
    assert_eq!(material.tables[0].constants, expected);
    assert_eq!(material.tables[0].time, None);
}

#[test]
fn both_kinds_of_scaling() {
    for (option, kind) in [("AUTS", ScalingKind::Auto), ("CBCS", ScalingKind::Cycle)] {
        let law = "TB,WEAR,3,,,ARCD\nTBDATA,1,1e-4,1e10,1,1\n";
        let scaling = format!("TB,WEAR,3,,,{option} ! scaling of wear increment\nTBDATA,1,0.2,5e4\n");
        for text in [format!("{law}{scaling}"), format!("{scaling}{law}")] {
            let found = only(&text).scaling.unwrap();
            assert_eq!((found.kind, found.safety, found.maximum), (kind, 0.2, 5e4));
        }
        for blank in ["", "TBDATA,1\n", "TBDATA,,,\n"] {
            let text = format!("{law}TB,WEAR,3,,,{option}\n{blank}");
            let found = only(&text).scaling.unwrap();
            assert_eq!((found.safety, found.maximum), (0.1, 1e5));
        }
        let maximum_only = only(&format!("{law}TB,WEAR,3,,,{option}\nTBDATA,2,7\n"));
        assert_eq!(maximum_only.scaling.unwrap().safety, 0.1);
        assert_eq!(maximum_only.scaling.unwrap().maximum, 7.0);
    }
}
