//! The page of a study: the verdict, the picture, every case, what they are compared with, and what it came from.

use std::path::Path;

use super::Page;
use crate::output::OutputError;
use crate::output::plot::{number, study_svg};
use crate::output::study::status_words;
use crate::record::{Case, Cheapest, Clock, Errors, Kind, Status, StudyRecord, YardstickKind};

/// What the page of a study is made of.
#[derive(Clone, Copy, Debug)]
pub struct StudyPage<'a> {
    /// The study.
    pub study: &'a StudyRecord,
    /// The law's file, the machine, and whatever else is to be told of how it came about: label and text.
    pub provenance: &'a [(String, String)],
}

/// Writes the page of a study.
///
/// # Errors
/// A picture that cannot be drawn, a file that cannot be written.
pub fn write_study_page(study: &StudyPage<'_>, path: &Path) -> Result<(), OutputError> {
    let svg = study_svg(study.study, path)?;
    study.page(&svg).write(path)
}

impl StudyPage<'_> {
    fn page(&self, svg: &str) -> Page {
        let StudyPage { study, provenance } = self;
        let lead = format!("error against run time of wear by {}", study.law);
        let ended = if study.interrupted { "interrupted" } else { "done" };
        let mut page = Page::new(&study.title, &lead, ended, !study.interrupted);
        page.figures(&self.figures());
        page.picture(
            svg,
            "Error against run time, a line for each way of running the scene; unstable runs are crossed",
        );
        page.heading("Verdict");
        page.list(study.verdict.iter().map(String::as_str));
        page.heading("What the runs are compared with");
        page.facts(&self.yardstick());
        self.cases(&mut page);
        page.text(
            "~: less than three times the own error of what it is compared with, so it says only that it is small",
        );
        if !study.orders.is_empty() {
            page.heading("Observed orders");
            let row = |order: &crate::record::Order| {
                vec![order.line.clone(), number(order.order), format!("{} to {}", order.from, order.to)]
            };
            page.table(&["line", "order", "substeps"], &study.orders.iter().map(row).collect::<Vec<_>>());
        }
        if !study.left_out.is_empty() {
            page.heading("Left out, and why");
            page.list(study.left_out.iter().map(String::as_str));
        }
        page.heading("Norms");
        let norm = |(name, what): (&String, &String)| (plain(name), what.clone());
        page.facts(&study.norms.iter().map(norm).collect::<Vec<_>>());
        page.heading("Where it comes from");
        let mut facts = vec![("scene".to_owned(), study.scene.clone())];
        facts.extend(provenance.iter().cloned());
        page.facts(&facts);
        page
    }

    /// The cheapest ways, what they save, and how long it took to find out.
    fn figures(&self) -> Vec<(&'static str, String, String)> {
        let study = self.study;
        let mut figures = Vec::new();
        for (label, error) in [("Cheapest to 1 %", 1e-2), ("Cheapest to 0.1 %", 1e-3), ("Cheapest to 0.01 %", 1e-4)] {
            let Some(cheapest) = study.cheapest.iter().find(|cheapest| cheapest.error == error) else { continue };
            let (value, note) = self.cheapest(cheapest);
            figures.push((label, value, note));
        }
        let share = study.processor_share.map(|share| format!("{} of it on a processor", percent(share)));
        let took = format!("{} s of {} s", number(study.spent_s), number(study.budget_s));
        figures.push(("The study took", took, share.unwrap_or_default()));
        figures
    }

    fn cheapest(&self, cheapest: &Cheapest) -> (String, String) {
        let clock = self.study.clock;
        let factor = match clock {
            Clock::Wall => cheapest.factor,
            Clock::Processor => cheapest.processor_factor,
        };
        let case = cheapest.case.and_then(|index| self.study.cases.get(index));
        match case.and_then(|case| Some((case, case.time(clock)?))) {
            Some((case, time)) => {
                let way = format!("{}, {}", case.line, value(case));
                let gain = factor.map(|factor| format!("; {} times faster than explicit steps", number(factor)));
                (format!("{} ms", number(1e3 * time)), way + &gain.unwrap_or_default())
            }
            None => ("not reached".to_owned(), "no stable run is known to come so near".to_owned()),
        }
    }

    fn yardstick(&self) -> Vec<(String, String)> {
        let study = self.study;
        let yardstick = &study.yardstick;
        let stated = match yardstick.stated.is_empty() {
            false => format!("{} (estimated, rather too large)", listed(&yardstick.stated)),
            true if yardstick.kind == YardstickKind::SelfConverged => "not known, taken as none".to_owned(),
            true => "taken as none".to_owned(),
        };
        let mut facts =
            vec![("compared with".to_owned(), yardstick.name.clone()), ("its own error".to_owned(), stated)];
        if let Some(answer) = &yardstick.answer {
            facts.push((
                "off from the answer".to_owned(),
                format!("{} ({answer}; the grid's error is in it)", listed(&yardstick.measured)),
            ));
        }
        if let Some(grid) = study.grid.as_ref().filter(|grid| !grid.estimated.is_empty()) {
            let words = format!("{} (estimated from half the cells)", listed(&grid.estimated));
            facts.push(("the grid's own error".to_owned(), words));
        }
        if let Some(limit) = study.explicit_limit {
            let words = format!("{} for one step, {} substeps at least", number(limit.step), limit.substeps);
            facts.push(("limit of explicit steps".to_owned(), words));
        }
        facts
    }

    /// A table for each line, and what did not run.
    fn cases(&self, page: &mut Page) {
        let study = self.study;
        let present = |norm: &str| study.cases.iter().any(|case| case.errors.contains_key(norm));
        let mut norms: Vec<&String> = study.norms.keys().filter(|norm| present(norm)).collect();
        // What the wear profile is off by comes first.
        norms.sort_by_key(|norm| (!norm.starts_with("wear"), !norm.starts_with("pressure")));
        let mut lines: Vec<&str> = Vec::new();
        for case in &study.cases {
            if !lines.contains(&case.line.as_str()) {
                lines.push(&case.line);
            }
        }
        for line in lines {
            let cases: Vec<(usize, &Case)> =
                study.cases.iter().enumerate().filter(|(_, case)| case.line == line).collect();
            let against = match (&study.grid, cases.first().map(|(_, case)| case.kind)) {
                (Some(grid), Some(Kind::Grid)) => format!(", against {}", grid.against),
                _ => String::new(),
            };
            page.heading(&format!("{line}{against}"));
            let ran = cases.iter().filter(|(_, case)| matches!(case.status, Status::Done | Status::Unstable));
            let rows: Vec<Vec<String>> =
                ran.map(|(index, case)| row(case, &norms, study.front.contains(index))).collect();
            if let (false, Some((_, case))) = (rows.is_empty(), cases.first()) {
                let mut head: Vec<String> = vec![varied(case.kind).to_owned()];
                head.extend(["", "wall, ms", "processor, ms", "solves", "transforms", "law calls"].map(str::to_owned));
                head.extend(norms.iter().map(|norm| plain(norm)));
                page.table(&head.iter().map(String::as_str).collect::<Vec<_>>(), &rows);
            }
            let absent = cases.iter().filter_map(|(_, case)| match status_words(&case.status) {
                (_, "") => None,
                (word, reason) => Some(format!("{}: {word}: {reason}", value(case))),
            });
            let mut absent: Vec<String> = absent.collect();
            absent.extend(cases.iter().filter_map(|(_, case)| case.note.clone()));
            absent.dedup();
            if !absent.is_empty() {
                page.list(absent.iter().map(String::as_str));
            }
        }
    }
}

/// What a line varies.
fn varied(kind: Kind) -> &'static str {
    match kind {
        Kind::Substeps => "substeps",
        Kind::Tolerance => "tolerance",
        Kind::Scaling => "C1",
        Kind::Grid => "cells",
    }
}

/// The value that a case varies, with its name.
fn value(case: &Case) -> String {
    match case.kind {
        Kind::Tolerance => format!("tolerance {:e}", case.value),
        Kind::Scaling => format!("C1 = {}", case.value),
        kind => format!("{} {}", case.value, varied(kind)),
    }
}

fn row(case: &Case, norms: &[&String], on_front: bool) -> Vec<String> {
    let mark = match (&case.status, on_front) {
        (Status::Unstable, _) => "unstable",
        (_, true) => "on the front",
        _ => "",
    };
    let shown = match case.kind {
        Kind::Tolerance => format!("{:e}", case.value),
        _ => case.value.to_string(),
    };
    let ms = |seconds: Option<f64>| seconds.map_or_else(|| "-".to_owned(), |seconds| number(1e3 * seconds));
    let work = case.work.unwrap_or_default();
    let mut cells = vec![
        shown,
        mark.to_owned(),
        ms(case.timing.map(|timing| timing.wall_s)),
        ms(case.time(Clock::Processor)),
        work.contact_solves.to_string(),
        work.fft_pairs.to_string(),
        work.law_calls.to_string(),
    ];
    cells.extend(norms.iter().map(|norm| {
        let small = if case.unresolved.contains(norm) { "~" } else { "" };
        case.errors.get(*norm).map_or_else(|| "-".to_owned(), |error| format!("{small}{error:.1e}"))
    }));
    cells
}

fn listed(errors: &Errors) -> String {
    let each = errors.iter().map(|(norm, error)| format!("{} {error:.1e}", plain(norm)));
    each.collect::<Vec<_>>().join(", ")
}

/// The name of a norm as words; all are relative.
fn plain(norm: &str) -> String {
    norm.trim_end_matches("_relative").replace("_l2", " L2").replace('_', " ")
}

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}
