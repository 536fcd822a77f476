//! What it costs to evaluate a law through the C host library instead of the crate, on the same arrays.
//!
//! `cargo bench -p wearlaw --bench host_c`; without `--bench` (as `cargo test --benches` runs it) it only checks that both
//! give the same bits.
#![allow(unsafe_code)] // reason: calls the host library as C does.

mod support;

use std::cell::{RefCell, RefMut};
use std::ffi::{CStr, CString, c_char};
use std::hint::black_box;
use std::path::Path;

use libloading::Library;
use support::laws;
use support::timing::{Placed, Side, filled, in_turns, is_measured};
use wearlaw::law::{Batch, CallNumbers, Evaluation, Evaluator, Field, LawInstance, Outputs, Values};
use wearlaw_host::abi::{Constants, Outputs as HostOutputs, Solver, Source, Step};
use wearlaw_host::functions::{LawHandle, SurfaceHandle};
use wearlaw_plugin_api::abi::{WL_FIELD_PRESSURE, WL_FIELD_VELOCITY};

const DT: f64 = 0.125;
const CONSTANTS: [f64; 2] = [1e-4, 2e9];

fn main() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let in_c = laws::in_c(folder.path());
    let host = laws::archard().with_file_name(format!(
        "{}wearlaw_host{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    ));
    // SAFETY: the library is ours and does nothing when it is loaded.
    let host = unsafe { Library::new(&host) }.expect("cargo builds the host library beside this program");
    println!("linear law, least and median ns per point: the crate (a batch built for each call), the C host library");
    println!("{:>8} {:>8} {:>15} {:>15} {:>14}", "law", "points", "crate", "C host", "C host / crate");
    for (name, path) in [("C", &in_c), ("archard", &laws::archard())] {
        for points in if is_measured() { [1000, 100_000, 1_000_000] } else { [1, 1000, 8193] } {
            compare(name, &laws::load(path), &host, path, points);
        }
    }
}

fn compare(name: &str, law: &LawInstance, host: &Library, path: &Path, points: usize) {
    let mut place = Placed::new(&[points; 3]);
    let [p, v, answer] = filled(&mut place);
    let (p, v) = (&*p, &*v);
    // One array for both: two that lie differently to what is read can differ by a third in time.
    let w = RefCell::new(answer);
    let w = || RefMut::map(w.borrow_mut(), |w| &mut **w);
    let surface = Surface::new(host, path, p, v);
    let mut sides: Vec<Side<'_>> = vec![
        Box::new(|calls| (0..calls).for_each(|_| through_crate(law, black_box(p), black_box(v), &mut w()))),
        Box::new(|calls| (0..calls).for_each(|_| surface.evaluate(&mut w()))),
    ];
    let (rounds, calls) = if is_measured() { (201, (1 << 21) / points) } else { (1, 1) };
    let times = in_turns(rounds, calls.max(2), &mut sides);
    let per_point = |seconds: f64| seconds * 1e9 / points as f64;
    let cell =
        |side: usize| format!("{:>7.3} {:>7.3}", per_point(times[side].least()), per_point(times[side].median()));
    let (least, median) = (times[1].least() / times[0].least(), times[1].median() / times[0].median());
    println!("{name:>8} {points:>8} {:>15} {:>15} {least:>7.3} {median:>6.3}", cell(0), cell(1));
    let mut answers = Vec::new();
    for side in &mut sides {
        w().fill(f64::NAN);
        side(1);
        answers.push(w().iter().map(|x| x.to_bits()).collect::<Vec<_>>());
    }
    assert_eq!(answers[0], answers[1]);
    assert!(f64::from_bits(answers[0][points - 1]).is_finite());
}

fn through_crate(law: &LawInstance, p: &[f64], v: &[f64], w: &mut [f64]) {
    let mut constants = [1.0; 4];
    constants[..2].copy_from_slice(&CONSTANTS);
    let batch = Batch::builder(law.descriptor(), p.len())
        .numbers(CallNumbers { dt: DT, ..CallNumbers::default() })
        .constants(&constants[..law.descriptor().constants.len()])
        .field(Field::Pressure, Values::PerPoint(p))
        .field(Field::Velocity, Values::PerPoint(v))
        .build()
        .expect("the columns fit the law");
    assert_eq!(law.evaluate(&batch, &mut Outputs::new(w)), Ok(Evaluation::Good));
}

type Open = unsafe extern "C" fn(*const Source, *const Solver, *mut *mut LawHandle, *mut c_char, i64) -> i32;
type OpenSurface = unsafe extern "C" fn(*const LawHandle, i64, *mut *mut SurfaceHandle, *mut c_char, i64) -> i32;
type SetConstants = unsafe extern "C" fn(*mut SurfaceHandle, *const Constants, *mut c_char, i64) -> i32;
type SetField = unsafe extern "C" fn(*mut SurfaceHandle, i64, *const f64, i64, i64, *mut c_char, i64) -> i32;
type Evaluate = unsafe extern "C" fn(*mut SurfaceHandle, *const Step, *mut HostOutputs, *mut c_char, i64) -> i32;

/// A surface behind the C functions.
struct Surface {
    handle: *mut SurfaceHandle,
    evaluate: Evaluate,
    step: Step,
}

impl Surface {
    fn new(host: &Library, path: &Path, p: &[f64], v: &[f64]) -> Self {
        let path = CString::new(path.to_str().expect("a path in UTF-8")).expect("a path without NUL");
        let mut words = [0; 300];
        let text: (*mut c_char, i64) = (words.as_mut_ptr(), 300);
        let done = |status: i32| {
            // SAFETY: the host library ends its texts with a NUL.
            assert_eq!(status, 0, "{:?}", unsafe { CStr::from_ptr(text.0) });
        };
        // SAFETY: the functions have the types that they are declared with, and every pointer leads to a local or to an
        // array that outlives the surface; zeros are a value of the structs.
        unsafe {
            let open = host.get::<Open>(b"wlh_open_1").expect("a function");
            let surface = host.get::<OpenSurface>(b"wlh_open_surface").expect("a function");
            let constants = host.get::<SetConstants>(b"wlh_set_constants").expect("a function");
            let field = host.get::<SetField>(b"wlh_set_field").expect("a function");
            let mut source: Source = std::mem::zeroed();
            (source.struct_size, source.name) = (size_of::<Source>() as i64, path.as_ptr());
            let mut solver: Solver = std::mem::zeroed();
            (solver.struct_size, solver.dimension) = (size_of::<Solver>() as i64, 3);
            solver.provides = WL_FIELD_PRESSURE | WL_FIELD_VELOCITY;
            let (mut law, mut handle) = (std::ptr::null_mut(), std::ptr::null_mut());
            done(open(&source, &solver, &mut law, text.0, text.1));
            done(surface(law, p.len() as i64, &mut handle, text.0, text.1));
            let mut given: Constants = std::mem::zeroed();
            (given.struct_size, given.count) = (size_of::<Constants>() as i64, 2);
            (given.values, given.value_count) = (CONSTANTS.as_ptr(), 2);
            done(constants(handle, &given, text.0, text.1));
            done(field(handle, WL_FIELD_PRESSURE, p.as_ptr(), p.len() as i64, 1, text.0, text.1));
            done(field(handle, WL_FIELD_VELOCITY, v.as_ptr(), v.len() as i64, 1, text.0, text.1));
            let mut step: Step = std::mem::zeroed();
            (step.struct_size, step.dt) = (size_of::<Step>() as i64, DT);
            Self { handle, evaluate: *host.get::<Evaluate>(b"wlh_evaluate").expect("a function"), step }
        }
    }

    fn evaluate(&self, w: &mut [f64]) {
        // SAFETY: zeros are a value of the struct.
        let mut outputs: HostOutputs = unsafe { std::mem::zeroed() };
        outputs.struct_size = size_of::<HostOutputs>() as i64;
        (outputs.increment, outputs.increment_length) = (w.as_mut_ptr(), w.len() as i64);
        let mut words = [0; 300];
        // SAFETY: the surface's arrays outlive it, the outputs are borrowed for the call.
        let status = unsafe {
            (self.evaluate)(self.handle, black_box(&self.step), black_box(&mut outputs), words.as_mut_ptr(), 300)
        };
        assert_eq!(status, 0);
    }
}
