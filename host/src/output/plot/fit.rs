//! The picture of a fit, `fit.svg`: what was measured with the fitted scene through it, and what is left of each measurement.

use super::axis::Axis;
use super::curve::{Curve, Look};
use super::panel::{INK, Panel, Place, QUIET, Style, VERMILLION, dot, line, paper, write};
use super::{DrawingFailure, FINE, OutputError, Sheet, shortened, shown, write_file};
use crate::record::FitRecord;
use plotters::drawing::IntoDrawingArea;
use plotters::prelude::SVGBackend;
use std::io::Write;
use std::path::Path;

/// Size of the picture in pixels.
const SIZE: (u32, u32) = (860, 680);
const ABOVE: Place = Place { left: 92.0, top: 118.0, right: 828.0, bottom: 398.0 };
const BELOW: Place = Place { left: 92.0, top: 486.0, right: 828.0, bottom: 616.0 };

/// Writes the picture as SVG.
///
/// # Errors
/// `Drawing` when it cannot be drawn, `Io` when it cannot be written, both with the path.
pub(in crate::output) fn write_fit_plot(fit: &FitRecord, path: &Path) -> Result<(), OutputError> {
    let svg = draw(fit).map_err(|source| OutputError::Drawing { path: path.into(), source: source.into() })?;
    write_file(path, |to| to.write_all(svg.as_bytes()))
}

/// The picture as the text of an SVG file.
pub(in crate::output) fn draw(fit: &FitRecord) -> Result<String, DrawingFailure> {
    let mut svg = String::new();
    let sheet = SVGBackend::with_string(&mut svg, (SIZE.0 * FINE, SIZE.1 * FINE)).into_drawing_area();
    paper(&sheet, (f64::from(SIZE.0), f64::from(SIZE.1)))?;
    let title = format!("{} fitted to {}", fit.law, name_of(&fit.data));
    write(&sheet, &shortened(&title), (28.0, 30.0), Style::title(19.0))?;
    write(&sheet, &shortened(&found(fit)), (28.0, 56.0), Style::left(12.5, QUIET))?;
    let fitted = |point: &crate::record::FitPoint| (point.at, point.fitted);
    let curve = Curve { dots: false, ..Curve::new("fitted", Look::End, fit.points.iter().map(fitted)) };
    let heights = fit.points.iter().flat_map(|point| [point.measured + point.sigma, point.fitted]);
    let across = || Axis::spanning((&capital(&fit.across), ""), fit.points.iter().map(|point| point.at), 6);
    let above =
        Panel { across: across(), up: Axis::from_zero((&capital(&fit.quantity), ""), heights, 5), curves: vec![curve] };
    above.draw(&sheet, ABOVE)?;
    points(&sheet, ABOVE, &above, fit.points.iter().map(|point| (point.at, point.measured, point.sigma)))?;
    let y = ABOVE.top - 16.0;
    dot(&sheet, (ABOVE.right - 190.0, y), Look::Start)?;
    write(&sheet, "measured", (ABOVE.right - 178.0, y), Style::left(13.0, INK))?;
    let left = |point: &crate::record::FitPoint| {
        let unit = if fit.relative { 0.01 * point.measured } else { point.sigma };
        (point.at, (point.measured - point.fitted) / unit, point.sigma / unit)
    };
    let most = fit.points.iter().map(|point| left(point).1.abs() + left(point).2).fold(0.0, f64::max);
    let caption = if fit.relative { "Measured less fitted (%)" } else { "Measured less fitted (standard deviations)" };
    let below =
        Panel { across: across(), up: Axis::spanning((caption, ""), [-most, most].into_iter(), 4), curves: Vec::new() };
    below.draw(&sheet, BELOW)?;
    let middle = BELOW.bottom - below.up.fraction(0.0) * (BELOW.bottom - BELOW.top);
    line(&sheet, &[(BELOW.left, middle), (BELOW.right, middle)], INK, 1.25)?;
    points(&sheet, BELOW, &below, fit.points.iter().map(left))?;
    sheet.present()?;
    drop(sheet);
    Ok(shown(&svg, SIZE))
}

/// Dots with a bar of one standard deviation to either side.
fn points(
    sheet: &Sheet<'_>,
    place: Place,
    panel: &Panel,
    points: impl Iterator<Item = (f64, f64, f64)>,
) -> Result<(), DrawingFailure> {
    for (x, y, sigma) in points {
        let across = place.left + panel.across.fraction(x) * (place.right - place.left);
        let height =
            |y: f64| (place.bottom - panel.up.fraction(y) * (place.bottom - place.top)).clamp(place.top, place.bottom);
        line(sheet, &[(across, height(y - sigma)), (across, height(y + sigma))], VERMILLION, 1.0)?;
        dot(sheet, (across, height(y)), Look::Start)?;
    }
    Ok(())
}

/// What was found, in a line.
fn found(fit: &FitRecord) -> String {
    let each = fit.parameters.iter().map(|one| match one.interval {
        Some([low, high]) => format!("{} = {:.4e} ({low:.3e} to {high:.3e})", one.name, one.value),
        None => format!("{} cannot be known by itself", one.name),
    });
    each.collect::<Vec<_>>().join("   ·   ")
}

fn name_of(path: &str) -> String {
    Path::new(path).file_name().map_or_else(|| path.to_owned(), |name| name.to_string_lossy().into_owned())
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
