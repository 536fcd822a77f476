//! Histories with mistakes: every message names the file, and the line and column or the point and time.

use super::program::Room;

const HEADER: &str = "time,point,pressure,velocity\n";

#[test]
fn a_mistake_in_a_history_has_its_place() {
    let room = Room::new();
    for (text, telling) in [
        ("", &["empty file", "header row"] as &[&str]),
        ("# nothing but words\n", &["empty file", "header row"]),
        (HEADER, &["no rows", "at least one time"]),
        (&rows("0,7,1,1\n1,7,1,1\n0.5,7,1,1\n"), &["line 4", "time goes back from 1 to 0.5", "point 7"]),
        (&rows("0,7,1,1\n0,8,1,1\n1,7,1,1\n"), &["point 8 has no row at time 1", "every point at every time"]),
        (&rows("0,7,1,1\n0,8,1,1\n1,8,1,1\n"), &["point 7 has no row at time 1"]),
        (&rows("0,7,1,1\n1,7,NaN,1\n"), &["line 3, column 3 (`pressure`)", "`NaN`", "finite number"]),
        (&rows("0,7,1,1\n1,7,1,-inf\n"), &["line 3, column 4 (`velocity`)", "`-inf`", "finite number"]),
        (&rows("0,7,1,1\n1,7,1e999,1\n"), &["line 3, column 3 (`pressure`)", "`1e999`"]),
        (&rows("0,7,1,1\n1,7,high,1\n"), &["line 3, column 3 (`pressure`)", "`high`", "a number"]),
        (&rows("0,7.5,1,1\n"), &["line 2, column 2 (`point`)", "`7.5`", "an integer"]),
        (&rows("0,7,1,1\n1,7,1\n"), &["line 3", "3 fields", "expected 4"]),
        (&rows("0,7,1,1\n1,7,1,1\n1,7,1,1\n1,7,1,1\n"), &["time 1", "more than twice"]),
        (&rows("0,7,1,1\n"), &["single time", "`step.duration`"]),
        (
            "time,point,pressure,velocity,area\n0,7,1,1,-2\n1,7,1,1,-2\n",
            &["line 2", "area -2", "point 7", "more than 0"],
        ),
        ("time,point,pressure,velocity,nx,ny,nz\n0,7,1,1,0,0,0\n1,7,1,1,0,0,1\n", &[]),
        ("time,point,pressure,velocity,nx\n0,7,1,1,1\n1,7,1,1,1\n", &["`nx` without `nz`", "nx, ny, nz"]),
        ("time,point,pressure,velocty\n0,7,1,1\n1,7,1,1\n", &["unknown column `velocty`", "`velocity`", "column 4"]),
        ("time,point,presure,velocity\n0,7,1,1\n1,7,1,1\n", &["unknown column `presure`", "`pressure`"]),
        (
            "time,point,velocity\n0,7,1\n1,7,1\n",
            &["no column `pressure` (above zero it says where there is contact", "time, point, velocity"],
        ),
        ("time,pressure,velocity\n0,1,1\n1,1,1\n", &["no column `point`"]),
        ("point,pressure,velocity\n7,1,1\n7,1,1\n", &["no column `time`"]),
        ("time,point,pressure,pressure,velocity\n0,7,1,1,1\n", &["column `pressure` is given twice"]),
        ("time,point,pressure,velocity,slip\n0,7,1,1,0\n1,7,1,1,1\n", &["both `velocity` and `slip`", "one of them"]),
        ("time,point,pressure\n0,7,1\n1,7,1\n", &["`velocity`", "column `velocity` or `slip`", "`step.velocity`"]),
    ] {
        room.write("history.csv", text);
        if telling.is_empty() {
            // A normal that nobody reads may be what it likes.
            let ended = room.run(&["run", "scene.toml", "--out", "unread"]);
            assert_eq!(ended.code, 0, "{}", ended.stderr);
            continue;
        }
        let said = room.refused(&["run", "scene.toml"], telling);
        assert!(said.contains("history.csv") || said.contains("contact.history"), "{said}");
    }
}

#[test]
fn what_is_no_history_is_said_so() {
    let room = Room::new();
    let set = |name: &str| format!("contact.history=\"{name}\"");
    room.refused(&["run", "scene.toml", "--set", &set("none.csv")], &["none.csv", "no such file", "CSV or NPZ"]);
    room.refused(&["run", "scene.toml", "--set", &set(".")], &["directory", "a history file"]);
    room.write("broken.npz", "PK\u{3}\u{4} and no more");
    room.refused(&["run", "scene.toml", "--set", &set("broken.npz")], &["broken.npz", "not a readable NPZ archive"]);
    room.write("text.npz", "time,point,pressure,velocity\n0,7,1,1\n");
    room.refused(&["run", "scene.toml", "--set", &set("text.npz")], &["text.npz", "not a readable NPZ archive"]);
}

fn rows(rows: &str) -> String {
    format!("{HEADER}{rows}")
}
