//! The free format of a deck: case, blanks, comments, separators, line ends, and what is passed over.

use super::super::Note;
use super::{constants, deck, only};

const PLAIN: [f64; 4] = [1e-4, 1e10, 1.0, 1.0];

#[test]
fn case_and_blanks_mean_nothing() {
    let text = "  tb , Wear ,1, , , arcd\n\t tbdata , 1 , 1E-4 ,1e10 , 1. ,01  ";
    assert_eq!(constants(text), PLAIN);
}

#[test]
fn names_count_to_the_fourth_letter() {
    let text = "TB,WEAR,1,,,ARCD\nTBTE,20\nTBDA,1,1e-4,1e10,1,1\nTBTEMPER,30\nTBDATAS,1,2,2,2,2";
    assert_eq!(only(text).tables.len(), 2);
}

#[test]
fn comments_end_what_is_read() {
    let text = "! TB,WEAR,9\n/COM, TB,WEAR,8,,,NONE $ TBDATA,oops\nc*** TBDATA,oops\n* TBDATA,oops\n\
                TB,WEAR,1,,,ARCD!x\nTBDATA,1,1e-4,1e10,1,1!,7 $ TBDATA,1,9\n!";
    assert_eq!(constants(text), PLAIN);
    assert_eq!(deck(text).notes, []);
}

#[test]
fn dollars_separate_commands() {
    let text = "K=1e-4 $ TB,WEAR,1,,,ARCD $ TBDATA,1,K,1e10 $TBDATA,3,1,1$";
    assert_eq!(constants(text), PLAIN);
    let commented = "TB,WEAR,1,,,ARCD $ TBDATA,1,1e-4,1e10,1,1 $ /COM, $ TBDATA,1,9";
    assert_eq!(constants(commented), PLAIN);
    let quoted = "N='a$b' $ TB,WEAR,1,,,ARCD $ TBDATA,1,1e-4,1e10,1,1\n/TITLE,Don't $ TBDATA,x";
    assert_eq!(constants(quoted), PLAIN);
}

#[test]
fn every_kind_of_line_end() {
    for end in ["\n", "\r\n", "\r", "\n\n", "\r\n\r\n"] {
        let text = ["TB,WEAR,1,,,ARCD", "TBDATA,1,1e-4,1e10,1,1"].join(end);
        assert_eq!(constants(&text), PLAIN, "{end:?}");
        assert_eq!(constants(&(text + end)), PLAIN, "{end:?}");
    }
    let found = super::diagnostic("! a\r\n! b\rTB,WEAR,1,,,NONE\r\n");
    assert_eq!((found.line, found.column), (3, 13));
}

#[test]
fn a_byte_order_mark_and_long_lines() {
    let long = " ".repeat(200_000);
    let text = format!("\u{feff}TB,WEAR,1,,,ARCD{long}\nTBDATA,{long}1,1e-4,1e10,1,1{long}!{long}");
    assert_eq!(constants(&text), PLAIN);
    let found = super::diagnostic(&format!("TB,{long}WEAR,1,,,NONE"));
    assert_eq!(found.column, 200_013);
    let picture = found.render();
    assert!(picture.contains("^^^^") && picture.len() < 1000, "{picture}");
}

#[test]
fn what_is_not_about_wear_is_counted() {
    let text = "/prep7\nET,1,CONTA174\nMP,EX,1,2e11\nNBLOCK,6,SOLID\n(3i9,6e21.13e3)\n        1        0  1.0\n\
                -1\nMP,NUXY,1,0.3\nTB,ELASTIC,1\nTBDATA,1,2e11,oops\nTBTEMP,oops\nTBDATA,,undefined\n\
                TB,WEAR,1,,,ARCD\nMP,MU,1,0.2\nTBDATA,1,1e-4,1e10,1,1\nA(1,2)=3 $ VALUE='text'\nmp,dens,1,7800\n";
    let expected = [
        ("/PREP7", 1, 1),
        ("ET", 1, 2),
        ("MP", 4, 3),
        ("NBLOCK", 1, 4),
        ("lines of data", 3, 5),
        ("TB,ELASTIC", 1, 9),
        ("TBDATA of TB,ELASTIC", 2, 10),
        ("TBTEMP of TB,ELASTIC", 1, 11),
        ("array elements", 1, 16),
    ];
    let expected = expected.map(|(command, count, first_line)| Note::PassedOver {
        command: command.to_owned(),
        count,
        first_line,
    });
    assert_eq!(deck(text).notes, expected);
    assert_eq!(constants(text), PLAIN);
    assert_eq!(deck(text).notes[2].to_string(), "passed over MP: 4 times, first on line 3");
}

#[test]
fn nothing_after_eof_is_read() {
    let text = "TB,WEAR,1,,,ARCD\nTBDATA,1,1e-4,1e10,1,1\n/EOF\nTBDATA,1,oops\n";
    assert_eq!(constants(text), PLAIN);
}

#[test]
fn the_format_line_of_a_written_file_is_no_command() {
    let text = "K=1e-4\n*CFOPEN,out\n*VWRITE,K\nK = 7 (F8.2)\nTB,WEAR,1,,,ARCD\nTBDATA,1,K,1e10,1,1";
    assert_eq!(constants(text), PLAIN);
}

#[test]
fn a_file_in_another_encoding() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("deck.dat");
    let mut bytes = b"! Verschlei\xdf\n/TITLE,caf\xe9\nTB,WEAR,1,,,ARCD ! \xff\xfe\n".to_vec();
    std::fs::write(&path, [&bytes[..], b"TBDATA,1,1e-4,1e10,1,1"].concat()).unwrap();
    let read = super::Deck::read(&path).unwrap();
    assert_eq!(read.material(None).unwrap().tables[0].constants, PLAIN.map(Some));
    bytes.extend(b"TBDATA,1,1\xe9-4,1e10,1,1");
    std::fs::write(&path, bytes).unwrap();
    let refused = super::Deck::read(&path).unwrap_err().to_string();
    assert!(refused.contains("deck.dat:4:11: value 1 of TBDATA: found `\u{fffd}`, expected"), "{refused}");
    let absent = super::Deck::read(&folder.path().join("none.inp")).unwrap_err();
    assert!(absent.to_string().contains("none.inp: No such file"), "{absent}");
}
