//! The law's constants over time and temperature.

use crate::law::Values;

/// Constants on a grid over time and temperature: linear between its points, held outside them.
///
/// An axis along which nothing changes is dropped, so that a table of equal rows costs what constants cost.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstantTable {
    times: Vec<f64>,
    temperatures: Vec<f64>,
    /// `[constant][time][temperature]`
    values: Vec<f64>,
    count: usize,
}

/// One row of a table: constants at a time, a temperature, or both.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Time, where the table has that axis.
    pub time: Option<f64>,
    /// Temperature, where the table has that axis.
    pub temperature: Option<f64>,
    /// The law's constants, in its own order.
    pub constants: Vec<f64>,
}

impl ConstantTable {
    /// A table of `rows`, which form a full grid: every time with every temperature.
    pub fn new(rows: &[Row]) -> ConstantTable {
        let axis = |of: fn(&Row) -> Option<f64>| {
            let mut points: Vec<f64> = rows.iter().map(|row| of(row).unwrap_or(0.0)).collect();
            points.sort_by(f64::total_cmp);
            points.dedup();
            points
        };
        let (times, temperatures) = (axis(|row| row.time), axis(|row| row.temperature));
        let count = rows.first().map_or(0, |row| row.constants.len());
        let mut values = vec![0.0; count * times.len() * temperatures.len()];
        let place = |axis: &[f64], at: Option<f64>| {
            axis.iter().position(|point| *point == at.unwrap_or(0.0)).unwrap_or_default()
        };
        for row in rows {
            let (i, j) = (place(&times, row.time), place(&temperatures, row.temperature));
            for (c, value) in row.constants.iter().enumerate() {
                values[(c * times.len() + i) * temperatures.len() + j] = *value;
            }
        }
        let mut table = ConstantTable { times, temperatures, values, count };
        table.drop_constant_axes();
        table
    }

    fn drop_constant_axes(&mut self) {
        let (t, k) = (self.times.len(), self.temperatures.len());
        let at = |c: usize, i: usize, j: usize| self.values[(c * t + i) * k + j];
        let all = |test: &dyn Fn(usize, usize, usize) -> bool| {
            (0..self.count).all(|c| (0..t).all(|i| (0..k).all(|j| test(c, i, j))))
        };
        let same_in_time = all(&|c, i, j| at(c, i, j) == at(c, 0, j));
        let same_in_temperature = all(&|c, i, j| at(c, i, j) == at(c, i, 0));
        let (keep_t, keep_k) = (if same_in_time { 1 } else { t }, if same_in_temperature { 1 } else { k });
        if (keep_t, keep_k) == (t, k) {
            return;
        }
        let mut values = Vec::with_capacity(self.count * keep_t * keep_k);
        for c in 0..self.count {
            for i in 0..keep_t {
                values.extend((0..keep_k).map(|j| at(c, i, j)));
            }
        }
        self.times.truncate(keep_t);
        self.temperatures.truncate(keep_k);
        self.values = values;
    }

    /// Whether constant `c` has this value in every row.
    pub fn is_always(&self, c: usize, value: f64) -> bool {
        let rows = self.times.len() * self.temperatures.len();
        self.values.get(c * rows..(c + 1) * rows).is_some_and(|all| all.iter().all(|one| *one == value))
    }

    /// Number of constants.
    pub fn count(&self) -> usize {
        self.count
    }
    /// Whether the constants change with time.
    pub fn varies_in_time(&self) -> bool {
        self.times.len() > 1
    }
    /// Whether the constants change with temperature.
    pub fn varies_in_temperature(&self) -> bool {
        self.temperatures.len() > 1
    }
    /// Times of the table's points, where it bends; empty if it does not change with time.
    pub fn break_times(&self) -> &[f64] {
        if self.varies_in_time() { &self.times } else { &[] }
    }
    /// Temperatures of the table's points, where it bends; empty if it does not change with temperature.
    pub fn break_temperatures(&self) -> &[f64] {
        if self.varies_in_temperature() { &self.temperatures } else { &[] }
    }

    /// Constant `c` at a time and, where the table has that axis, a temperature.
    pub fn value(&self, c: usize, time: f64, temperature: f64) -> f64 {
        let k = self.temperatures.len();
        let (i, a) = locate(&self.times, time);
        let (j, b) = locate(&self.temperatures, temperature);
        let row = |i: usize| {
            let row = &self.values[(c * self.times.len() + i) * k..][..k];
            blend(row[j], row[(j + 1).min(k - 1)], b)
        };
        blend(row(i), row((i + 1).min(self.times.len() - 1)), a)
    }

    /// All constants at a time for points at `temperature`; those that differ from point to point go through `room`.
    ///
    /// `temperature` is absent where the table has no such axis.
    pub fn at<'b>(
        &self,
        time: f64,
        temperature: &Values<'_>,
        points: usize,
        room: &'b mut Vec<f64>,
    ) -> Vec<Values<'b>> {
        let one = match *temperature {
            _ if !self.varies_in_temperature() => 0.0,
            Values::Uniform(temperature) => temperature,
            Values::PerPoint(all) => return self.at_points(time, (all, 1), points, room),
            Values::Strided { data, step } => return self.at_points(time, (data, step), points, room),
            _ => f64::NAN,
        };
        (0..self.count).map(|c| Values::Uniform(self.value(c, time, one))).collect()
    }

    /// All constants at a time, for temperatures `step` numbers apart.
    fn at_points<'b>(
        &self,
        time: f64,
        (temperatures, step): (&[f64], usize),
        points: usize,
        room: &'b mut Vec<f64>,
    ) -> Vec<Values<'b>> {
        room.clear();
        for c in 0..self.count {
            let temperatures = temperatures.iter().step_by(step).take(points);
            room.extend(temperatures.map(|temperature| self.value(c, time, *temperature)));
        }
        let chunks = room.chunks_exact(points.max(1));
        chunks.take(self.count).map(Values::PerPoint).collect()
    }
}

/// The interval of an axis that holds `at`, and how far in it is; held outside.
fn locate(axis: &[f64], at: f64) -> (usize, f64) {
    let above = axis.partition_point(|point| *point <= at);
    match above {
        0 => (0, 0.0),
        n if n == axis.len() => (n - 1, 0.0),
        n => (n - 1, (at - axis[n - 1]) / (axis[n] - axis[n - 1])),
    }
}

fn blend(a: f64, b: f64, part: f64) -> f64 {
    if part == 0.0 || a == b { a } else { a + part * (b - a) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(time: Option<f64>, temperature: Option<f64>, constants: &[f64]) -> Row {
        Row { time, temperature, constants: constants.to_vec() }
    }

    #[test]
    fn values_are_linear_between_points_and_held_outside() {
        let table = ConstantTable::new(&[row(Some(2.0), None, &[30.0, 5.0]), row(Some(1.0), None, &[10.0, 5.0])]);
        for (time, value) in [(0.0, 10.0), (1.0, 10.0), (1.25, 15.0), (2.0, 30.0), (9.0, 30.0)] {
            assert_eq!((table.value(0, time, 7.0), table.value(1, time, 7.0)), (value, 5.0), "at {time}");
        }
        assert_eq!(table.break_times(), [1.0, 2.0]);
        assert!(table.break_temperatures().is_empty());
    }

    #[test]
    fn a_grid_is_bilinear() {
        let rows = [(0.0, 100.0, 1.0), (0.0, 200.0, 2.0), (1.0, 100.0, 5.0), (1.0, 200.0, 10.0)];
        let table = ConstantTable::new(&rows.map(|(t, k, v)| row(Some(t), Some(k), &[v])));
        assert_eq!(table.value(0, 0.5, 150.0), 4.5);
        assert_eq!(table.value(0, 2.0, 50.0), 5.0);
    }

    #[test]
    fn axes_without_change_are_dropped() {
        let rows = [(0.0, 100.0, 1.0), (0.0, 200.0, 2.0), (1.0, 100.0, 1.0), (1.0, 200.0, 2.0)];
        let table = ConstantTable::new(&rows.map(|(t, k, v)| row(Some(t), Some(k), &[v])));
        assert!(!table.varies_in_time() && table.varies_in_temperature());
        assert_eq!(table.value(0, 0.3, 125.0), 1.25);
    }

    #[test]
    fn temperatures_of_points_give_constants_of_points() {
        let table = ConstantTable::new(&[row(None, Some(0.0), &[1.0, 0.0]), row(None, Some(10.0), &[3.0, 4.0])]);
        let mut room = Vec::new();
        let temperature = [0.0, 5.0, 20.0];
        let all = table.at(0.0, &Values::PerPoint(&temperature), 3, &mut room);
        assert_eq!(all, [Values::PerPoint(&[1.0, 2.0, 3.0]), Values::PerPoint(&[0.0, 2.0, 4.0])]);
        let apart = [0.0, f64::NAN, 5.0, f64::NAN, 20.0];
        let strided = table.at(0.0, &Values::Strided { data: &apart, step: 2 }, 3, &mut room);
        assert_eq!(strided, [Values::PerPoint(&[1.0, 2.0, 3.0]), Values::PerPoint(&[0.0, 2.0, 4.0])]);
        let one = table.at(0.0, &Values::Uniform(5.0), 3, &mut room);
        assert_eq!(one, [Values::Uniform(2.0), Values::Uniform(2.0)]);
    }
}
