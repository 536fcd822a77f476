//! How lines of a study look: each differs from all others in dash or marker, not in colour alone.

use crate::output::plot::panel::{BLUE, INK, VERMILLION, line, stroke};
use crate::output::plot::{DrawingFailure, FINE, Sheet, fine};
use crate::record::{Case, Kind};
use plotters::element::{DashedPathElement, Polygon};
use plotters::style::{RGBColor, ShapeStyle};

// Okabe and Ito (2008), "Color Universal Design".
const GREEN: RGBColor = RGBColor(0x00, 0x9e, 0x73);
const PURPLE: RGBColor = RGBColor(0xcc, 0x79, 0xa7);
const ORANGE: RGBColor = RGBColor(0xe6, 0x9f, 0x00);
const PAPER: RGBColor = RGBColor(255, 255, 255);
/// Half of a marker's height.
const SIZE: f64 = 5.0;

/// The shape of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    Circle,
    Square,
    Up,
    Diamond,
    Down,
    Star,
}

/// How a line looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Mark {
    colour: RGBColor,
    shape: Shape,
    filled: bool,
    /// Lengths of dash and gap; `None`: solid.
    dash: Option<(i32, i32)>,
}

impl Mark {
    /// The look of the line that a case belongs to.
    pub(super) fn of(case: &Case) -> Self {
        let (colour, shape) = match (case.kind, case.method.as_str()) {
            (Kind::Scaling, _) => (PURPLE, Shape::Star),
            (_, "explicit-euler") => (VERMILLION, Shape::Circle),
            (_, "implicit-euler") => (BLUE, Shape::Square),
            (_, "tr-bdf2") => (GREEN, Shape::Up),
            (_, "sdirk2") => (ORANGE, Shape::Diamond),
            _ => (INK, Shape::Down),
        };
        let (filled, dash) = match case.kind {
            _ if case.isolated => (false, Some((2, 4))),
            Kind::Substeps => (true, None),
            Kind::Tolerance => (false, Some((8, 4))),
            Kind::Scaling => (true, Some((2, 3))),
            Kind::Grid => (true, None),
        };
        // Explicit steps at their limit are a single point of their own.
        let filled = filled && !case.line.ends_with("limit");
        Self { colour, shape, filled, dash }
    }

    /// Draws the line through the points.
    pub(super) fn stroke(&self, sheet: &Sheet<'_>, points: &[(f64, f64)]) -> Result<(), DrawingFailure> {
        if points.len() < 2 {
            return Ok(());
        }
        match self.dash {
            None => line(sheet, points, self.colour, 1.5),
            Some((dash, gap)) => {
                let points: Vec<_> = points.iter().map(|&at| fine(at)).collect();
                let (dash, gap) = (dash * FINE as i32, gap * FINE as i32);
                sheet.draw(&DashedPathElement::new(points, dash, gap, stroke(self.colour, 1.5)))
            }
        }
    }

    /// Draws the marker; a filled one has a rim of paper, so that it can be told from what lies below.
    pub(super) fn dot(&self, sheet: &Sheet<'_>, at: (f64, f64)) -> Result<(), DrawingFailure> {
        let corners = |size: f64| {
            self.corners().iter().map(|(x, y)| fine((at.0 + size * x, at.1 - size * y))).collect::<Vec<_>>()
        };
        let shape = |size: f64, colour: RGBColor| Polygon::new(corners(size), ShapeStyle::from(colour).filled());
        if self.filled {
            sheet.draw(&shape(SIZE + 1.2, PAPER))?;
            return sheet.draw(&shape(SIZE, self.colour));
        }
        sheet.draw(&shape(SIZE + 0.5, self.colour))?;
        sheet.draw(&shape(SIZE - 2.0, PAPER))
    }

    /// Corners of the marker, of height 2.
    fn corners(&self) -> Vec<(f64, f64)> {
        let around = |count: u32, turn: f64, inner: f64| {
            (0..count).map(move |i| {
                let angle = std::f64::consts::TAU * f64::from(i) / f64::from(count) + turn;
                let radius = if i % 2 == 1 { inner } else { 1.0 };
                (radius * angle.cos(), radius * angle.sin())
            })
        };
        let quarter = std::f64::consts::FRAC_PI_2;
        match self.shape {
            Shape::Circle => around(24, 0.0, 1.0).collect(),
            Shape::Square => vec![(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
            Shape::Up => around(3, quarter, 1.2).map(|(x, y)| (1.1 * x, 1.1 * y)).map(raised).collect(),
            Shape::Down => around(3, -quarter, 1.2).map(|(x, y)| (1.1 * x, 1.1 * y)).map(raised).collect(),
            Shape::Diamond => vec![(0.0, 1.2), (1.0, 0.0), (0.0, -1.2), (-1.0, 0.0)],
            Shape::Star => around(10, quarter, 0.45).map(|(x, y)| (1.3 * x, 1.3 * y)).collect(),
        }
    }
}

/// Corners of a triangle all lie on its circle, whichever of them it is.
fn raised((x, y): (f64, f64)) -> (f64, f64) {
    let size = 1.2 / x.hypot(y);
    (size * x, size * y)
}

/// A cross over a marker.
pub(super) fn cross(sheet: &Sheet<'_>, (x, y): (f64, f64)) -> Result<(), DrawingFailure> {
    let arm = 1.5 * SIZE;
    for (colour, width) in [(PAPER, 3.6), (INK, 1.8)] {
        line(sheet, &[(x - arm, y - arm), (x + arm, y + arm)], colour, width)?;
        line(sheet, &[(x - arm, y + arm), (x + arm, y - arm)], colour, width)?;
    }
    Ok(())
}
