//! Every way in which a wear command can be wrong: sentence, line, column and underline.

use super::{diagnostic, wrong};

const ARCHARD: &str = "TB,WEAR,1,,,ARCD\n";
const GOOD: &str = "TBDATA,1,1e-4,1e10,1,1\n";

#[test]
fn the_picture_of_an_error() {
    let text = "/PREP7\n  TB,WEAR,1,,,ARDC ! wear\n";
    assert_eq!(
        diagnostic(text).render(),
        "error: unknown TBOPT `ARDC` of TB,WEAR: expected ARCD, USER, AUTS or CBCS; did you mean `ARCD`?\n \
         --> deck.inp:2:15\n  \
         |\n\
         2 |   TB,WEAR,1,,,ARDC ! wear\n  \
         |               ^^^^"
    );
}

#[test]
fn tb() {
    let expected = "expected ARCD, USER, AUTS or CBCS";
    wrong("TB,WEAR,1,,,BKIN", 1, 13, "BKIN", &format!("unknown TBOPT `BKIN` of TB,WEAR: {expected}"));
    wrong("TB,WEAR,1", 1, 1, "TB,WEAR,1", &format!("TB,WEAR without TBOPT: {expected} in its sixth field"));
    wrong("TB WEAR,1,,,ARCD", 1, 4, "WEAR,1,,,ARCD", "expected `,` after `TB`");
    wrong("TB,WEAR,1.5,,,ARCD", 1, 9, "1.5", "MATID of TB = 1.5 is not a whole number from 1 to 4294967295");
    wrong("TB,WEAR,0,,,ARCD", 1, 9, "0", "MATID of TB = 0 is not a whole number from 1 to 4294967295");
    wrong("TB,WEAR,1,,0,USER", 1, 12, "0", "NPTS of TB = 0 is not a whole number from 1 to 1000");
    wrong("TB,WEAR,1,,1e9,USER", 1, 12, "1e9", "NPTS of TB = 1000000000 is not a whole number from 1 to 1000");
    wrong("TB,WEAR,1,-1,,ARCD", 1, 11, "-1", "NTEMP of TB = -1 is not a whole number from 0 to 2147483647");
    wrong("TB,WEAR,cid,,,ARCD", 1, 9, "cid", "MATID of TB: `cid` is neither a number nor a parameter defined above");
    wrong("TB,WEAR,1,,,ARCD,,x", 1, 19, "x", "`TB` has 5 fields here, found another");
}

#[test]
fn commands_without_their_table() {
    for command in ["TBDATA,1,2", "TBFIELD,TIME,0", "tbtemp,1"] {
        let name = command.split(',').next().unwrap().to_uppercase();
        let message = format!("`{name}` before any TB: expected a TB,WEAR above it");
        wrong(&format!("\n {command}"), 2, 2, command, &message);
    }
    let text = format!("{ARCHARD}{GOOD}TBPT,,1,2\n");
    wrong(
        &text,
        3,
        1,
        "TBPT,,1,2",
        "`TBPT` changes a wear table in a way that is not read: expected TB, TBDATA, TBFIELD or TBTEMP",
    );
    let deleted = format!("{ARCHARD}{GOOD}TB,ELASTIC,1\nTBPT,,1,2\nTBDELE,ELASTIC,1\nTBDELE,WEAR,1\n");
    assert!(diagnostic(&deleted).to_string().starts_with("deck.inp:6:1: `TBDELE` changes a wear table"));
}

#[test]
fn commands_inside_blocks() {
    let text = format!("*IF,A,EQ,1,THEN\n{ARCHARD}{GOOD}*ENDIF\n");
    wrong(
        &text,
        2,
        1,
        "TB,WEAR,1,,,ARCD",
        "`TB` stands inside *IF of line 1, which is not evaluated: expected wear commands outside of blocks",
    );
    let text = format!("{ARCHARD}*DO,I,1,2\n{GOOD}*ENDDO");
    assert!(diagnostic(&text).to_string().contains("3:1: `TBDATA` stands inside *DO of line 2"));
    let closed = format!("*IF,A,EQ,1,:skip\n*DO,I,1,2\n*ENDDO\n{ARCHARD}{GOOD}");
    assert_eq!(super::constants(&closed).len(), 4);
}

#[test]
fn tbdata() {
    let archard = "TB,WEAR with ARCD has constants C1 to C8";
    for stloc in ["0", "9", "-1", "1.5", "1e30"] {
        let value: f64 = stloc.parse().unwrap();
        let message = format!("STLOC = {value} is out of range: {archard}");
        wrong(&format!("{ARCHARD}TBDATA,{stloc},1"), 2, 8, stloc, &message);
    }
    wrong(&format!("{ARCHARD}TBDATA,8,1,,2"), 2, 13, "2", &format!("found constant C10: {archard}"));
    let user = "TB,WEAR,1,,2,USER\nTBDATA,1,1,2,33\n";
    wrong(user, 2, 14, "33", "found constant C3: TB,WEAR with USER and NPTS = 2 has constants C1 to C2");
    let continued = "TB,WEAR,1,,2,USER\nTBDATA,1,1,2\nTBDATA,,33\n";
    wrong(continued, 3, 9, "33", "found constant C3: TB,WEAR with USER and NPTS = 2 has constants C1 to C2");
    wrong(&format!("{ARCHARD}TBDATA,1,1,1,1,1,1,1,77"), 2, 22, "77", "`TBDATA` has 7 fields here, found another");
    wrong(&format!("{ARCHARD}TBDATA 1,1"), 2, 8, "1,1", "expected `,` after `TBDATA`");
    wrong(
        &format!("{ARCHARD}\tTBDATA,1,1,abc,1,1"),
        2,
        13,
        "abc",
        "value 2 of TBDATA: `abc` is neither a number nor a parameter defined above",
    );
}

#[test]
fn missing_constants() {
    wrong(ARCHARD, 1, 1, "TB,WEAR,1,,,ARCD", "TB,WEAR,1 with ARCD has no TBDATA: expected constants C1 to C4");
    wrong(
        "TB,WEAR,1,,2,USER",
        1,
        1,
        "TB,WEAR,1,,2,USER",
        "TB,WEAR,1 with USER has no TBDATA: expected constants C1 to C2",
    );
    let message = "C4 (velocity exponent n) has no value and no default";
    wrong(&format!("{ARCHARD}TBDATA,1,1,2,3"), 2, 1, "TBDATA,1,1,2,3", message);
    let message = "C2 (hardness H) has no value and no default at temperature = 5";
    wrong(&format!("{ARCHARD}TBTEMP,5\nTBDATA,1,1,,3,4"), 3, 1, "TBDATA,1,1,,3,4", message);
    let message = "C3 (of 3 of the law) has no value and no default";
    wrong("TB,WEAR,1,,3,USER\nTBDATA,1,1,2", 2, 1, "TBDATA,1,1,2", message);
    let message = "material 4 scales the wear increment but has no law: expected TB,WEAR,4 with ARCD or USER";
    wrong("TB,WEAR,4,,,AUTS", 1, 1, "TB,WEAR,4,,,AUTS", message);
}

#[test]
fn field_values() {
    let user = "TB,WEAR,1,,1,USER\n";
    let case = |commands: &str, line, column, underlined: &str, message: &str| {
        wrong(&format!("{user}{commands}"), line, column, underlined, message);
    };
    case("TBFIELD,FREQ,1", 2, 9, "FREQ", "unknown field variable `FREQ` of a wear table: expected TIME or TEMP");
    case("TBFIELD,TIME", 2, 1, "TBFIELD,TIME", "TBFIELD has no value");
    case("TBFIELD", 2, 1, "TBFIELD", "the type of TBFIELD has no value");
    case("TBTEMP,1,CRIT", 2, 10, "CRIT", "KMOD of TBTEMP is not read: expected the temperature only");
    case(
        "TBTEMP,1\nTBDATA,1,1\nTBFIELD,TEMP,2",
        4,
        1,
        "TBFIELD,TEMP,2",
        "TBTEMP and TBFIELD in the same table: expected TBFIELD,TEMP or TBTEMP throughout",
    );
    case(
        "TBFIELD,TIME,0\nTBFIELD,TIME,1\nTBDATA,1,1",
        2,
        1,
        "TBFIELD,TIME,0",
        "time = 0 has no TBDATA: expected constants before the next value",
    );
    case(
        "TBTEMP,1\nTBDATA,1,1\nTBTEMP,2",
        4,
        1,
        "TBTEMP,2",
        "temperature = 2 has no TBDATA: expected constants before the next value",
    );
    let back = "goes back or is out of order: expected ascending values, each variable's whole range before the other's next value";
    case("TBTEMP,2\nTBDATA,1,1\nTBTEMP,1\nTBDATA,1,1", 4, 1, "TBTEMP,1", &format!("temperature = 1 {back}"));
    case(
        "TBFIELD,TIME,0\nTBDATA,1,1\nTBFIELD,TIME,-0\nTBDATA,1,1",
        4,
        1,
        "TBFIELD,TIME,-0",
        "the point time = -0 is given already: expected ascending values",
    );
    case(
        "TBFIELD,TIME,1\nTBFIELD,TEMP,1\nTBDATA,1,1\nTBFIELD,TEMP,2\nTBDATA,1,2\nTBFIELD,TIME,0\nTBFIELD,TEMP,1\nTBDATA,1,3",
        7,
        1,
        "TBFIELD,TIME,0",
        &format!("time = 0 {back}"),
    );
    case(
        "TBDATA,1,1\nTBFIELD,TIME,1\nTBDATA,1,1",
        3,
        1,
        "TBFIELD,TIME,1",
        "constants given by time, those above without a field value: expected the same field variables throughout",
    );
    case(
        "TBFIELD,TIME,1\nTBDATA,1,1\nTBFIELD,TEMP,1\nTBDATA,1,1",
        4,
        1,
        "TBFIELD,TEMP,1",
        "constants given by time and temperature, those above by time: expected the same field variables throughout",
    );
}

#[test]
fn an_incomplete_grid_names_the_missing_point() {
    let text = "TB,WEAR,1,,1,USER\nTBFIELD,TIME,0\nTBFIELD,TEMP,20\nTBDATA,1,1\nTBFIELD,TEMP,90\nTBDATA,1,1\n\
                TBFIELD,TIME,1\nTBFIELD,TEMP,20\nTBDATA,1,1\n";
    wrong(
        text,
        1,
        1,
        "TB,WEAR,1,,1,USER",
        "the table is not a full grid: no constants at time = 1, temperature = 90 (2 times x 2 temperatures, found 3 of 4 points)",
    );
}

#[test]
fn documented_controls() {
    wrong(
        &format!("{ARCHARD}TBDATA,1,1,1,1,1,2"),
        2,
        18,
        "2",
        "C5 = 2 is not a documented flag: expected 0 or blank, 1, 10, 11 or -99",
    );
    wrong(
        &format!("{ARCHARD}{GOOD}TBDATA,6,0,0,0"),
        3,
        10,
        "0",
        "the wear direction C6, C7, C8 is zero: expected direction cosines, or nothing for the default",
    );
    let differ = "C5 to C8 differ from those of the first row: expected the same controls in every row of a table";
    let text = format!("{ARCHARD}TBTEMP,1\nTBDATA,1,1,1,1,1,1\nTBTEMP,2\n{GOOD}");
    wrong(&text, 5, 1, GOOD.trim_end(), differ);
    let same = format!("{ARCHARD}TBTEMP,1\nTBDATA,1,1,1,1,1,0\nTBTEMP,2\n{GOOD}");
    assert_eq!(super::only(&same).tables.len(), 2);
}

#[test]
fn scaling_constants() {
    let scaling = format!("{ARCHARD}{GOOD}TB,WEAR,1,,,AUTS\n");
    for c1 in ["0", "1", "1.5", "-0.1"] {
        let message = format!("wear scaling factor C1 = {c1}: expected more than 0 and less than 1");
        wrong(&format!("{scaling}TBDATA,1,{c1}"), 4, 10, c1, &message);
    }
    wrong(&format!("{scaling}TBDATA,2,0.5"), 4, 10, "0.5", "maximum scale factor C2 = 0.5: expected at least 1");
    wrong(
        &format!("{scaling}TBDATA,3,0.5"),
        4,
        8,
        "3",
        "STLOC = 3 is out of range: TB,WEAR with AUTS has constants C1 to C2",
    );
    wrong(
        &format!("{scaling}TBTEMP,3"),
        4,
        1,
        "TBTEMP,3",
        "`TBTEMP` in a table of scaling factors: expected TBDATA only",
    );
}
