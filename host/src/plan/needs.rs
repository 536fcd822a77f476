//! What a run needs of a scene, field by field, and what it can leave out.

use crate::contact::prescribed::{Column, Header, Motion, Needs};
use crate::law::{Field, Fields, LawDescriptor, OutputItem};
use crate::plan::build::Skipped;
use crate::plan::output::{FieldKind, OutputPlan};
use crate::plan::{Block, Material, PlanError, PlanProblem};
use crate::scene::{Basis, Scene};

/// Points up to which coordinates are read for the plot alone.
const PLOTTED_POINTS: usize = 200_000;

/// Everything that decides what is needed.
pub(super) struct Setting<'a> {
    pub(super) scene: &'a Scene,
    pub(super) law: &'a LawDescriptor,
    pub(super) header: Option<&'a Header>,
    pub(super) blocks: &'a [Block],
    pub(super) material: &'a Material,
    pub(super) output: &'a OutputPlan,
}

/// What is needed.
pub(super) struct Resolved {
    pub(super) fields: Fields,
    pub(super) columns: Needs,
    pub(super) inputs: Vec<Option<Column>>,
    pub(super) motion: Motion,
    pub(super) temperature: bool,
}

impl Setting<'_> {
    fn has(&self, column: Column) -> bool {
        self.header.is_some_and(|header| header.has_column(column))
    }

    pub(super) fn every_step(&self, gives: impl Fn(&crate::plan::LoadStep) -> bool) -> bool {
        self.blocks.iter().all(|block| block.steps.iter().all(&gives))
    }

    fn motion(&self) -> Motion {
        match self.header.map_or(Motion::None, Header::motion) {
            Motion::None if self.every_step(|step| step.velocity.is_some()) => Motion::Velocity,
            found => found,
        }
    }

    fn gives_temperature(&self) -> bool {
        self.has(Column::Temperature) || self.every_step(|step| step.temperature.is_some())
    }

    fn gives_friction(&self) -> bool {
        self.has(Column::Friction)
            || self.scene.contact.friction.is_some()
            || self.every_step(|step| step.friction.is_some())
    }

    fn gives_stress(&self) -> bool {
        self.header.is_some_and(Header::has_stress)
    }

    fn moves(&self) -> bool {
        self.motion() != Motion::None
    }

    /// Whether the scene can give a field; if not, what would.
    fn gives(&self, field: Field) -> Result<(), &'static str> {
        let history = self.header.is_some();
        let (there, remedy) = match field {
            Field::Slip | Field::Velocity | Field::SlipVector | Field::AccumulatedSlip => match history {
                true => (self.moves(), "give a column `velocity` or `slip` in `contact.history`, or `step.velocity`"),
                false => (self.moves(), "give `step.velocity`"),
            },
            Field::Temperature => match history {
                true => (
                    self.gives_temperature(),
                    "give a column `temperature` in `contact.history`, or `step.temperature`",
                ),
                false => (self.gives_temperature(), "give `step.temperature`"),
            },
            Field::FrictionStress | Field::FrictionWork => (
                self.moves() && (self.has(Column::Shear) || self.gives_friction()),
                "give `contact.friction`, or a column `friction` or `shear` in `contact.history`, and a motion",
            ),
            Field::FrictionCoefficient => match history {
                true => (self.gives_friction(), "give `contact.friction`, or a column `friction` in `contact.history`"),
                false => (self.gives_friction(), "give `contact.friction`"),
            },
            Field::NodalTraction => {
                (self.gives_stress(), "give columns `sxx` to `sxz` (nodal stresses) in `contact.history`")
            }
            Field::Area => (self.has(Column::Area), "give a column `area` in `contact.history`"),
            Field::Coordinates => (self.has(Column::X), "give columns `x`, `y`, `z` in `contact.history`"),
            Field::CounterTemperature => {
                (false, "no key of a prescribed scene gives the counter surface a temperature")
            }
            Field::Gap => {
                (false, "a prescribed scene has no gap; `contact.model` = \"foundation\" or \"halfspace\" has")
            }
            Field::ElementId => (false, "a prescribed scene has points but no elements"),
            Field::Pressure
            | Field::Normal
            | Field::Tangent
            | Field::AccumulatedWear
            | Field::ContactState
            | Field::PointId => (true, ""),
        };
        if there { Ok(()) } else { Err(remedy) }
    }

    pub(super) fn missing(&self, field: &str, remedy: &str) -> PlanError {
        let (law, field) = (self.law.name.clone(), format!("`{field}`"));
        let problem = PlanProblem::Missing { law, field, remedy: remedy.to_owned() };
        self.scene.error_at("law.use", problem)
    }

    /// Finds what is needed and notes what is not.
    pub(super) fn resolve(&self, skipped: &mut Vec<Skipped>) -> Result<Resolved, PlanError> {
        let mut fields = Fields::EMPTY;
        for field in self.law.reads.iter() {
            self.gives(field).map_err(|remedy| self.missing(field.name(), remedy))?;
            fields = fields.with(field);
        }
        for field in self.law.uses.iter() {
            match self.gives(field) {
                Ok(()) => fields = fields.with(field),
                Err(remedy) => skipped.push(Skipped::new(
                    &format!("`{}`, which the law would use", field.name()),
                    &format!("the scene does not give it ({remedy})"),
                )),
            }
        }
        let mut columns = Needs::none();
        let inputs = self.inputs(&mut columns)?;
        let temperature = self.temperature(fields, skipped)?;
        if temperature && self.has(Column::Temperature) {
            columns.add(Column::Temperature);
        }
        self.traction(fields, &mut columns, skipped)?;
        let motion = self.motion();
        match motion {
            Motion::Velocity if self.has(Column::Velocity) => columns.add(Column::Velocity),
            Motion::Slip => columns.add(Column::Slip),
            Motion::SlipVector => Column::SLIP_VECTOR.iter().for_each(|column| columns.add(*column)),
            Motion::Velocity | Motion::None => {}
        }
        self.friction(fields, &mut columns, skipped);
        if self.has(Column::Area) {
            columns.add(Column::Area);
        } else {
            let why = "no column `area` in a history says how large the points are";
            skipped.push(Skipped::new("load, contact area and wear volume", why));
        }
        self.coordinates(fields, &mut columns, skipped);
        self.leave_out(fields, skipped);
        Ok(Resolved { fields, columns, inputs, motion, temperature })
    }

    fn inputs(&self, columns: &mut Needs) -> Result<Vec<Option<Column>>, PlanError> {
        let mut inputs = Vec::new();
        for input in &self.law.inputs {
            let there = self.header.is_some_and(|header| header.has(&input.name));
            if there {
                inputs.push(Some(match Column::from_name(&input.name) {
                    Some(column) => {
                        columns.add(column);
                        column
                    }
                    None => columns.add_further(&input.name),
                }));
            } else if input.default.is_some() {
                inputs.push(None);
            } else {
                let remedy = format!("give a column `{}` in `contact.history`", input.name);
                return Err(self.missing(&input.name, &remedy));
            }
        }
        Ok(inputs)
    }

    fn temperature(&self, fields: Fields, skipped: &mut Vec<Skipped>) -> Result<bool, PlanError> {
        let table = self.material.constants.varies_in_temperature();
        if table && !self.gives_temperature() {
            let remedy = "give a column `temperature` in `contact.history`, or `step.temperature`";
            let problem = PlanProblem::Missing {
                law: self.law.name.clone(),
                field: "constants that depend on `temperature`".to_owned(),
                remedy: remedy.to_owned(),
            };
            return Err(self.scene.error_at("law.table", problem));
        }
        let shown = self.output.has(FieldKind::Temperature);
        if shown && !self.gives_temperature() {
            let reason = "nothing in the scene gives a temperature";
            let problem = PlanProblem::FieldNotThere { field: "temperature".to_owned(), reason };
            return Err(self.scene.error_at("output.fields", problem));
        }
        let needed = table || shown || fields.contains(Field::Temperature);
        if !needed {
            let what = if self.has(Column::Temperature) { "the column `temperature`" } else { "temperatures" };
            skipped.push(Skipped::new(what, "the law does not read them and no table depends on them"));
        }
        Ok(needed)
    }

    fn traction(&self, fields: Fields, columns: &mut Needs, skipped: &mut Vec<Skipped>) -> Result<(), PlanError> {
        let driven = self.material.basis == Basis::NodalStress;
        if driven && !self.gives_stress() {
            let remedy = "give columns `sxx` to `sxz` (nodal stresses) in `contact.history`";
            let problem = PlanProblem::Missing {
                law: self.law.name.clone(),
                field: "nodal stresses (`basis` = \"nodal-stress\", C5 = 1 or 11)".to_owned(),
                remedy: remedy.to_owned(),
            };
            return Err(self.scene.error_at("law.basis", problem));
        }
        if driven || fields.contains(Field::NodalTraction) {
            Column::STRESS.iter().for_each(|column| columns.add(*column));
        } else {
            skipped.push(Skipped::new("nodal stresses", "wear is based on the contact pressure"));
        }
        if !driven && self.header.is_some() {
            columns.add(Column::Pressure);
        } else if driven && self.has(Column::Pressure) {
            skipped.push(Skipped::new("the column `pressure`", "wear is based on nodal stresses"));
        }
        let turned = self.material.direction.is_some() || self.law.writes(OutputItem::Direction);
        let normals = driven
            || turned
            || [Field::Normal, Field::Tangent, Field::NodalTraction].iter().any(|f| fields.contains(*f));
        let oblique = [Field::SlipVector, Field::FrictionStress].iter().any(|field| fields.contains(*field));
        if normals || oblique {
            if self.has(Column::NormalX) {
                Column::NORMAL.iter().for_each(|column| columns.add(*column));
            }
        } else {
            skipped.push(Skipped::new("normals", "the wear direction is the default and the law does not read them"));
        }
        Ok(())
    }

    fn friction(&self, fields: Fields, columns: &mut Needs, skipped: &mut Vec<Skipped>) {
        let needed = [Field::FrictionStress, Field::FrictionWork].iter().any(|field| fields.contains(*field));
        if needed && self.has(Column::Shear) {
            columns.add(Column::Shear);
        }
        // A shear stress that is given is not the product of a coefficient.
        let by_coefficient = fields.contains(Field::FrictionCoefficient) || needed && !self.has(Column::Shear);
        if by_coefficient && self.has(Column::Friction) {
            columns.add(Column::Friction);
        }
        let frictional = [Field::FrictionStress, Field::FrictionWork, Field::FrictionCoefficient];
        if !frictional.iter().any(|field| self.law.fields().contains(*field)) {
            skipped.push(Skipped::new("friction", "the law does not read it"));
        }
    }

    fn coordinates(&self, fields: Fields, columns: &mut Needs, skipped: &mut Vec<Skipped>) {
        if !self.has(Column::X) {
            return;
        }
        let few = self.header.and_then(|header| header.points).is_none_or(|points| points <= PLOTTED_POINTS);
        if few || fields.contains(Field::Coordinates) || !self.output.fields.is_empty() {
            Column::COORDINATES.iter().for_each(|column| columns.add(*column));
        } else {
            let why = "the law does not read them, no field is written, and there are too many points to plot";
            skipped.push(Skipped::new("coordinates", why));
        }
    }

    fn leave_out(&self, fields: Fields, skipped: &mut Vec<Skipped>) {
        if !fields.contains(Field::SlipVector) {
            skipped.push(Skipped::new("slip vectors", "the law does not read them"));
        }
        if !self.law.writes(OutputItem::Direction) {
            skipped.push(Skipped::new("wear directions", "the law keeps the direction that it is given"));
        }
        if self.law.state.is_empty() {
            skipped.push(Skipped::new("state variables", "the law has none"));
        }
        skipped.push(Skipped::new("derivatives", "prescribed pressure does not answer to wear"));
        skipped.push(Skipped::new("contact solves", "pressure is prescribed"));
        skipped.push(Skipped::new("the stability estimate", "a prescribed pressure has no stability limit"));
        if !self.law.wants_open_points() {
            skipped.push(Skipped::new("points out of contact", "the law does not ask for them: no call, no wear"));
        }
        let table = &self.scene.law.table;
        if !table.is_empty()
            && !self.material.constants.varies_in_time()
            && !self.material.constants.varies_in_temperature()
        {
            skipped.push(Skipped::new("the table of constants", "its rows are equal"));
        }
        if self.output.fields.is_empty() {
            skipped.push(Skipped::new("field files", "`output.fields` asks for none"));
        }
    }
}
