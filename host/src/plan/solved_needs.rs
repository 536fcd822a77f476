//! What a run on a contact that answers back needs of a scene, and what it can leave out.

use crate::contact::prescribed::{Motion, Needs};
use crate::law::{Field, Fields, OutputItem};
use crate::plan::needs::{Resolved, Setting};
use crate::plan::output::FieldKind;
use crate::plan::{LoadStep, PlanError, PlanProblem, Skipped};

impl Setting<'_> {
    fn some_step(&self, gives: impl Fn(&LoadStep) -> bool) -> bool {
        self.blocks.iter().any(|block| block.steps.iter().any(&gives))
    }

    /// Whether a solved scene can give a field; if not, what would.
    fn solved_gives(&self, field: Field) -> Result<(), &'static str> {
        let moves = self.some_step(|step| step.velocity.is_some() || step.velocity_file.is_some());
        let friction = self.scene.contact.friction.is_some();
        let (there, remedy) = match field {
            Field::Slip | Field::Velocity | Field::SlipVector | Field::AccumulatedSlip => {
                (moves, "give `step.velocity`, or `step.stroke` with `step.frequency`")
            }
            Field::Temperature => (self.every_step(|step| step.temperature.is_some()), "give `step.temperature`"),
            Field::FrictionStress | Field::FrictionWork => {
                (moves && friction, "give `contact.friction`, and a motion (`step.velocity`)")
            }
            Field::FrictionCoefficient => (friction, "give `contact.friction`"),
            Field::CounterTemperature => (false, "no key of a scene gives the counter surface a temperature"),
            Field::ElementId => (false, "a grid has cells but no elements"),
            _ => (true, ""),
        };
        if there { Ok(()) } else { Err(remedy) }
    }

    /// Finds what a solved scene needs and notes what it does not.
    pub(super) fn resolve_solved(&self, skipped: &mut Vec<Skipped>) -> Result<Resolved, PlanError> {
        let mut fields = Fields::EMPTY;
        for field in self.law.reads.iter() {
            self.solved_gives(field).map_err(|remedy| self.missing(field.name(), remedy))?;
            fields = fields.with(field);
        }
        for field in self.law.uses.iter() {
            match self.solved_gives(field) {
                Ok(()) => fields = fields.with(field),
                Err(remedy) => skipped.push(Skipped::new(
                    &format!("`{}`, which the law would use", field.name()),
                    &format!("the scene does not give it ({remedy})"),
                )),
            }
        }
        if let Some(input) = self.law.inputs.iter().find(|input| input.default.is_none()) {
            return Err(
                self.missing(&input.name, "only a history (`contact.model` = \"prescribed\") gives further inputs")
            );
        }
        let temperature = self.solved_temperature(fields, skipped)?;
        let motion = if self.some_step(|step| step.velocity.is_some() || step.velocity_file.is_some()) {
            Motion::Velocity
        } else {
            Motion::None
        };
        let quiet = |field: Field| !fields.contains(field);
        if quiet(Field::SlipVector) {
            skipped.push(Skipped::new("slip vectors", "the law does not read them"));
        }
        if quiet(Field::Coordinates) {
            skipped.push(Skipped::new("coordinates of the points", "the law does not read them"));
        }
        if quiet(Field::FrictionStress) && quiet(Field::FrictionWork) && quiet(Field::FrictionCoefficient) {
            skipped.push(Skipped::new("friction", "the law does not read it"));
        }
        if !self.law.writes(OutputItem::Direction) {
            skipped.push(Skipped::new("wear directions", "the law keeps the direction that it is given"));
        }
        if self.law.state.is_empty() {
            skipped.push(Skipped::new("state variables", "the law has none"));
        }
        if self.output.fields.is_empty() {
            skipped.push(Skipped::new("field files", "`output.fields` asks for none"));
        }
        let inputs = self.law.inputs.iter().map(|_| None).collect();
        Ok(Resolved { fields, columns: Needs::none(), inputs, motion, temperature })
    }

    fn solved_temperature(&self, fields: Fields, skipped: &mut Vec<Skipped>) -> Result<bool, PlanError> {
        let given = self.every_step(|step| step.temperature.is_some());
        let table = self.material.constants.varies_in_temperature();
        if table && !given {
            let problem = PlanProblem::Missing {
                law: self.law.name.clone(),
                field: "constants that depend on `temperature`".to_owned(),
                remedy: "give `step.temperature`".to_owned(),
            };
            return Err(self.scene.error_at("law.table", problem));
        }
        let shown = self.output.has(FieldKind::Temperature);
        if shown && !given {
            let reason = "nothing in the scene gives a temperature";
            let problem = PlanProblem::FieldNotThere { field: "temperature".to_owned(), reason };
            return Err(self.scene.error_at("output.fields", problem));
        }
        let needed = table || shown || fields.contains(Field::Temperature);
        if !needed {
            skipped.push(Skipped::new("temperatures", "the law does not read them and no table depends on them"));
        }
        Ok(needed)
    }
}
