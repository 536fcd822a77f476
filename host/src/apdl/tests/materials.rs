//! Several materials in a deck, and the choice of one.

use super::super::{LawOption, Note, Span};
use super::{deck, diagnostic};

const TWO: &str = "TB,WEAR,7,,,ARCD\nTBDATA,1,1,2,3,4\nTB,WEAR,2,,1,USER\nTBDATA,1,5\nTB,WEAR,7,,,AUTS\n";

#[test]
fn several_materials_keep_their_own_tables() {
    let deck = deck(TWO);
    assert_eq!(deck.materials.len(), 2);
    let seven = deck.material(Some(7)).unwrap();
    assert_eq!(seven.option, LawOption::Archard);
    assert!(seven.scaling.is_some());
    let expected = Span { line: 1, start: 0, end: 16 };
    assert_eq!(seven.span, expected);
    let two = deck.material(Some(2)).unwrap();
    assert_eq!(two.option, LawOption::User { constants: 1 });
    assert!(two.scaling.is_none());
    assert_eq!(&TWO[two.span.start..two.span.end], "TB,WEAR,2,,1,USER");
}

#[test]
fn the_choice_is_refused_with_a_list() {
    let message = |text: &str, chosen| deck(text).material(chosen).unwrap_err().to_string();
    assert_eq!(message(TWO, None), "deck.inp: materials 2, 7 have wear laws, expected a choice of one");
    assert_eq!(message(TWO, Some(3)), "deck.inp: material 3 has no wear law, found one for 2, 7");
    for chosen in [None, Some(1)] {
        assert_eq!(message("MP,EX,1,2e11\n", chosen), "deck.inp: found no TB,WEAR with ARCD or USER, expected one");
    }
    let one = deck("TB,WEAR,4,,,USER");
    assert_eq!(one.material(None).unwrap().id, 4);
    assert_eq!(one.material(Some(4)).unwrap().id, 4);
}

#[test]
fn a_second_law_or_scaling_is_shown_beside_the_first() {
    let text = "TB,WEAR,1,,,ARCD\nTBDATA,1,1,2,3,4\nTB,WEAR,1,,,USER\n";
    let found = diagnostic(text);
    assert_eq!(
        found.to_string(),
        "deck.inp:3:1: material 1 has a wear law already: expected one wear law and one scaling per material"
    );
    let picture = found.render();
    assert!(picture.contains("1 | TB,WEAR,1,,,ARCD"), "{picture}");
    assert!(picture.contains("given here"), "{picture}");
    let scaling = "TB,WEAR,1,,,AUTS\nTB,WEAR,1,,,CBCS\n";
    assert!(diagnostic(scaling).to_string().contains("2:1: material 1 has a scaling already"));
}

#[test]
fn a_direction_that_is_scaled_is_noted() {
    let text = "MP,EX,1,1\nTB,WEAR,1,,,ARCD\nTBDATA,1,1,2,3,4,0,3\nTBDATA,8,-4\n";
    let notes = deck(text).notes;
    let expected = Note::DirectionScaled { material: 1, line: 2, given: [3.0, 0.0, -4.0] };
    assert_eq!(notes[1..], [expected]);
    assert_eq!(
        notes[1].to_string(),
        "material 1 (line 2): C6 to C8 (3, 0, -4) are not of length 1 and are used scaled to it"
    );
}
