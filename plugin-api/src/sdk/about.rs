//! What a law says of itself, and the trait of a law over a batch.

use core::ffi::CStr;

use crate::abi::{
    WL_CUT_STEP, WL_FAILED, WL_MISSING_INPUT, WL_OK, WL_OUT_OF_DOMAIN, WL_QUANTITY_ABOVE_MINIMUM,
    WL_QUANTITY_BELOW_MAXIMUM, WL_QUANTITY_CLOSES_UNITS, WL_UNRELIABLE,
};

use super::{Answer, Batch};

/// The extension that is a law's own table of known values, as `expected.csv` has them: a text closed by NUL.
pub const SELFTEST: &CStr = c"wearlaw.selftest/1";

/// How good an answer is, from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(i32)]
pub enum Status {
    /// The values are good.
    Ok = WL_OK,
    /// The values may be used, with a warning.
    Unreliable = WL_UNRELIABLE,
    /// The values are void; a shorter substep may work.
    CutStep = WL_CUT_STEP,
    /// The values are void and a shorter substep does not help.
    OutOfDomain = WL_OUT_OF_DOMAIN,
    /// An input that the law needs is not there.
    MissingInput = WL_MISSING_INPUT,
    /// The law failed.
    Failed = WL_FAILED,
}

/// SI exponents of a unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Exponent of the metre.
    pub metre: f64,
    /// Exponent of the kilogram.
    pub kilogram: f64,
    /// Exponent of the second.
    pub second: f64,
    /// Exponent of the kelvin.
    pub kelvin: f64,
}

impl Unit {
    /// A plain number.
    pub const NUMBER: Unit = Unit::new(0.0, 0.0, 0.0, 0.0);
    /// Length.
    pub const METRE: Unit = Unit::new(1.0, 0.0, 0.0, 0.0);
    /// Per length.
    pub const PER_METRE: Unit = Unit::new(-1.0, 0.0, 0.0, 0.0);
    /// Area.
    pub const SQUARE_METRE: Unit = Unit::new(2.0, 0.0, 0.0, 0.0);
    /// Mass.
    pub const KILOGRAM: Unit = Unit::new(0.0, 1.0, 0.0, 0.0);
    /// Time.
    pub const SECOND: Unit = Unit::new(0.0, 0.0, 1.0, 0.0);
    /// Rate, frequency.
    pub const PER_SECOND: Unit = Unit::new(0.0, 0.0, -1.0, 0.0);
    /// Temperature difference.
    pub const KELVIN: Unit = Unit::new(0.0, 0.0, 0.0, 1.0);
    /// Per degree of temperature.
    pub const PER_KELVIN: Unit = Unit::new(0.0, 0.0, 0.0, -1.0);
    /// Force.
    pub const NEWTON: Unit = Unit::new(1.0, 1.0, -2.0, 0.0);
    /// Work, activation energy.
    pub const JOULE: Unit = Unit::new(2.0, 1.0, -2.0, 0.0);
    /// Pressure, stress, hardness.
    pub const PASCAL: Unit = Unit::new(-1.0, 1.0, -2.0, 0.0);
    /// Specific wear rate (volume per force and distance).
    pub const PER_PASCAL: Unit = Unit::new(1.0, -1.0, 2.0, 0.0);
    /// Change of a pressure with the temperature.
    pub const PASCAL_PER_KELVIN: Unit = Unit::new(-1.0, 1.0, -2.0, -1.0);
    /// Sliding velocity.
    pub const METRE_PER_SECOND: Unit = Unit::new(1.0, 0.0, -1.0, 0.0);
    /// Work per area.
    pub const JOULE_PER_SQUARE_METRE: Unit = Unit::new(0.0, 1.0, -2.0, 0.0);
    /// Heat flux.
    pub const WATT_PER_SQUARE_METRE: Unit = Unit::new(0.0, 1.0, -3.0, 0.0);
    /// Density.
    pub const KILOGRAM_PER_CUBIC_METRE: Unit = Unit::new(-3.0, 1.0, 0.0, 0.0);

    /// A unit from its SI exponents.
    pub const fn new(metre: f64, kilogram: f64, second: f64, kelvin: f64) -> Unit {
        Unit { metre, kilogram, second, kelvin }
    }
}

/// A constant, state variable or further input. Bounds and default are in SI units.
#[derive(Clone, Copy, Debug)]
pub struct Quantity {
    pub(crate) name: &'static str,
    pub(crate) summary: &'static str,
    pub(crate) unit: Unit,
    pub(crate) minimum: f64,
    pub(crate) maximum: f64,
    pub(crate) default: f64,
    pub(crate) flags: i64,
}

impl Quantity {
    /// A quantity without bounds that must be given (a state variable starts at 0).
    pub const fn new(name: &'static str, unit: Unit) -> Quantity {
        Quantity {
            name,
            summary: "",
            unit,
            minimum: f64::NEG_INFINITY,
            maximum: f64::INFINITY,
            default: f64::NAN,
            flags: 0,
        }
    }
    /// Says in one line what it is.
    pub const fn about(mut self, summary: &'static str) -> Self {
        self.summary = summary;
        self
    }
    /// Allows `bound` and more.
    pub const fn at_least(mut self, bound: f64) -> Self {
        self.minimum = bound;
        self
    }
    /// Allows more than `bound`.
    pub const fn above(mut self, bound: f64) -> Self {
        self.minimum = bound;
        self.flags |= WL_QUANTITY_ABOVE_MINIMUM;
        self
    }
    /// Allows `bound` and less.
    pub const fn at_most(mut self, bound: f64) -> Self {
        self.maximum = bound;
        self
    }
    /// Allows less than `bound`.
    pub const fn below(mut self, bound: f64) -> Self {
        self.maximum = bound;
        self.flags |= WL_QUANTITY_BELOW_MAXIMUM;
        self
    }
    /// Default of a constant or input; initial value of a state variable.
    pub const fn default(mut self, value: f64) -> Self {
        self.default = value;
        self
    }
    /// Marks the one constant whose unit follows from the others.
    pub const fn closes_units(mut self) -> Self {
        self.flags |= WL_QUANTITY_CLOSES_UNITS;
        self
    }
}

/// The claim that the increment is homogeneous of some degree in the pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Degree {
    /// Nothing is claimed.
    Unclaimed,
    /// Homogeneous of this degree.
    Value(f64),
    /// Homogeneous of the degree that this constant (index from 0) holds.
    Constant(usize),
}

/// What a law says of itself. Masks are the `WL_` constants of [`crate::abi`], joined with `|`.
pub trait About: Sized + Send + Sync + 'static {
    /// Name: letters, digits, `-` and `_`.
    const NAME: &'static str;
    /// Version of the law; empty: that of the crate that exports it.
    const VERSION: &'static str = "";
    /// One line on what it does; empty: the description of the crate that exports it.
    const SUMMARY: &'static str = "";
    /// Where the equation comes from.
    const SOURCE: &'static str = "";
    /// `WL_FIELD_` bits that it must have.
    const READS: i64;
    /// `WL_FIELD_` bits that it uses if they are there.
    const USES: i64 = 0;
    /// `WL_OUT_` bits that it can write; that of the state is added where there are state variables.
    const WRITES: i64 = 0;
    /// `WL_CLAIM_` bits.
    const CLAIMS: i64 = 0;
    /// `WL_FLAG_` bits.
    const FLAGS: i64 = 0;
    /// Constants, in the order in which a call gives them.
    const CONSTANTS: &'static [Quantity] = &[];
    /// State variables.
    const STATE: &'static [Quantity] = &[];
    /// Further inputs by name.
    const INPUTS: &'static [Quantity] = &[];
    /// Homogeneity in the pressure.
    const DEGREE: Degree = Degree::Unclaimed;

    /// Known values that the plugin carries, the text of an `expected.csv`: the extension [`SELFTEST`].
    const KNOWN_VALUES: Option<&'static CStr> = None;

    /// The instance of a law that takes no options; a law that takes some writes its own `create` instead.
    const INSTANCE: Option<Self> = None;

    /// Makes an instance; `options` is the scene's `[law] options`.
    ///
    /// # Errors
    /// A sentence that says what is wrong with the options.
    fn create(options: Option<&str>) -> Result<Self, String> {
        let name = Self::NAME;
        match options {
            None | Some("") => Self::INSTANCE.ok_or_else(|| format!("{name} was written without INSTANCE or create")),
            Some(options) => Err(format!("found options \"{options}\", expected none: {name} has no options")),
        }
    }
}

/// A law that takes a batch at a time.
pub trait Law: About {
    /// Evaluates the law at every point of `batch`, writes every item that `answer` holds, and returns the worst
    /// status.
    fn evaluate(&self, batch: &Batch<'_>, answer: &mut Answer<'_>) -> Status;

    /// Answers a call of which the increments alone are wanted, `increment[points]`, with less ado than
    /// [`evaluate`](Law::evaluate); true if every one is written and good. Otherwise, which is what a law does that has
    /// no such way, `evaluate` answers.
    #[inline]
    fn increments(&self, batch: &Batch<'_>, increment: &mut [f64]) -> bool {
        let _ = (batch, increment);
        false
    }
}
