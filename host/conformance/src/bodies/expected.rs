//! Values that the author computed independently: `expected.csv`, or the law's extension `wearlaw.selftest/1`.
#![allow(unsafe_code)] // reason: reads the text that an extension points at.

use wearlaw_plugin_api::abi;

use super::super::harness::call::{Asked, Call, Given, Layout, good};
use super::super::harness::known::{SELFTEST, Table, selftest};
use super::super::harness::points::number_text;
use super::super::harness::subject::{Instance, Law};
use super::super::harness::ulps::ulps;
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::bench::Bench;

/// Relative difference that a value may have: rounding, and nothing that a wrong equation gives.
const TOLERANCE: f64 = 1e-12;

/// The table of a law, if it has one; a word on what is wrong with it otherwise.
pub(super) fn table_of(bench: &Bench, law: &Law<'_>) -> Result<Option<Table>, String> {
    if let Some(path) = &bench.task.expected {
        return Table::read(path).map(Some);
    }
    let Some(address) = law.library.extension(&law.table, SELFTEST) else { return Ok(None) };
    // SAFETY: the address is what the law answered for this extension, and the law lives through the call.
    unsafe { selftest(address) }.map(Some)
}

/// Whether every row comes out, in every way of asking: a law may have one of its own for the increment alone.
pub(super) fn expected(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        let table = match table_of(bench, law) {
            Ok(Some(table)) => table,
            Ok(None) => return skip("there is no expected.csv beside the law, and it has no wearlaw.selftest/1"),
            Err(reason) => return broken(Finding::new(reason)),
        };
        if let Some(reason) = table.misfit(about) {
            return broken(Finding::new(reason));
        }
        let mut worst = 0;
        let mut compared = 0;
        for row in 0..table.rows() {
            for asked in Asked::ways(about) {
                let (values, off) = one(law, instance, &table, row, asked)?;
                (compared, worst) = (compared + values, worst.max(off));
            }
        }
        if compared == 0 {
            return broken(Finding::new(format!("{} gives no answers, such as `increment`", table.origin())));
        }
        let rows = table.rows();
        Ok(Verdict::Pass(Some(format!("{rows} rows, {compared} values, at most {worst} ulp off"))))
    })
}

/// How far a value is off what a row says, in words; nothing where that is no part of it.
fn off(found: f64, expected: f64) -> String {
    let part = (found - expected).abs() / expected.abs();
    match part {
        part if !part.is_finite() => String::new(),
        part if part >= 1e-4 => format!(", {:.3} % off", 100.0 * part),
        part => format!(", a part {part:.0e} off: are all 17 digits of the value there?"),
    }
}

/// Holds the law to a row: how many values were compared, and the most units in the last place that one is off.
fn one(law: &Law<'_>, instance: &Instance<'_>, table: &Table, row: usize, asked: Asked) -> Judged<(usize, u64)> {
    let about = &law.about;
    let (case, absent) = table.case(row, about);
    let layout = Layout { given: Given::Declared, asked, absent, ..Layout::plain(about) };
    let answers = Call::new(about, &case, &layout).answers(instance);
    let name = table.row_name(row);
    if let Some(refusal) = Table::beyond(about, &case) {
        return broken(Finding::new(format!("{name}: {refusal}, so no host gives it to the law")));
    }
    let status = table.status(row).or_else(|reason| broken(Finding::new(reason)))?;
    let input = || table.inputs(row, &case, about);
    if answers.status != status {
        let how = match answers.status {
            abi::WL_OK => "is answered",
            abi::WL_UNRELIABLE => "is answered as unreliable",
            _ => "is refused",
        };
        let finding = Finding::new(format!("{name} {how}")).at(input());
        let values = if good(status) { " and the values of the row" } else { "" };
        return broken(finding.with(format!("status {}", answers.status), format!("status {status}{values}")));
    }
    if !good(status) {
        return Ok((1, 0));
    }
    let (mut compared, mut worst) = (0, 0);
    for (head, found, direction) in answers.at(0).named(about) {
        let Some(expected) = table.get(row, &head) else { continue };
        compared += 1;
        let allowed = if direction { TOLERANCE } else { TOLERANCE * expected.abs() };
        if (found - expected).abs() <= allowed {
            worst = worst.max(if direction { 0 } else { ulps(found, expected) });
            continue;
        }
        let finding = Finding::new(format!("{name}: {head} does not come out")).at(input());
        return broken(finding.with(
            format!("{head} {}{}", number_text(found), off(found, expected)),
            format!("{head} {}, to {allowed:.1e}", number_text(expected)),
        ));
    }
    Ok((compared, worst))
}
