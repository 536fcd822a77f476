//! Every law of `plugins/` that has an `expected.csv`: built as its author would build it, loaded, and held to every
//! row, point by point and as batches that read the table in place.
//!
//! A column is a constant, a field (vectors: `_x`, `_y`, `_z`; an empty cell: not given), `dt`, `absolute_zero`, a state
//! variable with `_start` or `_end`, or an answer. Increments, state variables and derivatives agree to 4 ulp, components
//! of directions to 1e-15.
#![allow(unsafe_code)] // hands a function of this program over as the entry of a law

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use wearlaw::law::build::{BuildRequest, build};
use wearlaw::law::{
    BatchBuilder, CallNumbers, Embedded, Evaluation, Evaluator, Field, LawDescriptor, LawInstance, LoadOptions,
    OutputItem, Outputs, Plugin, Values,
};

/// Most units in the last place between an answer and its expected value.
const ULPS: f64 = 4.0;
/// Most difference of a component of a direction.
const DIRECTION: f64 = 1e-15;

/// An `expected.csv`: its rows one after the other, an empty cell as NaN.
struct Expected {
    heads: Vec<String>,
    cells: Vec<f64>,
}

impl Expected {
    fn read(path: &Path) -> Expected {
        let mut table = csv::Reader::from_path(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let heads = table.headers().expect("there is a line of names").iter().map(str::to_owned).collect();
        let number = |cell: &str| match cell {
            "" => f64::NAN,
            _ => cell.parse().unwrap_or_else(|_| panic!("{}: found `{cell}`, expected a number", path.display())),
        };
        let rows: Vec<_> = table.records().map(|row| row.expect("a row of the table's width")).collect();
        Expected { heads, cells: rows.iter().flatten().map(number).collect() }
    }

    fn rows(&self) -> usize {
        self.cells.len() / self.heads.len()
    }

    fn column(&self, name: &str) -> Option<usize> {
        self.heads.iter().position(|head| head == name)
    }

    fn get(&self, row: usize, name: &str) -> Option<f64> {
        self.column(name).map(|column| self.cells[row * self.heads.len() + column])
    }

    /// The values of a column from `row` on, as they lie in the table; absent if the first of them is.
    fn values(&self, row: usize, name: &str) -> Values<'_> {
        let Some(column) = self.column(name) else { return Values::Absent };
        let data = &self.cells[row * self.heads.len() + column..];
        if data[0].is_nan() { Values::Absent } else { Values::Strided { data, step: self.heads.len() } }
    }

    /// Whether two rows can be points of one call: the same cells given, the same `dt` and `absolute_zero`.
    fn alike(&self, one: usize, other: usize) -> bool {
        let width = self.heads.len();
        let of = |row: usize| &self.cells[row * width..(row + 1) * width];
        let given = of(one).iter().zip(of(other)).all(|(a, b)| a.is_nan() == b.is_nan());
        given && ["dt", "absolute_zero"].iter().all(|name| self.get(one, name) == self.get(other, name))
    }
}

/// What a call answered.
#[derive(Clone, Debug, Default, PartialEq)]
struct Answers {
    increment: Vec<f64>,
    direction: Vec<f64>,
    state: Vec<f64>,
    d_pressure: Vec<f64>,
}

/// Name of the first component of a field.
fn head_of(field: Field) -> String {
    let name = field.name();
    if field.shape().width() == 3 { format!("{name}_x") } else { name.to_owned() }
}

/// Evaluates `points` rows from `row` on in one call.
fn evaluate(law: &LawInstance, table: &Expected, row: usize, points: usize) -> Answers {
    let about = law.descriptor();
    let constants: Vec<_> = about.constants.iter().map(|c| table.values(row, &c.name)).collect();
    let inputs: Vec<_> = about.inputs.iter().map(|i| table.values(row, &i.name)).collect();
    let numbers = CallNumbers {
        dt: table.get(row, "dt").expect("there is a column dt"),
        absolute_zero: table.get(row, "absolute_zero").unwrap_or(0.0),
        ..CallNumbers::default()
    };
    let mut batch = BatchBuilder::new(about, points).numbers(numbers).constant_values(&constants).inputs(&inputs);
    for field in about.fields().iter() {
        batch = batch.field(field, table.values(row, &head_of(field)));
    }
    if let Some(first) = about.state.first() {
        batch = batch.state(table.values(row, &format!("{}_start", first.name)));
    }
    let batch = batch.build().unwrap_or_else(|error| panic!("{}, row {row}: {error}", about.name));

    let room = |width: usize, wanted: bool| vec![f64::NAN; if wanted { width * points } else { 0 }];
    let (slopes, turns) = (about.writes(OutputItem::DPressure), about.writes(OutputItem::Direction));
    let mut answers = Answers {
        increment: room(1, true),
        direction: room(3, turns),
        state: room(about.state.len(), true),
        d_pressure: room(1, slopes),
    };
    let mut outputs = Outputs::new(&mut answers.increment);
    outputs.direction = turns.then_some(&mut answers.direction);
    outputs.state = (!about.state.is_empty()).then_some(&mut answers.state);
    outputs.d_pressure = slopes.then_some(&mut answers.d_pressure);
    let evaluation = law.evaluate(&batch, &mut outputs);
    assert_eq!(evaluation, Ok(Evaluation::Good), "{}, row {row}", about.name);
    answers
}

/// Compares the answers at one point with a row; answers the largest difference, as part of what is allowed.
fn compare(about: &LawDescriptor, table: &Expected, row: usize, answers: &Answers) -> f64 {
    let mut named = vec![("increment".to_owned(), answers.increment[0], None)];
    named.extend(answers.d_pressure.iter().map(|slope| ("d_pressure".to_owned(), *slope, None)));
    let ends = about.state.iter().zip(&answers.state);
    named.extend(ends.map(|(variable, end)| (format!("{}_end", variable.name), *end, None)));
    let components = ["direction_x", "direction_y", "direction_z"].into_iter().zip(&answers.direction);
    named.extend(components.map(|(name, component)| (name.to_owned(), *component, Some(DIRECTION))));
    let mut worst = 0.0_f64;
    for (name, found, allowed) in named {
        let expected = table.get(row, &name).unwrap_or_else(|| panic!("{}: no column {name}", about.name));
        let size = expected.abs();
        let allowed = allowed.unwrap_or_else(|| if size == 0.0 { 0.0 } else { ULPS * (size.next_up() - size) });
        let off = (found - expected).abs();
        assert!(off <= allowed, "{}, row {row}: {name} is {found:e}, expected {expected:e}", about.name);
        if off > 0.0 {
            worst = worst.max(off / allowed);
        }
    }
    worst
}

/// Whether every column of the table means something to the law; a misspelt one would test nothing.
fn assert_known(about: &LawDescriptor, table: &Expected) {
    let mut known: Vec<String> = ["dt", "absolute_zero", "increment", "d_pressure"].map(str::to_owned).to_vec();
    known.extend(about.constants.iter().chain(&about.inputs).map(|quantity| quantity.name.clone()));
    let vectors = about.fields().iter().filter(|field| field.shape().width() == 3).map(Field::name);
    for name in vectors.chain(["direction"]) {
        known.extend(["_x", "_y", "_z"].map(|component| format!("{name}{component}")));
    }
    known.extend(about.fields().iter().map(|field| field.name().to_owned()));
    known.extend(about.state.iter().flat_map(|v| ["_start", "_end"].map(|end| format!("{}{end}", v.name))));
    for head in &table.heads {
        assert!(known.contains(head), "{}: column `{head}` means nothing", about.name);
    }
}

/// Holds the law of a folder to its table.
fn hold(folder: &Path, sources: Vec<PathBuf>, library: PathBuf) {
    let library = library_of(sources, library);
    let plugin = Plugin::open(library, &LoadOptions::default()).expect("the law loads");
    assert!(plugin.warnings().is_empty(), "{:?}", plugin.warnings());
    let law = plugin.law(None).expect("the folder holds one law").create(None).expect("the law starts");
    let about = law.descriptor();
    let table = Expected::read(&folder.join("expected.csv"));
    assert_known(about, &table);
    assert!(table.rows() >= 20, "{}: {} rows", about.name, table.rows());

    let mut worst = 0.0_f64;
    let single: Vec<_> = (0..table.rows()).map(|row| evaluate(&law, &table, row, 1)).collect();
    for (row, answers) in single.iter().enumerate() {
        worst = worst.max(compare(about, &table, row, answers));
    }
    let mut row = 0;
    while row < table.rows() {
        let points = (row..table.rows()).take_while(|other| table.alike(row, *other)).count();
        let together = evaluate(&law, &table, row, points);
        let apart =
            |part: fn(&Answers) -> &Vec<f64>| single[row..row + points].iter().flat_map(part).copied().collect();
        let apart = Answers {
            increment: apart(|a| &a.increment),
            direction: apart(|a| &a.direction),
            state: apart(|a| &a.state),
            d_pressure: apart(|a| &a.d_pressure),
        };
        assert_eq!(together, apart, "{}, {points} rows from {row}: a batch differs from its points", about.name);
        row += points;
    }
    println!("{}: {} rows, at worst {worst:.3} of what is allowed", about.name, table.rows());
}

#[test]
fn embedded_and_loaded_archard_give_the_same_bits() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../plugins/archard").canonicalize().expect("a folder");
    let libraries = tempfile::tempdir().expect("a temporary folder");
    let library = library_of(vec![folder.clone()], libraries.path().join("archard"));
    // SAFETY: the entry is made by `export_laws!`, which keeps the contract.
    let embedded = unsafe { Embedded::new("archard", wearlaw_archard::wearlaw_entry_1) };
    let [embedded, loaded] = [Plugin::from_entry(Arc::new(embedded)), Plugin::open(library, &LoadOptions::default())]
        .map(|plugin| plugin.expect("archard loads").law(None).expect("there is one").create(None).expect("it starts"));
    assert_eq!(embedded.descriptor(), loaded.descriptor());
    let table = Expected::read(&folder.join("expected.csv"));
    for row in 0..table.rows() {
        let [one, other] = [&embedded, &loaded].map(|law| {
            let answers = evaluate(law, &table, row, 1);
            [answers.increment[0].to_bits(), answers.d_pressure[0].to_bits()]
        });
        assert_eq!(one, other, "row {row}");
    }
}

/// Builds a law's library.
fn library_of(sources: Vec<PathBuf>, library: PathBuf) -> PathBuf {
    let mut request = BuildRequest { output: Some(library), ..BuildRequest::default() };
    if sources[0].is_dir() {
        request.extra_flags = vec!["--offline".into()];
    }
    request.sources = sources;
    build(&request).unwrap_or_else(|error| panic!("{:?}: {error}", request.sources)).library
}

/// The files that a folder's law is built from: a crate, or the sources of one language.
fn sources(folder: &Path) -> Vec<PathBuf> {
    if folder.join("Cargo.toml").exists() {
        return vec![folder.to_path_buf()];
    }
    let files = fs::read_dir(folder).expect("a folder of a law").map(|entry| entry.expect("an entry").path());
    let is_source = |path: &PathBuf| path.extension().is_some_and(|e| ["c", "cpp", "f90"].iter().any(|s| e == *s));
    files.filter(is_source).collect()
}

#[test]
fn every_law_gives_its_expected_values() {
    let plugins = Path::new(env!("CARGO_MANIFEST_DIR")).join("../plugins");
    let libraries = tempfile::tempdir().expect("a temporary folder");
    let fortran = std::env::var("FC").unwrap_or_else(|_| "gfortran".to_owned());
    let has_fortran = Command::new(&fortran).arg("--version").output().is_ok();
    let mut held = Vec::new();
    for entry in fs::read_dir(plugins).expect("there are plugins") {
        let folder = entry.expect("an entry").path().canonicalize().expect("an entry's path");
        if !folder.join("expected.csv").exists() {
            continue;
        }
        let sources = sources(&folder);
        assert!(!sources.is_empty(), "{} has an expected.csv and no sources", folder.display());
        if sources.iter().any(|path| path.extension().is_some_and(|e| e == "f90")) && !has_fortran {
            assert!(std::env::var("WEARLAW_NEED_FORTRAN").as_deref() != Ok("1"), "{fortran} is needed, not found");
            // Straight to the stream: what a test prints is kept back when it passes.
            let _ = writeln!(std::io::stderr(), "NOT RUN: laws_expected fortran: {fortran} not found");
            continue;
        }
        let name = folder.file_name().expect("a folder has a name").to_string_lossy().into_owned();
        hold(&folder, sources, libraries.path().join(&name));
        held.push(name);
    }
    held.sort();
    for law in ["archard", "example-c", "example-cpp", "example-rust"] {
        assert!(held.iter().any(|name| name == law), "{law} was not tested, only {held:?}");
    }
    assert!(!has_fortran || held.iter().any(|name| name == "example-fortran"), "{held:?}");
}
