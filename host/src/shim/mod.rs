//! User subroutines for solvers that call no libraries by themselves: a Fortran source that loads a law and calls it.
//!
//! The source is whole: the interface of `libwearlaw_host`, the law's one point with what every node remembers, and the
//! subroutine of the solver's own form. Which law, its constants and which of its fields are set is written into it.

#[cfg(test)]
mod tests;

use std::fmt::Write;

use crate::law::build::CARRIED;
use crate::law::{Claim, Field, Fields, LawDescriptor, OutputItem, Quantity};

/// A form of user subroutine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// `umeshmotion`: moves nodes of an adaptive mesh.
    Umeshmotion,
    /// `uwearindex`: answers the rate of wear of a node in contact.
    Uwearindex,
}

/// What a shim is made from.
#[derive(Debug, Clone)]
pub struct Wanted<'a> {
    /// The subroutine that the solver calls.
    pub form: Form,
    /// The law.
    pub law: &'a LawDescriptor,
    /// How the law is opened: a whole path, `PATH#LAW` or `embedded:archard`.
    pub library: String,
    /// SHA-256 of the library, in hexadecimal; empty: none.
    pub sha256: String,
    /// Constants by name, in the solver's units; for a form that is given none.
    pub constants: Vec<(String, f64)>,
    /// The solver's units of length, mass and time in SI.
    pub units: [f64; 3],
}

/// Why there is no shim.
#[derive(Debug, thiserror::Error, PartialEq)]
pub enum ShimError {
    /// The solver's subroutine is not given what the law reads.
    #[error("law `{law}` reads `{field}`, which {form} is not given; it is given {given}")]
    NotGiven {
        /// The law.
        law: String,
        /// The field, or the law's own input.
        field: String,
        /// The form.
        form: &'static str,
        /// What it is given.
        given: String,
    },
    /// The subroutine can answer wear along the normal only.
    #[error(
        "law `{law}` has a wear direction of its own, expected one that wears along the normal: {form} answers no other"
    )]
    Direction {
        /// The law.
        law: String,
        /// The form.
        form: &'static str,
    },
    /// A state variable without an initial value.
    #[error("state variable `{name}` of law `{law}` has no initial value, and {form} is given none")]
    NoInitial {
        /// The law.
        law: String,
        /// The variable.
        name: String,
        /// The form.
        form: &'static str,
    },
    /// A constant is missing, unknown or out of its bounds, or given where the solver gives them.
    #[error("{0}")]
    Constant(String),
}

const UMESHMOTION: [Field; 11] = [
    Field::Pressure,
    Field::Slip,
    Field::Velocity,
    Field::Normal,
    Field::Coordinates,
    Field::Temperature,
    Field::FrictionStress,
    Field::FrictionWork,
    Field::Gap,
    Field::Area,
    Field::PointId,
];
const UWEARINDEX: [Field; 11] = [
    Field::Pressure,
    Field::Slip,
    Field::Velocity,
    Field::Normal,
    Field::Coordinates,
    Field::Temperature,
    Field::FrictionStress,
    Field::FrictionCoefficient,
    Field::FrictionWork,
    Field::Area,
    Field::PointId,
];

impl Form {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Form::Umeshmotion => "umeshmotion",
            Form::Uwearindex => "uwearindex",
        }
    }

    fn gives(self) -> Fields {
        match self {
            Form::Umeshmotion => UMESHMOTION.into_iter().collect(),
            Form::Uwearindex => UWEARINDEX.into_iter().collect(),
        }
    }
}

/// The Fortran source.
///
/// # Errors
/// See [`ShimError`].
pub fn source(wanted: &Wanted<'_>) -> Result<String, ShimError> {
    let Wanted { form, law, .. } = wanted;
    let (form, given) = (*form, form.gives());
    let name = || law.name.clone();
    let missing = law.reads.difference(given).iter().next().map(|field| field.name().to_owned());
    let missing = missing.or_else(|| law.inputs.first().map(|input| input.name.clone()));
    if let Some(field) = missing {
        return Err(ShimError::NotGiven { law: name(), field, form: form.name(), given: given.names().join(", ") });
    }
    if law.writes(OutputItem::Direction) {
        return Err(ShimError::Direction { law: name(), form: form.name() });
    }
    if let Some(variable) = law.state.iter().find(|variable| variable.default.is_none()) {
        return Err(ShimError::NoInitial { law: name(), name: variable.name.clone(), form: form.name() });
    }
    let values = constants(wanted)?;
    let fields: Vec<Field> = law.fields().iter().filter(|field| given.contains(*field)).collect();
    let of_the_moment = law.claims(Claim::LinearInDt) && law.state.is_empty();
    let names: Vec<&str> = law.constants.iter().map(|constant| constant.name.as_str()).collect();
    let [metre, kilogram, second] = wanted.units.map(number);
    let whole = CORE.to_owned()
        + match form {
            Form::Umeshmotion => include_str!("umeshmotion.f90.in"),
            Form::Uwearindex => include_str!("uwearindex.f90.in"),
        };
    let stop = match form {
        Form::Umeshmotion => "    call xit()",
        Form::Uwearindex => "    call quit(9999)",
    };
    Ok(whole
        .replace("@INTERFACES@", &interfaces())
        .replace("@FORM@", form.name())
        .replace("@VERSION@", env!("CARGO_PKG_VERSION"))
        .replace("@LAW@", &format!("{} {}", law.name, law.version))
        .replace("@CONSTANT_COUNT@", &law.constants.len().to_string())
        .replace("@STATE_COUNT@", &law.state.len().to_string())
        .replace("@OF_THE_MOMENT@", if of_the_moment { ".true." } else { ".false." })
        .replace("@LIBRARY@", &literal(&wanted.library))
        .replace("@SHA256@", &wanted.sha256)
        .replace("@PROVIDES@", &provides(&fields))
        .replace("@METRE@", &metre)
        .replace("@KILOGRAM@", &kilogram)
        .replace("@SECOND@", &second)
        .replace("@FIELDS@", &set(&fields))
        .replace("@STOP@", stop)
        .replace("@CONSTANTS@", &if names.is_empty() { "none".to_owned() } else { names.join(", ") })
        .replace("@SLOTS@", &values.len().max(1).to_string())
        .replace("@VALUES@", &listed(&values))
        .replace("@ASKED@", &asked(&fields)))
}

const CORE: &str = include_str!("core.f90.in");

/// The modules that a solver in Fortran uses, as they are.
fn interfaces() -> String {
    let of = |wanted: &str| CARRIED.iter().find(|(name, _)| *name == wanted).map_or("", |(_, text)| text);
    format!("{}\n{}", of("wearlaw.f90"), of("wearlaw_host.f90"))
}

/// The law's constants in their order, for a form that is given none.
fn constants(wanted: &Wanted<'_>) -> Result<Vec<f64>, ShimError> {
    let Wanted { form, law, constants, .. } = wanted;
    if let (Form::Uwearindex, Some((name, _))) = (form, constants.first()) {
        let what = format!("found a value for `{name}`, expected none: uwearindex is given the constants, as `param`");
        return Err(ShimError::Constant(what));
    }
    let known = || law.constants.iter().map(|constant| constant.name.as_str()).collect::<Vec<_>>().join(", ");
    if let Some((name, _)) = constants.iter().find(|(name, _)| !law.constants.iter().any(|known| known.name == *name)) {
        return Err(ShimError::Constant(format!("law `{}` has no constant `{name}`; it has {}", law.name, known())));
    }
    if *form == Form::Uwearindex {
        return Ok(Vec::new());
    }
    let in_si = |quantity: &Quantity, value: f64| {
        let [metre, kilogram, second] = wanted.units;
        let [m, kg, s, _] = quantity.exponents;
        value * metre.powf(m) * kilogram.powf(kg) * second.powf(s)
    };
    let each = law.constants.iter().map(|constant| {
        let found = constants.iter().find(|(name, _)| *name == constant.name).map(|(_, value)| *value);
        // A default is in SI, and what is written into the source in the solver's units.
        let value = found.or_else(|| constant.default.map(|value| value / in_si(constant, 1.0)));
        let Some(value) = value else {
            let what = format!(
                "constant `{}` of law `{}` has no value: --constants {}=..",
                constant.name, law.name, constant.name
            );
            return Err(ShimError::Constant(what));
        };
        if !constant.closes_units && !constant.allows(in_si(constant, value)) {
            let what =
                format!("found {value} for constant `{}`, expected it in {} (SI)", constant.name, constant.interval());
            return Err(ShimError::Constant(what));
        }
        Ok(value)
    });
    each.collect()
}

/// A text as Fortran has it, in lines that are not too long, with a zero at its end.
fn literal(text: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let parts = letters.chunks(60).map(|part| {
        let part: String = part.iter().collect();
        format!("    '{}'", part.replace('\'', "''"))
    });
    parts.collect::<Vec<_>>().join(" // &\n") + " // c_null_char"
}

/// A number as Fortran has it, to the last bit.
fn number(value: f64) -> String {
    format!("{value:e}_c_double")
}

fn listed(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().copied().map(number).collect();
    if values.is_empty() { number(0.0) } else { values.join(", &\n    ") }
}

fn provides(fields: &[Field]) -> String {
    let each: Vec<String> = fields.iter().map(|field| format!("WL_FIELD_{}", field.name().to_uppercase())).collect();
    if each.is_empty() { "zero".to_owned() } else { each.join(" + &\n        ") }
}

/// Where the law finds the fields: in the point of the shim.
fn set(fields: &[Field]) -> String {
    let mut text = String::new();
    for field in fields {
        let (lower, upper) = (field.name(), field.name().to_uppercase());
        let which = if *field == Field::PointId { "index_field" } else { "field" };
        let vector = matches!(field, Field::Normal | Field::Coordinates | Field::FrictionStress);
        let length = if vector { "three" } else { "one" };
        let _ = writeln!(
            text,
            "      call need(wlh_set_{which}(surface, WL_FIELD_{upper}, c_loc(shim%{lower}), {length}, zero, &\n        \
             text, size(text, kind=c_int64_t)))"
        );
    }
    text.trim_end().to_owned()
}

/// What is asked of the solver beside pressure and slip.
fn asked(fields: &[Field]) -> String {
    let mut text = String::new();
    let mut ask = |call: &str, value: &str| {
        let _ = writeln!(text, "  found = 0\n  call {call}\n  if (answer == 0) {value}");
    };
    if fields.contains(&Field::Area) {
        ask(
            "getvrmavgatnode(node, 'CNAREA', found, answer, elements, count, jmatyp, jgvblock)",
            "shim%area = found(1)",
        );
    }
    if fields.contains(&Field::Temperature) {
        ask("getvrn(node, 'NT', found, answer, jgvblock, 0)", "shim%temperature = found(1)");
    }
    if fields.contains(&Field::Coordinates) {
        ask("getvrn(node, 'COORD', found, answer, jgvblock, 0)", "shim%coordinates(:ndim) = found(:ndim)");
    }
    text.trim_end().to_owned()
}
