//! Input decks with mistakes, through a scene and through `wearlaw apdl`: file, line and column, the line underlined.

use super::program::{Room, SCENE};

#[test]
fn a_mistake_in_a_deck_is_underlined() {
    let room = Room::new();
    let constants = "constants = { K = 1.0e-4, H = 1.0e3, m = 1.0, n = 1.0 }";
    room.write("scene.toml", &SCENE.replace(constants, "apdl = \"deck.inp\""));
    for (deck, telling) in [
        ("TB,WEAR,1,,,ARCD\nTBDATA,1,1e-4,1e1x,1,1\n", &["deck.inp:2:15", "1e1x"] as &[&str]),
        ("TB,WEAR,1,,,ARCT\nTBDATA,1,1e-4,1e10,1,1\n", &["deck.inp:1:13", "ARCT"]),
        ("TBDATA,1,1e-4,1e10,1,1\n", &["deck.inp:1:1", "TB"]),
        ("TB,WEAR,1,,,ARCD\nTBDATA,0,1e-4,1e10,1,1\n", &["deck.inp:2:", "0"]),
        ("TB,WEAR,1,,,ARCD\nTBDATA,1,K,1e10,1,1\n", &["deck.inp:2:10", "K"]),
        ("TB,WEAR,1,,,ARCD\nTBFIELD,TIEM,0\nTBDATA,1,1e-4,1e10,1,1\n", &["deck.inp:2:9", "TIEM"]),
    ] {
        room.write("deck.inp", deck);
        for words in [&["apdl", "deck.inp"], &["run", "scene.toml"], &["plan", "scene.toml"]] {
            let said = room.refused(words, telling);
            assert!(said.contains('^'), "{said}");
        }
        let document = room.json(&["apdl", "deck.inp", "--json"], 2);
        assert!(document["error"]["line"].as_u64() > Some(0), "{document}");
    }
}

#[test]
fn a_deck_that_does_not_fit_the_scene_is_refused() {
    let room = Room::new();
    let constants = "constants = { K = 1.0e-4, H = 1.0e3, m = 1.0, n = 1.0 }";
    room.write("scene.toml", &SCENE.replace(constants, "apdl = \"deck.inp\""));
    for (deck, telling) in [
        ("ET,1,185\n", &["deck.inp", "TB,WEAR"] as &[&str]),
        ("TB,WEAR,1,,,ARCD\nTBDATA,1,1e-4,-5,1,1\n", &["constant `H`", "-5", "(0, inf)"]),
        ("TB,WEAR,1,,,ARCD\nTBDATA,1,1e-4,1e10,1,1\nTBDATA,5,7\n", &["C5 = 7", "-99"]),
        (
            "TB,WEAR,1,,,ARCD\nTBDATA,1,1e-4,1e10,1,1\nTB,WEAR,1,,,AUTS\nTBDATA,1,0.1,1e5\n",
            &["AUTS", "prescribed pressure"],
        ),
        (
            "TB,WEAR,1,,,ARCD\nTBDATA,1,1e-4,1e10,1,1\nTB,WEAR,2,,,ARCD\nTBDATA,1,1e-4,1e10,1,1\n",
            &["deck.inp", "1", "2", "material"],
        ),
    ] {
        room.write("deck.inp", deck);
        room.refused(&["run", "scene.toml"], telling);
    }
    room.refused(&["run", "scene.toml", "--set", "law.material=3"], &["material 3", "deck.inp"]);
    room.refused(&["apdl", "deck.inp", "--material", "3"], &["material 3", "deck.inp"]);
    room.refused(&["apdl", "none.inp"], &["none.inp"]);
}
