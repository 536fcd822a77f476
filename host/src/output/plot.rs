//! The figure of a run, `plot.svg`: pressure and wear along the surface at start and end (or the
//! loading over time where the points form no line), wear depth and worn volume over time.
//!
//! The same record gives the same bytes. Curves differ in dash as well as in colour, legends stand
//! outside the axes, and powers of ten stand in the captions.

mod axis;
mod curve;
mod fit;
mod panel;
mod study;

use super::{OutputError, write_file};
use crate::record::{History, HistoryRow, Profile, Units};
use axis::Axis;
pub(super) use axis::{number, rounded};
use curve::{Curve, Look};
use panel::{Panel, Place, QUIET, Style, write};
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::prelude::SVGBackend;
use std::io::Write;
use std::path::Path;

pub(super) use fit::write_fit_plot;
pub(super) use study::{study_svg, write_study_plot};

/// Size of the figure in pixels.
const SIZE: (u32, u32) = (1000, 700);
/// The drawing library knows whole pixels only: it draws on a sheet finer by this factor, which
/// the file then shows at the size of the figure.
const FINE: u32 = 8;
/// Longest title that fits one line.
const TITLE: usize = 78;

type Sheet<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type DrawingFailure = DrawingAreaErrorKind<std::io::Error>;

/// What the figure shows.
#[derive(Debug, Clone, Copy)]
pub struct Figure<'a> {
    /// Title of the scene.
    pub title: &'a str,
    /// Labels of the units.
    pub units: &'a Units,
    /// The quantities over time.
    pub history: &'a History,
    /// Profiles along the surface; without them the loading over time is shown.
    pub profile: Option<&'a Profile<'a>>,
}

/// Writes the figure as SVG.
///
/// # Errors
/// `Drawing` when it cannot be drawn, `Io` when it cannot be written, both with the path.
pub fn write_plot(figure: &Figure<'_>, path: &Path) -> Result<(), OutputError> {
    let svg = plot_svg(figure, path)?;
    write_file(path, |to| to.write_all(svg.as_bytes()))
}

/// The figure as the text of an SVG file, for the file at `path`.
pub(super) fn plot_svg(figure: &Figure<'_>, path: &Path) -> Result<String, OutputError> {
    draw(figure).map_err(|source| OutputError::Drawing { path: path.into(), source: source.into() })
}

/// The figure as the text of an SVG file.
fn draw(figure: &Figure<'_>) -> Result<String, DrawingFailure> {
    let mut svg = String::new();
    let fine_size = (SIZE.0 * FINE, SIZE.1 * FINE);
    let sheet = SVGBackend::with_string(&mut svg, fine_size).into_drawing_area();
    let (width, height) = (f64::from(SIZE.0), f64::from(SIZE.1));
    panel::paper(&sheet, (width, height))?;
    write(&sheet, &shortened(figure.title), (28.0, 32.0), Style::title(19.0))?;
    write(&sheet, &summary(figure), (28.0, 57.0), Style::left(13.0, QUIET))?;
    let columns = [(84.0, 484.0), (572.0, 972.0)];
    let rows = [(118.0, 326.0), (428.0, 636.0)];
    for (i, panel) in panels(figure).iter().enumerate() {
        let ((left, right), (top, bottom)) = (columns[i % 2], rows[i / 2]);
        panel.draw(&sheet, Place { left, top, right, bottom })?;
    }
    sheet.present()?;
    drop(sheet);
    Ok(shown(&svg, SIZE))
}

/// The text of a fine sheet as it is shown at the size of its figure.
fn shown(svg: &str, (width, height): (u32, u32)) -> String {
    let fine = format!("width=\"{}\" height=\"{}\" viewBox", width * FINE, height * FINE);
    let shown =
        format!("width=\"{width}\" height=\"{height}\" stroke-linejoin=\"round\" stroke-linecap=\"butt\" viewBox");
    svg.replacen(&fine, &shown, 1)
}

fn panels(figure: &Figure<'_>) -> [Panel; 4] {
    let (units, rows) = (figure.units, &figure.history.rows);
    let [first, second] = match figure.profile {
        Some(profile) => profiles(profile, units),
        None => loading(figure.history, units),
    };
    let depth = over_time(figure, ("Largest wear depth", &units.length), |row| Some(row.max_wear_depth));
    let last = if rows.iter().any(|row| row.wear_volume.is_some()) {
        over_time(figure, ("Worn volume", &units.volume()), |row| row.wear_volume)
    } else {
        // Without areas there is no volume; the distance tells what the depth came from.
        over_time(figure, ("Sliding distance", &units.length), |row| Some(row.sliding_distance))
    };
    [first, second, depth, last]
}

fn profiles(profile: &Profile<'_>, units: &Units) -> [Panel; 2] {
    let panel = |quantity: (&str, &str), start: &[f64], end: &[f64]| {
        let along = |field: &[f64]| profile.coordinate.iter().copied().zip(field.iter().copied()).collect::<Vec<_>>();
        let mut curves = vec![
            Curve::new("end", Look::End, along(end).into_iter()),
            Curve::new("start", Look::Start, along(start).into_iter()),
        ];
        for curve in &mut curves {
            curve.dots = profile.axis == "point";
        }
        let name = if profile.axis == "point" { axis::COUNT } else { &profile.axis };
        Panel {
            across: Axis::spanning((name, &profile.unit), profile.coordinate.iter().copied(), 5),
            up: Axis::from_zero(quantity, start.iter().chain(end).copied(), 5),
            curves,
        }
    };
    [
        panel(("Contact pressure", &units.pressure()), &profile.pressure_start, &profile.pressure_end),
        panel(("Wear depth", &units.length), &profile.wear_start, &profile.wear_end),
    ]
}

fn loading(history: &History, units: &Units) -> [Panel; 2] {
    let pressure = history.rows.iter().map(|row| (row.time, row.max_pressure));
    let velocity: Vec<(f64, f64)> =
        history.sliding_velocity().flat_map(|(start, end, velocity)| [(start, velocity), (end, velocity)]).collect();
    let pressure = Curve::new("", Look::End, pressure);
    // Means over steps: the corners are no measured instants.
    let velocity = Curve { dots: false, ..Curve::new("", Look::End, velocity.into_iter()) };
    [
        timed(history, ("Largest contact pressure", &units.pressure()), units, pressure),
        timed(history, ("Sliding velocity, mean over each step", &units.velocity()), units, velocity),
    ]
}

fn over_time(figure: &Figure<'_>, quantity: (&str, &str), value: impl Fn(&HistoryRow) -> Option<f64>) -> Panel {
    let points = figure.history.rows.iter().map(|row| (row.time, value(row).unwrap_or(f64::NAN)));
    let curve = Curve::new("", Look::End, points);
    timed(figure.history, quantity, figure.units, curve)
}

fn timed(history: &History, quantity: (&str, &str), units: &Units, curve: Curve) -> Panel {
    // A history that begins with its first step begins where that step did.
    let start = history.rows.first().map(|row| row.time - row.dt);
    let times = start.into_iter().chain(history.rows.iter().map(|row| row.time));
    Panel {
        across: Axis::spanning(("Time", &units.time), times, 5),
        up: Axis::from_zero(quantity, curve.points.iter().map(|&(_, y)| y), 5),
        curves: vec![curve],
    }
}

fn summary(figure: &Figure<'_>) -> String {
    let Some(end) = figure.history.last() else {
        return "no step was accepted".into();
    };
    let Units { length, time, .. } = figure.units;
    format!(
        "At the end:  time {} {time}   ·   sliding distance {} {length}   ·   largest wear depth {} {length}",
        number(end.time),
        number(end.sliding_distance),
        number(end.max_wear_depth),
    )
}

fn shortened(title: &str) -> String {
    if title.chars().count() <= TITLE {
        return title.to_owned();
    }
    let mut short: String = title.chars().take(TITLE - 1).collect();
    short.truncate(short.trim_end().len());
    short + "…"
}

fn fine((x, y): (f64, f64)) -> (i32, i32) {
    // `as` saturates, so that a number far outside the figure cannot wrap into it.
    ((x * f64::from(FINE)).round() as i32, (y * f64::from(FINE)).round() as i32)
}

#[cfg(test)]
mod tests;
