//! The fields, outputs, claims and flags of the ABI: their names, bits, units and shapes.

use serde::{Deserialize, Serialize};
use wearlaw_plugin_api::abi;

/// What one point has of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One double.
    Scalar,
    /// Three adjacent doubles in the global frame.
    Vector,
    /// One 64-bit integer.
    Index,
}

impl Shape {
    /// Numbers at one point.
    pub const fn width(self) -> usize {
        match self {
            Shape::Vector => 3,
            Shape::Scalar | Shape::Index => 1,
        }
    }
}

macro_rules! names {
    (
        $(#[$about:meta])* $one:ident, $what:literal, $known:expr;
        $( $(#[$doc:meta])* $variant:ident = $bit:expr, $name:literal; )*
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $one { $( $(#[$doc])* $variant, )* }

        impl $one {
            #[doc = concat!("Every ", $what, " that this version of the ABI knows, in the order of its bits.")]
            pub const ALL: &'static [$one] = &[$( $one::$variant, )*];

            /// The one bit that stands for it in a mask.
            pub const fn bit(self) -> i64 {
                match self { $( $one::$variant => $bit, )* }
            }

            /// Its name in scenes, reports and messages.
            pub const fn name(self) -> &'static str {
                match self { $( $one::$variant => $name, )* }
            }

            #[doc = concat!("The ", $what, " of that name.")]
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|one| one.name() == name)
            }
        }

        impl Named for $one {
            const KNOWN: i64 = $known;
            const ALL: &'static [Self] = Self::ALL;
            fn bit(self) -> i64 { $one::bit(self) }
            fn name(self) -> &'static str { $one::name(self) }
        }
    };
}

/// One named bit of a mask.
pub trait Named: Copy + 'static {
    /// All bits that this version of the ABI knows.
    const KNOWN: i64;
    /// Every named bit.
    const ALL: &'static [Self];
    /// The bit.
    fn bit(self) -> i64;
    /// The name.
    fn name(self) -> &'static str;
}

names! {
    /// A field of the view: what a law can read at a point.
    Field, "field", abi::WL_FIELDS_KNOWN;
    /// Contact pressure, positive in compression.
    Pressure = abi::WL_FIELD_PRESSURE, "pressure";
    /// Slip increment over the substep.
    Slip = abi::WL_FIELD_SLIP, "slip";
    /// Sliding velocity.
    Velocity = abi::WL_FIELD_VELOCITY, "velocity";
    /// Net tangential displacement over the substep.
    SlipVector = abi::WL_FIELD_SLIP_VECTOR, "slip_vector";
    /// Outward unit normal of the worn body.
    Normal = abi::WL_FIELD_NORMAL, "normal";
    /// Position.
    Coordinates = abi::WL_FIELD_COORDINATES, "coordinates";
    /// First unit tangent.
    Tangent = abi::WL_FIELD_TANGENT, "tangent";
    /// Temperature of the worn surface.
    Temperature = abi::WL_FIELD_TEMPERATURE, "temperature";
    /// Temperature of the counter surface.
    CounterTemperature = abi::WL_FIELD_COUNTER_TEMPERATURE, "counter_temperature";
    /// Friction stress on the worn body.
    FrictionStress = abi::WL_FIELD_FRICTION_STRESS, "friction_stress";
    /// Friction coefficient.
    FrictionCoefficient = abi::WL_FIELD_FRICTION_COEFFICIENT, "friction_coefficient";
    /// Friction work per area over the substep.
    FrictionWork = abi::WL_FIELD_FRICTION_WORK, "friction_work";
    /// Wear depth at the start of the substep.
    AccumulatedWear = abi::WL_FIELD_ACCUMULATED_WEAR, "accumulated_wear";
    /// Sliding distance at the start of the substep.
    AccumulatedSlip = abi::WL_FIELD_ACCUMULATED_SLIP, "accumulated_slip";
    /// Normal traction from nodal stresses.
    NodalTraction = abi::WL_FIELD_NODAL_TRACTION, "nodal_traction";
    /// Gap, negative is penetration.
    Gap = abi::WL_FIELD_GAP, "gap";
    /// Area of the point.
    Area = abi::WL_FIELD_AREA, "area";
    /// Contact state: open, stick or sliding.
    ContactState = abi::WL_FIELD_CONTACT_STATE, "contact_state";
    /// Number of the point in the host's numbering.
    PointId = abi::WL_FIELD_POINT_ID, "point_id";
    /// Number of the contact element.
    ElementId = abi::WL_FIELD_ELEMENT_ID, "element_id";
}

impl Field {
    /// What one point has of it.
    pub const fn shape(self) -> Shape {
        match self {
            Field::SlipVector | Field::Normal | Field::Coordinates | Field::Tangent | Field::FrictionStress => {
                Shape::Vector
            }
            Field::ContactState | Field::PointId | Field::ElementId => Shape::Index,
            _ => Shape::Scalar,
        }
    }

    /// SI exponents of metre, kilogram, second and kelvin; `area` as in 3-D.
    pub const fn exponents(self) -> [f64; 4] {
        match self {
            Field::Pressure | Field::FrictionStress | Field::NodalTraction => [-1.0, 1.0, -2.0, 0.0],
            Field::Slip
            | Field::SlipVector
            | Field::Coordinates
            | Field::AccumulatedWear
            | Field::AccumulatedSlip
            | Field::Gap => [1.0, 0.0, 0.0, 0.0],
            Field::Velocity => [1.0, 0.0, -1.0, 0.0],
            Field::FrictionWork => [0.0, 1.0, -2.0, 0.0],
            Field::Temperature | Field::CounterTemperature => [0.0, 0.0, 0.0, 1.0],
            Field::Area => [2.0, 0.0, 0.0, 0.0],
            Field::Normal
            | Field::Tangent
            | Field::FrictionCoefficient
            | Field::ContactState
            | Field::PointId
            | Field::ElementId => [0.0; 4],
        }
    }
}

names! {
    /// An optional output of a law; the wear increment is always written.
    OutputItem, "output", abi::WL_OUTS_KNOWN;
    /// Wear direction.
    Direction = abi::WL_OUT_DIRECTION, "direction";
    /// State variables at the end of the substep.
    State = abi::WL_OUT_STATE, "state";
    /// Derivative of the increment with respect to the contact pressure.
    DPressure = abi::WL_OUT_D_PRESSURE, "d_pressure";
    /// Status of every point.
    Status = abi::WL_OUT_STATUS, "status";
}

names! {
    /// A property that a law claims to have.
    Claim, "claim", abi::WL_CLAIMS_KNOWN;
    /// The same inputs give the same bits.
    Deterministic = abi::WL_CLAIM_DETERMINISTIC, "deterministic";
    /// The wear increment is never negative.
    NonNegative = abi::WL_CLAIM_NON_NEGATIVE, "non_negative";
    /// At fixed rates a substep wears as much as its equal parts, one after the other.
    LinearInDt = abi::WL_CLAIM_LINEAR_IN_DT, "linear_in_dt";
    /// No pressure, no wear.
    ZeroWithoutPressure = abi::WL_CLAIM_ZERO_WITHOUT_PRESSURE, "zero_without_pressure";
    /// No slip, no wear.
    ZeroWithoutSlip = abi::WL_CLAIM_ZERO_WITHOUT_SLIP, "zero_without_slip";
    /// Turning the frame turns the direction and leaves the increment.
    FrameIndifferent = abi::WL_CLAIM_FRAME_INDIFFERENT, "frame_indifferent";
}

names! {
    /// A flag of a law that the host obeys.
    Flag, "flag", abi::WL_FLAGS_KNOWN;
    /// One instance must not be evaluated from several threads at once.
    Serial = abi::WL_FLAG_SERIAL, "serial";
    /// The law wants points out of contact too.
    OpenPoints = abi::WL_FLAG_OPEN_POINTS, "open_points";
    /// The derivative has jumps where the law changes branch.
    Kinks = abi::WL_FLAG_KINKS, "kinks";
}

/// A set of named bits; unknown bits are kept, so that a newer law's mask is not altered.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Mask<T> {
    bits: i64,
    of: std::marker::PhantomData<fn() -> T>,
}

/// A set of fields.
pub type Fields = Mask<Field>;
/// A set of optional outputs.
pub type OutputItems = Mask<OutputItem>;
/// A set of claims.
pub type Claims = Mask<Claim>;
/// A set of law flags.
pub type Flags = Mask<Flag>;

impl<T: Named> Mask<T> {
    /// The empty set.
    pub const EMPTY: Self = Self::from_bits(0);

    /// The set of these bits, known or not.
    pub const fn from_bits(bits: i64) -> Self {
        Self { bits, of: std::marker::PhantomData }
    }

    /// The bits, as the ABI has them.
    pub const fn bits(self) -> i64 {
        self.bits
    }

    /// True if it holds nothing, known or unknown.
    pub const fn is_empty(self) -> bool {
        self.bits == 0
    }

    /// True if `one` is in it.
    pub fn contains(self, one: T) -> bool {
        self.bits & one.bit() != 0
    }

    /// The set with `one` in it.
    pub fn with(self, one: T) -> Self {
        Self::from_bits(self.bits | one.bit())
    }

    /// What is in either.
    pub const fn union(self, other: Self) -> Self {
        Self::from_bits(self.bits | other.bits)
    }

    /// What is in both.
    pub const fn intersection(self, other: Self) -> Self {
        Self::from_bits(self.bits & other.bits)
    }

    /// What is in this one and not in the other.
    pub const fn difference(self, other: Self) -> Self {
        Self::from_bits(self.bits & !other.bits)
    }

    /// The bits that this version of the ABI has no name for.
    pub const fn unknown(self) -> i64 {
        self.bits & !T::KNOWN
    }

    /// The known members, in the order of their bits.
    pub fn iter(self) -> impl Iterator<Item = T> {
        T::ALL.iter().copied().filter(move |one| self.contains(*one))
    }

    /// The names of the known members, in the order of their bits.
    pub fn names(self) -> Vec<&'static str> {
        self.iter().map(T::name).collect()
    }
}

impl<T: Named> Default for Mask<T> {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl<T: Named> FromIterator<T> for Mask<T> {
    fn from_iter<I: IntoIterator<Item = T>>(members: I) -> Self {
        members.into_iter().fold(Self::EMPTY, Self::with)
    }
}

impl<T: Named> std::fmt::Debug for Mask<T> {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_set().entries(self.names()).finish()
    }
}

impl<T: Named> std::fmt::Display for Mask<T> {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(&self.names().join(", "))
    }
}

impl<T: Named> Serialize for Mask<T> {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.names())
    }
}

impl<'de, T: Named> Deserialize<'de> for Mask<T> {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let names = Vec::<String>::deserialize(from)?;
        let mut mask = Self::EMPTY;
        for name in names {
            let one = T::ALL.iter().copied().find(|one| one.name() == name);
            mask = mask.with(one.ok_or_else(|| serde::de::Error::custom(format!("no member `{name}`")))?);
        }
        Ok(mask)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bits_are_distinct<T: Named>() {
        let mut seen = 0_i64;
        for one in T::ALL {
            assert_eq!(one.bit().count_ones(), 1, "{}", one.name());
            assert_eq!(seen & one.bit(), 0, "{}", one.name());
            seen |= one.bit();
        }
        assert_eq!(seen, T::KNOWN);
    }

    #[test]
    fn every_known_bit_has_one_name() {
        bits_are_distinct::<Field>();
        bits_are_distinct::<OutputItem>();
        bits_are_distinct::<Claim>();
        bits_are_distinct::<Flag>();
    }

    #[test]
    fn a_mask_keeps_its_members_through_json() {
        let mask: Fields = [Field::Gap, Field::Pressure].into_iter().collect();
        assert_eq!(mask.names(), ["pressure", "gap"]);
        let text = serde_json::to_string(&mask).expect("a mask is a list of names");
        assert_eq!(text, r#"["pressure","gap"]"#);
        assert_eq!(serde_json::from_str::<Fields>(&text).expect("its own text"), mask);
    }

    #[test]
    fn bits_without_a_name_are_told_apart() {
        let mask = Fields::from_bits(1 | 1 << 40);
        assert_eq!(mask.unknown(), 1 << 40);
        assert_eq!(mask.names(), ["pressure"]);
    }
}
