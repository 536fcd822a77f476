//! What an exact answer says of the cells of a scene at a time.

use super::super::run::Coupled;
use super::asked::{Asked, Reason, number};
use super::published::{self, Published};
use super::{loading, springs};
use crate::contact::surface::Shape;
use crate::reference::PointAnswer;
use crate::reference::foundation::parabola::WornParabola;
use crate::reference::foundation::point::SpringPoint;
use crate::reference::modes::WavyWear;
use crate::reference::scar::Scar;

/// An answer on the cells.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::solve::coupled) struct Answer {
    /// Wear depth `[cells]`; what an answer says at their centres.
    pub(in crate::solve::coupled) wear: Vec<f64>,
    /// Contact pressure `[cells]`.
    pub(in crate::solve::coupled) pressure: Vec<f64>,
    /// Worn volume, where it is known better than by the cells.
    pub(in crate::solve::coupled) volume: Option<f64>,
    /// Radius or half-width of the contact, where there is one.
    pub(in crate::solve::coupled) contact_radius: Option<f64>,
    /// Load, where an approach is given.
    pub(in crate::solve::coupled) load: Option<f64>,
    /// The cell at the apex, where the surface has one.
    pub(in crate::solve::coupled) center: Option<usize>,
}

impl Coupled<'_> {
    /// What an answer says of the cells at a represented time.
    ///
    /// # Errors
    /// Numbers for which the answer has no value.
    pub(in crate::solve::coupled) fn answer(&self, asked: &Asked, until: f64) -> Result<Answer, Reason> {
        let radii = self.radii()?;
        let on = |at: &dyn Fn(f64) -> PointAnswer| Answer::of(radii.iter().map(|radius| at(*radius)));
        let mut answer = match asked {
            Asked::Hertz(hertz) => {
                Answer { contact_radius: Some(hertz.contact_radius), ..on(&|radius| hertz.at(radius)) }
            }
            Asked::Scar(start, rate) => {
                let scar =
                    Scar::new(start.indenter, start.radius, start.modulus, start.load, rate.dose(self.plan, until));
                let scar = scar.map_err(number)?;
                Answer {
                    contact_radius: Some(scar.contact_radius),
                    volume: Some(scar.worn_volume),
                    ..on(&|radius| scar.at(radius))
                }
            }
            Asked::Parabola { indenter, radius, stiffness, load, rate } => {
                let dose = rate.dose(self.plan, until);
                let worn = WornParabola::new(*indenter, *radius, *stiffness, *load, dose).map_err(number)?;
                Answer {
                    contact_radius: Some(worn.contact_radius),
                    volume: Some(dose * load),
                    ..on(&|radius| worn.at(radius))
                }
            }
            Asked::Springs { stiffness, rate } => {
                let [wear, pressure] = springs::answer(self, *stiffness, *rate, until)?;
                Answer { wear, pressure, ..Answer::default() }
            }
            Asked::Point { .. } => self.points_alone(asked, until)?,
            Asked::Wave { amplitude, waves, size, modulus, load, rate } => {
                let dose = rate.dose(self.plan, until);
                let mean = load / (size[0] * size[1]);
                let wave = WavyWear::new(*amplitude, *waves, *size, *modulus, mean, dose).map_err(number)?;
                Answer { volume: Some(dose * load), ..Answer::of(self.offsets().map(|offset| wave.at(offset))) }
            }
            Asked::Stick(limit) => {
                // The run lets slip what does not lie within the radius; the pressure on the radius itself is infinite.
                let at = |radius: f64| match radius < limit.stick_radius {
                    true => limit.at(radius),
                    false => PointAnswer { pressure: 0.0, ..limit.at(radius.max(limit.stick_radius.next_up())) },
                };
                Answer { contact_radius: Some(limit.contact_radius), load: Some(limit.load), ..on(&at) }
            }
            Asked::Published => Answer::default(),
        };
        if !matches!(self.solved.surface.shape, Shape::Rough { .. } | Shape::File { .. }) {
            let all = radii.iter().enumerate();
            answer.center = all.min_by(|a, b| a.1.total_cmp(b.1)).map(|(cell, _)| cell);
        }
        Ok(answer)
    }

    /// What was published after so many cycles.
    ///
    /// # Errors
    /// Cycles of which nothing was.
    pub(in crate::solve::coupled) fn published(&self, cycles: f64) -> Result<Published, Reason> {
        published::answer(self, cycles)
    }

    /// Springs that are held, each by itself.
    fn points_alone(&self, asked: &Asked, until: f64) -> Result<Answer, Reason> {
        let Asked::Point { stiffness, approach, rate, exponent } = *asked else { return Ok(Answer::default()) };
        let mut slid = vec![0.0; self.points()];
        let mut failed = None;
        loading::walk(self.plan, until, true, |visit| match springs::slides(self, visit.step, rate.exponent) {
            Ok(slides) => {
                let whole = visit.slid(rate.exponent);
                let of = |cell: usize| slides.get(cell).or(slides.first()).copied().unwrap_or(0.0);
                slid.iter_mut().enumerate().for_each(|(cell, slid)| *slid += whole * of(cell));
            }
            Err(reason) => failed = Some(reason),
        });
        if let Some(reason) = failed {
            return Err(reason);
        }
        let points = self.gap.iter().zip(&slid).map(|(gap, slid)| {
            let pressure = stiffness * (approach - gap);
            if pressure.is_nan() || pressure <= 0.0 {
                return Ok(PointAnswer::default());
            }
            SpringPoint::new(stiffness, pressure, rate.per_slid, exponent).and_then(|spring| spring.at(*slid))
        });
        Ok(Answer::of(points.collect::<Result<Vec<_>, _>>().map_err(number)?))
    }

    /// Distances of the cells from the apex.
    fn radii(&self) -> Result<Vec<f64>, Reason> {
        let surface = &self.solved.surface;
        surface.distances(&self.solved.cells, self.solved.is_periodic()).map_err(|error| error.to_string())
    }

    /// Places of the cells counted from the apex.
    fn offsets(&self) -> impl Iterator<Item = [f64; 2]> {
        let (cells, center) = (self.solved.cells, self.solved.surface.center);
        (0..cells.count()).map(move |cell| {
            let index = [cell % cells.counts[0], cell / cells.counts[0]];
            [0, 1].map(|axis| match center {
                _ if axis == 1 && cells.dimension == 2 => 0.0,
                Some(center) => (index[axis] as f64 + 0.5) * cells.spacing[axis] - center[axis],
                None => (index[axis] as f64 - (cells.counts[axis] / 2) as f64) * cells.spacing[axis],
            })
        })
    }
}

impl Answer {
    fn of(points: impl IntoIterator<Item = PointAnswer>) -> Answer {
        let (wear, pressure) = points.into_iter().map(|point| (point.wear_depth, point.pressure)).unzip();
        Answer { wear, pressure, ..Answer::default() }
    }
}
