//! Any springs under one rigid body, worn by dw/dt = c v p: the cells of a foundation, to about 1e-13.
//!
//! With p_i = k (D - g_i - w_i) on the cells in contact, D being the approach, dp_i/dt = k (dD/dt - c_i v p_i), which is
//! linear while the contact set stays. Under a load P(t) the sum over the n cells in contact gives
//! dD/dt = (1/n) sum c_i v p_i + (dP/dt) / (n k A); under an approach dD/dt is given. The equations are followed by their
//! Taylor series in time, whose coefficients come from one another: over steps of at most 1/(k c v) the 24th term is below
//! 1e-24. At the end of a step, and at seven times within, cells out of contact that would overlap and cells in contact
//! that would pull are looked for; the first such time is found by halving on the series, the cell changes sides there,
//! and the next step starts. So no error of a time step is left, and the answer is that of the discrete problem itself.

use super::super::answer::{QuantityError, not_negative, positive};

/// The cells and what they are made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Springs {
    /// Initial gap of each cell `[cells]`; infinite where it never touches.
    pub gap: Vec<f64>,
    /// Pressure per length k.
    pub stiffness: f64,
    /// Area of a cell A; length in 2-D.
    pub area: f64,
    /// Wear per pressure and sliding distance c of each cell `[cells]`, or one for all.
    pub rate: Vec<f64>,
}

/// What presses the body, at the start and at the end of a stretch; linear in between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pressing {
    /// Load; per length in 2-D.
    Load([f64; 2]),
    /// Approach.
    Approach([f64; 2]),
}

/// A stretch of time with one sliding speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// How long it lasts.
    pub duration: f64,
    /// Sliding speed v.
    pub speed: f64,
    /// What presses.
    pub pressing: Pressing,
}

/// The springs at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringsAnswer {
    /// Time since the first stretch began.
    pub time: f64,
    /// Approach; the smallest gap where nothing presses.
    pub approach: f64,
    /// Contact pressure `[cells]`.
    pub pressure: Vec<f64>,
    /// Wear depth `[cells]`.
    pub wear_depth: Vec<f64>,
}

/// Why springs have no answer.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SpringsError {
    /// A number.
    #[error(transparent)]
    Quantity(#[from] QuantityError),
    /// Rates of neither one nor all cells.
    #[error("found {found} wear rates for {cells} cells, expected one, or one for each")]
    Rates {
        /// How many there are.
        found: usize,
        /// Number of cells.
        cells: usize,
    },
    /// A load and no cell that could carry it.
    #[error("found a load of {load:e} and no cell with a finite gap, expected at least one")]
    NowhereToTouch {
        /// The load.
        load: f64,
    },
    /// Wear so stiff that following it would take too long.
    #[error("k c v times the duration is {found:e}, expected at most 1e5")]
    TooStiff {
        /// The product.
        found: f64,
    },
}

/// Terms of the series beyond the constant one.
const TERMS: usize = 24;
/// Times within a step at which the contact is looked at.
const LOOKS: usize = 8;

/// The springs at each of `times`, which increase and lie within the stretches; the first load is put on at once.
///
/// # Errors
/// Numbers out of their bounds, rates of another number than the cells, a load with nothing to carry it, or wear that is
/// too fast to be followed.
pub fn follow(springs: &Springs, stretches: &[Stretch], times: &[f64]) -> Result<Vec<SpringsAnswer>, SpringsError> {
    check(springs, stretches)?;
    let mut state = State::new(springs);
    let mut answers = Vec::with_capacity(times.len());
    let mut wanted = times.iter().copied().peekable();
    let mut start = 0.0;
    for (index, stretch) in stretches.iter().enumerate() {
        state.press(stretch.pressing);
        let mut done = 0.0;
        loop {
            let last = index + 1 == stretches.len();
            let next = wanted.next_if(|time| *time < start + stretch.duration || last);
            let until = next.map_or(stretch.duration, |time| (time - start).clamp(done, stretch.duration));
            state.advance(stretch, done, until);
            done = until;
            match next {
                Some(time) => answers.push(state.answer(time)),
                None => break,
            }
        }
        start += stretch.duration;
    }
    Ok(answers)
}

fn check(springs: &Springs, stretches: &[Stretch]) -> Result<(), SpringsError> {
    positive("the stiffness", springs.stiffness)?;
    positive("the area of a cell", springs.area)?;
    let (found, cells) = (springs.rate.len(), springs.gap.len());
    if found != 1 && found != cells {
        return Err(SpringsError::Rates { found, cells });
    }
    for rate in &springs.rate {
        not_negative("a wear rate", *rate)?;
    }
    if let Some(gap) = springs.gap.iter().find(|gap| gap.is_nan() || **gap == f64::NEG_INFINITY) {
        let name = "an initial gap";
        return Err(QuantityError { name, found: *gap, expected: "a finite number, or infinity" }.into());
    }
    let fastest = springs.rate.iter().copied().fold(0.0, f64::max);
    for stretch in stretches {
        not_negative("a duration", stretch.duration)?;
        not_negative("a sliding speed", stretch.speed)?;
        if let Pressing::Load(loads) = stretch.pressing {
            for load in loads {
                not_negative("a load", load)?;
                if load > 0.0 && !springs.gap.iter().any(|gap| gap.is_finite()) {
                    return Err(SpringsError::NowhereToTouch { load });
                }
            }
        }
        let found = springs.stiffness * fastest * stretch.speed * stretch.duration;
        if found.is_nan() || found > 1e5 {
            return Err(SpringsError::TooStiff { found });
        }
    }
    Ok(())
}

/// The springs on the way, and the series of the step at hand.
struct State<'a> {
    springs: &'a Springs,
    approach: f64,
    wear: Vec<f64>,
    pressure: Vec<f64>,
    /// Cells in contact.
    inside: Vec<usize>,
    /// All others with a finite gap, the lowest last; a gap stays while its cell is out of contact.
    outside: Vec<usize>,
    /// Coefficients of the pressures of the cells in contact, in powers of time over step.
    pressures: Vec<Series>,
    approaches: Series,
}

/// Coefficients in powers of time over step.
type Series = [f64; TERMS + 1];

/// What ends a step early.
enum Event {
    /// The cells in contact of these numbers begin to pull.
    Leave(Vec<usize>),
    /// So many of the lowest cells out of contact are touched.
    Join(usize),
}

impl<'a> State<'a> {
    fn new(springs: &'a Springs) -> State<'a> {
        let cells = springs.gap.len();
        State {
            springs,
            approach: 0.0,
            wear: vec![0.0; cells],
            pressure: vec![0.0; cells],
            inside: Vec::new(),
            outside: Vec::new(),
            pressures: Vec::new(),
            approaches: [0.0; TERMS + 1],
        }
    }

    fn rate(&self, cell: usize) -> f64 {
        if self.springs.rate.len() == 1 { self.springs.rate[0] } else { self.springs.rate[cell] }
    }

    fn gap(&self, cell: usize) -> f64 {
        self.springs.gap[cell] + self.wear[cell]
    }

    /// Solves the elastic contact at the start of a stretch: the lowest cells carry a load, one more at a time.
    fn press(&mut self, pressing: Pressing) {
        let mut cells: Vec<usize> = (0..self.wear.len()).filter(|cell| self.springs.gap[*cell].is_finite()).collect();
        cells.sort_by(|a, b| self.gap(*b).total_cmp(&self.gap(*a)));
        let lowest = cells.last().map_or(f64::INFINITY, |cell| self.gap(*cell));
        self.approach = match pressing {
            Pressing::Approach([start, _]) => start,
            Pressing::Load([start, _]) => {
                let wanted = start / (self.springs.area * self.springs.stiffness);
                // Relative to the lowest gap, so that an offset of all costs no digits.
                let (mut sum, mut count, mut approach) = (0.0, 0.0, lowest);
                for gap in cells.iter().rev().map(|cell| self.gap(*cell)) {
                    if count > 0.0 && approach <= gap {
                        break;
                    }
                    (sum, count) = (sum + (gap - lowest), count + 1.0);
                    approach = lowest + (wanted + sum) / count;
                }
                approach
            }
        };
        // A rising load finds the lowest cells touching already.
        let rising = matches!(pressing, Pressing::Load([start, end]) if end > start);
        self.pressure.fill(0.0);
        let touches = |cell: &usize| self.approach > self.gap(*cell) || (rising && self.approach == self.gap(*cell));
        let first = cells.partition_point(|cell| !touches(cell));
        self.inside = cells.split_off(first);
        self.outside = cells;
        for cell in &self.inside {
            self.pressure[*cell] =
                self.springs.stiffness * (self.approach - self.springs.gap[*cell] - self.wear[*cell]);
        }
    }

    /// Follows a stretch from one of its times to another.
    fn advance(&mut self, stretch: &Stretch, from: f64, until: f64) {
        let fastest = self.springs.rate.iter().copied().fold(0.0, f64::max) * stretch.speed;
        let longest = if fastest > 0.0 { 1.0 / (self.springs.stiffness * fastest) } else { f64::INFINITY };
        let mut now = from;
        while now < until {
            let step = longest.min(until - now);
            self.expand(stretch, step);
            let event = self.first_event();
            let part = event.as_ref().map_or(1.0, |(part, _)| *part);
            self.move_on(stretch.speed * step, part);
            now = if part == 1.0 && step == until - now { until } else { now + part * step };
            match event {
                Some((_, Event::Join(count))) => {
                    let joining = self.outside.split_off(self.outside.len() - count);
                    self.inside.extend(joining);
                }
                Some((_, Event::Leave(places))) => {
                    for place in places.into_iter().rev() {
                        let cell = self.inside.remove(place);
                        self.pressure[cell] = 0.0;
                        let gap = self.gap(cell);
                        let place = self.outside.partition_point(|other| self.gap(*other) > gap);
                        self.outside.insert(place, cell);
                    }
                }
                None => {}
            }
        }
    }

    /// The series of a step: coefficient j + 1 from coefficient j.
    fn expand(&mut self, stretch: &Stretch, step: f64) {
        let Springs { stiffness: k, area, .. } = *self.springs;
        let count = self.inside.len() as f64;
        let by_load = matches!(stretch.pressing, Pressing::Load(_)) && count > 0.0;
        let change = match stretch.pressing {
            Pressing::Load([start, end]) if by_load => (end - start) / stretch.duration * step / (count * k * area),
            Pressing::Load(_) => 0.0,
            Pressing::Approach([start, end]) => (end - start) / stretch.duration * step,
        };
        self.approaches = [0.0; TERMS + 1];
        self.approaches[0] = self.approach;
        let start = |cell: &usize| {
            let mut series = [0.0; TERMS + 1];
            series[0] = self.pressure[*cell];
            series
        };
        let mut pressures: Vec<Series> = self.inside.iter().map(start).collect();
        let worn: Vec<f64> = self.inside.iter().map(|cell| self.rate(*cell) * stretch.speed * step).collect();
        for j in 0..TERMS {
            let mut slope = if j == 0 { change } else { 0.0 };
            if by_load {
                slope += pressures.iter().zip(&worn).map(|(series, worn)| worn * series[j]).sum::<f64>() / count;
            }
            let next = 1.0 / (j + 1) as f64;
            for (series, worn) in pressures.iter_mut().zip(&worn) {
                series[j + 1] = k * (slope - worn * series[j]) * next;
            }
            self.approaches[j + 1] = slope * next;
        }
        self.pressures = pressures;
    }

    /// Whether a cell out of contact would overlap at a part of the step. Its gap is compared with how far the approach has
    /// moved: a cell that has just left lies on the approach to rounding.
    fn overlaps(&self, cell: usize, part: f64) -> bool {
        (self.gap(cell) - self.approach).max(0.0) < value(&self.approaches, part) - self.approach
    }

    /// The part of the step until the first cells change sides, and what they do.
    fn first_event(&self) -> Option<(f64, Event)> {
        for look in 1..=LOOKS {
            let (before, part) = ((look - 1) as f64 / LOOKS as f64, look as f64 / LOOKS as f64);
            let pulls = |series: &Series, part: f64| value(series, part) < 0.0;
            let leaving = self.pressures.iter().enumerate().filter(|(_, series)| pulls(series, part));
            let leaving = leaving.map(|(place, series)| (crossing(before, part, |part| pulls(series, part)), place));
            let leaving: Vec<(f64, usize)> = leaving.collect();
            let leave = leaving.iter().fold(f64::INFINITY, |first, (at, _)| first.min(*at));
            let lowest = self.outside.last().filter(|cell| self.overlaps(**cell, part));
            let join = lowest.map(|cell| crossing(before, part, |part| self.overlaps(*cell, part)));
            match join {
                Some(join) if join <= leave => {
                    let lowest = self.outside.last().map_or(f64::INFINITY, |cell| self.gap(*cell));
                    let count = self.outside.iter().rev().take_while(|cell| self.gap(**cell) == lowest).count();
                    return Some((join, Event::Join(count)));
                }
                _ if leave.is_finite() => {
                    let places = leaving.iter().filter(|(at, _)| *at == leave).map(|(_, place)| *place);
                    return Some((leave, Event::Leave(places.collect())));
                }
                _ => {}
            }
        }
        None
    }

    /// Takes the series at a part of the step; `slid` is the sliding distance of the whole step.
    fn move_on(&mut self, slid: f64, part: f64) {
        self.approach = value(&self.approaches, part);
        for place in 0..self.inside.len() {
            let (cell, series) = (self.inside[place], &self.pressures[place]);
            let terms = series.iter().enumerate().rev();
            let integral = terms.fold(0.0, |sum, (j, term)| sum * part + term / (j + 1) as f64) * part;
            self.wear[cell] += self.rate(cell) * slid * integral;
            self.pressure[cell] = value(series, part).max(0.0);
        }
    }

    fn answer(&self, time: f64) -> SpringsAnswer {
        SpringsAnswer { time, approach: self.approach, pressure: self.pressure.clone(), wear_depth: self.wear.clone() }
    }
}

/// The last part of the step, between two of them, before something is wrong.
fn crossing(mut low: f64, mut high: f64, wrong: impl Fn(f64) -> bool) -> f64 {
    while f64::midpoint(low, high) > low && f64::midpoint(low, high) < high {
        let middle = f64::midpoint(low, high);
        if wrong(middle) { high = middle } else { low = middle }
    }
    low
}

fn value(series: &Series, part: f64) -> f64 {
    series.iter().rev().fold(0.0, |sum, term| sum * part + term)
}

#[cfg(test)]
#[path = "discrete_tests.rs"]
mod tests;
