//! The table of a study, in a hundred columns.

use std::path::Path;

use super::console::Console;
use super::table::labelled;
use super::unit_text::significant;
use crate::output::STUDY_PICTURE;
use crate::record::{Case, Errors, Kind, Status, StudyRecord, YardstickKind};

const WIDTH: usize = 100;
/// The columns of errors: a short name each.
const NORMS: [(&str, &str); 6] = [
    ("wear_l2_relative", "wear"),
    ("wear_max_relative", "max"),
    ("pressure_l2_relative", "press."),
    ("volume_relative", "volume"),
    ("centre_depth_relative", "centre"),
    ("scar_radius_relative", "radius"),
];

/// The whole text of a study.
pub(super) fn text(console: &Console, study: &StudyRecord, out: &Path) -> String {
    let mut text = format!("{}\n", console.headline(&study.title));
    let mut line = |label: &str, value: &str| text.push_str(&labelled(label, value, 18, WIDTH));
    line("law", &study.law);
    let cells = study.cells.as_ref().map(|cells| cells.iter().map(usize::to_string).collect::<Vec<_>>().join(" x "));
    line("points", &cells.map_or_else(|| study.points.to_string(), |cells| format!("{cells} cells")));
    line("compared with", &study.yardstick.name);
    line("its own error", &stated(study));
    if let Some(answer) = &study.yardstick.answer {
        line(
            "off from the answer",
            &format!("{} ({answer}; the grid's error is in it)", listed(&study.yardstick.measured)),
        );
    }
    if let Some(grid) = study.grid.as_ref().filter(|grid| !grid.estimated.is_empty()) {
        line("grid's own error", &format!("{} (estimated from half the cells)", listed(&grid.estimated)));
    }
    if let Some(limit) = study.explicit_limit {
        let limit = format!("{}, {} substeps", significant(limit.step, 4), limit.substeps);
        line("explicit limit", &limit);
    }
    text.push_str(&rows(console, study));
    text.push_str(LEGEND);
    if !study.left_out.is_empty() {
        text.push_str(&format!("\n{}\n", console.headline("left out")));
        study.left_out.iter().for_each(|line| text.push_str(&labelled("-", line, 2, WIDTH)));
    }
    text.push_str(&format!("\n{}\n", console.headline("verdict")));
    study.verdict.iter().for_each(|line| text.push_str(&labelled("-", line, 2, WIDTH)));
    let time = format!("{} s of {} s", significant(study.spent_s, 3), significant(study.budget_s, 3));
    let picture = out.join(STUDY_PICTURE);
    let last = format!("the study took {time}; its picture is {}, its table lies beside it", picture.display());
    text.push_str(&labelled("-", &last, 2, WIDTH));
    text
}

const LEGEND: &str = "
  ms, cpu: least wall and processor time; +%: largest over least wall time; ': run only once
  solves, pairs, calls: contact solves, pairs of transforms, calls of the law
  wear, max: wear profile, L2 and largest; press.: L2 in the contact; centre: depth; all relative
  X: unstable; *: on the Pareto front; ~: less than three times the yardstick's own error
";

/// What is stated of the yardstick.
fn stated(study: &StudyRecord) -> String {
    match study.yardstick.stated.is_empty() {
        false => format!("{} (stated: rather too large)", listed(&study.yardstick.stated)),
        true if study.yardstick.kind == YardstickKind::SelfConverged => "not known, taken as none".to_owned(),
        true => "taken as none".to_owned(),
    }
}

fn listed(errors: &Errors) -> String {
    let each = NORMS.iter().filter_map(|(norm, short)| Some(format!("{short} {}", error(*errors.get(*norm)?))));
    each.collect::<Vec<_>>().join(", ")
}

fn error(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.1e}") }
}

/// The table, line by line.
fn rows(console: &Console, study: &StudyRecord) -> String {
    let present = |norm: &str| study.cases.iter().any(|case| case.errors.contains_key(norm));
    let norms: Vec<(&str, &str)> = NORMS.iter().copied().filter(|(norm, _)| present(norm)).collect();
    let mut text = String::new();
    let mut shown = "";
    let mut block: Vec<Vec<String>> = Vec::new();
    let mut tail: Vec<String> = Vec::new();
    let mut refused: Vec<(&str, Vec<&str>)> = Vec::new();
    for (index, case) in study.cases.iter().enumerate() {
        // A line that never began has no table; one reason mostly holds for several.
        if let Status::Refused(reason) = &case.status
            && case.line != shown
        {
            match refused.iter_mut().find(|(other, _)| *other == reason.as_str()) {
                Some((_, lines)) => lines.push(&case.line),
                None => refused.push((reason, vec![&case.line])),
            }
            continue;
        }
        if case.line != shown {
            flush(&mut text, &mut block, &mut tail);
            shown = &case.line;
            let against = match (&study.grid, case.kind) {
                (Some(grid), Kind::Grid) => format!(", against {}", grid.against),
                _ => String::new(),
            };
            text.push_str(&format!("\n{}\n", console.headline(&format!("{}{against}", case.line))));
            block.push(header(case.kind, &norms));
        }
        match &case.status {
            Status::Done | Status::Unstable => block.push(row(case, &norms, study.front.contains(&index))),
            Status::Refused(reason) => tail.push(labelled("refused", reason, 10, WIDTH)),
            Status::Failed(reason) => tail.push(labelled(&value(case), &format!("failed: {reason}"), 10, WIDTH)),
            Status::LeftOut(reason) => tail.push(labelled(&value(case), &format!("left out: {reason}"), 10, WIDTH)),
        }
        if let Some(note) = &case.note
            && study.cases.get(index + 1).is_none_or(|next| next.line != case.line)
        {
            tail.push(labelled("note", note, 10, WIDTH));
        }
    }
    flush(&mut text, &mut block, &mut tail);
    if !refused.is_empty() {
        text.push_str(&format!("\n{}\n", console.headline("refused")));
    }
    for (reason, lines) in refused {
        text.push_str(&labelled("-", &format!("{}: {reason}", lines.join(", ")), 2, WIDTH));
    }
    text
}

/// Ends the rows of a line: the table if it has any, then what stands below it.
fn flush(text: &mut String, block: &mut Vec<Vec<String>>, tail: &mut Vec<String>) {
    if block.len() > 1 {
        text.push_str(&right_aligned(block));
    }
    block.clear();
    tail.drain(..).for_each(|line| text.push_str(&line));
}

fn header(kind: Kind, norms: &[(&str, &str)]) -> Vec<String> {
    let varied = match kind {
        Kind::Substeps => "steps",
        Kind::Tolerance => "tol.",
        Kind::Scaling => "C1",
        Kind::Grid => "cells",
    };
    let before = [varied, "", "ms", "+%", "cpu", "solves", "pairs", "calls"];
    before.iter().copied().chain(norms.iter().map(|(_, short)| *short)).map(str::to_owned).collect()
}

fn value(case: &Case) -> String {
    match case.kind {
        Kind::Tolerance => format!("{:e}", case.value),
        _ => case.value.to_string(),
    }
}

fn row(case: &Case, norms: &[(&str, &str)], on_front: bool) -> Vec<String> {
    let timing = case.timing;
    let ms = |seconds: f64| significant(1e3 * seconds, 3);
    let once = timing.is_some_and(|timing| !timing.warmed_up);
    let mark = match (case.status == Status::Unstable, on_front) {
        (true, _) => "X",
        (false, true) => "*",
        _ => "",
    };
    let work = case.work.unwrap_or_default();
    let mut cells = vec![
        value(case),
        mark.to_owned(),
        timing.map_or_else(String::new, |timing| format!("{}{}", ms(timing.wall_s), if once { "'" } else { "" })),
        timing.filter(|_| !once).map_or_else(String::new, |timing| format!("{:.0}", 100.0 * timing.wall_spread)),
        timing.map_or_else(String::new, |timing| ms(timing.processor_s)),
        short(work.contact_solves),
        short(work.fft_pairs),
        short(work.law_calls),
    ];
    cells.extend(norms.iter().map(|(norm, _)| {
        let small = if case.unresolved.iter().any(|name| name == norm) { "~" } else { "" };
        case.errors.get(*norm).map_or_else(String::new, |value| format!("{small}{}", error(*value)))
    }));
    cells
}

/// A count in at most six characters.
fn short(count: u64) -> String {
    if count < 1_000_000 { count.to_string() } else { format!("{:.1e}", count as f64) }
}

/// Columns aligned to the right, a blank apart.
fn right_aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let length = |text: &str| text.chars().count();
    let width =
        |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|cell| length(cell)).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = " ".to_owned();
        for (cell, width) in row.iter().zip(&widths) {
            line.push(' ');
            line.push_str(&" ".repeat(width - length(cell)));
            line.push_str(cell);
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up_on_the_right() {
        let rows = [vec!["n".to_owned(), "error".to_owned()], vec!["128".to_owned(), "1e-3".to_owned()]];
        assert_eq!(right_aligned(&rows), "    n error\n  128  1e-3\n");
        assert_eq!((short(999_999), short(12_345_678)), ("999999".to_owned(), "1.2e7".to_owned()));
    }
}
