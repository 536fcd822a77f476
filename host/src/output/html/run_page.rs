//! The page of a run: what came out, how good it is, what it took, what was left out, and what it came from.

use std::path::Path;

use serde_json::Value;

use super::Page;
use crate::output::plot::{number, plot_svg, rounded};
use crate::output::{Figure, OutputError, Report};
use crate::record::{Cost, ESTIMATED, HistoryRow, Identity};

/// Rows of the history that are shown at most.
const ROWS: usize = 24;

/// Digits of the results.
const DIGITS: usize = 11;

/// What the page of a run is made of.
#[derive(Clone, Copy, Debug)]
pub struct RunPage<'a> {
    /// The report.
    pub report: &'a Report,
    /// The figure, with title, units and history.
    pub figure: Figure<'a>,
    /// What it was a run of.
    pub identity: &'a Identity,
    /// The machine, and whatever else is to be told of how it came about: label and text.
    pub machine: &'a [(String, String)],
}

/// Writes the page of a run.
///
/// # Errors
/// A figure that cannot be drawn, a file that cannot be written.
pub fn write_run_page(run: &RunPage<'_>, path: &Path) -> Result<(), OutputError> {
    let svg = plot_svg(&run.figure, path)?;
    run.page(&svg).write(path)
}

impl RunPage<'_> {
    fn page(&self, svg: &str) -> Page {
        let RunPage { report, figure, .. } = self;
        let law = &report.law;
        let isolated = if law.isolated { ", in a process of its own" } else { "" };
        let lead = format!("wear by {} {}{isolated}", law.name, law.version);
        let mut page = Page::new(figure.title, &lead, &report.ended, report.ended == "done");
        page.figures(&self.figures());
        page.picture(svg, "Pressure and wear along the surface or the loading over time, and wear over time");
        if !report.warnings.is_empty() {
            page.heading("To know");
            page.list(report.warnings.iter().map(String::as_str));
        }
        page.heading("Result");
        page.facts(&self.result());
        self.error(&mut page);
        page.heading("Cost");
        page.facts(&cost(&report.cost));
        page.heading("Stability");
        page.text(&report.stability.verdict);
        page.heading("Plan: computed");
        page.list(report.computed.iter().map(String::as_str));
        page.heading("Plan: left out, and why");
        let text = |entry: &Value, key: &str| entry[key].as_str().unwrap_or_default().to_owned();
        let skipped: Vec<Value> = report.skipped.as_array().cloned().unwrap_or_default();
        page.facts(&skipped.iter().map(|entry| (text(entry, "what"), text(entry, "why"))).collect::<Vec<_>>());
        page.heading("History");
        self.history(&mut page);
        page.heading("Where it comes from");
        page.facts(&self.provenance());
        let scene = serde_json::to_string_pretty(&report.scene).unwrap_or_default();
        page.hidden("The scene as it was resolved", &scene);
        page
    }

    /// The few numbers that matter, the error beside the run time.
    fn figures(&self) -> Vec<(&'static str, String, String)> {
        let (report, units) = (self.report, self.figure.units);
        let last = &report.last;
        let mut figures =
            vec![("Largest wear depth", with_unit(last.max_wear_depth, &units.length), after(last, &units.time))];
        if let Some(volume) = last.wear_volume {
            figures.push(("Worn volume", with_unit(volume, &units.volume()), String::new()));
        }
        let error = match report.error["value"].as_f64() {
            Some(value) => number(value),
            None => "not known".to_owned(),
        };
        let norm = report.error["norm"].as_str().unwrap_or("no reference, no estimate");
        let reference = report.error["reference"].as_str().unwrap_or_default();
        let (name, compared) = match reference.strip_prefix(ESTIMATED) {
            Some(causes) => ("Estimated error", format!("{norm}: {causes}, not the law")),
            None if reference.is_empty() => ("Error", norm.to_owned()),
            None => ("Error", format!("{norm}, against {reference}")),
        };
        figures.push((name, error, compared));
        let steps = format!("{} steps", report.cost.steps);
        figures.push(("Run time", with_unit(report.cost.run_time_s, "s"), steps));
        figures
    }

    fn result(&self) -> Vec<(String, String)> {
        let (last, units) = (&self.report.last, self.figure.units);
        let known = [
            ("time", Some(last.time), units.time.clone()),
            ("sliding distance", Some(last.sliding_distance), units.length.clone()),
            ("load", last.load, units.load()),
            ("approach", last.approach, units.length.clone()),
            ("largest contact pressure", Some(last.max_pressure), units.pressure()),
            ("contact area", last.contact_area, units.area()),
            ("largest wear depth", Some(last.max_wear_depth), units.length.clone()),
            ("worn volume", last.wear_volume, units.volume()),
        ];
        let mut facts: Vec<(String, String)> = known
            .into_iter()
            .filter_map(|(name, value, unit)| Some((name.to_owned(), format!("{} {unit}", rounded(value?, DIGITS)))))
            .collect();
        if let Some(share) = self.report.share {
            facts.push((
                "shares of the wear".to_owned(),
                format!("{} wearing body, {} counterbody", share[0], share[1]),
            ));
        }
        facts
    }

    /// Every norm against the reference, and what is estimated.
    fn error(&self, page: &mut Page) {
        let error = &self.report.error;
        let shown = |value: &Value| value.as_f64().map_or_else(|| "-".to_owned(), number);
        let fields = error["by_field"].as_object().cloned().unwrap_or_default();
        let reference = error["reference"].as_str().unwrap_or_default();
        // What is estimated has its own table below.
        if !fields.is_empty() && !reference.starts_with(ESTIMATED) {
            page.heading(&format!("Error: against {reference}"));
            let rows: Vec<Vec<String>> = fields
                .iter()
                .map(|(name, value)| {
                    vec![name.replace('_', " ").replace(" l2 ", " L2, ").replace(" cells", ", in cells"), shown(value)]
                })
                .collect();
            page.table(&["norm", "value"], &rows);
        }
        let estimate = &error["estimate"];
        let named = [
            ("wear, L2, relative", "wear_l2_relative"),
            ("pressure, L2, relative", "pressure_l2_relative"),
            ("volume, relative", "volume_relative"),
        ];
        let parts = ["steps", "grid", "total"];
        let rows: Vec<Vec<String>> = named
            .iter()
            .filter(|(_, key)| parts.iter().any(|part| estimate[*part][*key].is_number()))
            .map(|(name, key)| {
                let cells = parts.iter().map(|part| shown(&estimate[*part][*key]));
                std::iter::once((*name).to_owned()).chain(cells).collect()
            })
            .collect();
        if !rows.is_empty() {
            page.heading("Error: estimated");
            page.table(&["norm", "steps", "grid", "both"], &rows);
            let without = estimate["without"].as_array().cloned().unwrap_or_default();
            for text in without.iter().filter_map(Value::as_str) {
                page.text(&format!("Not in it: {text}."));
            }
        }
    }

    fn history(&self, page: &mut Page) {
        let (rows, units) = (&self.figure.history.rows, self.figure.units);
        let every = rows.len().div_ceil(ROWS).max(1);
        let head = [
            format!("time, {}", units.time),
            format!("slid, {}", units.length),
            format!("load, {}", units.load()),
            format!("largest pressure, {}", units.pressure()),
            format!("largest depth, {}", units.length),
            format!("volume, {}", units.volume()),
        ];
        let last = rows.len().saturating_sub(1);
        let shown = rows.iter().enumerate().filter(|(k, _)| k % every == 0 || *k == last).map(|(_, row)| {
            let cell = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), number);
            [
                Some(row.time),
                Some(row.sliding_distance),
                row.load,
                Some(row.max_pressure),
                Some(row.max_wear_depth),
                row.wear_volume,
            ]
            .map(cell)
            .to_vec()
        });
        page.table(&head.each_ref().map(String::as_str), &shown.collect::<Vec<_>>());
        if every > 1 {
            page.text(&format!("One row in {every} of {}; all are in history.csv.", rows.len()));
        }
    }

    fn provenance(&self) -> Vec<(String, String)> {
        let fact = |label: &str, text: &str| (label.to_owned(), text.to_owned());
        let law = &self.report.law;
        let mut facts = vec![
            fact("wearlaw", &self.identity.program),
            fact("law", &format!("{} {} ({})", law.name, law.version, law.path)),
            fact("SHA-256 of the law", law.sha256.as_deref().unwrap_or("part of the program")),
        ];
        if let Some(constants) = &law.constants {
            let all: Vec<String> = constants.iter().map(|(name, value)| format!("{name} = {value}")).collect();
            facts.push(fact("constants", &all.join(", ")));
        }
        for (what, hash) in &self.identity.contents {
            facts.push((format!("SHA-256 of {what}"), hash.clone()));
        }
        if let Some(seed) = self.report.scene["surface"]["seed"].as_i64() {
            facts.push(fact("seed of the surface", &seed.to_string()));
        }
        facts.extend(self.machine.iter().cloned());
        facts
    }
}

fn with_unit(value: f64, unit: &str) -> String {
    format!("{} {unit}", number(value))
}

fn after(last: &HistoryRow, unit: &str) -> String {
    format!("at time {} {unit}", number(last.time))
}

fn cost(cost: &Cost) -> Vec<(String, String)> {
    let mut facts = vec![
        ("run time".to_owned(), format!("{} s", number(cost.run_time_s))),
        ("of it in the law, summed over threads".to_owned(), format!("{} s", number(cost.law_time_s))),
        ("of it in contact solves".to_owned(), format!("{} s", number(cost.contact_time_s))),
    ];
    let counts = [
        ("steps", cost.steps),
        ("rejected steps", cost.rejected_steps),
        ("calls of the law", cost.law_calls),
        ("points evaluated", cost.points_evaluated),
        ("contact solves", cost.contact_solves),
        ("iterations of them", cost.contact_iterations),
        ("pairs of transforms", cost.fft_pairs),
    ];
    facts.extend(counts.iter().map(|(name, count)| ((*name).to_owned(), count.to_string())));
    if cost.peak_memory_bytes > 0 {
        facts.push(("peak memory".to_owned(), format!("{} MB", number(cost.peak_memory_bytes as f64 * 1e-6))));
    }
    facts
}
