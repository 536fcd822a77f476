use super::super::height_map::read;
use super::*;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

struct Folder(TempDir);

impl Folder {
    fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap())
    }

    fn file(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, content).unwrap();
        path
    }
}

fn array(descr: &str, fortran: &str, shape: &str, bytes: &[u8]) -> Vec<u8> {
    let text = format!("{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}\n");
    let mut all = b"\x93NUMPY\x01\x00".to_vec();
    all.extend((text.len() as u16).to_le_bytes());
    all.extend(text.as_bytes());
    all.extend(bytes);
    all
}

fn doubles(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// What an error says behind the path.
fn fault(path: &Path, cells: &Cells) -> String {
    let text = read(path, cells).unwrap_err().to_string();
    text.strip_prefix(&format!("{}: ", path.display())).expect("the error begins with the path").to_owned()
}

const HEIGHTS: [f64; 6] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.5];

#[test]
fn every_format_gives_the_same_heights() {
    let (folder, grid) = (Folder::new(), cells([3, 2], [0.5, 0.5]));
    let columns = doubles(&[1.0, 4.0, 2.0, 5.0, 3.0, 6.5]);
    let esri = "NCOLS 3\nnrows 2\nxllcorner 7\nyllcorner -7\ncellsize 0.5\nNODATA_value -9999\n4 5 6.5\n1 2 3\n";
    let unbroken = "ncols 3\nnrows 2\ndx 0.5\ndy 0.5\n4 5\n6.5 1 2 3\n";
    let singles: Vec<u8> = HEIGHTS.iter().flat_map(|value| (*value as f32).to_be_bytes()).collect();
    let files = [
        folder.file("c.npy", array("<f8", "False", "(2, 3)", &doubles(&HEIGHTS))),
        folder.file("f.npy", array("<f8", "True", "(2, 3)", &columns)),
        folder.file("single.NPY", array(">f4", "False", "(2, 3)", &singles)),
        folder.file("commas.csv", "# heights\n1, 2,3\r\n\n4,5,6.5\n"),
        folder.file("semicolons.csv", "1;2;3\n4;5;6.5"),
        folder.file("blanks.txt", "1 2\t3\n  4 5 6.5\n"),
        folder.file("esri.asc", esri),
        folder.file("unbroken.asc", unbroken),
    ];
    for path in files {
        assert_eq!(read(&path, &grid).unwrap(), HEIGHTS, "{}", path.display());
    }
    let path = folder.file("gap.csv", "1,2,3\n4,5,6.5\n");
    assert_eq!(gap(Shape::File { path: path.clone() }, &grid).unwrap(), [5.5, 4.5, 3.5, 2.5, 1.5, 0.0]);
    let placed = gap_at(Shape::File { path }, [1.0, 1.0], &grid, false).unwrap_err().to_string();
    assert!(placed.contains("shape \"file\" has no apex"), "{placed}");
}

#[test]
fn a_profile_may_lie_or_stand() {
    let (folder, profile) = (Folder::new(), line(6, 1.0));
    let files = [
        folder.file("a.npy", array("<f8", "False", "(6,)", &doubles(&HEIGHTS))),
        folder.file("b.npy", array("<f8", "False", "(1, 6)", &doubles(&HEIGHTS))),
        folder.file("c.npy", array("<f8", "False", "(6, 1)", &doubles(&HEIGHTS))),
        folder.file("a.csv", "1,2,3,4,5,6.5\n"),
        folder.file("b.csv", "1\n2\n3\n4\n5\n6.5\n"),
        folder.file("a.asc", "ncols 6\nnrows 1\ncellsize 1\n1 2 3 4 5 6.5\n"),
    ];
    for path in files {
        assert_eq!(read(&path, &profile).unwrap(), HEIGHTS, "{}", path.display());
    }
}

#[test]
fn another_size_than_the_grid_is_refused_with_both() {
    let (folder, grid) = (Folder::new(), cells([3, 2], [1.0, 1.0]));
    let expected = "expected 3 x 2 as in `grid.cells`";
    let turned = folder.file("a.npy", array("<f8", "False", "(3, 2)", &doubles(&HEIGHTS)));
    assert_eq!(fault(&turned, &grid), format!("found 2 x 3 heights (in x and y), {expected}"));
    let long = folder.file("a.csv", "1,2,3\n4,5,6\n7,8,9\n");
    assert_eq!(fault(&long, &grid), format!("found 3 x 3 heights (in x and y), {expected}"));
    let esri = folder.file("a.asc", "ncols 4\nnrows 2\ncellsize 1\n1 2 3 4 5 6 7 8\n");
    assert_eq!(fault(&esri, &grid), format!("found 4 x 2 heights (in x and y), {expected}"));
    let empty = folder.file("empty.csv", "# nothing\n");
    assert_eq!(fault(&empty, &grid), format!("found 0 x 0 heights (in x and y), {expected}"));
    let solid = folder.file("solid.npy", array("<f8", "False", "(1, 2, 3)", &doubles(&HEIGHTS)));
    assert_eq!(fault(&solid, &grid), "found an array of 3 indices, expected a row of heights or a table [y][x]");
}

#[test]
fn a_height_that_is_none_is_refused_with_its_place() {
    let (folder, grid) = (Folder::new(), cells([3, 2], [1.0, 1.0]));
    let mut heights = HEIGHTS;
    heights[4] = f64::NAN;
    let array = folder.file("a.npy", array("<f8", "False", "(2, 3)", &doubles(&heights)));
    assert_eq!(fault(&array, &grid), "the height in row 2, column 2 is NaN, expected a finite number");
    let infinite = folder.file("a.csv", "1,2,inf\n4,5,6\n");
    assert_eq!(fault(&infinite, &grid), "the height in row 1, column 3 is inf, expected a finite number");
    let missing = folder.file("a.asc", "ncols 3\nnrows 2\nnodata_value -9999\n1 -9999.0 3\n4 5 6\n");
    let place = "the height in row 1, column 2 is -9999.0, the mark of a missing one";
    assert_eq!(fault(&missing, &grid), format!("{place}, expected a finite number"));
    let bare = folder.file("b.asc", "ncols 3\nnrows 2\n1 2 3\nnan 5 6\n");
    assert_eq!(fault(&bare, &grid), "the height in row 2, column 1 is nan, expected a finite number");
    let word = folder.file("b.csv", "1,2,3\n4,five,6\n");
    assert_eq!(fault(&word, &grid), "line 2, field 2: found `five`, expected a number");
    let ragged = folder.file("c.csv", "# x\n1,2,3\n4,5\n");
    assert_eq!(fault(&ragged, &grid), "line 3: found 2 heights, expected 3 as in the rows above");
}

#[test]
fn an_esri_header_is_checked() {
    let (folder, grid) = (Folder::new(), cells([3, 2], [1.0, 1.0]));
    let faulty = |text: &str| fault(&folder.file("a.asc", text), &grid);
    let cells = faulty("ncols 3\nnrows 2\ncellsize 1000\n1 2 3\n4 5 6\n");
    assert!(
        cells.starts_with("cells of length 1e3 in x, expected 1e0 as `grid.size` and `grid.cells` give"),
        "{cells}"
    );
    assert_eq!(faulty("ncols 3\n1 2 3\n"), "line 2: the header ends without `ncols` and `nrows`, expected both");
    let count = faulty("ncols 3.5\nnrows 2\n1 2 3\n");
    assert_eq!(count, "line 1: found `ncols 3.5`, expected a whole number of 1 or more behind `ncols`");
    assert!(faulty("ncols 3\nrows 2\n1 2 3\n").starts_with("line 2: found `rows`, expected ncols, nrows,"));
    let few = faulty("ncols 3\nnrows 2\n1 2 3\n4 5\n");
    assert_eq!(few, "line 4: found 5 heights, expected 3 x 2 as the header says");
}

#[test]
fn what_cannot_be_read_is_told_apart_from_what_is_wrong() {
    let (folder, grid) = (Folder::new(), cells([3, 2], [1.0, 1.0]));
    let missing = read(&folder.0.path().join("none.csv"), &grid).unwrap_err();
    assert!(missing.to_string().contains("none.csv: the height map cannot be read: ") && !missing.is_io());
    std::fs::create_dir(folder.0.path().join("a.npy")).unwrap();
    let directory = read(&folder.0.path().join("a.npy"), &grid).unwrap_err();
    assert!(matches!(directory, SurfaceError::Io { .. }) && !directory.is_io());
    let source = std::io::Error::from(std::io::ErrorKind::PermissionDenied);
    assert!(SurfaceError::Io { path: "a.csv".into(), source }.is_io());
    let ending = folder.file("a.x3p", "");
    assert_eq!(fault(&ending, &grid), "found the ending \"x3p\", expected a height map in .npy, .csv, .txt or .asc");
    let text = folder.file("b.npy", "1,2,3");
    assert_eq!(fault(&text, &grid), "not an array in .npy format");
    let short = folder.file("c.npy", array("<f8", "False", "(2, 3)", &doubles(&HEIGHTS[..5])));
    assert_eq!(fault(&short, &grid), "40 bytes of elements, expected 48 for its shape");
}
