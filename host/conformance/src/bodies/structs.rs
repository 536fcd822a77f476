//! Structs that are as short as an older host's or longer than this one's, and texts that must fit their buffer.
#![allow(unsafe_code)] // reason: hands a law structs of other sizes, in memory that ends where they do.

use std::ffi::{CStr, c_char};

use wearlaw_plugin_api::abi;

use super::super::harness::arrays::{Arrays, Room};
use super::super::harness::call::{Answers, Asked, Call, Layout};
use super::super::harness::points::Case;
use super::super::harness::subject::{Instance, Law, Library};
use super::super::message::{Judged, Verdict, broken};
use super::super::outcome::Finding;
use super::bench::{Bench, POINTS, ask, still_good};
use super::faults::odd_cases;
use super::options::others;
use wearlaw_law::table::{preset_quantity, preset_table, this_host};

/// Bytes of the structs of version 1.0, which no later host makes shorter.
const LAW_1_0: usize = 744;
const QUANTITY_1_0: usize = 392;
const VIEW_1_0: usize = 536;
const OUTPUT_1_0: usize = 88;
/// Bytes behind the known part of a longer struct, and what they hold.
const LONGER: usize = 512;
const BEYOND: u8 = 0xa5;

/// A struct of another size, between pages that nobody may touch.
struct Sized<T> {
    first: *mut T,
    size: usize,
    _arrays: Arrays,
}

impl<T> Sized<T> {
    /// Holds as much of `value` as fits `size` bytes; what is behind it is filled.
    fn new(name: &str, value: T, size: usize) -> Self {
        let mut arrays = Arrays::new(Room::GuardBehind, 0);
        let first = arrays.place(name, size, false);
        let known = size.min(size_of::<T>());
        // SAFETY: the array has `size` bytes, and the value at least `known`.
        unsafe {
            first.write_bytes(BEYOND, size);
            first.copy_from_nonoverlapping((&raw const value).cast(), known);
            // Every struct of the ABI begins with its size.
            first.cast::<i64>().write(size as i64);
        }
        Self { first: first.cast(), size, _arrays: arrays }
    }

    /// The struct as this host knows it; a shorter one ends in the bytes of `rest`.
    fn read(&self, rest: T) -> T {
        let mut whole = std::mem::ManuallyDrop::new(rest);
        let known = self.size.min(size_of::<T>());
        // SAFETY: both have at least `known` bytes, and any bits are values of these plain structs.
        unsafe {
            (&raw mut *whole).cast::<u8>().copy_from_nonoverlapping(self.first.cast::<u8>(), known);
        }
        std::mem::ManuallyDrop::into_inner(whole)
    }

    /// True if the size and what lies behind the known part are as they were.
    fn is_left_alone(&self) -> bool {
        // SAFETY: the array has `size` bytes.
        let bytes = unsafe { std::slice::from_raw_parts(self.first.cast::<u8>(), self.size) };
        let size = i64::from_ne_bytes(bytes[..8].try_into().unwrap_or_default());
        size == self.size as i64 && bytes[self.size.min(size_of::<T>())..].iter().all(|byte| *byte == BEYOND)
    }
}

fn spoilt(what: &str) -> Finding {
    let finding =
        Finding::new(format!("it writes beyond the part of {what} that it knows, or changes its struct_size"));
    finding.with("other bytes", "min(struct_size, sizeof) bytes touched")
}

/// Goes through a law's functions with structs of these sizes, and compares with the usual ones.
fn with_sizes(bench: &Bench, law: usize, quantity: usize, view: usize, output: usize) -> Judged {
    let library = bench.open()?;
    let usual = library.law(&bench.task)?;
    let index = index_of(&library, &usual)?;
    let host = Sized::new(
        "the host",
        *this_host(),
        if law > LAW_1_0 { size_of::<abi::Host>() + LONGER } else { size_of::<abi::Host>() },
    );
    let table = Sized::new("the law's table", preset_table(), law);
    bench.label("the entry, with a table of another size");
    // SAFETY: host and table have the sizes that they state.
    let status = unsafe { library.ask(index, host.first, table.first) };
    if status != abi::WL_OK {
        let finding = Finding::new(format!("the entry refuses a table of {law} bytes"));
        return broken(finding.with(format!("status {status}"), format!("{}", abi::WL_OK)));
    }
    if !table.is_left_alone() || !host.is_left_alone() {
        return broken(spoilt("the table"));
    }
    let filled = table.read(preset_table());
    if (filled.name, filled.reads, filled.writes) != (usual.table.name, usual.table.reads, usual.table.writes) {
        return broken(Finding::new(format!("a table of {law} bytes is filled in another way")));
    }
    bench.label("describe, with a quantity of another size");
    let counts = [
        (abi::WL_KIND_CONSTANT, usual.about.constants.len()),
        (abi::WL_KIND_STATE, usual.about.state.len()),
        (abi::WL_KIND_INPUT, usual.about.inputs.len()),
    ];
    for (kind, count) in counts {
        for index in 0..count as i64 {
            let place = Sized::new("the quantity", preset_quantity(), quantity);
            // SAFETY: the quantity has the size that it states.
            let status = unsafe { library.describe_into(&filled, (kind, index), place.first) };
            if status != Some(abi::WL_OK) {
                let finding = Finding::new(format!("describe refuses a quantity of {quantity} bytes"));
                return broken(finding.with(format!("{status:?}"), format!("{}", abi::WL_OK)));
            }
            if !place.is_left_alone() {
                return broken(spoilt("the quantity"));
            }
        }
    }
    let instance = usual.instance(&bench.task)?;
    let case = bench.good(&usual, &instance, POINTS)?;
    for asked in Asked::ways(&usual.about) {
        let layout = Layout { asked, ..Layout::plain(&usual.about) };
        let expected = ask(&usual.about, &instance, &case, &layout);
        still_good(&usual.about, &case, &expected, "with structs of the usual size")?;
        bench.label("evaluate, with structs of another size");
        let found = resized(&usual, &instance, &case, &layout, view, output)?;
        let same = |one: &Answers, other: &Answers| {
            (0..case.count).all(|i| one.at(i).difference(&other.at(i)).is_none_or(|d| d.small))
        };
        if found.status != expected.status || !same(&found, &expected) {
            let finding = Finding::new("structs of another size change the answer").at(case.named(&usual.about, 0));
            return broken(finding.with(
                format!("status {}, increment {}", found.status, found.increment[0]),
                format!("status {}, increment {}", expected.status, expected.increment[0]),
            ));
        }
    }
    Ok(Verdict::Pass(None))
}

fn index_of(library: &Library, law: &Law<'_>) -> Judged<i32> {
    let at = library.tables()?.iter().position(|table| table.name == law.table.name);
    match at.and_then(|at| i32::try_from(at).ok()) {
        Some(at) => Ok(at),
        None => broken(Finding::new("the law is gone when it is asked for again")),
    }
}

fn resized(
    law: &Law<'_>,
    instance: &Instance<'_>,
    case: &Case,
    layout: &Layout,
    view_size: usize,
    output_size: usize,
) -> Judged<Answers> {
    let call = Call::new(&law.about, case, layout);
    // SAFETY: both structs live as long as the call.
    let (view, output) = unsafe { (*call.view(), *call.output()) };
    let (view, output) = (Sized::new("the view", view, view_size), Sized::new("the output", output, output_size));
    // SAFETY: the structs have the sizes that they state; their arrays belong to `call`, which lives on.
    let status = unsafe { instance.evaluate(view.first, output.first) };
    if !view.is_left_alone() {
        return broken(spoilt("the view"));
    }
    if !output.is_left_alone() {
        return broken(spoilt("the output"));
    }
    Ok(call.read_from(status, &output.read(empty_output())))
}

fn empty_output() -> abi::Output {
    abi::Output {
        struct_size: 0,
        increment: std::ptr::null_mut(),
        direction: std::ptr::null_mut(),
        state: std::ptr::null_mut(),
        status: std::ptr::null_mut(),
        first_bad: -1,
        dt_factor: 0.0,
        missing: 0,
        text: std::ptr::null_mut(),
        text_size: 0,
        d_pressure: std::ptr::null_mut(),
    }
}

/// Structs of the 1.0 sizes.
pub(super) fn smaller(bench: &Bench) -> Judged {
    with_sizes(bench, LAW_1_0, QUANTITY_1_0, VIEW_1_0, OUTPUT_1_0)
}

/// Structs that go on behind what this version knows.
pub(super) fn larger(bench: &Bench) -> Judged {
    let sizes =
        [size_of::<abi::LawTable>(), size_of::<abi::Quantity>(), size_of::<abi::View>(), size_of::<abi::Output>()];
    let [law, quantity, view, output] = sizes.map(|size| size + LONGER);
    with_sizes(bench, law, quantity, view, output)
}

/// Sizes of the buffer for a text that are tried; the last is what hosts have.
const TEXTS: [usize; 6] = [0, 1, 2, 9, 40, 512];

/// Texts of refusals, in buffers that end where their page does.
pub(super) fn text(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let law = library.law(&bench.task)?;
    let mut texts = 0;
    let others = others(&bench.task);
    for size in TEXTS {
        for options in &others {
            bench.label(&format!(
                "create with the options {}, with a buffer of {size} bytes for its text",
                options.label
            ));
            texts += usize::from(created_text(&law, options.words.as_deref(), size)?);
        }
    }
    let instance = law.instance(&bench.task)?;
    let known = bench.known_constants(&law);
    let mut sampler = bench.sampler(&law, &known);
    for case in odd_cases(&mut sampler, &law.about, 10) {
        for size in TEXTS {
            let layout = Layout {
                room: Room::GuardBehind,
                text: Some(size),
                filling: u64::from(BEYOND),
                ..Layout::plain(&law.about)
            };
            let answers = ask(&law.about, &instance, &case, &layout);
            if answers.status == abi::WL_OK || size == 0 {
                continue;
            }
            // A law need not say anything.
            let untouched = answers.text.iter().all(|byte| *byte == BEYOND);
            texts += usize::from(!untouched);
            if !untouched && !answers.text.contains(&0) {
                let finding = Finding::new(format!("the text of a refusal is not closed in a buffer of {size} bytes"));
                let found = String::from_utf8_lossy(&answers.text).into_owned();
                return broken(finding.with(found, "a NUL within the buffer").at(case.named(&law.about, 0)));
            }
        }
    }
    Ok(Verdict::Pass(Some(format!("{texts} texts"))))
}

/// Tries to create with such a buffer; whether a text was left in it.
fn created_text(law: &Law<'_>, options: Option<&CStr>, size: usize) -> Judged<bool> {
    let mut arrays = Arrays::new(Room::GuardBehind, 0);
    let buffer = arrays.place("the buffer for a text", size, false);
    // SAFETY: the array has `size` bytes.
    unsafe { buffer.write_bytes(BEYOND, size) };
    let (text, text_size) = if size == 0 { (std::ptr::null_mut(), 0) } else { (buffer.cast::<c_char>(), size as i64) };
    // SAFETY: the buffer has the size that is stated.
    let status = unsafe { law.try_create(options, text, text_size) };
    // SAFETY: as above.
    let left = unsafe { std::slice::from_raw_parts(buffer, size) };
    let untouched = left.iter().all(|byte| *byte == BEYOND);
    if status.is_none_or(|status| status == abi::WL_OK) || untouched {
        return Ok(false);
    }
    if !left.contains(&0) {
        let finding = Finding::new(format!("the text of create is not closed in a buffer of {size} bytes"));
        return broken(finding.with(String::from_utf8_lossy(left).into_owned(), "a NUL within the buffer"));
    }
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sizes_of_1_0_are_those_of_this_version_as_long_as_it_is_1_0() {
        assert_eq!(abi::WL_ABI_MINOR, 0, "a later minor keeps the numbers above and drops this test");
        assert_eq!(size_of::<abi::LawTable>(), LAW_1_0);
        assert_eq!(size_of::<abi::Quantity>(), QUANTITY_1_0);
        assert_eq!(size_of::<abi::View>(), VIEW_1_0);
        assert_eq!(size_of::<abi::Output>(), OUTPUT_1_0);
    }
}
