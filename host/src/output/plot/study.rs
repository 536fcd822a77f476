//! The picture of a study, `study.svg`: error against run time, both in decades, a line per method.
//!
//! Lines differ in dash and marker as well as in colour; unstable runs are crossed; the front that nothing stable beats lies
//! below the lines as a grey stair; what the yardstick cannot tell from its own error is shaded. Grids have a panel of their
//! own, because their errors are against something else.

mod decades;
mod marks;

use super::panel::{AXIS, GRID, INK, Place, QUIET, Style, line, paper, write};
use super::{DrawingFailure, FINE, OutputError, Sheet, fine, shortened, shown, write_file};
use crate::record::{Case, Clock, Kind, Status, StudyRecord};
use decades::Decades;
use marks::{Mark, cross};
use plotters::drawing::IntoDrawingArea;
use plotters::element::Rectangle;
use plotters::prelude::SVGBackend;
use plotters::style::{Color, RGBColor, ShapeStyle, WHITE};
use std::io::Write;
use std::path::Path;

/// Size of the picture in pixels.
const SIZE: (u32, u32) = (1000, 660);
/// Where the lines are drawn, and the grids.
const MAIN: Place = Place { left: 84.0, top: 92.0, right: 664.0, bottom: 600.0 };
const SIDE: Place = Place { left: 752.0, top: 456.0, right: 972.0, bottom: 600.0 };
/// Where the legend begins, and the height of a row.
const LEGEND: (f64, f64) = (700.0, 102.0);
const ROW: f64 = 21.0;
const FRONT: RGBColor = RGBColor(0xc4, 0xc9, 0xcf);
const SHADE: RGBColor = RGBColor(0xf1, 0xf2, 0xf4);
/// Errors below so many times the yardstick's own are shaded, as the table marks them.
const RESOLVED: f64 = 3.0;

/// Writes the picture as SVG.
///
/// # Errors
/// `Drawing` when it cannot be drawn, `Io` when it cannot be written, both with the path.
pub(in crate::output) fn write_study_plot(study: &StudyRecord, path: &Path) -> Result<(), OutputError> {
    let svg = study_svg(study, path)?;
    write_file(path, |to| to.write_all(svg.as_bytes()))
}

/// The picture as the text of an SVG file, for the file at `path`.
pub(in crate::output) fn study_svg(study: &StudyRecord, path: &Path) -> Result<String, OutputError> {
    draw(study).map_err(|source| OutputError::Drawing { path: path.into(), source: source.into() })
}

/// Where an error of 0 is drawn, which has no decade.
const NOTHING: f64 = 1e-16;

/// A case as a point: run time and error.
fn point(case: &Case, study: &StudyRecord) -> Option<(f64, f64)> {
    let (time, error) = (case.time(study.clock)?, *case.errors.get(&study.norm)?);
    (time > 0.0 && error >= 0.0 && error.is_finite()).then_some((time, if error == 0.0 { NOTHING } else { error }))
}

/// Two axes with their place on the sheet.
struct Axes {
    place: Place,
    across: Decades,
    up: Decades,
}

impl Axes {
    fn around(place: Place, points: &[(f64, f64)]) -> Self {
        Self {
            place,
            across: Decades::around(points.iter().map(|point| point.0)),
            up: Decades::around(points.iter().map(|point| point.1)),
        }
    }

    fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let Place { left, top, right, bottom } = self.place;
        (left + self.across.fraction(x) * (right - left), bottom - self.up.fraction(y) * (bottom - top))
    }

    fn draw(&self, sheet: &Sheet<'_>) -> Result<(), DrawingFailure> {
        let Place { left, top, right, bottom } = self.place;
        for (at, whole) in self.up.ticks() {
            let y = bottom - at * (bottom - top);
            if whole {
                line(sheet, &[(left, y), (right, y)], GRID, 1.0)?;
            }
            line(sheet, &[(left, y), (left - if whole { 6.0 } else { 3.0 }, y)], AXIS, 1.0)?;
        }
        for (at, whole) in self.across.ticks() {
            let x = left + at * (right - left);
            if whole {
                line(sheet, &[(x, top), (x, bottom)], GRID, 1.0)?;
            }
            line(sheet, &[(x, bottom), (x, bottom + if whole { 6.0 } else { 3.0 })], AXIS, 1.0)?;
        }
        for (at, label) in self.up.labels() {
            write(sheet, &label, (left - 9.0, bottom - at * (bottom - top)), Style::right(12.0))?;
        }
        for (at, label) in self.across.labels() {
            write(sheet, &label, (left + at * (right - left), bottom + 18.0), Style::centred(12.0, QUIET))?;
        }
        line(sheet, &[(left, top), (left, bottom), (right, bottom)], AXIS, 1.25)
    }

    fn captions(&self, sheet: &Sheet<'_>, up: &str, across: &str) -> Result<(), DrawingFailure> {
        let Place { left, top, right, bottom } = self.place;
        write(sheet, up, (left, top - 16.0), Style::title(13.0))?;
        write(sheet, across, ((left + right) / 2.0, bottom + 40.0), Style::centred(13.0, INK))
    }
}

/// The picture as the text of an SVG file.
fn draw(study: &StudyRecord) -> Result<String, DrawingFailure> {
    let mut svg = String::new();
    let sheet = SVGBackend::with_string(&mut svg, (SIZE.0 * FINE, SIZE.1 * FINE)).into_drawing_area();
    paper(&sheet, (f64::from(SIZE.0), f64::from(SIZE.1)))?;
    write(&sheet, &shortened(&study.title), (28.0, 30.0), Style::title(19.0))?;
    write(&sheet, &below(study), (28.0, 54.0), Style::left(12.5, QUIET))?;
    main(&sheet, study)?;
    side(&sheet, study)?;
    sheet.present()?;
    drop(sheet);
    Ok(shown(&svg, SIZE))
}

/// What stands below the title.
fn below(study: &StudyRecord) -> String {
    let cells = study.cells.as_ref().map(|cells| {
        let each: Vec<String> = cells.iter().map(usize::to_string).collect();
        format!("{} cells", each.join(" × "))
    });
    format!(
        "{}   ·   law {}   ·   compared with {}",
        cells.unwrap_or(format!("{} points", study.points)),
        study.law,
        study.yardstick.name
    )
}

/// The lines in the order in which they first appear, without those of grids.
fn lines(study: &StudyRecord) -> Vec<Vec<(usize, &Case)>> {
    let mut lines: Vec<Vec<(usize, &Case)>> = Vec::new();
    for (index, case) in study.cases.iter().enumerate().filter(|(_, case)| case.kind != Kind::Grid) {
        if point(case, study).is_none() {
            continue;
        }
        match lines.iter_mut().find(|line| line.first().is_some_and(|(_, first)| first.line == case.line)) {
            Some(line) => line.push((index, case)),
            None => lines.push(vec![(index, case)]),
        }
    }
    lines
}

fn main(sheet: &Sheet<'_>, study: &StudyRecord) -> Result<(), DrawingFailure> {
    let lines = lines(study);
    let points: Vec<(f64, f64)> = lines.iter().flatten().filter_map(|(_, case)| point(case, study)).collect();
    let axes = Axes::around(MAIN, &points);
    let own = study.yardstick.stated.get(&study.norm).map(|own| RESOLVED * own).filter(|own| axes.up.holds(*own));
    if let Some(own) = own {
        let (_, top) = axes.at((1.0, own));
        let shade = ShapeStyle::from(SHADE).filled();
        sheet.draw(&Rectangle::new([fine((MAIN.left, top)), fine((MAIN.right, MAIN.bottom))], shade))?;
    }
    axes.draw(sheet)?;
    axes.captions(
        sheet,
        norm_words(&study.norm),
        match study.clock {
            Clock::Wall => "Run time (s, least wall time)",
            Clock::Processor => "Run time (s, least processor time)",
        },
    )?;
    if let Some(own) = own {
        let (_, top) = axes.at((1.0, own));
        let place = (MAIN.left + 8.0, top + 10.0);
        write(sheet, "below three times the yardstick's own error", place, Style::left(11.0, QUIET))?;
    }
    if lines.iter().flatten().any(|(_, case)| case.errors.get(&study.norm) == Some(&0.0)) {
        write(sheet, "errors of 0 are drawn at 1e-16", (MAIN.right, MAIN.top - 16.0), Style::right(11.0))?;
    }
    front(sheet, &axes, study)?;
    let level = level(sheet, &axes, study)?;
    let (mut row, mut crossed) = (LEGEND.1, false);
    for line in &lines {
        let mark = Mark::of(line[0].1);
        let at: Vec<(f64, f64)> =
            line.iter().filter_map(|(_, case)| point(case, study)).map(|point| axes.at(point)).collect();
        mark.stroke(sheet, &at)?;
        for ((_, case), at) in line.iter().zip(&at) {
            mark.dot(sheet, *at)?;
            if case.status == Status::Unstable {
                cross(sheet, *at)?;
                crossed = true;
            }
        }
        mark.stroke(sheet, &[(LEGEND.0, row), (LEGEND.0 + 40.0, row)])?;
        mark.dot(sheet, (LEGEND.0 + 20.0, row))?;
        write(sheet, &line[0].1.line, (LEGEND.0 + 50.0, row), Style::left(12.5, INK))?;
        row += ROW;
    }
    if crossed {
        cross(sheet, (LEGEND.0 + 20.0, row))?;
        write(sheet, "unstable: beyond the explicit limit", (LEGEND.0 + 50.0, row), Style::left(12.5, INK))?;
        row += ROW;
    }
    if !study.front.is_empty() {
        super::panel::line(sheet, &[(LEGEND.0, row), (LEGEND.0 + 40.0, row)], FRONT, 5.0)?;
        write(sheet, "Pareto front: nothing stable beats it", (LEGEND.0 + 50.0, row), Style::left(12.5, INK))?;
    }
    // Above the lines that may run through it.
    let Some((words, y)) = level else { return Ok(()) };
    let width = 5.8 * words.chars().count() as f64;
    let [left, right] = [MAIN.right - 6.0 - width, MAIN.right - 2.0];
    let paper = ShapeStyle::from(WHITE.mix(0.8)).filled();
    sheet.draw(&Rectangle::new([fine((left, y - 16.0)), fine((right, y - 3.0))], paper))?;
    write(sheet, words, (MAIN.right - 4.0, y - 9.0), Style::right(11.0))
}

/// A dotted line where the grid's own error lies; its words, and how high it is.
fn level(sheet: &Sheet<'_>, axes: &Axes, study: &StudyRecord) -> Result<Option<(&'static str, f64)>, DrawingFailure> {
    let measured = study.yardstick.measured.get(&study.norm);
    let estimated = study.grid.as_ref().and_then(|grid| grid.estimated.get(&study.norm));
    let (Some(error), words) = (match measured {
        Some(_) => (measured, "the grid's own error, against the exact answer"),
        None => (estimated, "the grid's own error, estimated"),
    }) else {
        return Ok(None);
    };
    if !axes.up.holds(*error) {
        return Ok(None);
    }
    let (_, y) = axes.at((1.0, *error));
    let points = vec![fine((MAIN.left, y)), fine((MAIN.right, y))];
    let dots = plotters::element::DashedPathElement::new(
        points,
        2 * FINE as i32,
        5 * FINE as i32,
        super::panel::stroke(QUIET, 1.25),
    );
    sheet.draw(&dots)?;
    Ok(Some((words, y)))
}

/// The stair of what nothing stable beats.
fn front(sheet: &Sheet<'_>, axes: &Axes, study: &StudyRecord) -> Result<(), DrawingFailure> {
    let corners = study.front.iter().filter_map(|index| point(&study.cases[*index], study));
    let corners: Vec<(f64, f64)> = corners.map(|corner| axes.at(corner)).collect();
    let (Some(first), Some(last)) = (corners.first(), corners.last()) else { return Ok(()) };
    let mut stair = vec![(first.0, MAIN.top), *first];
    for pair in corners.windows(2) {
        stair.extend([(pair[1].0, pair[0].1), pair[1]]);
    }
    stair.push((MAIN.right, last.1));
    line(sheet, &stair, FRONT, 5.0)
}

/// Grids: their error against their run time.
fn side(sheet: &Sheet<'_>, study: &StudyRecord) -> Result<(), DrawingFailure> {
    let grids: Vec<(&Case, (f64, f64))> = study
        .cases
        .iter()
        .filter(|case| case.kind == Kind::Grid)
        .filter_map(|case| Some((case, point(case, study)?)))
        .collect();
    if grids.is_empty() {
        return Ok(());
    }
    let points: Vec<(f64, f64)> = grids.iter().map(|(_, point)| *point).collect();
    let axes = Axes::around(SIDE, &points);
    axes.draw(sheet)?;
    axes.captions(sheet, "Error of the grid, cells beside it", "Run time (s)")?;
    let mark = Mark::of(grids[0].0);
    let at: Vec<(f64, f64)> = points.iter().map(|point| axes.at(*point)).collect();
    mark.stroke(sheet, &at)?;
    for ((case, _), at) in grids.iter().zip(&at) {
        mark.dot(sheet, *at)?;
        // The label stands on the side that is farther from the edge.
        let (x, style) = match at.0 > (SIDE.left + SIDE.right) / 2.0 {
            true => (at.0 + 4.0, Style::right(11.5)),
            false => (at.0 + 6.0, Style::left(11.5, QUIET)),
        };
        write(sheet, &case.value.to_string(), (x, at.1 - 11.0), style)?;
    }
    Ok(())
}

/// A norm as a caption.
fn norm_words(norm: &str) -> &'static str {
    match norm {
        "pressure_l2_relative" => "Error of the contact pressure (relative, L2)",
        _ => "Error of the wear profile (relative, L2)",
    }
}
