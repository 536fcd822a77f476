//! The facts of a library file and the description of a law, as text.

use super::console::Console;
use super::table::{aligned, labelled};
use super::unit_text::{bytes, number, unit};
use crate::error::printable;
use crate::law::file_facts::{ENTRY_SYMBOL, FileFacts};
use crate::law::{Degree, LawDescriptor, Quantity};

/// Width of the column of labels, and of the whole text.
const LABEL: usize = 17;
const WIDTH: usize = 96;

/// What the file says without running its code.
pub(super) fn file_text(facts: &FileFacts, console: &Console) -> String {
    let mut text = format!("{}\n", console.headline(&printable(&facts.path.display().to_string())));
    let mut line = |label: &str, value: &str| text.push_str(&labelled(label, &printable(value), LABEL, WIDTH));
    line("size", &bytes(facts.size));
    line("SHA-256", &facts.sha256);
    line("built for", &format!("{}, {} bits, {}", facts.elf.architecture, facts.elf.bits, facts.elf.os_abi));
    let layout = if facts.elf.has_layout { ", with its type layout (written in Rust)" } else { "" };
    line("entry", &format!("{ENTRY_SYMBOL}{layout}"));
    line("needs", &or_none(&facts.elf.needed));
    text
}

/// The facts of a file as JSON.
pub(super) fn file_json(facts: &FileFacts) -> serde_json::Value {
    let elf = &facts.elf;
    serde_json::json!({
        "path": facts.path.display().to_string(),
        "size": facts.size,
        "sha256": facts.sha256,
        "architecture": elf.architecture,
        "bits": elf.bits,
        "os_abi": elf.os_abi,
        "entry": ENTRY_SYMBOL,
        "has_layout": elf.has_layout,
        "exported_symbols": elf.exported_symbols,
        "needed": elf.needed,
        "soname": elf.soname,
        "rpath": elf.rpath,
        "runpath": elf.runpath,
    })
}

/// What a law says of itself.
pub(super) fn law_text(law: &LawDescriptor, console: &Console) -> String {
    let version = if law.version.is_empty() { String::new() } else { format!(" {}", law.version) };
    let mut text = format!("{}\n", console.headline(&format!("{}{version}", law.name)));
    let mut line = |label: &str, value: &str| {
        if !value.is_empty() {
            text.push_str(&labelled(label, value, LABEL, WIDTH));
        }
    };
    line("what it does", &law.summary);
    line("source", &law.source);
    line("ABI", &format!("1.{}", law.abi_minor));
    line("reads", &or_none(&law.reads.names()));
    line("uses if given", &law.uses.names().join(", "));
    let mut writes = vec!["increment"];
    writes.extend(law.writes.names());
    line("writes", &writes.join(", "));
    line("claims", &or_none(&law.claims.names().iter().map(|name| name.replace('_', "-")).collect::<Vec<_>>()));
    line("flags", &law.flags.names().iter().map(|name| name.replace('_', "-")).collect::<Vec<_>>().join(", "));
    line("pressure degree", &degree(law));
    for (kind, preset, quantities) in [
        ("constants", "default", &law.constants),
        ("state variables", "initial", &law.state),
        ("further inputs", "default", &law.inputs),
    ] {
        if !quantities.is_empty() {
            text.push('\n');
            text.push_str(&quantity_table(kind, preset, quantities));
        }
    }
    text
}

fn quantity_table(kind: &str, preset: &str, quantities: &[Quantity]) -> String {
    let mut rows = vec![[kind, "unit", "allowed", preset, ""].map(str::to_owned).to_vec()];
    for quantity in quantities {
        let closes = if quantity.closes_units { "*" } else { "" };
        rows.push(vec![
            quantity.name.clone(),
            format!("{}{closes}", unit(quantity.exponents)),
            interval(quantity),
            quantity.default.map_or_else(|| "required".to_owned(), number),
            quantity.summary.clone(),
        ]);
    }
    let mut text = aligned(&rows, 2);
    if quantities.iter().any(|quantity| quantity.closes_units) {
        text.push_str("  * its unit follows from the values of the others\n");
    }
    text
}

/// The bounds as an interval with short numbers; `any` for none.
fn interval(quantity: &Quantity) -> String {
    let (low, high) = (quantity.minimum, quantity.maximum);
    if low == f64::NEG_INFINITY && high == f64::INFINITY {
        return "any".to_owned();
    }
    let open = if quantity.above_minimum || low.is_infinite() { '(' } else { '[' };
    let close = if quantity.below_maximum || high.is_infinite() { ')' } else { ']' };
    format!("{open}{}, {}{close}", number(low), number(high))
}

fn degree(law: &LawDescriptor) -> String {
    match law.pressure_degree {
        Degree::Unclaimed => String::new(),
        Degree::Value(value) => number(value),
        Degree::Constant(index) => {
            law.constants.get(index).map_or_else(String::new, |c| format!("constant {}", c.name))
        }
    }
}

fn or_none<T: AsRef<str>>(names: &[T]) -> String {
    if names.is_empty() {
        return "nothing".to_owned();
    }
    names.iter().map(AsRef::as_ref).collect::<Vec<&str>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::{Plugin, embedded};

    #[test]
    fn archard_is_described_in_aligned_columns() {
        let plugin = Plugin::from_entry(embedded::entry("archard").unwrap()).unwrap();
        let text = law_text(plugin.laws()[0].descriptor(), &Console::new(false, false));
        assert!(text.starts_with("archard "), "{text}");
        let constants: Vec<&str> = text.lines().skip_while(|line| !line.starts_with("  constants")).collect();
        let column = constants[0].find("allowed").unwrap();
        assert_eq!(&constants[1][column..column + 8], "[0, inf)");
        assert_eq!(&constants[2][column..column + 8], "(0, inf)");
        assert!(constants[1].contains("-*") && constants[2].contains("Pa") && constants[2].contains("required"));
        assert!(text.contains("pressure degree  constant m"), "{text}");
        assert!(text.lines().all(|line| line.len() <= WIDTH && line == line.trim_end()), "{text}");
    }
}
