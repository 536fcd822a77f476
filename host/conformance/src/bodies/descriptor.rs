//! What the law says of itself, looked at before a host would refuse it.

use std::ffi::c_char;

use wearlaw_plugin_api::abi;

use super::super::harness::points::number_text;
use super::super::harness::subject::{Library, chars_text};
use super::super::message::{Judged, Verdict, broken};
use super::super::outcome::Finding;
use super::bench::Bench;
use wearlaw_law::describe::MOST_QUANTITIES;
use wearlaw_law::fields::{Claims, Fields, Flags, Named, OutputItems};
use wearlaw_law::{Claim, Field, Flag, OutputItem};

const KINDS: [(i32, &str); 3] =
    [(abi::WL_KIND_CONSTANT, "constant"), (abi::WL_KIND_STATE, "state variable"), (abi::WL_KIND_INPUT, "input")];

/// A quantity as the law described it.
struct Described {
    kind: &'static str,
    index: i64,
    raw: abi::Quantity,
}

impl Described {
    /// As in `constant 2 (`m`)`.
    fn name(&self) -> String {
        format!("{} {} (`{}`)", self.kind, self.index, chars_text(&self.raw.name))
    }
}

/// The table of the law under test.
fn table(bench: &Bench, library: &Library) -> Judged<abi::LawTable> {
    let tables = library.tables()?;
    let wanted = |table: &&abi::LawTable| bench.task.law.as_ref().is_none_or(|name| chars_text(&table.name) == *name);
    match tables.iter().find(wanted) {
        Some(table) => Ok(*table),
        None => broken(Finding::new("the law is gone when it is asked for again")),
    }
}

fn count(table: &abi::LawTable, kind: i32) -> i64 {
    match kind {
        abi::WL_KIND_CONSTANT => table.constant_count,
        abi::WL_KIND_STATE => table.state_count,
        _ => table.input_count,
    }
}

/// All quantities, as far as the law describes them.
fn quantities(library: &Library, table: &abi::LawTable) -> Vec<Described> {
    let mut all = Vec::new();
    for (kind, word) in KINDS {
        for index in 0..count(table, kind).clamp(0, MOST_QUANTITIES) {
            if let Some((abi::WL_OK, raw)) = library.describe(table, kind, index) {
                all.push(Described { kind: word, index, raw });
            }
        }
    }
    all
}

/// What is wrong with a text in a fixed array.
fn text_fault(chars: &[c_char]) -> Option<&'static str> {
    let bytes: Vec<u8> = chars.iter().map(|byte| byte.to_ne_bytes()[0]).collect();
    let Some(end) = bytes.iter().position(|byte| *byte == 0) else { return Some("is not closed by a NUL") };
    match std::str::from_utf8(&bytes[..end]) {
        Err(_) => Some("is not UTF-8"),
        Ok(text) if text.chars().any(char::is_control) => Some("is not one line of text"),
        Ok(_) => None,
    }
}

/// Names, versions and summaries.
pub(super) fn names(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let all = library.tables()?;
    let own = table(bench, &library)?;
    let texts: [(&str, &[c_char]); 4] = [
        ("the law's name", &own.name),
        ("the law's version", &own.version),
        ("the law's summary", &own.summary),
        ("the law's source", &own.source),
    ];
    for (what, chars) in texts {
        if let Some(fault) = text_fault(chars) {
            let expected = format!("one line of UTF-8, closed by a NUL within {} bytes", chars.len());
            return broken(Finding::new(format!("{what} {fault}")).with(shown(chars), expected));
        }
    }
    let name = chars_text(&own.name);
    if name.is_empty() || !name.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-_".contains(&byte)) {
        return broken(
            Finding::new("the law's name is malformed").with(shown(&own.name), "letters, digits, `-` and `_`"),
        );
    }
    if all.iter().filter(|other| chars_text(&other.name) == name).count() > 1 {
        return broken(Finding::new(format!("two laws of the library are called `{name}`")));
    }
    if own.version[0] == 0 {
        return broken(Finding::new("the law has no version"));
    }
    let quantities = quantities(&library, &own);
    for (at, described) in quantities.iter().enumerate() {
        let raw = &described.raw;
        let of = |what: &str| format!("the {what} of {} {}", described.kind, described.index);
        for (what, chars) in [("name", &raw.name[..]), ("summary", &raw.summary[..])] {
            if let Some(fault) = text_fault(chars) {
                let expected = format!("one line of UTF-8, closed by a NUL within {} bytes", chars.len());
                return broken(Finding::new(format!("{} {fault}", of(what))).with(shown(chars), expected));
            }
        }
        let name = chars_text(&raw.name);
        let starts = name.bytes().next().is_some_and(|byte| byte.is_ascii_alphabetic());
        if !starts || !name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_') {
            let expected = "a letter, then letters, digits and underscores";
            return broken(Finding::new(format!("{} is malformed", of("name"))).with(shown(&raw.name), expected));
        }
        let same = |other: &&Described| other.kind == described.kind && other.raw.name == raw.name;
        if quantities[..at].iter().any(|other| same(&other)) {
            return broken(Finding::new(format!("two {}s are called `{name}`", described.kind)));
        }
        if described.kind == "input" && Field::from_name(&name).is_some() {
            let finding = Finding::new(format!("input `{name}` has the name of a field"));
            return broken(finding.with("an input", "the field's bit in reads or uses"));
        }
    }
    Ok(Verdict::Pass(None))
}

fn shown(chars: &[c_char]) -> String {
    format!("{:?}", chars_text(chars))
}

/// SI exponents and what closes the units.
pub(super) fn units(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let own = table(bench, &library)?;
    let mut closing = Vec::new();
    for described in quantities(&library, &own) {
        let raw = &described.raw;
        for (unit, exponent) in
            [("metre", raw.metre), ("kilogram", raw.kilogram), ("second", raw.second), ("kelvin", raw.kelvin)]
        {
            if !exponent.is_finite() {
                let finding = Finding::new(format!("the exponent of the {unit} of {} is no number", described.name()));
                return broken(finding.with(number_text(exponent), "a finite number"));
            }
        }
        let known = abi::WL_QUANTITY_CLOSES_UNITS | abi::WL_QUANTITY_ABOVE_MINIMUM | abi::WL_QUANTITY_BELOW_MAXIMUM;
        if raw.flags & !known != 0 {
            let finding = Finding::new(format!("{} has flags that do not exist", described.name()));
            return broken(finding.with(format!("{:#x}", raw.flags), format!("bits of {known:#x}")));
        }
        if raw.flags & abi::WL_QUANTITY_CLOSES_UNITS != 0 {
            if described.kind != "constant" {
                let what = format!("{} is said to close the units, which only a constant can", described.name());
                return broken(Finding::new(what));
            }
            closing.push(described.name());
        }
    }
    if closing.len() > 1 {
        let finding = Finding::new("more than one constant closes the units");
        return broken(finding.with(closing.join(", "), "at most one"));
    }
    Ok(Verdict::Pass(closing.pop().map(|name| format!("{name} closes the units"))))
}

/// Bounds of every quantity.
pub(super) fn bounds(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let own = table(bench, &library)?;
    for described in quantities(&library, &own) {
        let raw = &described.raw;
        let (low, high) = (raw.minimum, raw.maximum);
        let open = raw.flags & (abi::WL_QUANTITY_ABOVE_MINIMUM | abi::WL_QUANTITY_BELOW_MAXIMUM) != 0;
        let room = low < high && low != f64::INFINITY && high != f64::NEG_INFINITY;
        if room || (low == high && !open && low.is_finite()) {
            continue;
        }
        let finding = Finding::new(format!("no value keeps the bounds of {}", described.name()));
        let found = format!("minimum {}, maximum {}", number_text(low), number_text(high));
        return broken(finding.with(found, "a minimum below the maximum (in SI units; infinities for none)"));
    }
    Ok(Verdict::Pass(None))
}

/// Defaults and initial values.
pub(super) fn defaults(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let own = table(bench, &library)?;
    for described in quantities(&library, &own) {
        let raw = &described.raw;
        let value = raw.default_value;
        if value.is_nan() {
            continue;
        }
        let above =
            if raw.flags & abi::WL_QUANTITY_ABOVE_MINIMUM != 0 { value > raw.minimum } else { value >= raw.minimum };
        let below =
            if raw.flags & abi::WL_QUANTITY_BELOW_MAXIMUM != 0 { value < raw.maximum } else { value <= raw.maximum };
        // Bounds that nothing keeps are told by their own check.
        let sensible = raw.minimum <= raw.maximum;
        if value.is_infinite() || sensible && !(above && below) {
            let finding = Finding::new(format!("the default of {} is outside of its bounds", described.name()));
            let bounds = format!("{} to {}, or NaN", number_text(raw.minimum), number_text(raw.maximum));
            return broken(finding.with(number_text(value), bounds));
        }
    }
    Ok(Verdict::Pass(None))
}

/// Fields read and used, outputs written, counts.
pub(super) fn fields(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let own = table(bench, &library)?;
    for (what, mask) in [("reads", own.reads), ("uses", own.uses), ("writes", own.writes)] {
        if mask < 0 {
            return broken(Finding::new(format!("`{what}` is negative")).with(mask.to_string(), "bit 63 unused"));
        }
    }
    let unknown = Fields::from_bits(own.reads).unknown() | Fields::from_bits(own.uses).unknown();
    let (low, first) = (unknown.trailing_zeros(), i64::from(unknown.trailing_zeros()));
    if unknown != 0 {
        let named = library.describe(&own, abi::WL_KIND_FIELD, first);
        let name = named.filter(|(status, _)| *status == abi::WL_OK).map(|(_, quantity)| chars_text(&quantity.name));
        let name =
            name.filter(|name| !name.is_empty()).map_or_else(|| "without a name".to_owned(), |n| format!("`{n}`"));
        let finding =
            Finding::new(format!("it asks for the field of bit {low} ({name}), which this version does not have"));
        return broken(finding.with(format!("{unknown:#x}"), format!("bits of {:#x}", Field::KNOWN)));
    }
    let both = Fields::from_bits(own.reads & own.uses);
    if !both.is_empty() {
        let finding = Finding::new(format!("it both reads and uses {both}"));
        return Ok(Verdict::Warn(finding.with("both bits", "one: what it must have, or what it can do without")));
    }
    let unknown = OutputItems::from_bits(own.writes).unknown();
    if unknown != 0 {
        let finding = Finding::new("it writes outputs that do not exist");
        return broken(finding.with(format!("{unknown:#x}"), format!("bits of {:#x}", OutputItem::KNOWN)));
    }
    for (kind, word) in KINDS {
        let found = count(&own, kind);
        if !(0..=MOST_QUANTITIES).contains(&found) {
            let finding = Finding::new(format!("the number of {word}s is out of reason"));
            return broken(finding.with(found.to_string(), format!("0 to {MOST_QUANTITIES}")));
        }
        if found > 0 && own.describe.is_none() {
            return broken(Finding::new(format!("it has {found} {word}s and no `describe`")));
        }
        for index in 0..found {
            if let Some((status, _)) = library.describe(&own, kind, index)
                && status != abi::WL_OK
            {
                let finding = Finding::new(format!("`describe` does not answer for {word} {index} of {found}"));
                return broken(finding.with(format!("status {status}"), format!("{}", abi::WL_OK)));
            }
        }
    }
    let writes = OutputItems::from_bits(own.writes);
    if own.state_count > 0 && !writes.contains(OutputItem::State) {
        return broken(
            Finding::new("it has state variables and does not write them").with("no WL_OUT_STATE", "the bit"),
        );
    }
    if writes.contains(OutputItem::Direction) && !Fields::from_bits(own.reads).contains(Field::Normal) {
        let finding = Finding::new("it writes directions and does not read the normal");
        return Ok(Verdict::Warn(
            finding.with("no WL_FIELD_NORMAL in reads", "the bit: directions follow the surface"),
        ));
    }
    if own.evaluate.is_none() {
        return broken(Finding::new("it has no `evaluate`"));
    }
    Ok(Verdict::Pass(None))
}

/// Claims, flags and the pressure degree.
pub(super) fn claims(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let own = table(bench, &library)?;
    let unknown = [
        ("claims", own.claims, Claims::from_bits(own.claims).unknown(), Claim::KNOWN),
        ("flags", own.flags, Flags::from_bits(own.flags).unknown(), Flag::KNOWN),
    ];
    for (what, mask, unknown, known) in unknown {
        // A later minor may know more.
        let later = own.abi_minor > i64::from(abi::WL_ABI_MINOR);
        if mask < 0 || unknown != 0 && !later {
            let finding = Finding::new(format!("`{what}` has bits that do not exist"));
            return broken(finding.with(format!("{mask:#x}"), format!("bits of {known:#x}")));
        }
    }
    let (value, index) = (own.pressure_degree, own.pressure_degree_constant);
    let fault = if index < -1 || index >= own.constant_count.max(0) {
        format!("held by constant {index} of {}", own.constant_count)
    } else if !value.is_nan() && index >= 0 {
        format!("{} and held by constant {index}", number_text(value))
    } else if value.is_infinite() {
        number_text(value)
    } else {
        return Ok(Verdict::Pass(None));
    };
    let finding = Finding::new("the pressure degree is malformed");
    broken(finding.with(fault, "a finite number (NaN: none), or the index of a constant (-1: none)"))
}

/// Indices past the end, and the same answers when asked again.
pub(super) fn end(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let count_of_laws = library.tables()?.len() as i32;
    for index in [count_of_laws, count_of_laws + 1, i32::MAX, -1, i32::MIN] {
        let answer = library.table(index).map_or_else(|status| status, |_| abi::WL_OK);
        if answer != abi::WL_NO_MORE {
            let finding = Finding::new(format!("the entry does not end: index {index} of {count_of_laws} laws"));
            return broken(finding.with(format!("status {answer}"), format!("{} (WL_NO_MORE)", abi::WL_NO_MORE)));
        }
    }
    let own = table(bench, &library)?;
    for (kind, word) in KINDS {
        let known = count(&own, kind).max(0);
        for index in [known, known + 1, i64::MAX, -1, i64::MIN] {
            let Some((status, _)) = library.describe(&own, kind, index) else { continue };
            if status != abi::WL_NO_MORE {
                let finding = Finding::new(format!("`describe` does not end: {word} {index} of {known}"));
                return broken(finding.with(format!("status {status}"), format!("{} (WL_NO_MORE)", abi::WL_NO_MORE)));
            }
        }
    }
    for kind in [4, 99, -1] {
        if let Some((status, _)) = library.describe(&own, kind, 0)
            && status != abi::WL_NO_MORE
        {
            let finding = Finding::new(format!("`describe` answers for kind {kind}, which does not exist"));
            return broken(finding.with(format!("status {status}"), format!("{} (WL_NO_MORE)", abi::WL_NO_MORE)));
        }
    }
    let task = &bench.task;
    let (first, second) = (library.law(task)?.about, library.law(task)?.about);
    if first != second {
        return broken(Finding::new("the law describes itself in another way when it is asked again"));
    }
    Ok(Verdict::Pass(None))
}

/// Extensions that nobody knows.
pub(super) fn extension(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let own = table(bench, &library)?;
    if own.extension.is_none() {
        return Ok(Verdict::Pass(Some("the law has no extensions".to_owned())));
    }
    for id in [c"wearlaw.no-such-extension/1", c"", c"wearlaw.selftest/999", c"wearlaw"] {
        if library.extension(&own, id).is_some() {
            let finding = Finding::new(format!("the extension {id:?}, which does not exist, is found"));
            return broken(finding.with("an address", "NULL"));
        }
    }
    Ok(Verdict::Pass(None))
}
