//! One panel of the figure: caption and legend above, axes with ticks, curves.

use super::axis::Axis;
use super::curve::{Curve, Look};
use super::{FINE, Sheet, fine};
use plotters::element::{Circle, DashedPathElement, PathElement, Rectangle, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, IntoFont, RGBColor, ShapeStyle, TextStyle};

const FONT: &str = "Helvetica Neue, Helvetica, Arial, Liberation Sans, DejaVu Sans, sans-serif";
pub(super) const INK: RGBColor = RGBColor(0x22, 0x26, 0x2b);
pub(super) const QUIET: RGBColor = RGBColor(0x5a, 0x62, 0x6b);
pub(super) const AXIS: RGBColor = RGBColor(0x8a, 0x92, 0x9b);
pub(super) const GRID: RGBColor = RGBColor(0xe4, 0xe7, 0xeb);
// Okabe and Ito (2008), "Color Universal Design": blue and vermillion.
pub(super) const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xb2);
pub(super) const VERMILLION: RGBColor = RGBColor(0xd5, 0x5e, 0x00);

type Failure = super::DrawingFailure;

/// A rectangle on the sheet, in pixels of the figure.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

/// Axes and curves of a panel.
pub(super) struct Panel {
    pub across: Axis,
    pub up: Axis,
    pub curves: Vec<Curve>,
}

impl Panel {
    /// Draws the panel; `place` is the rectangle of the axes, captions and labels stand around it.
    pub fn draw(&self, sheet: &Sheet<'_>, place: Place) -> Result<(), Failure> {
        self.draw_axes(sheet, place)?;
        write(sheet, &self.up.caption, (place.left, place.top - 16.0), Style::title(15.0))?;
        let middle = (place.left + place.right) / 2.0;
        let below = (middle, place.bottom + 40.0);
        write(sheet, &self.across.caption, below, Style::centred(13.0, INK))?;
        self.draw_legend(sheet, place)?;
        self.curves.iter().try_for_each(|curve| self.draw_curve(sheet, place, curve))
    }

    fn draw_axes(&self, sheet: &Sheet<'_>, place: Place) -> Result<(), Failure> {
        let Place { left, top, right, bottom } = place;
        for (at, label) in &self.up.ticks {
            let y = bottom - at * (bottom - top);
            line(sheet, &[(left, y), (right, y)], GRID, 1.0)?;
            write(sheet, label, (left - 8.0, y), Style::right(12.0))?;
        }
        for (at, label) in &self.across.ticks {
            let x = left + at * (right - left);
            line(sheet, &[(x, top), (x, bottom)], GRID, 1.0)?;
            line(sheet, &[(x, bottom), (x, bottom + 5.0)], AXIS, 1.0)?;
            write(sheet, label, (x, bottom + 17.0), Style::centred(12.0, QUIET))?;
        }
        line(sheet, &[(left, top), (left, bottom), (right, bottom)], AXIS, 1.25)
    }

    /// The legend stands in the row of the caption, where no curve can run.
    fn draw_legend(&self, sheet: &Sheet<'_>, place: Place) -> Result<(), Failure> {
        let named: Vec<&Curve> = self.curves.iter().filter(|curve| !curve.name.is_empty()).collect();
        let y = place.top - 16.0;
        for (i, curve) in named.iter().enumerate() {
            let right = place.right - 84.0 * i as f64;
            let (stroke, text) = (right - 67.0, right - 31.0);
            stroke_curve(sheet, &[(stroke, y), (stroke + 30.0, y)], curve.look)?;
            write(sheet, curve.name, (text, y), Style::left(13.0, INK))?;
        }
        Ok(())
    }

    fn draw_curve(&self, sheet: &Sheet<'_>, place: Place, curve: &Curve) -> Result<(), Failure> {
        let pixel = |&(x, y): &(f64, f64)| {
            let across = place.left + self.across.fraction(x) * (place.right - place.left);
            let up = place.bottom - self.up.fraction(y) * (place.bottom - place.top);
            (across, up)
        };
        for run in curve.lines(|x| self.across.fraction(x)) {
            let pixels: Vec<_> = run.iter().map(pixel).collect();
            if pixels.len() > 1 {
                stroke_curve(sheet, &pixels, curve.look)?;
            }
            if curve.has_dots() || pixels.len() == 1 {
                for &at in &pixels {
                    dot(sheet, at, curve.look)?;
                }
            }
        }
        Ok(())
    }
}

fn colour(look: Look) -> RGBColor {
    match look {
        Look::End => BLUE,
        Look::Start => VERMILLION,
    }
}

fn stroke_curve(sheet: &Sheet<'_>, points: &[(f64, f64)], look: Look) -> Result<(), Failure> {
    match look {
        Look::End => line(sheet, points, colour(look), 2.25),
        Look::Start => {
            let points: Vec<_> = points.iter().map(|&at| fine(at)).collect();
            let style = stroke(colour(look), 2.25);
            let (dash, gap) = (7 * FINE as i32, 5 * FINE as i32);
            sheet.draw(&DashedPathElement::new(points, dash, gap, style))
        }
    }
}

pub(super) fn dot(sheet: &Sheet<'_>, at: (f64, f64), look: Look) -> Result<(), Failure> {
    let radius = 3.5 * f64::from(FINE);
    match look {
        Look::End => sheet.draw(&Circle::new(fine(at), radius as u32, ShapeStyle::from(colour(look)).filled())),
        Look::Start => {
            let paper = ShapeStyle::from(RGBColor(255, 255, 255)).filled();
            sheet.draw(&Circle::new(fine(at), radius as u32, paper))?;
            sheet.draw(&Circle::new(fine(at), radius as u32, stroke(colour(look), 1.75)))
        }
    }
}

pub(super) fn line(sheet: &Sheet<'_>, points: &[(f64, f64)], colour: RGBColor, width: f64) -> Result<(), Failure> {
    let points: Vec<_> = points.iter().map(|&at| fine(at)).collect();
    sheet.draw(&PathElement::new(points, stroke(colour, width)))
}

pub(super) fn stroke(colour: RGBColor, width: f64) -> ShapeStyle {
    ShapeStyle::from(colour).stroke_width((width * f64::from(FINE)).round() as u32)
}

/// Fills the whole figure.
pub(super) fn paper(sheet: &Sheet<'_>, (width, height): (f64, f64)) -> Result<(), Failure> {
    let white = ShapeStyle::from(RGBColor(255, 255, 255)).filled();
    sheet.draw(&Rectangle::new([fine((0.0, 0.0)), fine((width, height))], white))
}

/// How a piece of text is set: size in pixels, colour, weight, and which end stands at its place.
#[derive(Clone, Copy)]
pub(super) struct Style {
    size: f64,
    colour: RGBColor,
    bold: bool,
    anchor: HPos,
}

impl Style {
    pub fn left(size: f64, colour: RGBColor) -> Self {
        Self { size, colour, bold: false, anchor: HPos::Left }
    }

    pub fn title(size: f64) -> Self {
        Self { bold: true, ..Self::left(size, INK) }
    }

    pub fn right(size: f64) -> Self {
        Self { anchor: HPos::Right, ..Self::left(size, QUIET) }
    }

    pub fn centred(size: f64, colour: RGBColor) -> Self {
        Self { anchor: HPos::Center, ..Self::left(size, colour) }
    }
}

/// Writes text, centred in height on its place.
pub(super) fn write(sheet: &Sheet<'_>, text: &str, at: (f64, f64), style: Style) -> Result<(), Failure> {
    // The drawing library divides sizes by 1.24 on their way into the file.
    let size = style.size * f64::from(FINE) * 1.24;
    let weight = if style.bold { FontStyle::Bold } else { FontStyle::Normal };
    let font = TextStyle::from((FONT, size, weight).into_font())
        .color(&style.colour)
        .pos(Pos::new(style.anchor, VPos::Center));
    sheet.draw(&Text::new(text.to_owned(), fine(at), font))
}
