//! Which exact answer a scene asks for, with its numbers, or why it has none.

use super::super::run::Coupled;
use super::{loading, published, springs};
use crate::contact::Control;
use crate::contact::surface::Shape;
use crate::plan::{Elastic, Plan};
use crate::reference::foundation::parabola::WornParabola;
use crate::reference::hertz::Hertz;
use crate::reference::modes::WavyWear;
use crate::reference::scar;
use crate::reference::stick::StickLimit;
use crate::reference::{Indenter, NamedReference, QuantityError};
use crate::scene::{Basis, Mode};

/// An answer with everything but the wear that has been done.
#[derive(Clone, Debug)]
pub(in crate::solve::coupled) enum Asked {
    /// The contact before any wear, which stays.
    Hertz(Hertz),
    /// A growing scar.
    Scar(Hertz, Rate),
    /// A worn parabola on springs.
    Parabola { indenter: Indenter, radius: f64, stiffness: f64, load: f64, rate: Rate },
    /// Springs, cell by cell, under any loading.
    Springs { stiffness: f64, rate: Rate },
    /// Springs held at an approach, for any exponent of the pressure.
    Point { stiffness: f64, approach: f64, rate: Rate, exponent: f64 },
    /// A wave.
    Wave { amplitude: f64, waves: [f64; 2], size: [f64; 2], modulus: f64, load: f64, rate: Rate },
    /// The limit around a stick zone.
    Stick(StickLimit),
    /// Published depths of a whole case.
    Published,
}

/// Archard's c = (K/H) |v|^n: K/H and n.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::solve::coupled) struct Rate {
    pub(super) per_slid: f64,
    pub(super) exponent: f64,
}

impl Rate {
    /// Integral of c over time until a represented time.
    pub(super) fn dose(&self, plan: &Plan, until: f64) -> f64 {
        self.per_slid * loading::slid(plan, until, self.exponent)
    }
}

/// Why an answer does not cover a scene.
pub(super) type Reason = String;

impl Coupled<'_> {
    /// Resolves an answer for this scene.
    ///
    /// # Errors
    /// What the answer does not cover.
    pub(in crate::solve::coupled) fn ask(&self, named: NamedReference) -> Result<Asked, Reason> {
        let asked = match named {
            NamedReference::ArchardPrescribed => {
                return Err("it is for `contact.model` = \"prescribed\", this contact is solved".to_owned());
            }
            NamedReference::Hertz => self.ask_hertz()?,
            NamedReference::HertzScar => {
                let rate = self.linear()?;
                self.slides_alike()?;
                Asked::Scar(self.first_contact()?, rate)
            }
            NamedReference::WinklerParabola => {
                let rate = self.linear()?;
                self.slides_alike()?;
                let (indenter, radius) = self.indenter()?;
                Asked::Parabola { indenter, radius, stiffness: self.springs()?, load: self.load()?, rate }
            }
            NamedReference::WinklerDiscrete => Asked::Springs { stiffness: self.springs()?, rate: self.linear()? },
            NamedReference::WinklerPoint => {
                let (rate, exponent) = self.archard()?;
                let Control::Approach(approach) = self.pressing()? else {
                    return Err("the contact is under a load, expected an approach".to_owned());
                };
                if exponent < 0.0 {
                    return Err(format!("the pressure exponent is {exponent}, expected 0 or more"));
                }
                Asked::Point { stiffness: self.springs()?, approach, rate, exponent }
            }
            NamedReference::ModeDecay => self.ask_wave()?,
            NamedReference::StickLimit => Asked::Stick(self.ask_stick()?),
            NamedReference::McCollFretting => {
                let rate = self.linear()?;
                self.slides_alike()?;
                published::check(self, rate)?;
                Asked::Published
            }
        };
        self.check(&asked)?;
        Ok(asked)
    }

    /// Checks that the functions take the numbers of the whole loading.
    fn check(&self, asked: &Asked) -> Result<(), Reason> {
        let end = loading::end(self.plan);
        match asked {
            Asked::Scar(start, rate) => {
                let tau = scar::worn_part(start, rate.dose(self.plan, end));
                if tau > scar::LARGEST_TAU {
                    return Err(format!("at the end tau is {tau:e}, expected at most {:e}", scar::LARGEST_TAU));
                }
            }
            Asked::Parabola { indenter, radius, stiffness, load, rate } => {
                WornParabola::new(*indenter, *radius, *stiffness, *load, rate.dose(self.plan, end)).map_err(number)?;
            }
            Asked::Wave { amplitude, waves, size, modulus, load, rate } => {
                let mean = load / (size[0] * size[1]);
                let dose = rate.dose(self.plan, end);
                WavyWear::new(*amplitude, *waves, *size, *modulus, mean, dose).map_err(number)?;
            }
            Asked::Springs { stiffness, rate } => springs::check(self, *stiffness, *rate)?,
            Asked::Hertz(_) | Asked::Point { .. } | Asked::Stick(_) | Asked::Published => {}
        }
        Ok(())
    }

    fn ask_hertz(&self) -> Result<Asked, Reason> {
        if self.plan.material.mode != Mode::Post {
            let (rate, _) = self.archard()?;
            if rate.dose(self.plan, loading::end(self.plan)) > 0.0 {
                return Err("the surface wears away, expected `law.mode` = \"post\" or nothing that wears".to_owned());
            }
        }
        Ok(Asked::Hertz(self.first_contact()?))
    }

    fn ask_wave(&self) -> Result<Asked, Reason> {
        let rate = self.linear()?;
        self.slides_alike()?;
        let Elastic::HalfSpace { modulus, periodic: true, .. } = self.solved.elastic else {
            return Err("the contact is no periodic half-space".to_owned());
        };
        let Shape::Wavy { amplitude, waves } = self.solved.surface.shape else {
            return Err("the surface is not wavy".to_owned());
        };
        let cells = self.solved.cells;
        let waves = [waves[0] as f64, if cells.dimension == 2 { 0.0 } else { waves[1] as f64 }];
        let size = [0, 1].map(|axis| cells.counts[axis] as f64 * cells.spacing[axis]);
        Ok(Asked::Wave { amplitude, waves, size, modulus, load: self.load()?, rate })
    }

    fn ask_stick(&self) -> Result<StickLimit, Reason> {
        let (rate, _) = self.archard()?;
        let (indenter, radius) = self.indenter()?;
        let (modulus, datum) = self.half_space()?;
        let mut radii = loading::all_steps(self.plan).map(|step| step.stick.unwrap_or(0.0));
        let stick = radii.next().unwrap_or(0.0);
        if stick == 0.0 || radii.any(|other| other != stick) {
            return Err("not every load step has the same `stick`, above 0".to_owned());
        }
        if loading::all_steps(self.plan).any(|step| step.velocity_file.is_some()) {
            return Err("a velocity differs from cell to cell beyond the stick zone".to_owned());
        }
        if rate.dose(self.plan, loading::end(self.plan)) == 0.0 {
            return Err("nothing wears".to_owned());
        }
        let limit = match (self.pressing()?, indenter, datum) {
            (Control::Load(load), _, _) => StickLimit::under_load(indenter, radius, modulus, load, stick),
            (Control::Approach(approach), Indenter::Sphere, _) => {
                StickLimit::sphere_at_approach(radius, modulus, approach, stick)
            }
            (Control::Approach(approach), Indenter::Line, datum) => {
                StickLimit::line_at_approach(radius, modulus, approach, stick, datum.unwrap_or_default())
            }
        };
        limit.map_err(number)
    }

    /// Hertz contact under the load of the scene, or for a sphere at its approach.
    fn first_contact(&self) -> Result<Hertz, Reason> {
        let (indenter, radius) = self.indenter()?;
        let (modulus, _) = self.half_space()?;
        let hertz = match (self.pressing()?, indenter) {
            (Control::Load(load), _) => Hertz::new(indenter, radius, modulus, load),
            (Control::Approach(approach), Indenter::Sphere) if self.plan.material.mode == Mode::Post => {
                Hertz::at_approach(radius, modulus, approach)
            }
            (Control::Approach(_), _) => return Err("an approach is given, expected a load".to_owned()),
        };
        hertz.map_err(number)
    }

    /// Archard's rate and pressure exponent, where it alone says what wears where.
    fn archard(&self) -> Result<(Rate, f64), Reason> {
        let material = &self.plan.material;
        let constants = &material.constants;
        let reason = if self.evaluator.descriptor().name != "archard" {
            "the law is not `archard`"
        } else if constants.varies_in_time() || constants.varies_in_temperature() {
            "the constants change with time or temperature"
        } else if material.mode == Mode::Post {
            "wear is for postprocessing only"
        } else if material.average {
            "increments are averaged over the contact area"
        } else if material.basis == Basis::NodalStress {
            "wear is based on nodal stresses"
        } else if material.direction.is_some() {
            "the wear direction is not the default"
        } else {
            let [wear, hardness, pressure, velocity] = [0, 1, 2, 3].map(|c| constants.value(c, 0.0, 0.0));
            return Ok((Rate { per_slid: wear / hardness, exponent: velocity }, pressure));
        };
        Err(reason.to_owned())
    }

    /// The rate of a law that is proportional to the pressure.
    fn linear(&self) -> Result<Rate, Reason> {
        match self.archard()? {
            (rate, 1.0) => Ok(rate),
            (_, exponent) => Err(format!("the pressure exponent is {exponent}, expected 1")),
        }
    }

    fn slides_alike(&self) -> Result<(), Reason> {
        let alike =
            |step: &crate::plan::LoadStep| step.velocity_file.is_none() && step.stick.is_none_or(|stick| stick == 0.0);
        match loading::all_steps(self.plan).all(alike) {
            true => Ok(()),
            false => Err("the velocity differs from cell to cell".to_owned()),
        }
    }

    /// What presses, the same throughout.
    fn pressing(&self) -> Result<Control, Reason> {
        let mut all = loading::all_steps(self.plan).map(|step| match (step.load, step.approach) {
            (Some(load), _) if load.from == load.to => Some(Control::Load(load.to)),
            (None, Some(approach)) if approach.from == approach.to => Some(Control::Approach(approach.to)),
            _ => None,
        });
        let first = all.next().flatten();
        match first {
            Some(control) if all.all(|other| other == first) => Ok(control),
            _ => Err("load or approach is not the same throughout".to_owned()),
        }
    }

    pub(super) fn load(&self) -> Result<f64, Reason> {
        match self.pressing()? {
            Control::Load(load) => Ok(load),
            Control::Approach(_) => Err("an approach is given, expected a load".to_owned()),
        }
    }

    fn springs(&self) -> Result<f64, Reason> {
        match self.solved.elastic {
            Elastic::Foundation(stiffness) => Ok(stiffness),
            Elastic::HalfSpace { .. } => Err("the contact is a half-space, expected a foundation".to_owned()),
        }
    }

    /// Modulus and datum of a free half-space.
    pub(super) fn half_space(&self) -> Result<(f64, Option<f64>), Reason> {
        match self.solved.elastic {
            Elastic::HalfSpace { modulus, periodic: false, datum } => Ok((modulus, datum)),
            _ => Err("the contact is no half-space with a free boundary".to_owned()),
        }
    }

    /// The parabolic body and its radius.
    pub(super) fn indenter(&self) -> Result<(Indenter, f64), Reason> {
        match (&self.solved.surface.shape, self.solved.cells.dimension) {
            (Shape::Sphere { radius } | Shape::Cylinder { radius }, 2) => Ok((Indenter::Line, *radius)),
            (Shape::Sphere { radius }, _) => Ok((Indenter::Sphere, *radius)),
            _ => Err("the surface is neither a sphere in 3-D nor a cylinder in 2-D".to_owned()),
        }
    }
}

pub(super) fn number(error: QuantityError) -> Reason {
    error.to_string()
}
