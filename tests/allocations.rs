//! A key that has no effect on a scene costs nothing: the same allocations as a scene that never had it.
#![allow(unsafe_code)] // reason: an allocator that counts can be written in no other way

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicI64, AtomicU64, Ordering};

#[path = "support/solved.rs"]
mod solved;

use solved::{Case, archard};
use wearlaw::record::{End, Nobody};
use wearlaw::solve::Run;

/// The system's allocator, counting calls and bytes of all threads.
struct Counting;

static CALLS: AtomicU64 = AtomicU64::new(0);
static BYTES: AtomicU64 = AtomicU64::new(0);
/// Bytes that are held, and the most of them since the last look.
static HELD: AtomicI64 = AtomicI64::new(0);
static MOST: AtomicI64 = AtomicI64::new(0);

impl Counting {
    fn count(bytes: usize) {
        CALLS.fetch_add(1, Ordering::SeqCst);
        BYTES.fetch_add(bytes as u64, Ordering::SeqCst);
        Counting::hold(bytes as i64);
    }

    fn hold(bytes: i64) {
        let held = HELD.fetch_add(bytes, Ordering::SeqCst) + bytes;
        MOST.fetch_max(held, Ordering::SeqCst);
    }
}

// SAFETY: every call is handed to the system's allocator as it is.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        Counting::count(layout.size());
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        Counting::hold(-(layout.size() as i64));
        // SAFETY: the block came from the system's allocator, with this layout.
        unsafe { System.dealloc(block, layout) }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        Counting::count(size);
        Counting::hold(-(layout.size() as i64));
        // SAFETY: as for `dealloc`; the caller keeps the contract of `realloc`.
        unsafe { System.realloc(block, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Calls and bytes by which two runs alike may differ: threads of a pool take blocks of 2072 bytes for their queues, or
/// not, as it happens. An array of the grids here is larger than three of them.
const CHANCE: (u64, u64) = (3, 3 * 2072);

/// Whether two runs allocated alike.
fn alike(a: (u64, u64), b: (u64, u64)) -> bool {
    a.0.abs_diff(b.0) <= CHANCE.0 && a.1.abs_diff(b.1) <= CHANCE.1
}

/// Calls and bytes of a run, its preparation included. The plan is not counted, it holds the keys.
fn allocations(scene: &str) -> (u64, u64) {
    let (case, law) = (Case::text(scene), archard());
    let plan = case.plan(&law);
    let before = (CALLS.load(Ordering::SeqCst), BYTES.load(Ordering::SeqCst));
    let run = Run::prepare(&plan, &law).expect("no files");
    let record = run.go(1, &mut Nobody);
    let after = (CALLS.load(Ordering::SeqCst), BYTES.load(Ordering::SeqCst));
    assert!(matches!(record.end, End::Done), "{:?}\n{scene}", record.end);
    (after.0 - before.0, after.1 - before.1)
}

/// The most bytes that a run held at a time, its preparation included, and what it lists.
fn held(scene: &str) -> (f64, f64) {
    let (case, law) = (Case::text(scene), archard());
    let plan = case.plan(&law);
    let before = HELD.load(Ordering::SeqCst);
    MOST.store(before, Ordering::SeqCst);
    let run = Run::prepare(&plan, &law).expect("no files");
    let listed: u64 = run.memory().iter().map(|line| line.bytes).sum();
    let record = run.go(1, &mut Nobody);
    let most = MOST.load(Ordering::SeqCst) - before;
    assert!(matches!(record.end, End::Done), "{:?}\n{scene}", record.end);
    (most as f64, listed as f64)
}

/// A wave pressed flat on 128 by 128 cells: every cell is in contact.
fn wave(law: &str, integrator: &str) -> String {
    format!(
        "[law]\nuse = \"archard\"\nconstants = {{ K = 1e-4, H = 1e10 }}\n{law}\n\
         [contact]\nmodel = \"halfspace\"\nmodulus = 1.1e11\nboundary = \"periodic\"\n\
         [grid]\nsize = [1e-3, 1e-3]\ncells = [128, 128]\n\
         [surface]\nshape = \"wavy\"\namplitude = 1e-8\nwaves = [1, 1]\n\
         [[step]]\nduration = 0.1\nload = 20.0\nvelocity = 1.0\n[integrator]\n{integrator}\n"
    )
}

/// A scene of four parts, to which keys can be added: the law's, the contact's, the step's, and further sections.
type Scene = fn(&str, &str, &str, &str) -> String;

fn ball(law: &str, contact: &str, step: &str, more: &str) -> String {
    format!(
        "[law]\nuse = \"archard\"\nconstants = [1e-13, 1.0, 1.0, 1.0]\n{law}\n\
         [contact]\nmodel = \"halfspace\"\nmodulus = 1.1e11\n{contact}\n\
         [grid]\nsize = [6e-4, 6e-4]\ncells = [32, 32]\n[surface]\nshape = \"sphere\"\nradius = 1e-2\n\
         [[step]]\nduration = 0.02\nload = 20.0\nvelocity = 1.0\n{step}\n[integrator]\nsubsteps = 3\n{more}"
    )
}

fn springs(law: &str, contact: &str, step: &str, more: &str) -> String {
    format!(
        "[law]\nuse = \"archard\"\nconstants = [1e-13, 1.0, 2.0, 1.0]\n{law}\n\
         [contact]\nmodel = \"foundation\"\nstiffness = 1e12\ndimension = 2\n{contact}\n\
         [grid]\nsize = [1e-3]\ncells = [1024]\n[surface]\nshape = \"cylinder\"\nradius = 1e-2\n\
         [[step]]\nduration = 1e-9\napproach = 1e-6\nvelocity = 1.0\n{step}\n[integrator]\nsubsteps = 3\n{more}"
    )
}

fn prescribed(law: &str, contact: &str, step: &str, more: &str) -> String {
    format!(
        "[law]\nuse = \"archard\"\nconstants = [1e-4, 1e9, 1.0, 1.0]\n{law}\n\
         [contact]\nmodel = \"prescribed\"\n{contact}\n\
         [[step]]\nduration = 2.0\npressure = 1e6\nvelocity = 1.0\n{step}\n[integrator]\nsubsteps = 3\n{more}"
    )
}

/// Keys in the scene's four parts.
const IDLE: [[&str; 4]; 6] = [
    ["", "friction = 0.3", "", ""],
    ["", "", "temperature = 20.0", ""],
    ["mode = \"apply\"", "", "", ""],
    ["basis = \"pressure\"", "", "", ""],
    ["average = false", "", "", ""],
    ["", "", "", "[scaling]\nkind = \"none\"\n"],
];

// One test: another one beside it would be counted too.
#[test]
fn keys_of_no_effect_allocate_nothing() {
    let scenes: [(&str, Scene); 3] = [("a ball", ball), ("springs", springs), ("a prescribed pressure", prescribed)];
    for (name, scene) in scenes {
        let plain = scene("", "", "", "");
        // What is made once and for all is made by the first.
        allocations(&plain);
        let base = allocations(&plain);
        assert!(base.0 > 10, "nothing was counted");
        for [law, contact, step, more] in IDLE {
            let found = allocations(&scene(law, contact, step, more));
            assert!(alike(found, base), "{name} with {law}{contact}{step}{more}: {found:?}, without {base:?}");
        }
    }
    // An array over the cells more is seen: a stick zone needs distances of its own at every cell.
    for scene in [ball, springs] {
        let plain = allocations(&scene("", "", "", ""));
        let stick = allocations(&scene("", "", "stick = 1e-5", ""));
        assert!(!alike(stick, plain), "{stick:?}, without {plain:?}");
    }
    // What a plan lists is what a run holds, at most: all of it where all cells touch.
    let large = |scene: String| scene.replace("cells = [32, 32]", "cells = [128, 128]");
    for (name, scene, least) in [
        ("a wave", wave("", "substeps = 3"), 0.5),
        ("a wave to a tolerance", wave("", "tolerance = 1e-3"), 0.5),
        ("a ball", large(ball("", "", "", "")), 0.15),
        ("a ball under nodal tractions", large(ball("basis = \"nodal-stress\"", "", "", "")), 0.15),
    ] {
        let (held, listed) = held(&scene);
        assert!(held < 1.05 * listed && held > least * listed, "{name}: {held} bytes, the plan lists {listed}");
    }
}
