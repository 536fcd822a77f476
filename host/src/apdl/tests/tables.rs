//! TBDATA at its start location, repeated lines, and tables over time and temperature.

use super::super::LawOption;
use super::{constants, only};

/// Time, temperature and first constant of every row of a user's table.
fn points(commands: &str) -> Vec<(Option<f64>, Option<f64>, f64)> {
    let material = only(&format!("TB,WEAR,1,,1,USER\n{commands}"));
    let rows = material.tables.iter();
    rows.map(|r| (r.time, r.temperature, r.constants[0].unwrap())).collect()
}

#[test]
fn a_start_location_and_repeated_lines() {
    let start = "TB,WEAR,1,,4,USER\n";
    for lines in [
        "TBDATA,1,1,2,3,4",
        "TBDATA,,1,2,3,4",
        "TBDATA,3,3,4\nTBDATA,1,1,2",
        "TBDATA,1,1,2\nTBDATA,3,3,4",
        "TBDATA,,1,2\nTBDATA,,3\nTBDATA,,4",
        "TBDATA,1,9,9,9,9\nTBDATA,2,2,3\nTBDATA,1,1\nTBDATA,4,4",
        "TBDATA,1,1,,3,4\nTBDATA,2,2",
        "TBDATA,1,1,2,9,4\nTBDATA,1,,,3,,,",
        "TBDATA,2-1,1,,\nTBDATA,,2,3,4,,",
        "MP,EX,1,1\nTBDATA,1,1,2\nMP,EX,1,1\nTBDATA,,3,4",
    ] {
        let found = constants(&format!("{start}{lines}"));
        assert_eq!(found, [1.0, 2.0, 3.0, 4.0], "{lines}");
    }
}

#[test]
fn a_new_point_starts_at_the_first_location_again() {
    let text = "TB,WEAR,1,,2,USER\nTBTEMP,1\nTBDATA,,1,2\nTBTEMP,2\nTBDATA,,3,4\n";
    let material = only(text);
    assert_eq!(material.tables[1].constants, [Some(3.0), Some(4.0)]);
}

#[test]
fn more_constants_than_a_line_holds() {
    let archard = constants("TB,WEAR,1,,,ARCD\nTBDATA,1,1,2,3,4,10,0\nTBDATA,7,0,1");
    assert_eq!(archard, [1.0, 2.0, 3.0, 4.0, 10.0, 0.0, 0.0, 1.0]);
    let user = constants("TB,WEAR,1,,13,USER\nTBDATA,1,1,2,3,4,5,6\nTBDATA,,7,8,9,10,11,12\nTBDATA,,13");
    assert_eq!(user, (1..=13).map(f64::from).collect::<Vec<_>>());
}

#[test]
fn blank_arguments_of_tb() {
    let material = only("TB,WEAR,,,,USER\nTBDATA,3,3\nTBDATA,1,1,2");
    assert_eq!(material.id, 1);
    assert_eq!(material.option, LawOption::User { constants: 3 });
    let none = only("TB,WEAR,2,,,USER");
    assert_eq!(none.option, LawOption::User { constants: 0 });
    assert!(none.tables.is_empty());
    let ignored = only("m=7 $ n=2\nTB,WEAR,m+1,n,4,ARCD,,\nTBDATA,1,1,1,1,1");
    assert_eq!(ignored.id, 8);
}

#[test]
fn one_variable() {
    let by_time = points("TBFIELD,TIME,0\nTBDATA,1,1\nTBFIELD,time,0.5\nTBDATA,1,2\nTBFIELD,TIME,2\nTBDATA,1,3");
    let t = |t: f64, c: f64| (Some(t), None, c);
    assert_eq!(by_time, [t(0.0, 1.0), t(0.5, 2.0), t(2.0, 3.0)]);
    let by_temperature = points("TBFIELD,TEMP,-50\nTBDATA,1,1\nTBFIELD,Temp,20\nTBDATA,1,2");
    assert_eq!(by_temperature, [(None, Some(-50.0), 1.0), (None, Some(20.0), 2.0)]);
    assert_eq!(points("TBTEMP\nTBDATA,1,1"), [(None, Some(0.0), 1.0)]);
}

#[test]
fn time_and_temperature_in_either_order() {
    let p = |t: f64, temp: f64, c: f64| (Some(t), Some(temp), c);
    let expected = [p(0.0, 20.0, 1.0), p(1.0, 20.0, 2.0), p(0.0, 90.0, 3.0), p(1.0, 90.0, 4.0)];
    let held = "TBFIELD,TEMP,20\nTBFIELD,TIME,0\nTBDATA,1,1\nTBFIELD,TIME,1\nTBDATA,1,2\n\
                TBFIELD,TEMP,90\nTBFIELD,TIME,0\nTBDATA,1,3\nTBFIELD,TIME,1\nTBDATA,1,4\n";
    assert_eq!(points(held), expected);
    let repeated = "TBFIELD,TEMP,20\nTBFIELD,TIME,0\nTBDATA,1,1\nTBFIELD,TEMP,20\nTBFIELD,TIME,1\nTBDATA,1,2\n\
                    TBFIELD,TIME,0\nTBFIELD,TEMP,90\nTBDATA,1,3\nTBFIELD,TIME,1\nTBFIELD,TEMP,90\nTBDATA,1,4\n";
    assert_eq!(points(repeated), expected);
    let time_first = "TBFIELD,TIME,0\nTBFIELD,TEMP,20\nTBDATA,1,1\nTBFIELD,TEMP,90\nTBDATA,1,3\n\
                      TBFIELD,TIME,1\nTBFIELD,TEMP,20\nTBDATA,1,2\nTBFIELD,TEMP,90\nTBDATA,1,4\n";
    let [a, b, c, d] = expected;
    assert_eq!(points(time_first), [a, c, b, d]);
}

#[test]
fn a_long_table() {
    let rows: String = (0..20_000).map(|i| format!("TBFIELD,TIME,{i}\nTBDATA,1,{i}\n")).collect();
    assert_eq!(points(&rows).len(), 20_000);
}
