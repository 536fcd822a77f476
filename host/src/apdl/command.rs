//! The arguments of TB,WEAR, TBDATA, TBFIELD and TBTEMP as numbers, each with its place.

use super::expression::evaluate;
use super::lexer::{Field, Span, Statement};
use super::parameters::Parameters;
use super::problem::{Fault, Problem, nearest};

/// Most constants of a user-defined law; a slip in NPTS or STLOC must not ask for gigabytes.
pub(super) const MOST_CONSTANTS: usize = 1000;

/// Values on one TBDATA line.
const VALUES_PER_LINE: usize = 6;

/// TBOPT of TB,WEAR.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TableOption {
    Archard,
    User,
    Auto,
    Cycle,
}

impl TableOption {
    const ALL: [TableOption; 4] = [Self::Archard, Self::User, Self::Auto, Self::Cycle];

    pub fn name(self) -> &'static str {
        match self {
            TableOption::Archard => "ARCD",
            TableOption::User => "USER",
            TableOption::Auto => "AUTS",
            TableOption::Cycle => "CBCS",
        }
    }

    pub fn is_law(self) -> bool {
        matches!(self, TableOption::Archard | TableOption::User)
    }
}

/// `TB,WEAR,MATID,NTEMP,NPTS,TBOPT`
#[derive(Debug, Clone, Copy)]
pub(super) struct OpenTable {
    pub material: i64,
    pub option: TableOption,
    /// NPTS, if stated; it has a meaning for USER only.
    pub constants: Option<usize>,
    pub span: Span,
}

/// `TBDATA,STLOC,C1,..,C6`
#[derive(Debug, Clone)]
pub(super) struct Data {
    pub location: Option<(f64, Span)>,
    /// The values that are not blank, by their place on the line from 0.
    pub values: Vec<(usize, f64, Span)>,
    pub span: Span,
}

/// What a table of constants runs over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Variable {
    Time,
    Temperature,
}

impl Variable {
    pub fn name(self) -> &'static str {
        match self {
            Variable::Time => "time",
            Variable::Temperature => "temperature",
        }
    }
}

/// `TBFIELD,variable,value` or `TBTEMP,value`
#[derive(Debug, Clone, Copy)]
pub(super) struct FieldValue {
    pub command: &'static str,
    pub variable: Variable,
    pub value: f64,
    pub span: Span,
}

/// The fields of a wear command, of which there may be `limit`.
fn fields<'a>(statement: &Statement<'a>, limit: usize) -> Result<Fields<'a>, Box<Fault>> {
    let command = statement.upper_name();
    let fields = statement.fields().ok_or_else(|| {
        let command = command.clone();
        Fault::new(Problem::MissingComma { command }, statement.rest.span)
    })?;
    match fields.iter().skip(limit).find(|field| !field.is_blank()) {
        Some(extra) => Err(Fault::new(Problem::ExtraField { command, limit }, extra.span)),
        None => Ok(Fields { fields, span: statement.span }),
    }
}

struct Fields<'a> {
    fields: Vec<Field<'a>>,
    span: Span,
}

impl<'a> Fields<'a> {
    /// The field at a place from 0, unless it is blank.
    fn get(&self, at: usize) -> Option<&Field<'a>> {
        self.fields.get(at).filter(|field| !field.is_blank())
    }

    /// A whole number, or `None` for a blank field; a value with a fraction is refused where the solver would round.
    fn whole(
        &self,
        at: usize,
        what: &str,
        range: (i64, i64),
        parameters: &Parameters,
    ) -> Result<Option<i64>, Box<Fault>> {
        let Some(field) = self.get(at) else {
            return Ok(None);
        };
        let value = evaluate(field, what, parameters)?;
        let (least, most) = range;
        if value.fract() == 0.0 && value >= least as f64 && value <= most as f64 {
            return Ok(Some(value as i64));
        }
        let what = what.to_owned();
        let problem = Problem::NotWhole { what, value, least, most };
        Err(Fault::new(problem, field.span))
    }
}

/// The largest material number that `law.material` of a scene can name.
const LARGEST_MATERIAL: i64 = u32::MAX as i64;

pub(super) fn open_table(statement: &Statement<'_>, parameters: &Parameters) -> Result<OpenTable, Box<Fault>> {
    let fields = fields(statement, 5)?;
    let option = option(&fields)?;
    let material = fields.whole(1, "MATID of TB", (1, LARGEST_MATERIAL), parameters)?;
    fields.whole(2, "NTEMP of TB", (0, i64::from(i32::MAX)), parameters)?;
    let least = i64::from(option == TableOption::User);
    let points = fields.whole(3, "NPTS of TB", (least, MOST_CONSTANTS as i64), parameters)?;
    Ok(OpenTable {
        // a blank material number means material 1 to the material commands of a deck
        material: material.unwrap_or(1),
        option,
        constants: points.map(|points| points as usize),
        span: statement.span,
    })
}

fn option(fields: &Fields<'_>) -> Result<TableOption, Box<Fault>> {
    let Some(field) = fields.get(4) else {
        return Err(Fault::new(Problem::MissingOption, fields.span));
    };
    let known = TableOption::ALL.into_iter().find(|option| option.name().eq_ignore_ascii_case(field.text));
    known.ok_or_else(|| {
        let names = TableOption::ALL.into_iter().map(TableOption::name);
        let problem = Problem::UnknownOption { found: field.text.to_owned(), nearest: nearest(field.text, names) };
        Fault::new(problem, field.span)
    })
}

pub(super) fn data(statement: &Statement<'_>, parameters: &Parameters) -> Result<Data, Box<Fault>> {
    let fields = fields(statement, 1 + VALUES_PER_LINE)?;
    let number = |at: usize, what: &str| match fields.get(at) {
        Some(field) => evaluate(field, what, parameters).map(|value| Some((value, field.span))),
        None => Ok(None),
    };
    let location = number(0, "STLOC of TBDATA")?;
    let mut values = Vec::new();
    for place in 0..VALUES_PER_LINE {
        let what = format!("value {} of TBDATA", place + 1);
        if let Some((value, span)) = number(1 + place, &what)? {
            values.push((place, value, span));
        }
    }
    Ok(Data { location, values, span: statement.span })
}

pub(super) fn field_value(statement: &Statement<'_>, parameters: &Parameters) -> Result<FieldValue, Box<Fault>> {
    let fields = fields(statement, 2)?;
    let missing = |what: &str| {
        let what = what.to_owned();
        Fault::new(Problem::MissingValue { what }, fields.span)
    };
    let variable = fields.get(0).ok_or_else(|| missing("the type of TBFIELD"))?;
    let variable = match variable.text.to_ascii_uppercase().as_str() {
        "TIME" => Variable::Time,
        "TEMP" => Variable::Temperature,
        _ => {
            let found = variable.text.to_owned();
            return Err(Fault::new(Problem::UnknownVariable { found }, variable.span));
        }
    };
    let value = fields.get(1).ok_or_else(|| missing("TBFIELD"))?;
    Ok(FieldValue {
        command: "TBFIELD",
        variable,
        value: evaluate(value, "value of TBFIELD", parameters)?,
        span: statement.span,
    })
}

pub(super) fn temperature(statement: &Statement<'_>, parameters: &Parameters) -> Result<FieldValue, Box<Fault>> {
    let fields = fields(statement, 2)?;
    if let Some(mode) = fields.get(1) {
        return Err(Fault::new(Problem::ModifiedTemperature, mode.span));
    }
    let value = match fields.get(0) {
        Some(field) => evaluate(field, "temperature of TBTEMP", parameters)?,
        // blank TEMP: the documented default of TBTEMP
        None => 0.0,
    };
    Ok(FieldValue { command: "TBTEMP", variable: Variable::Temperature, value, span: statement.span })
}
