//! Makes new inputs from known ones: flipped bits, other bytes, pieces cut, doubled, moved in from another input, words
//! that the formats know, numbers at the ends of their ranges.

use super::random::Random;

/// Words of the formats, and numbers that are hard to take.
const WORDS: [&[u8]; 44] = [
    b"[",
    b"]",
    b"{",
    b"}",
    b"=",
    b"\"",
    b"'",
    b"#",
    b"!",
    b",",
    b"\n",
    b"\r\n",
    b"\0",
    b"\xef\xbb\xbf",
    b"\xff",
    b"(",
    b")",
    b"*",
    b"/",
    b"%",
    b"nan",
    b"-inf",
    b"1e999",
    b"-1",
    b"9223372036854775808",
    b"18446744073709551616",
    b"0x7f",
    b"5e-324",
    b"1e308",
    b"[law]",
    b"[[step]]",
    b"constants",
    b"time",
    b"pressure",
    b"TB,WEAR",
    b"TBDATA",
    b"TBTEMP",
    b"TBFIELD",
    b"*SET",
    b"*DO",
    b"\x93NUMPY",
    b"PK\x03\x04",
    b"\x7fELF",
    b"\xff\xff\xff\xff",
];

/// A new input from one of `known`.
pub fn mutated(known: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut bytes = known.get(random.below(known.len())).cloned().unwrap_or_default();
    for _ in 0..1 + random.below(4) {
        let at = random.below(bytes.len() + 1);
        let longest = if random.below(4) == 0 { 64 } else { 6 };
        let length = 1 + random.below(longest);
        let end = (at + length).min(bytes.len());
        match random.below(9) {
            0 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
            1 if at < bytes.len() => bytes[at] = random.below(256) as u8,
            2 => drop(bytes.drain(at..end)),
            3 => {
                let piece = bytes[at..end].to_vec();
                let to = random.below(bytes.len() + 1);
                bytes.splice(to..to, piece);
            }
            4 => {
                let other = known.get(random.below(known.len())).cloned().unwrap_or_default();
                let from = random.below(other.len() + 1);
                let piece = other[from..(from + 4 * length).min(other.len())].to_vec();
                bytes.splice(at..end, piece);
            }
            5 => drop(bytes.splice(at..end, WORDS[random.below(WORDS.len())].iter().copied())),
            6 => drop(bytes.splice(at..at, WORDS[random.below(WORDS.len())].iter().copied())),
            7 => number(&mut bytes, random),
            _ if random.below(8) == 0 => bytes.truncate(at),
            _ => {}
        }
        bytes.truncate(1 << 16);
    }
    bytes
}

/// Puts another number in place of one that stands in the text.
fn number(bytes: &mut Vec<u8>, random: &mut Random) {
    let digits: Vec<usize> = (0..bytes.len()).filter(|at| bytes[*at].is_ascii_digit()).collect();
    let Some(at) = digits.get(random.below(digits.len())).copied() else { return };
    let end = bytes[at..].iter().position(|byte| !byte.is_ascii_digit()).map_or(bytes.len(), |length| at + length);
    let other = match random.below(5) {
        0 => random.below(10).to_string(),
        1 => format!("{}", (random.part() - 0.5) * 10_f64.powi(random.below(60) as i32 - 30)),
        2 => "0".to_owned(),
        3 => u64::MAX.to_string(),
        _ => random.below(100_000).to_string(),
    };
    bytes.splice(at..end, other.into_bytes());
}

#[test]
fn mutations_are_the_same_for_a_seed_and_differ_from_their_source() {
    let known = vec![b"time,point,pressure\n0,1,2.5\n".to_vec(), b"[law]\nuse = \"archard\"\n".to_vec()];
    let make = |seed| {
        let mut random = Random(seed);
        (0..200).map(|_| mutated(&known, &mut random)).collect::<Vec<_>>()
    };
    assert_eq!(make(7), make(7));
    assert_ne!(make(7), make(8));
    let changed = make(7).iter().filter(|bytes| !known.contains(bytes)).count();
    assert!(changed > 150, "{changed} of 200");
}
