//! From what a scene gives to the constants a law sees: by name or by position, with defaults and bounds.

use thiserror::Error;

use super::descriptor::{LawDescriptor, Quantity};
use super::values::UnitSizes;

/// Constants as a scene gives them, in its own units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GivenConstants<'a> {
    /// Name and value, in any order.
    ByName(&'a [(String, f64)]),
    /// Values in the law's order; none stands for the default, and so does what is left out at the end.
    ByPosition(&'a [Option<f64>]),
}

/// Why constants were refused; positions count from 1.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ConstantsError {
    /// Several names that are not those of constants.
    #[error("law `{law}` has no constants {}; it has {}", list(names), list(known))]
    SeveralUnknown {
        /// The law.
        law: String,
        /// The names given.
        names: Vec<String>,
        /// All names.
        known: Vec<String>,
    },
    /// No constant of that name.
    #[error("law `{law}` has no constant `{name}`{}; it has {}", nearest.as_ref().map(|near| format!(" (did you mean `{near}`?)")).unwrap_or_default(), list(known))]
    Unknown {
        /// The law.
        law: String,
        /// The name given.
        name: String,
        /// The nearest name that it has.
        nearest: Option<String>,
        /// All names.
        known: Vec<String>,
    },
    /// The same name twice.
    #[error("constant `{name}` of law `{law}` is given twice")]
    Twice {
        /// The law.
        law: String,
        /// The name.
        name: String,
    },
    /// More values than constants.
    #[error("{found} constants are given, law `{law}` has {expected}: {}", list(known))]
    TooMany {
        /// The law.
        law: String,
        /// Values given.
        found: usize,
        /// Constants it has.
        expected: usize,
        /// Their names.
        known: Vec<String>,
    },
    /// A constant without a default was not given.
    #[error("constant `{name}` (number {position}) of law `{law}` is not given and has no default: {summary}")]
    Required {
        /// The law.
        law: String,
        /// The name.
        name: String,
        /// Its number, from 1.
        position: usize,
        /// What it is.
        summary: String,
    },
    /// A value outside its bounds.
    #[error("constant `{name}` of law `{law}` is {found}{}, expected {} in {interval}", in_si(*found, *found_si), if *found_si == *found { "a value" } else { "an SI value" })]
    OutOfBounds {
        /// The law.
        law: String,
        /// The name.
        name: String,
        /// Value in the scene's units.
        found: f64,
        /// Value in SI units.
        found_si: f64,
        /// The bounds in SI units, `(0, inf)`.
        interval: String,
    },
}

impl ConstantsError {
    /// The name of the constant that a scene gives wrongly, where there is one to point at.
    pub fn constant(&self) -> Option<&str> {
        match self {
            Self::Unknown { name, .. } | Self::Twice { name, .. } | Self::OutOfBounds { name, .. } => Some(name),
            Self::SeveralUnknown { .. } | Self::TooMany { .. } | Self::Required { .. } => None,
        }
    }
}

fn list(names: &[String]) -> String {
    if names.is_empty() {
        return "none".to_owned();
    }
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

fn in_si(found: f64, si: f64) -> String {
    if found == si { String::new() } else { format!(" ({si} in SI units)") }
}

impl LawDescriptor {
    /// The constants in the law's order and the scene's units, with defaults filled in and bounds checked.
    ///
    /// A dimensional bound of the constant that closes the units holds in SI units only, since its exponents follow
    /// from the others; in other units its sign is checked and nothing else.
    ///
    /// # Errors
    /// An unknown name, one given twice, too many values, a required one left out, or a value out of bounds.
    pub fn resolve_constants(&self, given: GivenConstants<'_>, units: UnitSizes) -> Result<Vec<f64>, ConstantsError> {
        let values = match given {
            GivenConstants::ByName(pairs) => self.by_name(pairs)?,
            GivenConstants::ByPosition(values) => self.by_position(values)?,
        };
        let mut resolved = Vec::with_capacity(values.len());
        for (index, (constant, value)) in self.constants.iter().zip(values).enumerate() {
            let factor = units.factor(constant.exponents);
            let value = match (value, constant.default) {
                (Some(value), _) => value,
                (None, Some(default)) => default / factor,
                (None, None) => {
                    return Err(ConstantsError::Required {
                        law: self.name.clone(),
                        name: constant.name.clone(),
                        position: index + 1,
                        summary: constant.summary.clone(),
                    });
                }
            };
            if !keeps_bounds(constant, value, factor) {
                return Err(ConstantsError::OutOfBounds {
                    law: self.name.clone(),
                    name: constant.name.clone(),
                    found: value,
                    found_si: value * factor,
                    interval: constant.interval(),
                });
            }
            resolved.push(value);
        }
        Ok(resolved)
    }

    fn constant_names(&self) -> Vec<String> {
        self.constants.iter().map(|constant| constant.name.clone()).collect()
    }

    fn by_name(&self, pairs: &[(String, f64)]) -> Result<Vec<Option<f64>>, ConstantsError> {
        let mut values = vec![None; self.constants.len()];
        let is_known = |name: &str| self.constants.iter().any(|constant| constant.name == name);
        let unknown = pairs.iter().map(|(name, _)| name.clone()).filter(|name| !is_known(name));
        let names: Vec<String> = unknown.collect();
        if names.len() > 1 {
            // Those of another law: to name one of them would hide that all are.
            return Err(ConstantsError::SeveralUnknown { law: self.name.clone(), names, known: self.constant_names() });
        }
        for (name, value) in pairs {
            let Some(index) = self.constants.iter().position(|constant| constant.name == *name) else {
                return Err(ConstantsError::Unknown {
                    law: self.name.clone(),
                    name: name.clone(),
                    nearest: nearest(name, &self.constants),
                    known: self.constant_names(),
                });
            };
            if values[index].replace(*value).is_some() {
                return Err(ConstantsError::Twice { law: self.name.clone(), name: name.clone() });
            }
        }
        Ok(values)
    }

    fn by_position(&self, given: &[Option<f64>]) -> Result<Vec<Option<f64>>, ConstantsError> {
        if given.len() > self.constants.len() {
            return Err(ConstantsError::TooMany {
                law: self.name.clone(),
                found: given.len(),
                expected: self.constants.len(),
                known: self.constant_names(),
            });
        }
        let mut values = given.to_vec();
        values.resize(self.constants.len(), None);
        Ok(values)
    }
}

/// The quantity whose name was probably meant.
pub fn nearest(name: &str, known: &[Quantity]) -> Option<String> {
    known
        .iter()
        .map(|quantity| {
            let same_letters =
                strsim::normalized_damerau_levenshtein(&quantity.name.to_lowercase(), &name.to_lowercase());
            (same_letters, &quantity.name)
        })
        .filter(|(likeness, _)| *likeness > 0.5)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name.clone())
}

/// The bounds are in SI units; those of the constant that closes the units survive a change of units by their sign alone.
fn keeps_bounds(constant: &Quantity, value: f64, factor: f64) -> bool {
    if !constant.closes_units || factor == 1.0 {
        return constant.allows(value * factor);
    }
    let free = |bound: f64, none: f64| {
        if bound == 0.0 || bound.is_infinite() { bound } else { none }
    };
    let signs = Quantity {
        minimum: free(constant.minimum, f64::NEG_INFINITY),
        maximum: free(constant.maximum, f64::INFINITY),
        ..constant.clone()
    };
    signs.allows(value)
}

#[cfg(test)]
mod tests {
    use super::super::test_laws::{constant, plain};
    use super::*;

    const MILLIMETRES: UnitSizes = UnitSizes { metre: 1e-3, kilogram: 1e3, second: 1.0, kelvin: 1.0 };

    fn law() -> LawDescriptor {
        let positive = |name: &str| Quantity { minimum: 0.0, above_minimum: true, ..constant(name) };
        LawDescriptor {
            constants: vec![
                Quantity {
                    minimum: 0.0,
                    maximum: 1.0,
                    closes_units: true,
                    exponents: [1.0, 0.0, 0.0, 0.0],
                    ..constant("K")
                },
                Quantity { maximum: 1e11, exponents: [-1.0, 1.0, -2.0, 0.0], ..positive("hardness") },
                Quantity { default: Some(2.0), ..positive("m") },
                Quantity { default: Some(5e6), exponents: [-1.0, 1.0, -2.0, 0.0], ..positive("threshold") },
            ],
            ..plain("archard")
        }
    }

    fn named(pairs: &[(&str, f64)], units: UnitSizes) -> Result<Vec<f64>, String> {
        let pairs: Vec<(String, f64)> = pairs.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
        law().resolve_constants(GivenConstants::ByName(&pairs), units).map_err(|error| error.to_string())
    }

    fn placed(values: &[Option<f64>]) -> Result<Vec<f64>, String> {
        law().resolve_constants(GivenConstants::ByPosition(values), UnitSizes::SI).map_err(|error| error.to_string())
    }

    #[test]
    fn names_positions_and_defaults_give_the_same_constants() {
        let all = vec![1e-4, 1e9, 2.0, 5e6];
        assert_eq!(named(&[("hardness", 1e9), ("K", 1e-4)], UnitSizes::SI), Ok(all.clone()));
        assert_eq!(placed(&[Some(1e-4), Some(1e9)]), Ok(all.clone()));
        assert_eq!(placed(&[Some(1e-4), Some(1e9), None, Some(5e6)]), Ok(all));
    }

    #[test]
    fn defaults_and_bounds_follow_the_units() {
        // Tonne, millimetre, second: pressures are in MPa.
        let resolved = named(&[("hardness", 1e3), ("K", 500.0)], MILLIMETRES).expect("within the bounds");
        assert_eq!(resolved[..3], [500.0, 1e3, 2.0]);
        assert!((resolved[3] - 5.0).abs() < 1e-12, "{resolved:?}");
        let said = named(&[("hardness", 2e5), ("K", 1.0)], MILLIMETRES).expect_err("2e11 Pa");
        assert!(said.starts_with("constant `hardness` of law `archard` is 200000 (2"), "{said}");
        assert!(said.ends_with("in SI units), expected an SI value in (0, 100000000000]"), "{said}");
        let said = named(&[("hardness", 1e3), ("K", -1.0)], MILLIMETRES).expect_err("the sign is checked in any units");
        assert!(said.contains("`K`") && said.contains("is -1"), "{said}");
    }

    #[test]
    fn every_mistake_names_the_constant() {
        let said = |result: Result<Vec<f64>, String>| result.expect_err("a mistake");
        assert_eq!(
            said(named(&[("k", 1.0)], UnitSizes::SI)),
            "law `archard` has no constant `k` (did you mean `K`?); it has `K`, `hardness`, `m`, `threshold`"
        );
        assert_eq!(
            said(named(&[("m", 1.0), ("m", 2.0)], UnitSizes::SI)),
            "constant `m` of law `archard` is given twice"
        );
        assert_eq!(
            said(placed(&[Some(1e-4)])),
            "constant `hardness` (number 2) of law `archard` is not given and has no default: a number of the tests"
        );
        assert_eq!(
            said(placed(&[Some(1.0); 5])),
            "5 constants are given, law `archard` has 4: `K`, `hardness`, `m`, `threshold`"
        );
        assert_eq!(
            said(placed(&[Some(1e-4), Some(0.0)])),
            "constant `hardness` of law `archard` is 0, expected a value in (0, 100000000000]"
        );
        for wrong in [f64::NAN, f64::INFINITY] {
            assert!(said(placed(&[Some(1e-4), Some(1.0), Some(wrong)])).contains("`m`"));
        }
    }
}
