//! Compiles a law with the machine's own compilers, loads it and calls it through the bare ABI, as a small host would.

#![allow(unsafe_code)] // the tests call loaded code; each block names what it relies on
#![allow(dead_code)] // every test target takes its own part of this file

use std::ffi::{CStr, c_char, c_void};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use wearlaw_plugin_api::abi::*;

/// Root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The folder an outsider gets.
pub fn include() -> PathBuf {
    root().join("include")
}

/// Sources that only the tests use.
pub fn data(name: &str) -> PathBuf {
    root().join("tests/data/languages").join(name)
}

/// The compiler of a source file, by its extension; an environment variable wins.
fn compiler(source: &Path) -> String {
    let (variable, fallback) = match source.extension().and_then(|e| e.to_str()) {
        Some("c") => ("CC", "cc"),
        Some("cpp") => ("CXX", "c++"),
        _ => ("FC", "gfortran"),
    };
    std::env::var(variable).unwrap_or_else(|_| fallback.to_owned())
}

/// Whether there is a Fortran compiler; says what did not run if there is none.
///
/// With `WEARLAW_NEED_FORTRAN=1` its absence is a failure.
pub fn fortran(test: &str) -> bool {
    let name = compiler(Path::new("law.f90"));
    let found = Command::new(&name).arg("--version").output().is_ok();
    if !found {
        // Straight to the stream: the harness keeps what `println!` writes when a test passes.
        writeln!(std::io::stdout(), "NOT RUN: {test}: {name} not found").expect("stdout is open");
        assert!(std::env::var("WEARLAW_NEED_FORTRAN").as_deref() != Ok("1"), "{name} is needed and was not found");
    }
    found
}

/// Compiles one law against the headers in `include`; answers the compiler's messages if it refuses.
pub fn try_compile(source: &Path, include: &Path, out: &Path, more: &[&str]) -> Result<(), String> {
    let folder = out.parent().expect("a library has a folder");
    let mut command = Command::new(compiler(source));
    command.args(["-O3", "-fPIC", "-shared", "-Wall", "-ffp-contract=off"]);
    command.args(["-fno-math-errno", "-fno-trapping-math"]);
    command.args(more).arg("-I").arg(include).arg("-o").arg(out);
    match source.extension().and_then(|e| e.to_str()) {
        Some("c") => command.arg("-std=c99"),
        Some("cpp") => command.arg("-std=c++11"),
        _ => command
            .args(["-std=f2008", "-nostdinc", "-Wno-unused-dummy-argument"])
            .arg("-J")
            .arg(folder)
            .arg(include.join("wearlaw.f90")),
    };
    let output = command.arg(source).arg("-lm").current_dir(folder).output().expect("the compiler starts");
    if output.status.success() { Ok(()) } else { Err(String::from_utf8_lossy(&output.stderr).into_owned()) }
}

/// Compiles a law in a folder of its own and loads it.
pub fn build(source: &Path) -> Native {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let out = folder.path().join("law.so");
    try_compile(source, &include(), &out, &[]).unwrap_or_else(|e| panic!("{}: {e}", source.display()));
    Native::open(&out, 0)
}

/// A loaded law.
pub struct Native {
    /// What the law says of itself.
    pub law: LawTable,
    _library: libloading::Library,
}

impl Native {
    /// Loads law `index` of a library.
    pub fn open(path: &Path, index: i32) -> Self {
        // SAFETY: the libraries are built by these tests from laws that do nothing when loaded.
        let library = unsafe { libloading::Library::new(path) }.expect("the library loads");
        // SAFETY: the tests load laws only, and a law's entry has this type by the ABI.
        let entry: EntryFn = unsafe { *library.get::<EntryFn>(ENTRY_SYMBOL).expect("an entry") };
        // SAFETY: all bits zero is a value of these plain structs (null pointers, absent functions).
        let (mut law, mut host): (LawTable, Host) = unsafe { (std::mem::zeroed(), std::mem::zeroed()) };
        law.struct_size = size_of::<LawTable>() as i64;
        host.struct_size = size_of::<Host>() as i64;
        // SAFETY: both structs live through the call and carry their sizes, as the ABI asks.
        let status = unsafe { entry(index, &host, &mut law) };
        assert_eq!(status, WL_OK, "law {index} of {}", path.display());
        // SAFETY: as above; the answer past the last law is all that is asked.
        let past = unsafe { entry(index + 9, &host, &mut law) };
        assert_eq!(past, WL_NO_MORE);
        Self { law, _library: library }
    }

    /// The names of a law's quantities of one kind, in order.
    pub fn names(&self, kind: i32) -> Vec<String> {
        (0..).map_while(|i| self.quantity(kind, i)).map(|q| text(&q.name)).collect()
    }

    /// One quantity, or nothing past the last.
    pub fn quantity(&self, kind: i32, index: i64) -> Option<Quantity> {
        // SAFETY: all bits zero is a value of this plain struct.
        let mut quantity: Quantity = unsafe { std::mem::zeroed() };
        quantity.struct_size = size_of::<Quantity>() as i64;
        let describe = self.law.describe.expect("a law with quantities describes them");
        // SAFETY: the struct lives through the call and carries its size.
        (unsafe { describe(kind, index, &mut quantity) } == WL_OK).then_some(quantity)
    }

    /// Makes an instance, or answers the law's status and text.
    pub fn create(&self, options: &CStr) -> Result<*mut c_void, (i32, String)> {
        let create = self.law.create.expect("this law has instances");
        let mut instance = std::ptr::null_mut();
        let mut buffer = [0 as c_char; 64];
        // SAFETY: every pointer is to a local that lives through the call; the text size is the buffer's.
        let status = unsafe { create(std::ptr::null(), options.as_ptr(), &mut instance, buffer.as_mut_ptr(), 64) };
        if status == WL_OK { Ok(instance) } else { Err((status, text(&buffer))) }
    }

    /// Frees an instance of this law.
    pub fn destroy(&self, instance: *mut c_void) {
        // SAFETY: the instance came from this law's create and is not used again.
        unsafe { self.law.destroy.expect("an instance can be freed")(instance) }
    }

    /// Evaluates; the view's pointers must hold as many values as its points and steps say.
    pub fn call(&self, instance: *mut c_void, view: &View, output: &mut Output) -> i32 {
        let evaluate = self.law.evaluate.expect("a law evaluates");
        // SAFETY: the tests keep the columns and the output arrays alive and as long as the view says.
        unsafe { evaluate(instance, view, output) }
    }
}

/// A view of `points` points with nothing in it.
pub fn view(points: usize, dt: f64) -> View {
    // SAFETY: all bits zero is a value of this plain struct: no columns.
    let mut view: View = unsafe { std::mem::zeroed() };
    view.struct_size = size_of::<View>() as i64;
    view.points = points as i64;
    view.dimension = 3;
    view.dt = dt;
    view
}

/// An output that takes the increments only.
pub fn output(increment: &mut [f64]) -> Output {
    // SAFETY: all bits zero is a value of this plain struct: nothing else is asked for.
    let mut output: Output = unsafe { std::mem::zeroed() };
    output.struct_size = size_of::<Output>() as i64;
    output.increment = increment.as_mut_ptr();
    output.first_bad = -1;
    output
}

/// A column over a slice.
pub fn column(values: &[f64], step: i64) -> Column {
    Column { ptr: values.as_ptr(), step }
}

/// The column of a real field by its name.
pub fn field<'a>(view: &'a mut View, name: &str) -> Option<&'a mut Column> {
    Some(match name {
        "pressure" => &mut view.pressure,
        "slip" => &mut view.slip,
        "velocity" => &mut view.velocity,
        "temperature" => &mut view.temperature,
        "friction_work" => &mut view.friction_work,
        _ => return None,
    })
}

/// A C text in a fixed array.
pub fn text(chars: &[c_char]) -> String {
    let bytes: Vec<u8> = chars.iter().take_while(|c| **c != 0).map(|c| *c as u8).collect();
    String::from_utf8(bytes).expect("the texts of the laws are ASCII")
}

/// Distance of two numbers in units in the last place.
pub fn ulps(a: f64, b: f64) -> u64 {
    let place = |x: f64| {
        if x.to_bits() >> 63 == 1 { -((x.to_bits() << 1 >> 1) as i64) } else { x.to_bits() as i64 }
    };
    if a.is_nan() || b.is_nan() { u64::MAX } else { place(a).abs_diff(place(b)) }
}

/// Even numbers between 0 and 1, the same in every run.
pub struct Numbers(pub u64);

impl Iterator for Numbers {
    type Item = f64;

    fn next(&mut self) -> Option<f64> {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        Some((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }
}
