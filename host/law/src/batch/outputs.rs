//! The caller's arrays that a law writes.

/// Where the answers of one call go; the lengths are those of the batch it is used with.
#[derive(Debug)]
pub struct Outputs<'a> {
    /// Wear increment `[points]`.
    pub increment: &'a mut [f64],
    /// Wear direction `[points][3]`.
    pub direction: Option<&'a mut [f64]>,
    /// State variables at the end `[points][variables]`; needed if the law has any.
    pub state: Option<&'a mut [f64]>,
    /// Status of every point `[points]`.
    pub status: Option<&'a mut [i32]>,
    /// Derivative of the increment with respect to the pressure `[points]`.
    pub d_pressure: Option<&'a mut [f64]>,
}

impl<'a> Outputs<'a> {
    /// Asks for the wear increment alone.
    pub fn new(increment: &'a mut [f64]) -> Self {
        Self { increment, direction: None, state: None, status: None, d_pressure: None }
    }

    /// The same arrays, borrowed for a shorter time.
    pub fn reborrow(&mut self) -> Outputs<'_> {
        Outputs {
            increment: self.increment,
            direction: self.direction.as_deref_mut(),
            state: self.state.as_deref_mut(),
            status: self.status.as_deref_mut(),
            d_pressure: self.d_pressure.as_deref_mut(),
        }
    }

    /// The outputs of the first `points` points and those of the rest, of a law with `variables` state variables.
    ///
    /// # Panics
    /// If an array is shorter than that, as splitting a slice does.
    pub fn split_at(self, points: usize, variables: usize) -> (Outputs<'a>, Outputs<'a>) {
        fn cut<T>(array: Option<&mut [T]>, at: usize) -> (Option<&mut [T]>, Option<&mut [T]>) {
            array.map(|array| array.split_at_mut(at)).unzip()
        }
        let (increment, increments) = self.increment.split_at_mut(points);
        let (direction, directions) = cut(self.direction, 3 * points);
        let (state, states) = cut(self.state, variables * points);
        let (status, statuses) = cut(self.status, points);
        let (d_pressure, d_pressures) = cut(self.d_pressure, points);
        (
            Outputs { increment, direction, state, status, d_pressure },
            Outputs {
                increment: increments,
                direction: directions,
                state: states,
                status: statuses,
                d_pressure: d_pressures,
            },
        )
    }
}
