//! Batches: columns in, increments out; brings every column to blocks of adjacent numbers.

use super::constants::{Each, Uniform};
use super::kernel::{GENERAL, kind};
use super::sweep::run;

/// Points gathered at a time where a column is not contiguous or a constant not uniform.
const BLOCK: usize = 128;

/// One real number per point, or one for all.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a> {
    values: &'a [f64],
    step: usize,
}

impl<'a> Column<'a> {
    /// The same value at every point.
    #[must_use]
    pub fn uniform(value: &'a f64) -> Self {
        Self { values: std::slice::from_ref(value), step: 0 }
    }

    /// One value after the other, a point each.
    #[must_use]
    pub fn each(values: &'a [f64]) -> Self {
        Self { values, step: 1 }
    }

    /// The value of point `i` is `values[i * step]`; a step of 0 is a uniform column.
    #[must_use]
    pub fn strided(values: &'a [f64], step: usize) -> Self {
        Self { values, step }
    }

    /// How many points the column has a value for; `usize::MAX` if it is uniform.
    #[must_use]
    pub fn points(&self) -> usize {
        match (self.values.len(), self.step) {
            (0, _) => 0,
            (_, 0) => usize::MAX,
            (len, step) => (len - 1) / step + 1,
        }
    }

    fn one_for_all(&self) -> Option<f64> {
        (self.step == 0).then(|| self.values[0])
    }

    /// Points `start..start + room.len()`, borrowed if they lie side by side, else copied to `room`.
    #[inline]
    fn block<'b>(&self, start: usize, room: &'b mut [f64]) -> &'b [f64]
    where
        'a: 'b,
    {
        match self.step {
            0 => room.fill(self.values[0]),
            1 => return &self.values[start..start + room.len()],
            step => {
                let from = self.values[start * step..].iter().step_by(step);
                room.iter_mut().zip(from).for_each(|(to, x)| *to = *x);
            }
        }
        room
    }
}

/// What the increment of a batch depends on; every quantity in the units of the scene.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// Contact pressure, positive in compression.
    pub pressure: Column<'a>,
    /// Sliding speed; the sign is ignored.
    pub velocity: Column<'a>,
    /// Pressure exponent m.
    pub m: Column<'a>,
    /// Velocity exponent n.
    pub n: Column<'a>,
    /// Wear coefficient K.
    pub coefficient: Column<'a>,
    /// Hardness H.
    pub hardness: Column<'a>,
    /// Length of the substep.
    pub dt: f64,
}

/// Which instructions to use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instructions {
    /// AVX2 and FMA where the processor has both.
    Best,
    /// Only what every processor of the architecture has; the same bits, slowly.
    Portable,
}

/// The wear increment `(K/H) p^m v^n dt` of every point, and on request its derivative with
/// respect to pressure, `m w / p`.
///
/// `out` and `slope` have one element per point. The result of a point depends on the inputs of that
/// point only: not on the batch, on steps, or on the instructions. See [the module](super) for
/// what comes out where an input is zero, negative or not finite.
///
/// True says that every increment is finite and comes from finite inputs, `v` aside where n = 0; false says nothing.
///
/// # Panics
/// If a column is shorter than `out`, or `slope` has another length: a fault of the caller.
pub fn increments(inputs: &Inputs, out: &mut [f64], slope: Option<&mut [f64]>) -> bool {
    increments_by(Instructions::Best, inputs, out, slope)
}

/// [`increments`] with a choice of instructions.
///
/// # Panics
/// As [`increments`].
pub fn increments_by(
    instructions: Instructions,
    inputs: &Inputs,
    out: &mut [f64],
    mut slope: Option<&mut [f64]>,
) -> bool {
    let Inputs { pressure, velocity, m, n, coefficient, hardness, dt } = *inputs;
    let points = out.len();
    for column in [pressure, velocity, m, n, coefficient, hardness] {
        assert!(column.points() >= points, "a column is shorter than the batch");
    }
    if let Some(slope) = &slope {
        assert_eq!(slope.len(), points, "one slope per point");
    }
    if points == 0 {
        return true;
    }
    let uniform = match (m.one_for_all(), n.one_for_all()) {
        (Some(m), Some(n)) => match (coefficient.one_for_all(), hardness.one_for_all()) {
            (Some(k), Some(h)) => Some(Uniform::new(m, n, (k, h, dt))),
            _ => None,
        },
        _ => None,
    };
    if let (Some(constants), 1, 1) = (uniform, pressure.step, velocity.step) {
        let (p, v) = (&pressure.values[..points], &velocity.values[..points]);
        return run(instructions, p, v, constants, out, slope);
    }
    let mut plain = true;
    let mut rooms = [[0.0; BLOCK]; 6];
    for start in (0..points).step_by(BLOCK) {
        let len = BLOCK.min(points - start);
        let [p, v, ms, ns, k, h] = rooms.each_mut().map(|room| &mut room[..len]);
        let p = pressure.block(start, p);
        let v = velocity.block(start, v);
        let out = &mut out[start..start + len];
        let slope = slope.as_deref_mut().map(|s| &mut s[start..start + len]);
        if let Some(constants) = uniform {
            plain &= run(instructions, p, v, constants, out, slope);
            continue;
        }
        let each = Each {
            kinds: (kind_of(&m), kind_of(&n)),
            m: m.block(start, ms),
            n: n.block(start, ns),
            k: coefficient.block(start, k),
            h: hardness.block(start, h),
            dt,
        };
        plain &= run(instructions, p, v, each, out, slope);
    }
    plain
}

/// The kind that the kernel of a whole column of exponents must answer for.
fn kind_of(exponent: &Column) -> u8 {
    exponent.one_for_all().map_or(GENERAL, kind)
}
