//! From the table that a law filled to a validated description.

use std::ffi::c_char;

use wearlaw_plugin_api::abi;

mod error;
#[cfg(test)]
mod tests;

pub use error::{DescribeError, MOST_QUANTITIES};

use super::descriptor::{Degree, LawDescriptor, Quantity};
use super::fields::{Claims, Field, Fields, Flags, OutputItem, OutputItems};

/// Asks the law to describe item `index` of `kind`: its answer and the struct it filled.
pub type Ask<'f> = &'f mut dyn FnMut(i32, i64) -> (i32, abi::Quantity);

/// Validates the table of one law; `ask` is its `describe` function, if it has one.
pub fn describe(table: &abi::LawTable, mut ask: Option<Ask<'_>>) -> Result<LawDescriptor, DescribeError> {
    let name = text(&table.name, "the law's name")?;
    if name.is_empty() || !name.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-_".contains(&byte)) {
        return Err(DescribeError::Name {
            what: "the law's name".to_owned(),
            found: name,
            expected: "letters, digits, `-` and `_`",
        });
    }
    if table.evaluate.is_none() {
        return Err(DescribeError::NoEvaluate);
    }
    masks_and_counts(table)?;
    if let Some(error) = unknown_field(table, &mut ask) {
        return Err(error);
    }
    let (constants, state, inputs) = (table.constant_count, table.state_count, table.input_count);
    if ask.is_none() && constants + state + inputs > 0 {
        return Err(DescribeError::NoDescribe { constants, state, inputs });
    }
    let constants = quantities(&mut ask, abi::WL_KIND_CONSTANT, "constant", constants)?;
    let mut closing = constants.iter().filter(|constant| constant.closes_units);
    if let (Some(first), Some(second)) = (closing.next(), closing.next()) {
        let (first, second) = (first.name.clone(), second.name.clone());
        return Err(DescribeError::TwoCloseUnits { first, second });
    }
    let writes = OutputItems::from_bits(table.writes & abi::WL_OUTS_KNOWN);
    if state > 0 && !writes.contains(OutputItem::State) {
        return Err(DescribeError::StateNotWritten { count: state });
    }
    let state = quantities(&mut ask, abi::WL_KIND_STATE, "state variable", state)?;
    let inputs = quantities(&mut ask, abi::WL_KIND_INPUT, "input", inputs)?;
    if let Some(input) = inputs.iter().find(|input| Field::from_name(&input.name).is_some()) {
        return Err(DescribeError::FieldName { name: input.name.clone() });
    }
    Ok(LawDescriptor {
        name,
        version: text(&table.version, "the law's version")?,
        summary: text(&table.summary, "the law's summary")?,
        source: text(&table.source, "the law's source")?,
        abi_minor: table.abi_minor,
        reads: Fields::from_bits(table.reads),
        // What a newer law can use and an older host cannot give stays absent.
        uses: Fields::from_bits(table.uses & abi::WL_FIELDS_KNOWN),
        writes,
        claims: Claims::from_bits(table.claims & abi::WL_CLAIMS_KNOWN),
        flags: Flags::from_bits(table.flags & abi::WL_FLAGS_KNOWN),
        constants,
        state,
        inputs,
        pressure_degree: pressure_degree(table)?,
    })
}

fn masks_and_counts(table: &abi::LawTable) -> Result<(), DescribeError> {
    let masks = [
        ("`reads`", table.reads),
        ("`uses`", table.uses),
        ("`writes`", table.writes),
        ("`claims`", table.claims),
        ("`flags`", table.flags),
    ];
    if let Some((what, found)) = masks.into_iter().find(|(_, mask)| *mask < 0) {
        return Err(DescribeError::NegativeMask { what, found });
    }
    let counts = [
        ("`constant_count`", table.constant_count),
        ("`state_count`", table.state_count),
        ("`input_count`", table.input_count),
    ];
    if let Some((what, found)) = counts.into_iter().find(|(_, count)| !(0..=MOST_QUANTITIES).contains(count)) {
        return Err(DescribeError::Count { what, found });
    }
    Ok(())
}

fn unknown_field(table: &abi::LawTable, ask: &mut Option<Ask<'_>>) -> Option<DescribeError> {
    let unknown = Fields::from_bits(table.reads).unknown();
    if unknown == 0 {
        return None;
    }
    let bit = unknown.trailing_zeros();
    let name = ask.as_mut().and_then(|ask| {
        let (status, quantity) = ask(abi::WL_KIND_FIELD, i64::from(bit));
        let name = text(&quantity.name, "a field's name").ok()?;
        (status == abi::WL_OK && !name.is_empty()).then_some(name)
    });
    let (host_minor, law_minor) = (i64::from(abi::WL_ABI_MINOR), table.abi_minor);
    Some(DescribeError::UnknownField { name, bit, host_minor, law_minor })
}

fn pressure_degree(table: &abi::LawTable) -> Result<Degree, DescribeError> {
    let (value, index) = (table.pressure_degree, table.pressure_degree_constant);
    let count = table.constant_count;
    if index < -1 || index >= count {
        return Err(DescribeError::DegreeIndex { index, count });
    }
    match (value.is_nan(), usize::try_from(index)) {
        (true, Ok(index)) => Ok(Degree::Constant(index)),
        (true, Err(_)) => Ok(Degree::Unclaimed),
        (false, Ok(_)) => Err(DescribeError::TwoDegrees { value, index }),
        (false, Err(_)) if value.is_finite() => Ok(Degree::Value(value)),
        (false, Err(_)) => Err(DescribeError::Number {
            what: "the pressure degree".to_owned(),
            found: value,
            expected: "a finite number, or NaN for no claim",
        }),
    }
}

fn quantities(
    ask: &mut Option<Ask<'_>>,
    kind: i32,
    word: &'static str,
    count: i64,
) -> Result<Vec<Quantity>, DescribeError> {
    let mut found: Vec<Quantity> = Vec::new();
    let Some(ask) = ask.as_mut() else {
        return Ok(found);
    };
    for index in 0..count {
        let (status, raw) = ask(kind, index);
        if status != abi::WL_OK {
            return Err(DescribeError::Describe { kind: word, index, status });
        }
        let quantity = quantity(&raw, word, index)?;
        if found.iter().any(|other| other.name == quantity.name) {
            return Err(DescribeError::Duplicate { kind: word, name: quantity.name });
        }
        found.push(quantity);
    }
    Ok(found)
}

fn quantity(raw: &abi::Quantity, kind: &'static str, index: i64) -> Result<Quantity, DescribeError> {
    let name = text(&raw.name, &format!("the name of {kind} {index}"))?;
    let starts = name.bytes().next().is_some_and(|byte| byte.is_ascii_alphabetic());
    if !starts || !name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_') {
        return Err(DescribeError::Name {
            what: format!("the name of {kind} {index}"),
            found: name,
            expected: "a letter, then letters, digits and underscores",
        });
    }
    let exponents = [raw.metre, raw.kilogram, raw.second, raw.kelvin];
    let number = |what: &str, found: f64, expected: &'static str| DescribeError::Number {
        what: format!("{what} of {kind} `{name}`"),
        found,
        expected,
    };
    if let Some(exponent) = exponents.into_iter().find(|exponent| !exponent.is_finite()) {
        return Err(number("an exponent", exponent, "a finite number"));
    }
    for (what, bound) in [("the minimum", raw.minimum), ("the maximum", raw.maximum)] {
        if bound.is_nan() {
            return Err(number(what, bound, "a number or an infinity"));
        }
    }
    if raw.default_value.is_infinite() {
        return Err(number("the default", raw.default_value, "a finite number, or NaN for none"));
    }
    let quantity = Quantity {
        summary: text(&raw.summary, &format!("the summary of {kind} `{name}`"))?,
        exponents,
        minimum: raw.minimum,
        maximum: raw.maximum,
        default: (!raw.default_value.is_nan()).then_some(raw.default_value),
        closes_units: raw.flags & abi::WL_QUANTITY_CLOSES_UNITS != 0,
        above_minimum: raw.flags & abi::WL_QUANTITY_ABOVE_MINIMUM != 0,
        below_maximum: raw.flags & abi::WL_QUANTITY_BELOW_MAXIMUM != 0,
        name,
    };
    let open = quantity.above_minimum || quantity.below_maximum || quantity.minimum.is_infinite();
    if quantity.minimum > quantity.maximum || (open && quantity.minimum == quantity.maximum) {
        return Err(DescribeError::Bounds {
            kind,
            name: quantity.name,
            minimum: quantity.minimum,
            maximum: quantity.maximum,
        });
    }
    if let Some(default) = quantity.default
        && !quantity.allows(default)
    {
        let interval = quantity.interval();
        return Err(DescribeError::Default { kind, name: quantity.name, default, interval });
    }
    if quantity.closes_units && kind != "constant" {
        return Err(DescribeError::ClosesUnits { kind, name: quantity.name });
    }
    Ok(quantity)
}

fn text(bytes: &[c_char], what: &str) -> Result<String, DescribeError> {
    let bytes: Vec<u8> = bytes.iter().map(|byte| byte.to_ne_bytes()[0]).collect();
    let Some(end) = bytes.iter().position(|byte| *byte == 0) else {
        return Err(DescribeError::Unterminated { what: what.to_owned(), size: bytes.len() });
    };
    match std::str::from_utf8(&bytes[..end]) {
        Err(_) => Err(DescribeError::NotUtf8 {
            what: what.to_owned(),
            found: String::from_utf8_lossy(&bytes[..end]).into_owned(),
        }),
        Ok(found) if found.chars().any(char::is_control) => {
            Err(DescribeError::NotOneLine { what: what.to_owned(), found: found.to_owned() })
        }
        Ok(found) => Ok(found.to_owned()),
    }
}
