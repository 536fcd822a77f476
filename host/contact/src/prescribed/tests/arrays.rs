use super::{fault, file, values};
use crate::prescribed::{Column, Header, History, Layout, Needs, PointIds, Samples};
use std::io::{Cursor, Write};
use zip::CompressionMethod::{self, Deflated, Stored};
use zip::write::SimpleFileOptions;

/// An array in .npy format whose header is padded to a multiple of `align`.
fn npy(descr: &str, fortran: bool, shape: &str, bytes: &[u8]) -> Vec<u8> {
    let order = if fortran { "True" } else { "False" };
    let mut text = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}");
    while !(10 + text.len() + 1).is_multiple_of(64) {
        text.push(' ');
    }
    text.push('\n');
    let mut array = b"\x93NUMPY\x01\x00".to_vec();
    array.extend_from_slice(&(text.len() as u16).to_le_bytes());
    array.extend_from_slice(text.as_bytes());
    array.extend_from_slice(bytes);
    array
}

fn doubles(shape: &str, values: &[f64]) -> Vec<u8> {
    let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    npy("<f8", false, shape, &bytes)
}

fn archive(method: CompressionMethod, align: u16, arrays: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(method).with_alignment(align);
    for (name, array) in arrays {
        zip.start_file(format!("{name}.npy"), options).unwrap();
        zip.write_all(array).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

const GRID: [f64; 6] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];

fn grid_arrays() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("time", doubles("(2,)", &[0.0, 1.0])),
        ("pressure", doubles("(2, 3)", &GRID)),
        ("velocity", doubles("(2,)", &[0.1, 0.2])),
        ("area", doubles("()", &[2.0])),
        ("x", npy("<f4", false, "(3,)", &[0, 0, 0, 0, 0, 0, 128, 63, 0, 0, 0, 64])),
    ]
}

pub(super) fn small_archive() -> Vec<u8> {
    archive(Stored, 64, &grid_arrays()[..2])
}

fn read(bytes: &[u8], needs: &Needs) -> History {
    let (_folder, path) = file("h.npz", bytes);
    History::read(&path, needs).expect("a good history")
}

#[test]
fn stored_and_deflated_grids_read_alike_and_only_the_stored_one_is_mapped() {
    let needs = Needs::of(&[Column::Pressure, Column::Velocity, Column::Area, Column::X]);
    let stored = read(&archive(Stored, 64, &grid_arrays()), &needs);
    let deflated = read(&archive(Deflated, 1, &grid_arrays()), &needs);
    for history in [&stored, &deflated] {
        assert_eq!(history.times(), [0.0, 1.0]);
        assert_eq!(*history.point_ids(), PointIds::Counted(3));
        assert_eq!(values(history, Column::Pressure), GRID);
        assert_eq!(values(history, Column::Velocity), [0.1, 0.1, 0.1, 0.2, 0.2, 0.2]);
        assert_eq!(values(history, Column::Area), [2.0; 6]);
        assert_eq!(values(history, Column::X), [0.0, 1.0, 2.0, 0.0, 1.0, 2.0]);
    }
    let samples = |history: &History| history.data(Column::Pressure).unwrap().samples.clone();
    assert!(matches!(samples(&stored), Samples::Mapped { len: 6, .. }));
    assert!(matches!(samples(&deflated), Samples::Owned(_)));
    assert!(matches!(stored.data(Column::X).unwrap().samples, Samples::Owned(_)), "f4 is copied");
}

#[test]
fn an_array_off_its_alignment_is_copied() {
    // Whatever the names' lengths, of eight paddings at most one makes the array aligned.
    let mut mapped = 0;
    for pad in 0..8 {
        let mut arrays = grid_arrays();
        let name = &"padding_"[..=pad];
        arrays.insert(0, (name, npy("|u1", false, "()", &[7])));
        let mut needs = Needs::of(&[Column::Pressure]);
        needs.allow(name);
        let history = read(&archive(Stored, 1, &arrays), &needs);
        assert_eq!(values(&history, Column::Pressure), GRID);
        mapped += usize::from(history.data(Column::Pressure).unwrap().samples.is_mapped());
    }
    assert_eq!(mapped, 1);
}

#[test]
fn every_type_and_order_of_elements_is_read() {
    let le = |bytes: &[u8]| bytes.to_vec();
    let cases: Vec<(&str, bool, Vec<u8>)> = vec![
        ("<f4", false, GRID.iter().flat_map(|v| (*v as f32).to_le_bytes()).collect()),
        (">f8", false, GRID.iter().flat_map(|v| v.to_be_bytes()).collect()),
        (">f4", false, GRID.iter().flat_map(|v| (*v as f32).to_be_bytes()).collect()),
        ("<i8", false, GRID.iter().flat_map(|v| (*v as i64).to_le_bytes()).collect()),
        (">i4", false, GRID.iter().flat_map(|v| (*v as i32).to_be_bytes()).collect()),
        ("<u2", false, GRID.iter().flat_map(|v| (*v as u16).to_le_bytes()).collect()),
        ("|u1", false, le(&[1, 2, 3, 4, 5, 6])),
        ("|u1", true, le(&[1, 4, 2, 5, 3, 6])),
        ("<f8", true, [1.0, 4.0, 2.0, 5.0, 3.0, 6.0_f64].iter().flat_map(|v| v.to_le_bytes()).collect()),
    ];
    for (descr, fortran, bytes) in cases {
        let mut arrays = grid_arrays();
        arrays[1].1 = npy(descr, fortran, "(2, 3)", &bytes);
        let history = read(&archive(Stored, 64, &arrays), &Needs::of(&[Column::Pressure]));
        assert_eq!(values(&history, Column::Pressure), GRID, "{descr}, fortran {fortran}");
    }
    let mut arrays = grid_arrays();
    arrays[1].1 = npy("|i1", false, "(2, 3)", &[255, 254, 3, 4, 5, 128]);
    let history = read(&archive(Stored, 64, &arrays), &Needs::of(&[Column::Pressure]));
    assert_eq!(values(&history, Column::Pressure), [-1.0, -2.0, 3.0, 4.0, 5.0, -128.0]);
}

#[test]
fn the_long_form_reads_as_the_same_rows_in_text() {
    let arrays = [
        ("point", npy("<i4", false, "(6,)", &[9, 0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0])),
        ("time", doubles("(6,)", &[0.0, 1.0, 1.0, 0.0, 1.0, 1.0])),
        ("pressure", doubles("(6,)", &[10.0, 11.0, 12.0, 20.0, 21.0, 22.0])),
        ("slip", doubles("(6,)", &[0.0, 3.0, 3.0, 0.0, 3.0, 3.0])),
        ("temperature", doubles("()", &[20.0])),
    ];
    let bytes = archive(Deflated, 1, &arrays);
    let needs = Needs::of(&[Column::Pressure, Column::Slip, Column::Temperature]);
    let history = read(&bytes, &needs);
    assert_eq!(history.times(), [0.0, 1.0, 1.0]);
    assert_eq!(*history.point_ids(), PointIds::Listed(vec![2, 9]));
    assert_eq!(values(&history, Column::Pressure), [20.0, 10.0, 21.0, 11.0, 22.0, 12.0]);
    assert_eq!(history.data(Column::Slip).unwrap().samples.as_slice(), [0.0, 3.0, 3.0]);
    assert_eq!(values(&history, Column::Temperature), [20.0; 6]);
    let (_folder, path) = file("h.npz", &bytes);
    let header = Header::read(&path).unwrap();
    assert_eq!((header.layout, header.times, header.points), (Layout::NpzLong, None, None));
}

#[test]
fn the_header_of_a_grid_tells_its_extent() {
    // An archive is known by its first bytes, whatever its name.
    let (_folder, path) = file("h.data", &archive(Deflated, 1, &grid_arrays()));
    let header = Header::read(&path).unwrap();
    assert_eq!((header.layout, header.times, header.points), (Layout::NpzGrid, Some(2), Some(3)));
    assert_eq!(header.names, ["time", "pressure", "velocity", "area", "x"]);
}

fn grid_fault(name: &'static str, array: Vec<u8>) -> String {
    let mut arrays = grid_arrays();
    arrays.retain(|a| a.0 != name);
    arrays.push((name, array));
    let mut needs = Needs::of(&[Column::Pressure, Column::Area]);
    if name == "friction" {
        needs.add(Column::Friction);
    }
    fault("h.npz", &archive(Stored, 64, &arrays), &needs)
}

#[test]
fn every_fault_of_an_array_is_told() {
    let nan = doubles("(2, 3)", &[1.0, 2.0, 3.0, 4.0, f64::NAN, 6.0]);
    let cases = [
        ("pressure", nan, "h.npz: array `pressure`, element 4: found NaN, expected a finite number"),
        (
            "pressure",
            doubles("(3, 3)", &[1.0; 9]),
            "h.npz: array `pressure` has shape (3, 3), expected (2, 3), (2,), (3,) or ()",
        ),
        (
            "pressure",
            doubles("(2, 3)", &[1.0; 5]),
            "h.npz: array `pressure`: 40 bytes of elements, expected 48 for its shape",
        ),
        (
            "pressure",
            doubles("(4294967296, 4294967296)", &[1.0]),
            "h.npz: array `pressure`: 8 bytes of elements, expected 18446744073709551615 for its shape",
        ),
        (
            "pressure",
            npy("<c16", false, "()", &[0; 16]),
            "h.npz: array `pressure`: elements of type '<c16', expected float64 or float32, or integers of 1 to 8 bytes",
        ),
        ("pressure", b"PRESSURE".to_vec(), "h.npz: array `pressure`: not an array in .npy format"),
        ("time", doubles("(2,)", &[1.0, 0.0]), "h.npz: array `time`, element 1: time goes back from 1 to 0"),
        ("time", doubles("(2, 1)", &[0.0, 1.0]), "h.npz: array `time` has shape (2, 1), expected one index"),
        ("point", doubles("(3,)", &[0.0, 1.5, 2.0]), "h.npz: array `point`, element 1: found 1.5, expected an integer"),
        ("point", doubles("(3,)", &[0.0, 1.0, 0.0]), "h.npz: array `point` holds the id 0 twice"),
        ("area", doubles("(3,)", &[1.0, 1.0, -2.0]), "h.npz: area -2 of point 2 at time 0, expected more than 0"),
        ("friction", doubles("()", &[-0.5]), "h.npz: friction -0.5 of point 0 at time 0, expected at least 0"),
        ("presure", doubles("()", &[1.0]), "h.npz: unknown column `presure`; did you mean `pressure`?"),
    ];
    for (name, array, expected) in cases {
        // `point` of three ids replaces nothing; the extents still come from the pressure.
        assert_eq!(grid_fault(name, array), expected, "{name}");
    }
}

#[test]
fn more_faults_of_shapes_and_archives_are_told() {
    let needs = Needs::of(&[Column::Pressure]);
    let square = [
        ("time", doubles("(2,)", &[0.0, 1.0])),
        ("pressure", doubles("(2, 2)", &[1.0; 4])),
        ("velocity", doubles("(2,)", &[1.0; 2])),
    ];
    let told = fault("h.npz", &archive(Stored, 1, &square), &needs);
    assert!(told.contains("`velocity` has shape (2,), expected (2, 1) for a value per time or (1, 2)"), "{told}");
    let thrice = [("time", doubles("(3,)", &[0.0; 3])), ("pressure", doubles("()", &[1.0]))];
    let told = fault("h.npz", &archive(Stored, 1, &thrice), &needs);
    assert!(told.contains("element 2: time 0 is given more than twice"), "{told}");
    let none = [("time", doubles("(0,)", &[])), ("pressure", doubles("()", &[1.0]))];
    assert!(fault("h.npz", &archive(Stored, 1, &none), &needs).contains("no rows"));
    assert!(fault("h.npz", b"time,point,pressure\n", &needs).contains("not a readable NPZ archive"));
    let whole = small_archive();
    assert!(fault("h.npz", &whole[..whole.len() - 30], &needs).contains("not a readable NPZ archive"));
    let mut damaged = whole.clone();
    let at = whole.windows(8).position(|w| w == 3.0_f64.to_le_bytes()).unwrap();
    damaged[at] = 1;
    assert!(fault("h.npz", &damaged, &needs).contains("array `pressure`: cannot be read to its end"));
}
