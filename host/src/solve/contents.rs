//! What stands behind the names of files in a scene, as hashes: a run goes on from a checkpoint only with the same.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use sha2::{Digest, Sha256};

use super::SolveError;

/// SHA-256 of numbers, to the bit.
pub(super) fn of_numbers(numbers: &[f64]) -> String {
    let mut hash = Sha256::new();
    let mut bytes = Vec::with_capacity(8 * 4096);
    for piece in numbers.chunks(4096) {
        bytes.clear();
        bytes.extend(piece.iter().flat_map(|number| number.to_le_bytes()));
        hash.update(&bytes);
    }
    text(hash)
}

/// SHA-256 of what a value looks like.
pub(super) fn of_value(value: &impl std::fmt::Debug) -> String {
    let mut hash = Sha256::new();
    hash.update(format!("{value:?}"));
    text(hash)
}

/// SHA-256 of a file.
///
/// # Errors
/// A file that cannot be read.
pub(super) fn of_file(path: &Path) -> Result<String, SolveError> {
    let fail = |source| SolveError::Contents { path: path.to_owned(), source };
    let mut file = File::open(path).map_err(fail)?;
    let mut hash = Sha256::new();
    let mut piece = vec![0; 1 << 16];
    loop {
        match file.read(&mut piece).map_err(fail)? {
            0 => return Ok(text(hash)),
            length => hash.update(&piece[..length]),
        }
    }
}

fn text(hash: Sha256) -> String {
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_numbers_hashes_like_the_numbers_and_one_bit_shows() {
        let numbers: Vec<f64> = (0..10_000).map(|i| f64::from(i) / 3.0).collect();
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("numbers");
        std::fs::write(&path, numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>()).unwrap();
        let hash = of_numbers(&numbers);
        assert_eq!(of_file(&path).unwrap(), hash);
        let mut other = numbers.clone();
        other[9_999] = f64::from_bits(other[9_999].to_bits() ^ 1);
        assert_ne!(of_numbers(&other), hash);
        assert_ne!(of_value(&0.0), of_value(&-0.0));
        assert!(of_file(&place.path().join("none")).unwrap_err().to_string().contains("none"));
    }
}
