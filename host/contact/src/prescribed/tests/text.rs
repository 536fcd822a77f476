use super::{fault, file, pressure_and_velocity, values};
use crate::prescribed::{Column, Header, History, Layout, Motion, Needs, PointIds, RowView, Samples};
use proptest::prelude::*;
use proptest::sample::Index;

const SORTED: &str = "\
# three points, one jump
time, point, pressure, velocity, temperature
0.0, 1, 10, 0.5, 300
0.0, 4, 20, 0.5, 310
0.0, 9, 30, 0.5, 320
1.0, 1, 11, 0.7, 300
1.0, 4, 21, 0.7, 310
1.0, 9, 31, 0.7, 320
1.0, 1, 12, 0.9, 300
1.0, 4, 22, 0.9, 310
1.0, 9, 32, 0.9, 320
2.5, 1, 13, 0.9, 300
2.5, 4, 23, 0.9, 310
2.5, 9, 33, 0.9, 320
";

fn read(text: &str, needs: &Needs) -> History {
    let (_folder, path) = file("h.csv", text.as_bytes());
    History::read(&path, needs).expect("a good history")
}

fn csv_fault(text: &str) -> String {
    fault("h.csv", text.as_bytes(), &pressure_and_velocity())
}

#[test]
fn a_history_with_a_jump_is_read_with_both_sides() {
    let history = read(SORTED, &pressure_and_velocity());
    assert_eq!(history.times(), [0.0, 1.0, 1.0, 2.5]);
    assert_eq!(history.points(), 3);
    assert_eq!(*history.point_ids(), PointIds::Listed(vec![1, 4, 9]));
    let pressure = history.column(Column::Pressure).unwrap();
    assert_eq!(pressure.row(1), RowView::PerPoint(&[11.0, 21.0, 31.0]));
    assert_eq!(pressure.row(2), RowView::PerPoint(&[12.0, 22.0, 32.0]));
    let jumps: Vec<bool> = history.intervals().map(|i| i.is_jump()).collect();
    assert_eq!(jumps, [false, true, false]);
    let last = history.intervals().last().unwrap();
    assert_eq!((last.row, last.start, last.end), (2, 1.0, 2.5));
}

#[test]
fn columns_are_kept_as_small_as_they_are() {
    let needs = pressure_and_velocity().with(Column::Temperature);
    let history = read(SORTED, &needs);
    let layout = |column| {
        let data = history.data(column).unwrap();
        (data.samples.as_slice().len(), data.time_step, data.point_step)
    };
    assert_eq!(layout(Column::Pressure), (12, 3, 1));
    assert_eq!(layout(Column::Velocity), (4, 1, 0));
    assert_eq!(layout(Column::Temperature), (3, 0, 1));
    let constant = read("time,point,pressure\n0,0,7\n0,1,7\n1,0,7\n1,1,7\n", &Needs::of(&[Column::Pressure]));
    assert_eq!(constant.data(Column::Pressure).unwrap().samples.as_slice(), [7.0]);
    assert_eq!(values(&constant, Column::Pressure), [7.0; 4]);
}

#[test]
fn a_column_that_nobody_needs_is_not_even_parsed() {
    let text = "time,point,pressure,temperature\n0,0,1,warm\n0,1,2,NaN\n";
    let history = read(text, &Needs::of(&[Column::Pressure]));
    assert!(history.data(Column::Temperature).is_none());
    assert_eq!(history.bytes(), 8 + 2 * 8);
    let told = fault("h.csv", text.as_bytes(), &Needs::of(&[Column::Temperature]));
    assert_eq!(told, "h.csv: line 2, column 4 (`temperature`): found `warm`, expected a number");
}

proptest! {
    #[test]
    fn shuffled_rows_give_the_same_history(swaps in prop::collection::vec(any::<(Index, Index)>(), 30), counted in any::<bool>()) {
        // Any order in which each point runs through its own rows in order is allowed.
        let mut lines: Vec<&str> = SORTED.lines().skip(2).collect();
        for (a, b) in swaps {
            let (a, b) = (a.index(lines.len()), b.index(lines.len()));
            lines.swap(a, b);
        }
        let id = |line: &str| line.split(", ").nth(1).unwrap().to_string();
        let ids: Vec<String> = lines.iter().map(|line| id(line)).collect();
        let mut text = "time,point,pressure,velocity,temperature\n".to_string();
        for (at, wanted) in ids.iter().enumerate() {
            let nth = ids[..at].iter().filter(|id| *id == wanted).count();
            let row = SORTED.lines().skip(2).filter(|line| id(line) == *wanted).nth(nth).unwrap();
            text.push_str(row);
            text.push('\n');
        }
        let renamed = |text: &str| match counted {
            true => text.replace(", 1, ", ", 0, ").replace(", 4, ", ", 1, ").replace(", 9, ", ", 2, "),
            false => text.to_string(),
        };
        let needs = pressure_and_velocity().with(Column::Temperature);
        let (sorted, shuffled) = (read(&renamed(SORTED), &needs), read(&renamed(&text), &needs));
        prop_assert_eq!(matches!(sorted.point_ids(), PointIds::Counted(3)), counted);
        prop_assert_eq!(sorted.times(), shuffled.times());
        prop_assert_eq!(sorted.point_ids(), shuffled.point_ids());
        for column in needs.columns() {
            prop_assert_eq!(values(&sorted, column), values(&shuffled, column));
            prop_assert_eq!(sorted.data(column).unwrap().time_step, shuffled.data(column).unwrap().time_step);
        }
    }
}

#[test]
fn values_run_linearly_between_rows() {
    let history = read(SORTED, &pressure_and_velocity());
    let pressure = history.column(Column::Pressure).unwrap();
    let mut out = [0.0; 2];
    pressure.interpolate(2, 3, 0.25, 1..3, &mut out);
    assert_eq!(out, [22.25, 32.25]);
    pressure.interpolate(2, 3, 1.0, 1..3, &mut out);
    assert_eq!(out, [23.0, 33.0]);
    let velocity = history.column(Column::Velocity).unwrap();
    velocity.interpolate(0, 1, 0.5, 0..2, &mut out);
    assert!((out[0] - 0.6).abs() < 1e-15 && out[0] == out[1]);
    assert_eq!(velocity.uniform_between(0, 1, 1.0), 0.7);
}

#[test]
fn one_time_is_enough_and_ids_may_look_like_decimals() {
    let history = read("\u{feff}time,point,pressure\r\n0.0,0.0,-1\r\n0.0,1e0,2\r\n", &Needs::of(&[Column::Pressure]));
    assert_eq!(history.times(), [0.0]);
    assert_eq!(history.intervals().count(), 0);
    assert_eq!(*history.point_ids(), PointIds::Counted(2));
    assert_eq!(values(&history, Column::Pressure), [-1.0, 2.0], "a negative pressure is kept: open");
    assert!(matches!(history.data(Column::Pressure).unwrap().samples, Samples::Owned(_)));
}

#[test]
fn the_header_is_known_without_the_values() {
    let (_folder, path) = file("h.csv", b"# made by hand\ntime, point, pressure, slip\n0,0,x,x\n");
    let header = Header::read(&path).unwrap();
    assert_eq!(header.names, ["time", "point", "pressure", "slip"]);
    assert_eq!((header.layout, header.motion(), header.line), (Layout::Csv, Motion::Slip, 2));
    assert!(!header.has_column(Column::Temperature));
    let error = header.check(&Needs::of(&[Column::Temperature])).unwrap_err().to_string();
    assert!(error.ends_with("no column `temperature`, found time, point, pressure, slip"), "{error}");
}

#[test]
fn parts_of_vectors_that_a_plane_lacks_are_zero() {
    let text = "time,point,nx,nz,sxx,szz,sxz,slip_x\n0,0,0,1,-1,-2,3,0\n1,0,0,1,-1,-2,3,4\n";
    let mut needs = Needs::of(&Column::STRESS);
    Column::NORMAL.iter().chain(&Column::SLIP_VECTOR).for_each(|c| needs.add(*c));
    let history = read(text, &needs);
    assert_eq!(values(&history, Column::NormalY), [0.0, 0.0]);
    assert_eq!(values(&history, Column::StressXy), [0.0, 0.0]);
    assert_eq!(values(&history, Column::SlipX), [0.0, 4.0]);
    assert_eq!(values(&history, Column::SlipY), [0.0, 0.0]);
}

#[test]
fn further_inputs_are_read_by_name_or_passed_over() {
    let text = "time,point,pressure,film\n0,0,1,5e-6\n";
    let mut needs = Needs::of(&[Column::Pressure]);
    assert!(fault("h.csv", text.as_bytes(), &needs).contains("unknown column `film` at line 1, column 4"));
    let mut passing = needs.clone();
    passing.allow("film");
    assert_eq!(read(text, &passing).bytes(), 16);
    let film = needs.add_further("film");
    assert_eq!(values(&read(text, &needs), film), [5e-6]);
}

#[test]
fn every_fault_of_the_names_is_told() {
    let cases = [
        ("", "h.csv: empty file, expected a header row such as time,point,pressure"),
        ("# only\n# comments\n", "h.csv: empty file, expected a header row such as time,point,pressure"),
        ("time,point,pressure,velocity\n", "h.csv: no rows, expected at least one time and one point"),
        (
            "time,point,presure\n0,0,1\n",
            "h.csv: unknown column `presure` at line 1, column 3; did you mean `pressure`?",
        ),
        ("time,point,pressure,time\n", "h.csv: column `time` is given twice at line 1, column 4"),
        ("point,pressure,velocity\n", "h.csv: no column `time`, found point, pressure, velocity"),
        ("time,pressure,velocity\n", "h.csv: no column `point`, found time, pressure, velocity"),
        (
            "time,point,velocity\n",
            "h.csv: no column `pressure` (above zero it says where there is contact, whether or not the law reads it), \
             found time, point, velocity",
        ),
        ("time,point,pressure\n", "h.csv: no column `velocity`, found time, point, pressure"),
        ("time,point,pressure,velocity,slip\n", "h.csv: both `velocity` and `slip` are given, expected one of them"),
        (
            "time,point,pressure,velocity,slip_x\n",
            "h.csv: both `velocity` and `slip_x` are given, expected one of them",
        ),
        ("time,point,pressure,slip,slip_x\n", "h.csv: both `slip` and `slip_x` are given, expected one of them"),
    ];
    for (text, expected) in cases {
        assert_eq!(csv_fault(text), expected, "{text:?}");
    }
    for (names, present, missing) in [
        ("sxx", "sxx", "szz"),
        ("nx", "nx", "nz"),
        ("nx,ny", "nx", "nz"),
        ("slip_y", "slip_y", "slip_x"),
        ("sxx,szz,sxz,syy", "syy", "sxy"),
    ] {
        let told = csv_fault(&format!("time,point,pressure,{names}\n"));
        assert!(told.contains(&format!("`{present}` without `{missing}`")), "{told}");
    }
}

#[test]
fn every_fault_of_the_rows_is_told() {
    let rows = |rows: &str| csv_fault(&format!("# c\n\ntime,point,pressure,velocity\n# d\n{rows}"));
    let cases = [
        ("0,0,1,1\n0,1,x1,1\n", "h.csv: line 6, column 3 (`pressure`): found `x1`, expected a number"),
        (",0,1,1\n", "h.csv: line 5, column 1 (`time`): found ``, expected a number"),
        ("0,0,1,1\n# e\n0,1,1,NaN\n", "h.csv: line 7, column 4 (`velocity`): found `NaN`, expected a finite number"),
        ("0,0,1e400,1\n", "h.csv: line 5, column 3 (`pressure`): found `1e400`, expected a finite number"),
        ("0,1.5,1,1\n", "h.csv: line 5, column 2 (`point`): found `1.5`, expected an integer"),
        ("0,0,1,1\r\n0,1,1\r\n", "h.csv: line 6: found 3 fields, expected 4 as in the header"),
        ("0,0,1,1\n2,0,1,1\n1,0,1,1\n", "h.csv: line 7: time goes back from 2 to 1 (point 0)"),
        (
            "0,0,1,1\n0,7,1,1\n1,0,1,1\n0.5,7,1,1\n",
            "h.csv: point 0 has no row at time 0.5, where point 7 has one; expected every point at every time",
        ),
        (
            "0,0,1,1\n0,7,1,1\n1,0,1,1\n",
            "h.csv: point 7 has no row at time 1, where point 0 has one; expected every point at every time",
        ),
        (
            "0,0,1,1\n1,0,1,1\n1,7,1,1\n",
            "h.csv: point 7 has no row at time 0, where point 0 has one; expected every point at every time",
        ),
        (
            "0,3,1,1\n0,4,1,1\n0,3,1,1\n1,3,1,1\n1,4,1,1\n",
            "h.csv: line 9: point 3 is given twice at time 0, where point 4 is given once; expected once, or twice for every point (a jump)",
        ),
        (
            "0,3,1,1\n0,3,1,1\n0,4,1,1\n",
            "h.csv: point 3 is given twice at time 0, where point 4 is given once; expected once, or twice for every point (a jump)",
        ),
        (
            "0,3,1,1\n0,4,1,1\n1,3,1,1\n1,4,1,1\n1,4,1,1\n2,3,1,1\n2,4,1,1\n",
            "h.csv: line 10: point 4 is given twice at time 1, where point 3 is given once; expected once, or twice for every point (a jump)",
        ),
        (
            "0,3,1,1\n0,3,1,1\n0,3,1,1\n",
            "h.csv: line 7: time 0 is given more than twice (point 3), expected once, or twice for a jump",
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(rows(text), expected, "{text:?}");
    }
    let area = fault("h.csv", b"time,point,pressure,area\n0,5,1,0\n", &Needs::of(&[Column::Area]));
    assert_eq!(area, "h.csv: line 2: area 0 of point 5 at time 0, expected more than 0");
    let friction = b"time,point,pressure,friction\n0,5,1,0\n0,6,1,-0.25\n";
    assert_eq!(
        fault("h.csv", friction, &Needs::of(&[Column::Friction])),
        "h.csv: line 3: friction -0.25 of point 6 at time 0, expected at least 0"
    );
    let normal =
        fault("h.csv", b"time,point,pressure,nx,ny,nz\n0,5,1,0,0,1\n0,6,1,0,0,0\n", &Needs::of(&Column::NORMAL));
    assert_eq!(normal, "h.csv: line 3: normal of length 0 at point 6, time 0");
}

#[test]
fn a_file_that_is_not_there_or_not_a_file_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let told = |path: &std::path::Path| History::read(path, &Needs::none()).unwrap_err().to_string();
    assert!(told(&folder.path().join("gone.csv")).contains("gone.csv: no such file"));
    assert!(told(folder.path()).contains("found a directory or device"));
}
