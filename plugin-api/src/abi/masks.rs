//! Masks: 64-bit integers with literal values (bit 63 unused, since Fortran has no unsigned integers).

/// Field bit. Contact pressure, positive in compression.
pub const WL_FIELD_PRESSURE: i64 = 1;
/// Field bit. Slip increment: length of the slip path over the substep, never negative.
pub const WL_FIELD_SLIP: i64 = 2;
/// Field bit. Sliding velocity: slip increment over `dt`, never negative.
pub const WL_FIELD_VELOCITY: i64 = 4;
/// Field bit. Net tangential displacement of the worn body relative to the counter body over the substep, 3 components.
pub const WL_FIELD_SLIP_VECTOR: i64 = 8;
/// Field bit. Outward unit normal of the worn body, 3 components.
pub const WL_FIELD_NORMAL: i64 = 16;
/// Field bit. Position of the point, 3 components.
pub const WL_FIELD_COORDINATES: i64 = 32;
/// Field bit. First unit tangent, 3 components.
pub const WL_FIELD_TANGENT: i64 = 64;
/// Field bit. Temperature of the worn surface.
pub const WL_FIELD_TEMPERATURE: i64 = 128;
/// Field bit. Temperature of the counter surface.
pub const WL_FIELD_COUNTER_TEMPERATURE: i64 = 256;
/// Field bit. Friction stress that acts on the worn body, 3 components.
pub const WL_FIELD_FRICTION_STRESS: i64 = 512;
/// Field bit. Friction coefficient.
pub const WL_FIELD_FRICTION_COEFFICIENT: i64 = 1024;
/// Field bit. Dissipated friction work per area over the substep (path integral, never negative).
pub const WL_FIELD_FRICTION_WORK: i64 = 2048;
/// Field bit. Wear depth at the start of the substep.
pub const WL_FIELD_ACCUMULATED_WEAR: i64 = 4096;
/// Field bit. Sliding distance at the start of the substep.
pub const WL_FIELD_ACCUMULATED_SLIP: i64 = 8192;
/// Field bit. Normal traction from nodal stresses, max(0, -n.sigma.n).
pub const WL_FIELD_NODAL_TRACTION: i64 = 16384;
/// Field bit. Gap between the surfaces; negative is penetration.
pub const WL_FIELD_GAP: i64 = 32768;
/// Field bit. Area that belongs to the point (length in 2-D).
pub const WL_FIELD_AREA: i64 = 65536;
/// Field bit. Contact state: `WL_OPEN`, `WL_STICK` or `WL_SLIDING` (index column).
pub const WL_FIELD_CONTACT_STATE: i64 = 131072;
/// Field bit. Number of the point in the host's numbering (index column).
pub const WL_FIELD_POINT_ID: i64 = 262144;
/// Field bit. Number of the contact element (index column).
pub const WL_FIELD_ELEMENT_ID: i64 = 524288;
/// All field bits that this version of the ABI knows.
pub const WL_FIELDS_KNOWN: i64 = 1048575;

/// Output bit. Wear direction, 3 components a point.
pub const WL_OUT_DIRECTION: i64 = 1;
/// Output bit. State variables at the end of the substep.
pub const WL_OUT_STATE: i64 = 2;
/// Output bit. Derivative of the wear increment with respect to the contact pressure.
pub const WL_OUT_D_PRESSURE: i64 = 4;
/// Output bit. Status of every point.
pub const WL_OUT_STATUS: i64 = 8;
/// All output bits that this version of the ABI knows.
pub const WL_OUTS_KNOWN: i64 = 15;

/// Claim bit. The same inputs give the same bits, whatever the batch, the thread or the process.
pub const WL_CLAIM_DETERMINISTIC: i64 = 1;
/// Claim bit. The wear increment is never negative.
pub const WL_CLAIM_NON_NEGATIVE: i64 = 2;
/// Claim bit. At fixed rates a substep wears as much as its equal parts, one after the other: without state variables, the
/// increment is proportional to `dt` (slip and friction work scale with it).
pub const WL_CLAIM_LINEAR_IN_DT: i64 = 4;
/// Claim bit. No pressure, no wear.
pub const WL_CLAIM_ZERO_WITHOUT_PRESSURE: i64 = 8;
/// Claim bit. No slip, no wear.
pub const WL_CLAIM_ZERO_WITHOUT_SLIP: i64 = 16;
/// Claim bit. Turning the frame turns the direction and leaves the increment.
pub const WL_CLAIM_FRAME_INDIFFERENT: i64 = 32;
/// All claim bits that this version of the ABI knows.
pub const WL_CLAIMS_KNOWN: i64 = 63;

/// Law flag. One instance must not be evaluated from several threads at once.
pub const WL_FLAG_SERIAL: i64 = 1;
/// Law flag. The law wants points out of contact too (oxide growth, healing); otherwise the host copies their state.
pub const WL_FLAG_OPEN_POINTS: i64 = 2;
/// Law flag. The derivative has jumps where the law changes branch.
pub const WL_FLAG_KINKS: i64 = 4;
/// All law flags that this version of the ABI knows.
pub const WL_FLAGS_KNOWN: i64 = 7;

/// Quantity flag. The unit of this constant follows from the others (at most one constant of a law has it).
pub const WL_QUANTITY_CLOSES_UNITS: i64 = 1;
/// Quantity flag. The minimum itself is excluded.
pub const WL_QUANTITY_ABOVE_MINIMUM: i64 = 2;
/// Quantity flag. The maximum itself is excluded.
pub const WL_QUANTITY_BELOW_MAXIMUM: i64 = 4;

/// What `describe` is asked for: a constant.
pub const WL_KIND_CONSTANT: i32 = 0;
/// What `describe` is asked for: a state variable.
pub const WL_KIND_STATE: i32 = 1;
/// What `describe` is asked for: a further input that the law declares by name.
pub const WL_KIND_INPUT: i32 = 2;
/// What `describe` is asked for: the name of a field; `index` is the number of its bit.
pub const WL_KIND_FIELD: i32 = 3;

/// Contact state: not in contact.
pub const WL_OPEN: i64 = 0;
/// Contact state: in contact, not sliding.
pub const WL_STICK: i64 = 1;
/// Contact state: in contact and sliding.
pub const WL_SLIDING: i64 = 2;
