//! Inputs to try a law on: ordinary ones, such as a contact has, and wide ones, as far as the bounds reach.

use super::points::{Case, Point};
use super::random::Random;
use wearlaw_law::{CallNumbers, Field, LawDescriptor, Quantity};

/// What can say whether a law answers a call of one point.
pub trait Answering {
    /// Whether the point of the call wears; none if the law refuses it or gives no finite value.
    fn wears(&self, case: &Case) -> Option<bool>;
}

/// Picks constants and points for one law.
pub struct Sampler<'l> {
    law: &'l LawDescriptor,
    /// Where random numbers come from.
    pub random: Random,
    /// Constants that the author computed with: known to make sense together.
    known: &'l [Vec<f64>],
    /// Constants that have a default keep it: the law as most use it.
    pub at_defaults: bool,
}

/// Sizes of ordinary values, by base unit: with them a pressure is 1e9 Pa, a length 1e-3 m, a temperature 300 K.
const ORDINARY: [f64; 4] = [1e-3, 1e6, 1.0, 300.0];
/// Sets of constants that are tried before the best is taken.
const TRIES: usize = 40;

impl<'l> Sampler<'l> {
    /// For one law; `stream` gives each check numbers of its own.
    pub fn new(law: &'l LawDescriptor, seed: u64, stream: &str, known: &'l [Vec<f64>]) -> Self {
        Self { law, random: Random::new(seed, stream), known, at_defaults: false }
    }

    /// Constants within their bounds, of an ordinary size.
    pub fn constants(&mut self) -> Vec<f64> {
        let law = self.law;
        let fits = |set: &&Vec<f64>| {
            let mut pairs = law.constants.iter().zip(set.iter());
            !self.at_defaults || pairs.all(|(constant, value)| constant.default.is_none_or(|default| default == *value))
        };
        let known: Vec<&Vec<f64>> = self.known.iter().filter(fits).collect();
        if !known.is_empty() && self.random.unit() < 0.5 {
            return known[self.random.below(known.len())].clone();
        }
        let kept = |constant: &Quantity, at_defaults: bool| constant.default.filter(|_| at_defaults);
        let constants = law.constants.iter();
        constants.map(|constant| kept(constant, self.at_defaults).unwrap_or_else(|| self.ordinary(constant))).collect()
    }

    /// A value of an ordinary size within the bounds.
    fn ordinary(&mut self, quantity: &Quantity) -> f64 {
        let size: f64 = ORDINARY.iter().zip(quantity.exponents).map(|(size, exponent)| size.powf(exponent)).product();
        let plain = quantity.exponents == [0.0; 4];
        for _ in 0..20 {
            let (low, high) = (quantity.minimum, quantity.maximum);
            let value = match quantity.default {
                Some(default) if self.random.unit() < 0.3 => default,
                Some(default) if default != 0.0 => default * self.random.between(0.5, 1.7),
                _ if low.is_finite() && high.is_finite() => self.random.between(low, high),
                // A number that only has to be positive is a coefficient.
                _ if plain && low == 0.0 => self.random.decades(1e-6, 1e-2),
                _ if plain => self.random.between(0.5, 2.0),
                _ if quantity.exponents == [0.0, 0.0, 0.0, 1.0] => size * self.random.between(0.8, 1.3),
                Some(_) => size * self.random.decades(1e-5, 1e-2),
                None => size * self.random.decades(0.3, 10.0),
            };
            if quantity.allows(value) {
                return value;
            }
        }
        nearest(quantity)
    }

    /// A value anywhere within the bounds, over as many decades as a double has sense for.
    pub fn wide(&mut self, quantity: &Quantity) -> f64 {
        for _ in 0..20 {
            let size = self.random.decades(1e-30, 1e30);
            let value = match (quantity.minimum, quantity.maximum) {
                (low, high) if low.is_finite() && high.is_finite() => self.random.between(low, high),
                (low, _) if low.is_finite() => low + size,
                (_, high) if high.is_finite() => high - size,
                _ if self.random.unit() < 0.5 => -size,
                _ => size,
            };
            if quantity.allows(value) {
                return value;
            }
        }
        nearest(quantity)
    }

    /// The numbers of a call in SI units.
    pub fn numbers(&mut self) -> CallNumbers {
        let dt = self.random.decades(1e-3, 1.0);
        CallNumbers {
            time: self.random.between(0.0, 10.0),
            dt,
            step_time: self.random.between(0.0, 1.0),
            reference_temperature: 293.15,
            ..CallNumbers::default()
        }
    }

    /// An ordinary point in contact and sliding, whose fields fit each other and the duration `dt`.
    pub fn point(&mut self, dt: f64) -> Point {
        let random = &mut self.random;
        let mut point = Point::zero(self.law);
        let (pressure, slip) = (random.decades(1e6, 1e9), random.decades(1e-6, 1e-2));
        let friction = random.between(0.05, 0.9);
        let normal = random.direction();
        let tangent = across(normal, random);
        let temperature = random.between(280.0, 420.0);
        let scalars = [
            (Field::Pressure, pressure),
            (Field::Slip, slip),
            (Field::Velocity, slip / dt),
            (Field::Temperature, temperature),
            (Field::CounterTemperature, temperature + random.between(-20.0, 20.0)),
            (Field::FrictionCoefficient, friction),
            (Field::FrictionWork, friction * pressure * slip),
            (Field::AccumulatedWear, random.decades(1e-9, 1e-5)),
            (Field::AccumulatedSlip, random.decades(1e-3, 10.0)),
            (Field::NodalTraction, pressure * random.between(0.9, 1.1)),
            (Field::Gap, -random.decades(1e-12, 1e-9)),
            (Field::Area, random.decades(1e-10, 1e-6)),
        ];
        scalars.into_iter().for_each(|(field, value)| point.set(field, 0, value));
        let position = [0, 1, 2].map(|_| random.between(-1e-2, 1e-2));
        let vectors = [
            (Field::Normal, normal),
            (Field::Tangent, tangent),
            (Field::SlipVector, tangent.map(|x| slip * x)),
            // It acts against the slip of the worn body.
            (Field::FrictionStress, tangent.map(|x| -friction * pressure * x)),
            (Field::Coordinates, position),
        ];
        vectors.into_iter().for_each(|(field, value)| point.set_vector(field, value));
        point.set_index(Field::ContactState, wearlaw_plugin_api::abi::WL_SLIDING);
        point.set_index(Field::PointId, (random.bits() >> 40).cast_signed() + 1);
        point.set_index(Field::ElementId, (random.bits() >> 40).cast_signed() + 1);
        let law = self.law;
        point.inputs = law.inputs.iter().map(|input| self.ordinary(input)).collect();
        point.state = law.state.iter().map(|variable| self.ordinary(variable)).collect();
        point
    }

    /// A call of `count` points that the law answers with good, finite values; none if it refuses all that is tried.
    ///
    /// Points that wear are preferred, since the others would hide a fault. The points are sorted by pressure.
    pub fn good(&mut self, law: &impl Answering, count: usize) -> Option<Case> {
        let mut best: Option<(usize, Case)> = None;
        for _ in 0..TRIES {
            let (numbers, constants) = (self.numbers(), self.constants());
            let mut points: Vec<(bool, Point)> = Vec::new();
            for tried in 0..6 * count.max(4) {
                // Constants that nothing goes with are given up early.
                if points.len() >= 4 * count || tried >= 16 && points.is_empty() {
                    break;
                }
                let point = self.point(numbers.dt);
                let case = Case::new(numbers, constants.clone(), vec![point]);
                if let Some(wears) = law.wears(&case) {
                    points.extend(case.points.into_iter().map(|point| (wears, point)));
                }
                if points.iter().filter(|(wears, _)| *wears).count() >= count {
                    break;
                }
            }
            points.sort_by_key(|(wears, _)| !wears);
            points.truncate(count);
            let wearing = points.iter().filter(|(wears, _)| *wears).count();
            if points.len() == count && best.as_ref().is_none_or(|(most, _)| wearing > *most) {
                let mut points: Vec<Point> = points.into_iter().map(|(_, point)| point).collect();
                points.sort_by(|a, b| a.scalar(Field::Pressure).total_cmp(&b.scalar(Field::Pressure)));
                best = Some((wearing, Case::new(numbers, constants, points)));
            }
            if best.as_ref().is_some_and(|(most, _)| *most == count) {
                break;
            }
        }
        best.map(|(_, case)| case)
    }
}

/// The allowed value nearest to zero.
pub fn nearest(quantity: &Quantity) -> f64 {
    let low = if quantity.above_minimum { quantity.minimum.next_up() } else { quantity.minimum };
    let high = if quantity.below_maximum { quantity.maximum.next_down() } else { quantity.maximum };
    0.0_f64.max(low).min(high)
}

/// A unit vector across `normal`.
pub fn across(normal: [f64; 3], random: &mut Random) -> [f64; 3] {
    loop {
        let other = random.direction();
        let along: f64 = other.iter().zip(normal).map(|(a, b)| a * b).sum();
        let mut rest = [0.0; 3];
        for (index, place) in rest.iter_mut().enumerate() {
            *place = other[index] - along * normal[index];
        }
        let length = rest.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.1 {
            return rest.map(|x| x / length);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::archard;

    #[test]
    fn values_keep_their_bounds() {
        let mut law = archard();
        let mut narrow = law.constants[0].clone();
        (narrow.minimum, narrow.maximum, narrow.above_minimum) = (-3.0, -2.0, true);
        law.constants.push(narrow);
        let mut sampler = Sampler::new(&law, 1, "test", &[]);
        for _ in 0..200 {
            let constants = sampler.constants();
            for (constant, value) in law.constants.iter().zip(constants) {
                assert!(constant.allows(value), "{} {value}", constant.name);
                let wide = sampler.wide(constant);
                assert!(constant.allows(wide), "{} {wide}", constant.name);
                assert!(constant.allows(nearest(constant)), "{}", constant.name);
            }
        }
    }

    #[test]
    fn the_fields_of_a_point_fit_each_other() {
        let law = archard();
        let mut sampler = Sampler::new(&law, 1, "test", &[]);
        let point = sampler.point(0.5);
        let (normal, tangent) = (point.real(Field::Normal), point.real(Field::Tangent));
        let dot: f64 = normal.iter().zip(tangent).map(|(a, b)| a * b).sum();
        assert!(dot.abs() < 1e-12);
        assert_eq!(point.scalar(Field::Velocity), point.scalar(Field::Slip) / 0.5);
        let slip: f64 = point.real(Field::SlipVector).iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((slip / point.scalar(Field::Slip) - 1.0).abs() < 1e-12);
    }
}
