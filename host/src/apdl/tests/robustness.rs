//! No bytes make the reader panic, and every message can be shown.

use super::super::{Deck, DeckError, to_toml};
use proptest::prelude::*;

/// Reads the bytes as a deck and goes through everything that can be done with the result.
fn exercise(bytes: &[u8]) {
    match Deck::parse(&String::from_utf8_lossy(bytes), "deck.inp") {
        Ok(deck) => {
            for note in &deck.notes {
                assert!(!note.to_string().is_empty());
            }
            for material in &deck.materials {
                let text = to_toml(material).expect("a material of a deck has a law section");
                text.parse::<toml::Table>().expect("toml");
            }
        }
        Err(DeckError::Command(diagnostic)) => {
            assert!(diagnostic.line >= 1 && diagnostic.column >= 1);
            assert!(diagnostic.to_string().starts_with("deck.inp:"));
            assert!(diagnostic.render().contains("deck.inp:"));
        }
        Err(other) => panic!("unexpected: {other}"),
    }
}

/// Pieces of decks, so that random text reaches deep into the reader.
fn piece() -> impl Strategy<Value = String> {
    let known = prop::sample::select(vec![
        "TB,WEAR,1,,,ARCD",
        "TB,WEAR,2,,3,USER",
        "TB,WEAR,1,,,AUTS",
        "TB,WEAR",
        "TB,ELASTIC,1",
        "TBDATA,1",
        "TBDATA,,",
        "TBDATA",
        "TBFIELD,TIME,",
        "TBFIELD,TEMP,",
        "TBTEMP,",
        "TBTEMP",
        "TBDELE,WEAR",
        "1",
        "2.d0",
        "1e-4",
        "-99",
        "10",
        ",",
        ",",
        ",",
        "\n",
        "\n",
        "\n",
        "\r\n",
        "\r",
        "$",
        "!",
        "K",
        "K=",
        "*SET,K,",
        "*IF,THEN",
        "*ENDIF",
        "*DO,I",
        "(",
        ")",
        "**",
        "*",
        "-",
        "+",
        "/",
        "'",
        " ",
        "\t",
        "SQRT(",
        "LOG(",
        "=",
        "/EOF",
        "é",
        "\u{fffd}",
        "\0",
        "\u{1b}[31m",
        "C***",
        "/COM",
        "%",
        "A(1)=",
    ]);
    prop_oneof![9 => known.prop_map(str::to_owned), 1 => ".{0,6}"]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn arbitrary_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        exercise(&bytes);
    }

    #[test]
    fn arbitrary_pieces(pieces in prop::collection::vec(piece(), 0..60)) {
        exercise(pieces.concat().as_bytes());
    }

    #[test]
    fn arbitrary_fields(fields in prop::collection::vec(prop::collection::vec(piece(), 0..4), 0..8)) {
        let fields: Vec<String> = fields.iter().map(|f| f.concat()).collect();
        let fields = fields.join(",");
        exercise(format!("K=3\nTB,WEAR,1,,,ARCD\nTBDATA,{fields}\nTBTEMP,{fields}\nTB,WEAR,{fields}").as_bytes());
    }
}

#[test]
fn a_good_deck_damaged_at_every_byte() {
    let deck = b"K=1e-4\nTB,WEAR,1,,,ARCD\nTBFIELD,TIME,0\nTBDATA,1,K*2,1e10,1,1,10\nTBDATA,6,0,0,1\nTB,WEAR,1,,,CBCS\nTBDATA,1,.5";
    exercise(deck);
    for at in 0..deck.len() {
        for byte in [0, b',', b'(', b'\n', b'$', b'*', 0xff] {
            let mut damaged = deck.to_vec();
            damaged[at] = byte;
            exercise(&damaged);
        }
        exercise(&deck[..at]);
    }
}
