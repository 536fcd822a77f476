//! The files that mutants are made of: the shipped laws and the helpers that make batches of them.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use wearlaw::law::Field;

/// A file of a law, and which parts of it are mutated.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The file, from the root of the repository.
    pub file: PathBuf,
    /// Folder of the law that is checked with it, from the root.
    pub law: PathBuf,
    /// A law for tests that uses every part of a helper, in place of a shipped one: its source and its name.
    pub everything: Option<(PathBuf, &'static str)>,
    /// Its text.
    pub text: String,
    /// Bytes of it that are mutated.
    pub regions: Vec<Range<usize>>,
    /// Bytes in which only names are taken for one another: units and constants as they are declared.
    pub declarations: Vec<Range<usize>>,
    /// Only lines with this word are mutated.
    pub lines_with: Option<&'static str>,
    /// Lines with one of these words are not mutated.
    pub not_run: Vec<String>,
    /// Names that may be taken for one another.
    pub names: Vec<&'static [&'static str]>,
}

impl Subject {
    /// The file's path as text.
    pub fn name(&self) -> String {
        self.file.display().to_string()
    }

    /// Whether it is a source of Fortran.
    pub fn is_fortran(&self) -> bool {
        is_fortran(&self.name())
    }

    /// Whether it is a law in a language whose compiler needs no second for it.
    pub fn is_quickly_built(&self) -> bool {
        self.everything.is_none() && self.file.extension().is_some_and(|ending| ending != "rs" && ending != "h")
    }

    /// A subject of a text that is mutated as a whole.
    #[cfg(test)]
    pub fn of_text(file: &str, text: &str, names: &[&'static [&'static str]]) -> Self {
        let whole: Range<usize> = 0..text.len();
        Self {
            file: file.into(),
            law: PathBuf::new(),
            everything: None,
            text: text.to_owned(),
            regions: vec![whole],
            declarations: Vec::new(),
            lines_with: None,
            not_run: Vec::new(),
            names: names.to_vec(),
        }
    }

    /// A file's regions, each from the first `from` to the next `to` behind it.
    fn new(law: &str, file: &str, marks: &[(&str, &str)], names: &[&'static [&'static str]]) -> Self {
        let text = fs::read_to_string(root().join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
        let declarations = Vec::new();
        let mut subject = Self {
            file: file.into(),
            law: law.into(),
            everything: None,
            text,
            regions: Vec::new(),
            declarations,
            lines_with: None,
            not_run: Vec::new(),
            names: names.to_vec(),
        };
        subject.regions = marks.iter().map(|(from, to)| subject.between(from, to)).collect();
        subject
    }

    fn between(&self, from: &str, to: &str) -> Range<usize> {
        let start = self.text.find(from).unwrap_or_else(|| panic!("no `{from}` in {}", self.name()));
        start..self.text[start..].find(to).map_or(self.text.len(), |at| start + at)
    }

    fn declaring(mut self, from: &str, to: &str) -> Self {
        self.declarations.push(self.between(from, to));
        self
    }

    /// With the law of `tests/data/languages` that uses everything.
    fn by_everything(mut self, file: &str, name: &'static str) -> Self {
        self.everything = Some((Path::new("tests/data/languages").join(file), name));
        self
    }

    /// Without the lines with one of these words, in which a mistake changes nothing.
    fn without(mut self, words: Vec<String>) -> Self {
        self.not_run = words;
        self
    }

    fn lines_with(mut self, word: &'static str) -> Self {
        self.lines_with = Some(word);
        self
    }
}

/// Whether a file is a source of Fortran, by its name.
pub fn is_fortran(file: &str) -> bool {
    [".f90", ".inc"].iter().any(|ending| file.ends_with(ending))
}

/// Root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().expect("the repository is there")
}

/// Whether Fortran can be compiled here.
fn has_fortran() -> bool {
    let compiler = std::env::var("FC").unwrap_or_else(|_| "gfortran".to_owned());
    std::process::Command::new(compiler).arg("--version").output().is_ok()
}

/// Fields that the laws `everything` read or use.
const EVERYTHING: [&str; 7] =
    ["pressure", "normal", "contact_state", "slip_vector", "temperature", "tangent", "point_id"];

/// Words of the lines of the helper in Fortran that no law `everything` runs, because they are for other fields (some by
/// their place among the vectors and indices), or in which nobody looks at a mistake: the extents of pointers.
fn not_run() -> Vec<String> {
    let others = Field::ALL.iter().map(|field| field.name()).filter(|name| !EVERYTHING.contains(name));
    let words = ["steps(3)", "steps(5)", "steps(8)", "c_f_pointer"].map(str::to_owned);
    others.map(|name| format!("%{name}%")).chain(words).collect()
}

/// The end of a file's last function, which no text has.
const END: &str = "\u{0}";

/// Everything that is mutated.
pub fn subjects() -> Vec<Subject> {
    let (c, cpp) = ("plugins/example-c", "plugins/example-cpp");
    let (fortran, rust, archard) = ("plugins/example-fortran", "plugins/example-rust", "plugins/archard");
    let archard_law: &[&[&str]] = &[&["pressure", "velocity"], &["k", "h", "m", "n"], &["NUMBER", "PASCAL"]];
    let softening: &[&[&str]] = &[
        &["k", "h", "softening", "t0", "tilt"],
        &["pressure", "slip", "temperature"],
        &["normal", "slip_vector"],
        &["NUMBER", "PASCAL", "PER_KELVIN", "KELVIN"],
    ];
    let functions = [("fn ", "#[cfg(test)]")];
    let mut all = vec![
        Subject::new(
            c,
            "plugins/example-c/threshold.c",
            &[("WL_POINT {", END)],
            &[&["K", "H", "p0"], &["pressure", "slip"], &["WL_NUMBER", "WL_PASCAL"]],
        )
        .declaring("C(K,", "#define LAW_WRITES"),
        Subject::new(c, "include/wearlaw_point_loop.h", &[("WL_GET", "/* ---- The functions")], &[])
            .lines_with("step")
            .by_everything("everything.c", "everything-c"),
        Subject::new(
            cpp,
            "plugins/example-cpp/running_in.cpp",
            &[("int32_t point", END)],
            &[&["K_0", "K_inf", "s_0", "H"], &["slip", "fresh"], &["number", "pascal", "metre"]],
        )
        .declaring("T K_0", "static constexpr"),
        Subject::new(cpp, "include/wearlaw_loop.hpp", &[("namespace", END)], &[])
            .lines_with("step")
            .by_everything("everything.cpp", "everything-cpp"),
        Subject::new(
            rust,
            "plugins/example-rust/src/lib.rs",
            &[("fn point(", "fn refuse"), ("fn direction(", "#[cfg(test)]")],
            softening,
        )
        .declaring("Quantity::new", "const DEGREE"),
        Subject::new(
            rust,
            "plugin-api/src/sdk/point.rs",
            &[("impl<T: PointLaw>", "/// A point at which nothing")],
            &[],
        )
        .by_everything("everything.rs", "everything-rust"),
        Subject::new(archard, "plugins/archard/src/law.rs", &[("fn evaluate(", "#[cfg(test)]")], archard_law)
            .declaring("Quantity::new", "const DEGREE"),
    ];
    for file in ["linear", "steady", "kernel", "scale", "sweep"] {
        let file = format!("plugins/archard/src/power/{file}.rs");
        all.push(Subject::new(archard, &file, &functions, &[]));
    }
    if has_fortran() {
        let file = "plugins/example-fortran/dissipated_work.f90";
        let units: &[&[&str]] = &[&["wl_per_pascal", "wl_number"]];
        all.push(
            Subject::new(fortran, file, &[("out%increment", "end function point")], units)
                .declaring("wl_declared(WL_KIND_CONSTANT", "contains"),
        );
        all.push(
            Subject::new(fortran, "include/wearlaw_point_loop.inc", &[("subroutine", END)], &[])
                .lines_with("step")
                .without(not_run())
                .by_everything("everything.f90", "everything-fortran"),
        );
    } else {
        println!("NOT RUN: mutate fortran: no compiler");
    }
    all
}
