//! Loading in time as pieces over which pressure and velocity are linear.

/// A stretch of time over which pressure and velocity are linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Time at its start and at its end.
    pub time: [f64; 2],
    /// Contact pressure at its start and at its end.
    pub pressure: [f64; 2],
    /// Sliding velocity at its start and at its end; the sign may change in between.
    pub velocity: [f64; 2],
}

/// Pieces from rows of pressure and velocity at `times`; repeated times (jumps) give none.
pub fn pieces_from_velocity(
    times: &[f64],
    pressure: impl Fn(usize) -> f64,
    velocity: impl Fn(usize) -> f64,
) -> Vec<Piece> {
    between(times, |k, time| Piece {
        time,
        pressure: [pressure(k), pressure(k + 1)],
        velocity: [velocity(k), velocity(k + 1)],
    })
}

/// Pieces from rows of pressure and relative displacement at `times`.
///
/// The speed is constant between rows: |s1 - s0| / (t1 - t0), with s the displacement (2-D or
/// scalar slip: the other components zero).
pub fn pieces_from_slip(
    times: &[f64],
    pressure: impl Fn(usize) -> f64,
    slip: impl Fn(usize) -> [f64; 3],
) -> Vec<Piece> {
    between(times, |k, time| {
        let (a, b) = (slip(k), slip(k + 1));
        let path = (b[0] - a[0]).hypot(b[1] - a[1]).hypot(b[2] - a[2]);
        let speed = path / (time[1] - time[0]);
        Piece { time, pressure: [pressure(k), pressure(k + 1)], velocity: [speed; 2] }
    })
}

fn between(times: &[f64], piece: impl Fn(usize, [f64; 2]) -> Piece) -> Vec<Piece> {
    let rows = times.windows(2).enumerate().filter(|(_, t)| t[1] > t[0]);
    rows.map(|(k, t)| piece(k, [t[0], t[1]])).collect()
}

/// What lies before the time `end`: the piece that holds it is cut there.
pub fn until(pieces: &[Piece], end: f64) -> Vec<Piece> {
    let before = pieces.iter().filter(|piece| piece.time[0] < end);
    let cut = before.map(|piece| {
        let [start, stop] = piece.time;
        if stop <= end {
            return *piece;
        }
        let s = (end - start) / (stop - start);
        let at = |[a, b]: [f64; 2]| a + s * (b - a);
        Piece {
            time: [start, end],
            pressure: [piece.pressure[0], at(piece.pressure)],
            velocity: [piece.velocity[0], at(piece.velocity)],
        }
    });
    cut.collect()
}

#[cfg(test)]
mod tests {
    use super::{Piece, pieces_from_slip, pieces_from_velocity, until};

    #[test]
    fn rows_become_pieces_and_jumps_take_no_time() {
        let times = [0.0, 2.0, 2.0, 3.0];
        let pressure = [1.0, 2.0, 5.0, 6.0];
        let by_velocity = pieces_from_velocity(&times, |k| pressure[k], |k| -pressure[k]);
        let last = Piece { time: [2.0, 3.0], pressure: [5.0, 6.0], velocity: [-5.0, -6.0] };
        assert_eq!(by_velocity.len(), 2);
        assert_eq!(by_velocity[1], last);
        let slip = [[0.0; 3], [-3.0, 4.0, 0.0], [0.0; 3], [0.0, 0.0, 2.0]];
        let by_slip = pieces_from_slip(&times, |k| pressure[k], |k| slip[k]);
        assert_eq!(by_slip[0].velocity, [2.5; 2]);
        assert_eq!(by_slip[1].velocity, [2.0; 2], "counted anew after the jump");
        let short = until(&by_velocity, 0.5);
        let first = Piece { time: [0.0, 0.5], pressure: [1.0, 1.25], velocity: [-1.0, -1.25] };
        assert_eq!(short, [first]);
        assert_eq!(until(&by_velocity, 9.0), by_velocity);
    }
}
