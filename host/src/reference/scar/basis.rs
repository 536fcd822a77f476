//! Pressures that an elastic half-space answers with themselves, and the points at which a scar is collocated.

use std::f64::consts::PI;

use super::super::answer::Indenter;

/// Polynomials in eta = (1 - r^2/a^2)^(1/2) of even degree 2n: a pressure B_n / eta over the contact gives the displacement
/// a lambda_n B_n / E* there.
///
/// Sphere: Legendre polynomials, lambda_n = pi ((2n-1)!! / (2n)!!)^2. Line: Chebyshev polynomials, lambda_n = 1/n, and a
/// constant for n = 0, which the datum decides and which is left out here. Source: G. Ya. Popov, J. Appl. Math. Mech. 27
/// (1963) 1255, for the sphere; the line's is the cosine series of ln |x - s|. Both are held against quadrature of the
/// kernel in tests.rs.
pub(super) struct Basis {
    pub indenter: Indenter,
    /// lambda_n, n = 0..=order.
    pub lambda: Vec<f64>,
    /// B_n at the edge, where eta = 0.
    pub edge: Vec<f64>,
    /// Integral of B_n over the contact: of B_n dx for x = 0..1 (line), of B_n r dr for r = 0..1 (sphere).
    pub moment: Vec<f64>,
}

/// Values of all B_n at one point.
pub(super) struct Values {
    /// B_n.
    pub value: Vec<f64>,
    /// 2 (1 - y) dB_n/dy with y = eta^2, which is -x dB_n/dx.
    pub drift: Vec<f64>,
}

impl Basis {
    pub fn new(indenter: Indenter, order: usize) -> Basis {
        let mut lambda = vec![0.0; order + 1];
        let mut ratio = 1.0;
        for (n, lambda) in lambda.iter_mut().enumerate() {
            let even = 2.0 * n as f64;
            *lambda = match indenter {
                Indenter::Line if n == 0 => 0.0,
                Indenter::Line => 1.0 / n as f64,
                Indenter::Sphere => {
                    ratio *= if n == 0 { 1.0 } else { (even - 1.0) / even };
                    PI * ratio * ratio
                }
            };
        }
        let mut basis = Basis { indenter, lambda, edge: Vec::new(), moment: Vec::new() };
        basis.edge = basis.at(PI / 2.0).value;
        let numbered = basis.edge.iter().enumerate().map(|(n, edge)| (2.0 * n as f64, edge));
        basis.moment = match indenter {
            Indenter::Line => numbered.map(|(degree, edge)| edge / (1.0 - degree * degree)).collect(),
            Indenter::Sphere => numbered.map(|(degree, edge)| edge / (2.0 - degree * (degree + 1.0))).collect(),
        };
        basis
    }

    /// Highest n.
    pub fn order(&self) -> usize {
        self.lambda.len() - 1
    }

    /// At eta = cos(angle), between the centre (0) and the edge (pi/2).
    pub fn at(&self, angle: f64) -> Values {
        let order = self.order();
        let (mut value, mut drift) = (Vec::with_capacity(order + 1), Vec::with_capacity(order + 1));
        match self.indenter {
            Indenter::Line => {
                for n in 0..=order {
                    let degree = 2.0 * n as f64;
                    value.push((degree * angle).cos());
                    drift.push(degree * angle.tan() * (degree * angle).sin());
                }
            }
            Indenter::Sphere => {
                // At the edge exactly, so that odd degrees vanish there.
                let eta = if angle == PI / 2.0 { 0.0 } else { angle.cos() };
                let (mut before, mut now) = (0.0, 1.0);
                for degree in 0..=2 * order {
                    let k = degree as f64;
                    if degree % 2 == 0 {
                        value.push(now);
                        drift.push(k * (before - eta * now) / eta);
                    }
                    let next = ((2.0 * k + 1.0) * eta * now - k * before) / (k + 1.0);
                    (before, now) = (now, next);
                }
            }
        }
        Values { value, drift }
    }

    /// The angles of the points of collocation, one for each n > 0: roots of cos((2n+1) angle) / cos(angle), which lie
    /// closest where the pressure starts.
    pub fn angles(&self) -> impl Iterator<Item = f64> + use<> {
        let order = self.order();
        (1..=order).map(move |j| (2 * j - 1) as f64 * PI / (2.0 * (2 * order + 1) as f64))
    }

    /// The coefficient of B_0 that carries the load on a contact of radius a (in Hertz radii), and its derivative.
    pub fn mean(&self, a: f64) -> [f64; 2] {
        match self.indenter {
            Indenter::Line => [1.0 / (2.0 * a), -1.0 / (2.0 * a * a)],
            Indenter::Sphere => [1.0 / (3.0 * a * a), -2.0 / (3.0 * a.powi(3))],
        }
    }

    /// Load in units of p0 a0 (line) or p0 a0^2 (sphere).
    pub fn load(&self) -> f64 {
        match self.indenter {
            Indenter::Line => PI / 2.0,
            Indenter::Sphere => 2.0 * PI / 3.0,
        }
    }

    /// Gap of the unworn bodies at r = a0 in units of a0 p0 / E*: a0^2 / 2R.
    pub fn curvature(&self) -> f64 {
        match self.indenter {
            Indenter::Line => 1.0,
            Indenter::Sphere => PI / 4.0,
        }
    }

    /// Wear in units of a0 p0 / E* per pressure in units of p0 and per unit of tau.
    pub fn rate(&self) -> f64 {
        match self.indenter {
            Indenter::Line => 8.0 / (3.0 * PI),
            Indenter::Sphere => 3.0 * PI / 16.0,
        }
    }
}
