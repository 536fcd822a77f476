//! The few lines that a run ends with.

use std::path::PathBuf;

use super::console::Console;
use super::table::labelled;
use super::unit_text::{elapsed, significant};
use crate::record::Estimated;
use crate::solve::Estimate;

/// What a run came to, for people; `None` where the scene cannot give it.
#[derive(Debug, Clone, Default)]
pub(super) struct Summary {
    /// The scene's title, or its file.
    pub(super) title: String,
    /// Name and version of the law, and where it came from.
    pub(super) law: String,
    /// Represented time at the end.
    pub(super) time: f64,
    /// Largest sliding distance.
    pub(super) sliding_distance: f64,
    /// Largest wear depth.
    pub(super) max_wear_depth: f64,
    /// Worn volume.
    pub(super) wear_volume: Option<f64>,
    /// How the error is known, in which norm, and how large it is.
    pub(super) error: Option<(String, String, f64)>,
    /// Estimated errors of steps and grid, where the scene asks for them.
    pub(super) estimate: Option<Estimate>,
    /// Wall time of the run without compiling the law, s.
    pub(super) run_time_s: f64,
    /// Wall time of compiling the law, s.
    pub(super) build_time_s: Option<f64>,
    /// Accepted steps, and points that the law was evaluated at.
    pub(super) steps: u64,
    /// Points that the law was evaluated at, counted again in every call.
    pub(super) points_evaluated: u64,
    /// The folder with the results.
    pub(super) out: PathBuf,
    /// Labels of length and time.
    pub(super) length: String,
    /// Label of time.
    pub(super) time_unit: String,
    /// Shares of the wear of the wearing body and the counterbody.
    pub(super) share: Option<[f64; 2]>,
    /// Why the run ended before its time.
    pub(super) stopped: Option<String>,
}

/// Width of the column of labels.
const LABEL: usize = 18;
const WIDTH: usize = 96;

impl Summary {
    /// The lines, the error beside the run time.
    pub(super) fn text(&self, console: &Console) -> String {
        let mut text = format!("{}\n", console.headline(&self.title));
        let mut line = |label: &str, value: &str| text.push_str(&labelled(label, value, LABEL, WIDTH));
        let (length, time) = (&self.length, &self.time_unit);
        line("law", &self.law);
        let at = format!("at time {} {time}, slid {} {length}", figures(self.time), figures(self.sliding_distance));
        line("wear depth", &format!("{} {length} {at}", significant(self.max_wear_depth, 11)));
        if let Some([own, other]) = self.share {
            let depth = |part: f64| significant(part * self.max_wear_depth, 6);
            line("of it", &format!("{} {length} wearing body, {} {length} counterbody", depth(own), depth(other)));
        }
        if let Some(volume) = self.wear_volume {
            line("wear volume", &format!("{} {length}^3", significant(volume, 11)));
        }
        if let Some(reason) = &self.stopped {
            line("ended early", reason);
        }
        let built = self.build_time_s.map_or_else(String::new, |s| format!(", and {} compiling the law", elapsed(s)));
        let run = format!("{}{built}", elapsed(self.run_time_s));
        match &self.error {
            Some((reference, norm, value)) => {
                // The line above has said that it is about the wear depth.
                let norm = norm.trim_end_matches(" error of the wear depth");
                line("error, run time", &format!("{} ({norm}, {reference}) in {run}", significant(*value, 3)));
            }
            None => line("run time", &run),
        }
        if let Some(estimate) = &self.estimate {
            line("estimated error", &estimated(estimate));
        }
        line("work", &format!("{} steps, {} points evaluated", self.steps, self.points_evaluated));
        line("results", &self.out.display().to_string());
        text
    }
}

/// Norm by norm the error of steps and grid, and what is not in it.
fn estimated(estimate: &Estimate) -> String {
    let parts = |of: fn(&Estimated) -> Option<f64>| {
        let short = |value: Option<f64>| value.map_or_else(|| "?".to_owned(), |value| significant(value, 2));
        let (steps, grid) = (of(&estimate.steps), of(&estimate.grid));
        match (of(&estimate.total), grid) {
            (None, None) if steps.is_none() => None,
            (Some(total), None) => Some(short(Some(total))),
            (total, grid) => Some(format!("{} (steps {}, grid {})", short(total), short(steps), short(grid))),
        }
    };
    let named = [
        ("wear L2", parts(|of| of.wear_l2_relative)),
        ("pressure L2", parts(|of| of.pressure_l2_relative)),
        ("volume", parts(|of| of.volume_relative)),
    ];
    let known: Vec<String> = named.into_iter().filter_map(|(name, text)| Some(format!("{name} {}", text?))).collect();
    let known = if known.is_empty() { "not known".to_owned() } else { known.join(", ") };
    let without: String = estimate.without.iter().map(|what| format!("; without {what}")).collect();
    let more = match estimate.time_s > 0.0 {
        true => format!("; the estimate took {} more", elapsed(estimate.time_s)),
        false => String::new(),
    };
    format!("{known}, relative{more}{without}")
}

/// Six figures, without zeros that say nothing.
fn figures(value: f64) -> String {
    let text = significant(value, 6);
    match text.split_once('e') {
        Some((digits, power)) => format!("{}e{power}", trimmed(digits)),
        None => trimmed(&text).to_owned(),
    }
}

fn trimmed(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_stands_beside_the_run_time() {
        let summary = Summary {
            title: "Pin on disc".to_owned(),
            law: "archard 0.1.0 (embedded:archard)".to_owned(),
            time: 1.0,
            sliding_distance: 0.25,
            max_wear_depth: 7.322_799_325_1e-6,
            error: Some(("against archard-prescribed".to_owned(), "relative".to_owned(), 2.1e-13)),
            run_time_s: 0.0032,
            out: "pin.out".into(),
            length: "m".to_owned(),
            time_unit: "s".to_owned(),
            ..Summary::default()
        };
        let text = summary.text(&Console::new(false, false));
        let line = text.lines().find(|line| line.contains("error")).unwrap();
        assert!(line.contains("2.10e-13") && line.contains("archard-prescribed") && line.contains("3.20 ms"), "{text}");
        assert!(text.contains("7.3227993251e-6 m at time 1 s, slid 0.25 m"), "{text}");
        assert!(!text.contains("volume") && !text.contains("compiling"), "{text}");
    }
}
