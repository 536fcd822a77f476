//! Which lines a study has: a method each, with cases from cheap to dear.

use super::asked::{Asked, Part, name};
use super::error::StudyError;
use crate::record::{Kind, Limit};
use crate::scene::{Method, Model, ScalingKind, Scene, Shape};

/// The integrators, in the order of their lines.
const METHODS: [Method; 4] = [Method::ExplicitEuler, Method::ImplicitEuler, Method::TrBdf2, Method::Sdirk2];
/// Most substeps that a line goes up to by itself.
const MOST: u32 = 24;
/// Explicit lines begin so many halvings below the fewest stable substeps.
const BELOW: i32 = 6;
/// Substeps that AUTS stretches; many, so that the first, which is as long as it is, weighs nothing.
const UNSCALED: u64 = 10_000;
/// The line of explicit steps as long as they may be.
pub(super) const AT_LIMIT: &str = "explicit-euler at its limit";
/// Fewest cells along a side of a grid that is varied by itself.
const FEWEST_CELLS: usize = 8;

/// One way of running the scene, before it is run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Planned {
    pub(super) value: f64,
    /// Roughly how many steps it takes; 1 where nothing is known.
    pub(super) steps: f64,
    pub(super) overrides: Vec<String>,
    /// Whether the verdict needs it: time is kept for it.
    pub(super) needed: bool,
}

/// A line before it is run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Line {
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) method: &'static str,
    pub(super) isolated: bool,
    pub(super) cases: Vec<Planned>,
    /// Whether the user gave the values: then none is left out because it says nothing new.
    pub(super) given: bool,
    /// Something to know about its cases.
    pub(super) note: Option<&'static str>,
}

/// What lines depend on.
pub(super) struct Ground<'a> {
    pub(super) scene: &'a Scene,
    pub(super) asked: &'a Asked,
    pub(super) limit: Option<Limit>,
    /// Whether there is a law in a process of its own beside the other.
    pub(super) elsewhere: bool,
}

impl Ground<'_> {
    fn is_prescribed(&self) -> bool {
        matches!(self.scene.contact.model, Model::Prescribed(_))
    }

    fn scaling(&self) -> ScalingKind {
        self.scene.scaling.kind.unwrap_or_default()
    }

    /// Overrides that all cases have which are not scaled themselves: AUTS knows no tolerance and is a line of its own.
    fn unscaled(&self) -> Vec<String> {
        let mut texts = vec!["output.fields=[]".to_owned()];
        if self.scaling() == ScalingKind::Auto {
            texts.push("scaling.kind=none".to_owned());
        }
        texts
    }

    /// Overrides that run the scene by a method.
    pub(super) fn method(&self, method: Method) -> Vec<String> {
        let mut texts = self.unscaled();
        texts.push(format!("integrator.method={}", name(method)));
        texts
    }

    /// Refuses what the user asks for by name and the scene does not have.
    ///
    /// # Errors
    /// [`StudyError::NotThere`].
    pub(super) fn check(&self) -> Result<(), StudyError> {
        let asked = self.asked;
        let by_name = |part: Part| asked.parts.contains(&part);
        let refuse = |found: &str, reason: &str| {
            Err(StudyError::NotThere { found: found.to_owned(), reason: reason.to_owned() })
        };
        if let Err(reason) = self.grids_apart()
            && (!asked.grids.is_empty() || by_name(Part::Grids))
        {
            return refuse("grids to be varied", reason);
        }
        if let Err(reason) = self.scaled_kind()
            && (!asked.safety.is_empty() || by_name(Part::Scaling))
        {
            return refuse("scaling to be varied", reason);
        }
        Ok(())
    }

    /// Why grids cannot be varied.
    fn grids_apart(&self) -> Result<(), &'static str> {
        if self.is_prescribed() {
            return Err("a scene whose pressure is prescribed has no grid");
        }
        match self.scene.surface.as_ref().map(|surface| &surface.shape) {
            Some(Shape::File { .. }) => Err("the heights in a file belong to one grid"),
            Some(Shape::Rough { .. }) => Err("a rough surface is drawn for its grid, another one has another surface"),
            _ => Ok(()),
        }
    }

    /// Which scaling the scene can have, or why none.
    fn scaled_kind(&self) -> Result<ScalingKind, &'static str> {
        let cycles = self.scene.cycles.iter().any(|cycle| cycle.count > 1);
        let ramps = self.scene.steps.iter().any(|step| !step.ramp.is_empty());
        match (cycles, self.is_prescribed()) {
            (true, _) => Ok(ScalingKind::Cycle),
            (false, true) => Err("quadrature of a prescribed pressure is exact without, and there are no cycles"),
            (false, false) if ramps => Err("load steps with ramps are not stretched, and there are no cycles"),
            (false, false) => Ok(ScalingKind::Auto),
        }
    }

    /// All lines, and what is left out as a whole with the reason.
    pub(super) fn lines(&self) -> (Vec<Line>, Vec<String>) {
        let (mut lines, mut left_out) = (Vec::new(), Vec::new());
        let asked = self.asked;
        if asked.wants(Part::Substeps) {
            lines.extend(self.methods().into_iter().flat_map(|method| self.stepped(method)));
        }
        if asked.wants(Part::Tolerances) {
            lines.extend(self.methods().into_iter().filter_map(|method| self.tolerant(method)));
        }
        if asked.wants(Part::Scaling) {
            match self.scaled_kind() {
                Ok(kind) => lines.push(self.scaled(kind)),
                Err(reason) => left_out.push(format!("scaling: {reason}")),
            }
        }
        if asked.wants(Part::Isolation) {
            match self.elsewhere {
                true => lines.push(self.apart()),
                false => {
                    left_out.push("a law in a process of its own beside one in this: there is only one".to_owned())
                }
            }
        }
        if asked.wants(Part::Grids) {
            match self.grids_apart() {
                Ok(()) => lines.push(self.grids()),
                Err(reason) => left_out.push(format!("grids: {reason}")),
            }
        }
        lines.retain(|line| !line.cases.is_empty());
        (lines, left_out)
    }

    fn methods(&self) -> Vec<Method> {
        match (self.asked.methods.is_empty(), self.is_prescribed()) {
            (false, _) => self.asked.methods.clone(),
            (true, true) => std::iter::once(Method::Auto).chain(METHODS).collect(),
            (true, false) => METHODS.to_vec(),
        }
    }

    /// Lines of fixed substeps.
    fn stepped(&self, method: Method) -> Vec<Line> {
        let explicit = method == Method::ExplicitEuler && !self.is_prescribed();
        let limit = self.limit.filter(|_| explicit).map(|limit| limit.substeps);
        let (given, doubling) = (!self.asked.substeps.is_empty(), (0..MOST).map(|power| 1_u64 << power));
        let values: Vec<u64> = match limit {
            _ if given => sorted(&self.asked.substeps, |a, b| a.cmp(b)),
            None => doubling.collect(),
            Some(fewest) => {
                let halved = (1..=BELOW).rev().map(|power| (fewest >> power).max(1));
                let mut values: Vec<u64> = halved.chain((0..MOST).map(|power| fewest << power)).collect();
                values.dedup();
                values
            }
        };
        let beyond = |word: &str| explicit.then(|| format!("integrator.beyond_limit={word}"));
        let case = |substeps: u64, word: &str, needed: bool| {
            let mut overrides = self.method(method);
            overrides.push(format!("integrator.substeps={substeps}"));
            overrides.extend(beyond(word));
            Planned { value: substeps as f64, steps: substeps as f64, overrides, needed }
        };
        let line = |name: &str, cases: Vec<Planned>, given: bool, note| Line {
            name: name.to_owned(),
            kind: Kind::Substeps,
            method: self::name(method),
            isolated: false,
            cases,
            given,
            note,
        };
        let stable = limit.and_then(|fewest| values.iter().copied().find(|substeps| *substeps >= fewest));
        let cases = values.iter().map(|substeps| case(*substeps, "run", Some(*substeps) == stable)).collect();
        let label = if method == Method::Auto { "quadrature" } else { name(method) };
        let mut lines = vec![line(label, cases, given, None)];
        if let Some(fewest) = limit.filter(|_| !given) {
            let note = Some("steps cut to 0.9 of the limit as it is measured on the way; the value counts them");
            let cut = Planned { steps: 1.25 * fewest as f64, ..case(1, "substep", true) };
            lines.push(line(AT_LIMIT, vec![cut], true, note));
        }
        lines
    }

    /// A line of tolerances; none for explicit steps, whose limit and not the tolerance sets their length.
    fn tolerant(&self, method: Method) -> Option<Line> {
        if method == Method::ExplicitEuler && !self.is_prescribed() {
            return None;
        }
        let given = !self.asked.tolerances.is_empty();
        let values = match given {
            true => sorted(&self.asked.tolerances, |a, b| b.total_cmp(a)),
            false => (1..=if self.is_prescribed() { 12 } else { 8 }).map(|power| 10_f64.powi(-power)).collect(),
        };
        let cases = values.iter().map(|tolerance| {
            let mut overrides = self.method(method);
            overrides.push(format!("integrator.tolerance={tolerance:e}"));
            Planned { value: *tolerance, steps: 1.0, overrides, needed: false }
        });
        let label = if self.is_prescribed() && method == Method::Auto { "quadrature" } else { name(method) };
        Some(Line {
            name: format!("{label} to a tolerance"),
            kind: Kind::Tolerance,
            method: name(method),
            isolated: false,
            cases: cases.collect(),
            given,
            note: None,
        })
    }

    fn scaled(&self, kind: ScalingKind) -> Line {
        let given = !self.asked.safety.is_empty();
        let values = match given {
            true => sorted(&self.asked.safety, |a, b| b.total_cmp(a)),
            false => vec![0.5, 0.2, 0.1, 0.05, 0.02, 0.01],
        };
        let auto = kind == ScalingKind::Auto;
        let cases = values.iter().map(|safety| {
            let mut overrides = vec!["output.fields=[]".to_owned(), "integrator.method=auto".to_owned()];
            if auto {
                overrides.push(format!("integrator.substeps={UNSCALED}"));
            }
            overrides.push(format!("scaling.kind={}", if auto { "auto" } else { "cycle" }));
            overrides.push(format!("scaling.safety={safety}"));
            Planned { value: *safety, steps: safety.recip(), overrides, needed: false }
        });
        Line {
            name: if auto { "AUTS" } else { "CBCS" }.to_owned(),
            kind: Kind::Scaling,
            method: "auto",
            isolated: false,
            cases: cases.collect(),
            given,
            note: auto.then_some("stretches ten thousand substeps per load step"),
        }
    }

    fn apart(&self) -> Line {
        let cases = [1e-1, 1e-2, 1e-3].map(|tolerance| {
            let mut overrides = self.method(Method::Auto);
            overrides.push(format!("integrator.tolerance={tolerance:e}"));
            Planned { value: tolerance, steps: 1.0, overrides, needed: false }
        });
        Line {
            name: "auto to a tolerance, isolated law".to_owned(),
            kind: Kind::Tolerance,
            method: "auto",
            isolated: true,
            cases: cases.to_vec(),
            given: true,
            note: Some("the processor time of the law's own process is not in it"),
        }
    }

    /// A line of grids, ending at the scene's own unless the user says otherwise.
    fn grids(&self) -> Line {
        let own = self.scene.grid.as_ref().map(|grid| grid.cells.clone()).unwrap_or_default();
        let first = own.first().copied().unwrap_or(1);
        let given = !self.asked.grids.is_empty();
        let values: Vec<usize> = match given {
            true => sorted(&self.asked.grids, |a, b| a.cmp(b)).into_iter().map(|cells| cells as usize).collect(),
            false => [4, 2, 1].iter().map(|part| first / part).filter(|cells| *cells >= FEWEST_CELLS).collect(),
        };
        let cases = values.iter().map(|cells| {
            let counts: Vec<String> = own.iter().map(|own| scaled_count(*own, *cells, first).to_string()).collect();
            let mut overrides = self.method(Method::Auto);
            overrides.push(format!("grid.cells=[{}]", counts.join(", ")));
            Planned { value: *cells as f64, steps: 1.0, overrides, needed: false }
        });
        Line {
            name: "grid".to_owned(),
            kind: Kind::Grid,
            method: "auto",
            isolated: false,
            cases: cases.collect(),
            given: true,
            note: None,
        }
    }

    /// Overrides of half the cells in every direction; `None`: not a grid that can be halved.
    pub(super) fn half_grid(&self) -> Option<String> {
        self.grids_apart().ok()?;
        let own = &self.scene.grid.as_ref()?.cells;
        let halves: Vec<usize> = own.iter().map(|cells| cells / 2).collect();
        let whole = halves.iter().all(|cells| *cells >= FEWEST_CELLS);
        whole.then(|| format!("grid.cells={halves:?}"))
    }
}

fn scaled_count(own: usize, first: usize, of: usize) -> usize {
    ((own as f64 * first as f64 / of as f64).round() as usize).max(1)
}

fn sorted<T: Copy + PartialEq>(values: &[T], order: impl Fn(&T, &T) -> std::cmp::Ordering) -> Vec<T> {
    let mut values = values.to_vec();
    values.sort_by(order);
    values.dedup();
    values
}
