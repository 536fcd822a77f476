//! Laws from user subroutines of other solvers, unmodified: a layer in C between their arguments and a law's.
//!
//! Which fields a law reads follows from the arguments that the subroutine mentions, so a solver gives no more than it needs.

mod fortran;
#[cfg(test)]
mod tests;

use std::fmt::Write;
use std::path::Path;

use super::BuildError;
use fortran::Procedure;

/// A form of user subroutine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// `subroutine uwearindex(wrnd, n, .., fric)`: the rate of wear of a node in contact.
    Uwearindex,
}

/// How a subroutine becomes a law.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Adaptation {
    /// The form of the subroutine.
    pub form: Form,
    /// Names of the elements of `param`, in their order, each with its unit's name where it has one.
    pub parameters: Vec<(String, Option<Unit>)>,
}

/// Exponents of metre, kilogram, second, kelvin, as the macro of `wearlaw_point.h` that stands for them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unit(String);

impl Adaptation {
    /// From `uwearindex` and `K,H:pascal`.
    ///
    /// # Errors
    /// What was found and what was expected, as text.
    pub fn parse(form: &str, parameters: &str) -> Result<Adaptation, String> {
        if form != "uwearindex" {
            return Err(format!("found form `{form}`, expected uwearindex"));
        }
        let mut all: Vec<(String, Option<Unit>)> = Vec::new();
        for one in parameters.split(',').map(str::trim).filter(|one| !one.is_empty()) {
            let (name, unit) = one.split_once(':').map_or((one, None), |(name, unit)| (name, Some(unit)));
            let letters = |name: &str| name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
            if !letters(name) || !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
                return Err(format!("found name `{name}`, expected letters, digits and _ after a letter"));
            }
            if all.iter().any(|(other, _)| other == name) {
                return Err(format!("found `{name}` twice, expected a name of its own for each element of param"));
            }
            all.push((name.to_owned(), unit.map(Unit::named).transpose()?));
        }
        Ok(Adaptation { form: Form::Uwearindex, parameters: all })
    }

    /// The layer in C for a source of this name.
    pub(super) fn layer(&self, path: &Path, text: &str, name: &str) -> Result<String, BuildError> {
        let wrong = |what: String| BuildError::NoSubroutine { path: path.to_owned(), what };
        let procedure = fortran::procedure(text, fortran::is_fixed(path), "uwearindex").map_err(wrong)?;
        let [found, expected] = [procedure.arguments.len(), ARGUMENTS.len()];
        if found != expected {
            return Err(wrong(format!("found `uwearindex` with {found} arguments, expected {expected}: wrnd to fric")));
        }
        let given = self.parameters.len();
        let most = procedure.greatest_index(&procedure.arguments[PARAM]);
        if procedure.mentions(&procedure.arguments[PARAM]) && most.unwrap_or(1) > given {
            let needed = most.map_or_else(|| "some elements".to_owned(), |most| format!("{most}"));
            return Err(wrong(format!(
                "it reads {needed} of `{}`, found names for {given}, expected a name for each: --params K,H:pascal",
                procedure.arguments[PARAM]
            )));
        }
        Ok(self.text(&procedure, path, name))
    }

    fn text(&self, procedure: &Procedure, path: &Path, name: &str) -> String {
        let file = path.file_name().map(|file| file.to_string_lossy().into_owned()).unwrap_or_default();
        let plain =
            |text: &str| text.chars().filter(|c| !matches!(c, '"' | '\\') && !c.is_control()).collect::<String>();
        let mentioned = |index: usize| procedure.mentions(&procedure.arguments[index]);
        let mut fields: Vec<&str> = Vec::new();
        let mut values = String::new();
        for (index, argument) in ARGUMENTS.iter().enumerate().skip(1) {
            let reads = if mentioned(index) { argument.reads } else { &[] };
            for field in reads {
                if !fields.contains(field) {
                    fields.push(field);
                }
            }
            let value = if mentioned(index) || argument.reads.is_empty() { argument.value } else { "0" };
            match argument.kind {
                Kind::Real => writeln!(values, "    double {} = {value};", argument.name),
                Kind::Integer => writeln!(values, "    int {} = (int)({value});", argument.name),
                Kind::Vector if value == "0" => writeln!(values, "    double {}[3] = {{0, 0, 0}};", argument.name),
                Kind::Vector => {
                    writeln!(values, "    double {}[3] = {{{value}[0], {value}[1], {value}[2]}};", argument.name)
                }
                Kind::Constants => {
                    let names: Vec<String> = self.parameters.iter().map(|(name, _)| format!("c->{name}")).collect();
                    let names = if names.is_empty() { "0".to_owned() } else { names.join(", ") };
                    writeln!(values, "    double {}[] = {{{names}}};", argument.name)
                }
            }
            .unwrap_or_default();
        }
        let unitless = self.parameters.iter().filter(|(_, unit)| unit.is_none()).count();
        let constants: String =
            self.parameters.iter().enumerate().fold(String::new(), |mut all, (index, (name, unit))| {
                let bounds = if unit.is_none() && unitless == 1 { "WL_ANY WL_CLOSES_UNITS" } else { "WL_ANY" };
                let unit = unit.as_ref().map_or("WL_NUMBER", |unit| &unit.0);
                let _ = write!(
                    all,
                    " C({name}, {unit}, {bounds}, WL_REQUIRED, \"param({}) of {}\")",
                    index + 1,
                    plain(&file)
                );
                all
            });
        // Without the length of the increment, its start or its number, and without memory, the rate is one of the moment.
        let of_the_moment = ![TIME, TIMINC, INC].into_iter().any(mentioned) && !procedure.remembers;
        let reads: String = fields.iter().map(|field| format!(" F({field})")).collect();
        TEMPLATE
            .replace("@NAME@", name)
            .replace("@FILE@", &plain(&file))
            .replace("@READS@", &reads)
            .replace("@CONSTANTS@", &constants)
            .replace("@CLAIMS@", if of_the_moment { "WL_CLAIM_LINEAR_IN_DT" } else { "0" })
            .replace("@VALUES@", &values)
    }
}

impl Unit {
    /// From the name that `include/README.md` lists, such as `pascal` or `per-pascal`.
    fn named(name: &str) -> Result<Unit, String> {
        const NAMES: [&str; 18] = [
            "number",
            "metre",
            "per-metre",
            "square-metre",
            "kilogram",
            "second",
            "per-second",
            "kelvin",
            "per-kelvin",
            "metre-per-second",
            "newton",
            "joule",
            "pascal",
            "per-pascal",
            "pascal-per-kelvin",
            "joule-per-square-metre",
            "watt-per-square-metre",
            "kilogram-per-cubic-metre",
        ];
        let name = name.trim().replace('_', "-");
        if !NAMES.contains(&name.as_str()) {
            return Err(format!("found unit `{name}`, expected one of {}", NAMES.join(", ")));
        }
        Ok(Unit(format!("WL_{}", name.replace('-', "_").to_uppercase())))
    }
}

enum Kind {
    Real,
    Integer,
    Vector,
    Constants,
}

struct Argument {
    name: &'static str,
    kind: Kind,
    /// What it is, in C, out of the point that the law is given.
    value: &'static str,
    /// The fields in that.
    reads: &'static [&'static str],
}

const fn argument(name: &'static str, kind: Kind, value: &'static str, reads: &'static [&'static str]) -> Argument {
    Argument { name, kind, value, reads }
}

/// Positions of the arguments that are asked about.
const INC: usize = 3;
const TIME: usize = 4;
const TIMINC: usize = 5;
const PARAM: usize = 13;

/// The arguments in their order, and what each is of a law's inputs.
const ARGUMENTS: [Argument; 20] = [
    argument("wrnd", Kind::Real, "0", &[]),
    argument("n", Kind::Integer, "in->point_id", &["point_id"]),
    argument("nuser", Kind::Integer, "in->point_id", &["point_id"]),
    argument("inc", Kind::Integer, "in->call->substep", &[]),
    argument("time", Kind::Real, "in->time", &[]),
    argument("timinc", Kind::Real, "in->dt", &[]),
    argument("coord", Kind::Vector, "in->coordinates", &["coordinates"]),
    argument("i2or3", Kind::Integer, "in->call->dimension", &[]),
    argument("normal", Kind::Vector, "in->normal", &["normal"]),
    argument("cofornd", Kind::Real, "in->pressure * in->area", &["pressure", "area"]),
    argument("frfornd", Kind::Real, "size(in->friction_stress) * in->area", &["friction_stress", "area"]),
    argument("costrs", Kind::Real, "in->pressure", &["pressure"]),
    argument("frstrs", Kind::Real, "size(in->friction_stress)", &["friction_stress"]),
    argument("param", Kind::Constants, "", &[]),
    argument("tempi", Kind::Real, "in->temperature", &["temperature"]),
    argument("relvelnd", Kind::Real, "in->velocity", &["velocity"]),
    argument("itouch", Kind::Integer, "in->call->pair", &[]),
    argument("ibody1", Kind::Integer, "in->call->body", &[]),
    argument("ibody2", Kind::Integer, "in->call->counter_body", &[]),
    argument("fric", Kind::Real, "in->friction_coefficient", &["friction_coefficient"]),
];

const TEMPLATE: &str = include_str!("uwearindex.c.in");
