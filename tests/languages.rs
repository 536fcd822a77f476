//! The point-wise helpers of C, C++, Fortran and Rust: the laws written with them are right, and alike in every language.

#[path = "support/native.rs"]
mod native;
#[path = "support/rust_law.rs"]
mod rust_law;

use std::path::{Path, PathBuf};

use native::{Native, Numbers, column, field, output, ulps, view};
use wearlaw_plugin_api::abi::*;

/// The sources of one law in the languages that can be compiled here.
fn in_every_language(test: &str, law: &str) -> Vec<PathBuf> {
    let mut sources = vec![native::data(&format!("{law}.c")), native::data(&format!("{law}.cpp"))];
    if native::fortran(test) {
        sources.push(native::data(&format!("{law}.f90")));
    }
    sources
}

/// Evaluates every row of a law's expected.csv and compares every answer it lists.
fn check_expected_values(source: &Path) {
    let law = native::build(source);
    let path = source.with_file_name("expected.csv");
    let mut table = csv::Reader::from_path(&path).expect("expected.csv is readable");
    let heads: Vec<String> = table.headers().expect("a header").iter().map(str::to_owned).collect();
    let states = law.names(WL_KIND_STATE);
    let mut rows = 0;
    for record in table.records() {
        let record = record.expect("a row");
        let at = |name: &str| {
            let k = heads.iter().position(|h| h == name).unwrap_or_else(|| panic!("no column {name}"));
            record[k].parse::<f64>().expect("a number")
        };
        let constants: Vec<f64> = law.names(WL_KIND_CONSTANT).iter().map(|n| at(n)).collect();
        let columns: Vec<Column> = constants.iter().map(|c| Column { ptr: c, step: 0 }).collect();
        let start: Vec<f64> = states.iter().map(|n| at(&format!("{n}_start"))).collect();
        let fields: Vec<(String, f64)> = law.names_of_fields().into_iter().map(|f| (f.clone(), at(&f))).collect();
        let mut v = view(1, at("dt"));
        v.constants = columns.as_ptr();
        v.constant_count = columns.len() as i64;
        v.state = column(&start, start.len() as i64);
        v.state_count = start.len() as i64;
        for (name, value) in &fields {
            *field(&mut v, name).expect("a field with a column here") = Column { ptr: value, step: 1 };
        }
        let (mut increment, mut slope, mut end) = ([f64::NAN], [f64::NAN], vec![f64::NAN; states.len()]);
        let mut o = output(&mut increment);
        o.state = if states.is_empty() { std::ptr::null_mut() } else { end.as_mut_ptr() };
        if law.law.writes & WL_OUT_D_PRESSURE != 0 {
            o.d_pressure = slope.as_mut_ptr();
        }
        assert_eq!(law.call(std::ptr::null_mut(), &v, &mut o), WL_OK, "{record:?}");
        let compare = |name: &str, found: f64| {
            let right = at(name);
            assert!((found - right).abs() <= 2e-15 * right.abs(), "{name}: {found:e}, expected {right:e}: {record:?}");
        };
        compare("increment", increment[0]);
        if law.law.writes & WL_OUT_D_PRESSURE != 0 {
            compare("d_pressure", slope[0]);
        }
        for (name, found) in states.iter().zip(&end) {
            compare(&format!("{name}_end"), *found);
        }
        rows += 1;
    }
    assert!(rows > 20, "{} has {rows} rows", path.display());
}

impl Native {
    fn names_of_fields(&self) -> Vec<String> {
        (0..63).filter_map(|bit| self.quantity(WL_KIND_FIELD, bit)).map(|q| native::text(&q.name)).collect()
    }
}

#[test]
fn the_example_in_c_gives_its_expected_values() {
    check_expected_values(&native::root().join("plugins/example-c/threshold.c"));
}

#[test]
fn the_example_in_cpp_gives_its_expected_values() {
    check_expected_values(&native::root().join("plugins/example-cpp/running_in.cpp"));
}

#[test]
fn the_example_in_fortran_gives_its_expected_values() {
    if native::fortran("the_example_in_fortran_gives_its_expected_values") {
        check_expected_values(&native::root().join("plugins/example-fortran/dissipated_work.f90"));
    }
}

#[test]
fn the_examples_answer_extreme_inputs_with_a_number_or_a_status() {
    let mut sources = vec!["plugins/example-c/threshold.c", "plugins/example-cpp/running_in.cpp"];
    if native::fortran("the_examples_answer_extreme_inputs_with_a_number_or_a_status") {
        sources.push("plugins/example-fortran/dissipated_work.f90");
    }
    let extremes = [0.0, -0.0, 5e-324, 1e-300, 1.0, 1e300, -1e300, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    for source in sources {
        let law = native::build(&native::root().join(source));
        let constants = vec![1e-4; law.law.constant_count as usize];
        let columns: Vec<Column> = constants.iter().map(|c| Column { ptr: c, step: 0 }).collect();
        let fields = law.names_of_fields();
        for first in &extremes {
            for second in &extremes {
                let mut v = view(1, 1.0);
                v.constants = columns.as_ptr();
                v.constant_count = columns.len() as i64;
                v.state = column(std::slice::from_ref(second), 1);
                v.state_count = law.law.state_count;
                for (name, value) in fields.iter().zip([first, second]) {
                    *field(&mut v, name).expect("a field with a column here") = Column { ptr: value, step: 1 };
                }
                let (mut increment, mut end) = ([f64::NAN], [0.0]);
                let mut o = output(&mut increment);
                o.state = if law.law.state_count > 0 { end.as_mut_ptr() } else { std::ptr::null_mut() };
                let status = law.call(std::ptr::null_mut(), &v, &mut o);
                let finite = increment[0].is_finite() && increment[0] >= 0.0 && end[0].is_finite();
                assert!(finite || status == WL_OUT_OF_DOMAIN, "{source}: {first}, {second}: {status}");
                assert!(!first.is_nan() || status == WL_OUT_OF_DOMAIN, "{source}: not a number passed silently");
            }
        }
    }
}

/// Answers of one Archard law at many points: increments, then derivatives.
fn archard(law: &Native, pressure: &[f64], velocity: &[f64]) -> Vec<f64> {
    let n = pressure.len();
    let constants = [3e-4, 1.7e9, 1.3, 0.7];
    let columns: Vec<Column> = constants.iter().map(|c| Column { ptr: c, step: 0 }).collect();
    let mut v = view(n, 0.37);
    v.constants = columns.as_ptr();
    v.constant_count = 4;
    v.pressure = column(pressure, 1);
    v.velocity = column(velocity, 1);
    let mut answer = vec![f64::NAN; 2 * n];
    let (increment, slope) = answer.split_at_mut(n);
    let mut o = output(increment);
    o.d_pressure = slope.as_mut_ptr();
    let instance = law.law.create.map(|_| law.create(c"").expect("this law has no objections"));
    assert_eq!(law.call(instance.unwrap_or(std::ptr::null_mut()), &v, &mut o), WL_OK);
    if let Some(instance) = instance {
        law.destroy(instance);
    }
    answer
}

#[test]
fn archard_agrees_in_every_language() {
    let n = 100_000;
    let mut numbers = Numbers(7);
    let mut draw =
        |low: f64, high: f64| -> Vec<f64> { numbers.by_ref().take(n).map(|x| low * (high / low).powf(x)).collect() };
    let (pressure, velocity) = (draw(1e-3, 1e10), draw(1e-9, 1e3));
    let mut answers: Vec<(String, Vec<f64>)> = in_every_language("archard_agrees_in_every_language", "archard")
        .iter()
        .map(|source| (source.display().to_string(), archard(&native::build(source), &pressure, &velocity)))
        .collect();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let library = rust_law::try_build(&rust_source(), folder.path()).unwrap_or_else(|said| panic!("{said}"));
    let law = Native::open(&library, 0);
    assert_eq!(native::text(&law.law.version), "1.0.0", "the version of the crate");
    answers.push(("archard.rs".to_owned(), archard(&law, &pressure, &velocity)));
    let (first, right) = answers.remove(0);
    for (name, found) in answers {
        let worst = found.iter().zip(&right).map(|(a, b)| ulps(*a, *b)).max();
        assert!(worst <= Some(5), "{name} and {first} differ by {worst:?} units in the last place");
    }
}

/// The law in Rust.
fn rust_source() -> String {
    std::fs::read_to_string(native::data("archard.rs")).expect("the source is there")
}

/// Lines that are neither blank nor a comment.
fn code_lines(text: &str) -> Vec<&str> {
    let comment = |l: &str| ["//", "/*", "!"].iter().any(|mark| l.starts_with(mark));
    text.lines().map(str::trim).filter(|l| !l.is_empty() && !comment(l)).collect()
}

#[test]
fn a_law_stays_within_its_lines() {
    let marks = [
        ("archard.c", "WL_POINT", "}"),
        ("archard.cpp", "int32_t point", "}"),
        ("archard.f90", "integer(c_int32_t) function point", "end function point"),
        ("archard.rs", "fn point", "}"),
    ];
    for (name, begin, end) in marks {
        let text = std::fs::read_to_string(native::data(name)).expect("the source is there");
        let lines = code_lines(&text);
        let from = lines.iter().position(|l| l.starts_with(begin)).expect("a procedure");
        let length = lines[from..].iter().position(|l| *l == end).expect("its end") + 1;
        assert!(length <= 15, "{name}: the procedure has {length} lines");
        assert!(lines.len() <= 25, "{name}: {} lines in all", lines.len());
    }
}

#[test]
fn a_misspelt_field_does_not_compile() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for source in in_every_language("a_misspelt_field_does_not_compile", "archard") {
        let text = std::fs::read_to_string(&source).expect("the source is there");
        let copy = folder.path().join(source.file_name().expect("a name"));
        let out = folder.path().join("law.so");
        for (right, wrong) in [("velocity", "velocty"), ("Velocity", "Velocty"), ("out->increment", "out->incremnt")] {
            if text.contains(right) {
                std::fs::write(&copy, text.replace(right, wrong)).expect("a writable folder");
                let refusal = native::try_compile(&copy, &native::include(), &out, &[]);
                assert!(refusal.is_err_and(|e| e.contains(wrong.trim_start_matches("out->"))), "{}", source.display());
            }
        }
    }
    for (right, wrong) in [("at.velocity", "at.velocty"), ("out.increment =", "out.incremnt =")] {
        let law = rust_source().replace(right, wrong);
        let refusal = rust_law::try_build(&law, &folder.path().join("crate"));
        let word = wrong.trim_start_matches("at.").trim_start_matches("out.").trim_end_matches(" =");
        assert!(refusal.is_err_and(|said| said.contains(word)), "archard.rs compiles with {wrong}");
    }
}
