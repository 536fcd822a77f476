//! The progress bar of a run, on a terminal only.

use indicatif::{ProgressBar, ProgressStyle};

use super::console::Console;
use super::unit_text::significant;

/// How far a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stage {
    /// Part of the represented time that is done, 0 to 1.
    pub(super) fraction: f64,
    /// Represented time, in the scene's unit.
    pub(super) time: f64,
    /// Accepted steps so far.
    pub(super) step: u64,
    /// Area under contact pressure, where the scene has areas.
    pub(super) contact_area: Option<f64>,
    /// Largest wear depth so far.
    pub(super) max_wear_depth: f64,
}

/// A progress bar, or nothing where there is no terminal to show it.
pub(super) struct Progress {
    bar: ProgressBar,
}

/// Steps of the bar: finer than any terminal is wide.
const STEPS: u64 = 10_000;

impl Progress {
    /// Shows an empty bar; it is gone when the value is.
    pub(super) fn start(console: &Console) -> Self {
        if !console.shows_progress() {
            return Self { bar: ProgressBar::hidden() };
        }
        let bar = ProgressBar::new(STEPS);
        let style = ProgressStyle::with_template("[{bar:30}] {percent:>3} %  {msg}  {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("=> "));
        Self { bar }
    }

    /// Shows what a study runs, and how much of its budget is spent.
    pub(super) fn show_case(&self, case: &str, spent: f64) {
        if !self.bar.is_hidden() {
            self.bar.set_position((spent.clamp(0.0, 1.0) * STEPS as f64) as u64);
            self.bar.set_message(case.to_owned());
        }
    }

    /// Shows how far a try is.
    pub(super) fn try_at(&self, time: f64, fraction: f64) {
        if !self.bar.is_hidden() {
            self.bar.set_position((fraction.clamp(0.0, 1.0) * STEPS as f64) as u64);
            self.bar.set_message(format!("time {}  trying", significant(time, 3)));
        }
    }

    /// Shows how far the run is; the bar draws no more often than anyone can read.
    pub(super) fn show(&self, stage: &Stage) {
        self.show_as("", stage);
    }

    /// Shows how far the run is that the results are compared with.
    pub(super) fn show_reference(&self, stage: &Stage) {
        self.show_as("reference  ", stage);
    }

    fn show_as(&self, what: &str, stage: &Stage) {
        if self.bar.is_hidden() {
            return;
        }
        self.bar.set_position((stage.fraction.clamp(0.0, 1.0) * STEPS as f64) as u64);
        self.bar.set_message(format!("{what}{}", words(stage)));
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

fn words(stage: &Stage) -> String {
    let area = stage.contact_area.map_or_else(String::new, |area| format!("  contact area {}", significant(area, 3)));
    format!(
        "time {}  step {}{area}  wear depth {}",
        significant(stage.time, 3),
        stage.step,
        significant(stage.max_wear_depth, 3)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_beside_the_bar_are_short() {
        let mut stage = Stage { fraction: 0.5, time: 1.75, step: 12, contact_area: None, max_wear_depth: 7.32e-6 };
        assert_eq!(words(&stage), "time 1.75  step 12  wear depth 7.32e-6");
        stage.contact_area = Some(2.5e-9);
        assert!(words(&stage).contains("contact area 2.50e-9"));
        Progress { bar: ProgressBar::hidden() }.show(&stage);
    }
}
