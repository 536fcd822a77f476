//! What a least-squares fit knows: covariance, confidence, and directions in which nothing changes.

/// Eigenvalues below so many times the largest belong to directions that the data cannot tell.
const FLAT: f64 = 1e-6;

/// What the derivatives of the residuals say.
pub(super) struct Known {
    /// Covariance of the parameters in directions that the data tell, without the variance of the residuals.
    pub(super) covariance: Vec<Vec<f64>>,
    /// Directions along which nothing that was measured changes, in the parameters.
    pub(super) flat: Vec<Vec<f64>>,
}

/// From the derivatives of each residual, `[points][parameters]`.
pub(super) fn known(derivatives: &[Vec<f64>], parameters: usize) -> Known {
    let norm = |column: usize| derivatives.iter().map(|row| row[column] * row[column]).sum::<f64>().sqrt();
    let norms: Vec<f64> = (0..parameters).map(norm).collect();
    let whole = norms.iter().copied().fold(0.0, f64::max);
    // Columns of one length, so that a parameter's unit says nothing; one without any effect stays as it is.
    let lengths: Vec<f64> =
        norms.iter().map(|norm| if *norm > 1e-12 * whole { *norm } else { whole.max(f64::MIN_POSITIVE) }).collect();
    let mut square = vec![vec![0.0; parameters]; parameters];
    for row in derivatives {
        for a in 0..parameters {
            for b in 0..parameters {
                square[a][b] += row[a] / lengths[a] * (row[b] / lengths[b]);
            }
        }
    }
    let (values, vectors) = eigen(square);
    let largest = values.iter().copied().fold(0.0, f64::max);
    let mut covariance = vec![vec![0.0; parameters]; parameters];
    let mut flat = Vec::new();
    for (value, vector) in values.iter().zip(&vectors) {
        let own: Vec<f64> = vector.iter().zip(&lengths).map(|(one, length)| one / length).collect();
        if *value <= FLAT * largest {
            flat.push(own);
            continue;
        }
        for a in 0..parameters {
            for b in 0..parameters {
                covariance[a][b] += own[a] * own[b] / value;
            }
        }
    }
    Known { covariance, flat }
}

/// Eigenvalues and vectors of a symmetric matrix, by Jacobi's rotations (Golub and Van Loan, Matrix Computations, 8.5).
fn eigen(mut a: Vec<Vec<f64>>) -> (Vec<f64>, Vec<Vec<f64>>) {
    let n = a.len();
    let mut v: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| if i == j { 1.0 } else { 0.0 }).collect()).collect();
    for _ in 0..60 {
        let off: f64 = (0..n).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| a[i][j] * a[i][j]).sum();
        if off < 1e-30 {
            break;
        }
        for p in 0..n {
            for q in p + 1..n {
                if a[p][q] == 0.0 {
                    continue;
                }
                let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
                let t = if theta == 0.0 { 1.0 } else { t };
                let c = 1.0 / (t * t + 1.0).sqrt();
                let s = t * c;
                for row in a.iter_mut() {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
                let (above, below) = a.split_at_mut(q);
                for (x, y) in above[p].iter_mut().zip(&mut below[0]) {
                    (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
                }
                for row in v.iter_mut() {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
            }
        }
    }
    let values = (0..n).map(|i| a[i][i]).collect();
    let vectors = (0..n).map(|j| (0..n).map(|i| v[i][j]).collect()).collect();
    (values, vectors)
}

/// The t beyond which a part of 0.025 of Student's distribution lies on either side, so that 95 % are within.
///
/// G. W. Hill, Algorithm 396, Comm. ACM 13 (1970) 619: six digits from three degrees of freedom on; exact for one and two.
pub(super) fn student(freedom: usize) -> f64 {
    let (p, n) = (0.05_f64, freedom as f64);
    if freedom == 0 {
        return f64::INFINITY;
    }
    if freedom == 1 {
        let angle = p * std::f64::consts::FRAC_PI_2;
        return angle.cos() / angle.sin();
    }
    if freedom == 2 {
        return (2.0 / (p * (2.0 - p)) - 2.0).sqrt();
    }
    let a = 1.0 / (n - 0.5);
    let b = 48.0 / (a * a);
    let mut c = ((20700.0 * a / b - 98.0) * a - 16.0) * a + 96.36;
    let d = ((94.5 / (b + c) - 3.0) / b + 1.0) * (a * std::f64::consts::FRAC_PI_2).sqrt() * n;
    let mut x = d * p;
    let mut y = x.powf(2.0 / n);
    if y > 0.05 + a {
        // The normal deviate of p / 2.
        x = -1.959_963_984_540_054;
        y = x * x;
        if freedom < 5 {
            c += 0.3 * (n - 4.5) * (x + 0.6);
        }
        c += (((0.05 * d * x - 5.0) * x - 7.0) * x - 2.0) * x + b;
        y = (((((0.4 * y + 6.3) * y + 36.0) * y + 94.5) / c - y - 3.0) / b + 1.0) * x;
        y = a * y * y;
        y = if y > 0.002 { y.exp_m1() } else { 0.5 * y * y + y };
    } else {
        y = ((1.0 / (((n + 6.0) / (n * y) - 0.089 * d - 0.822) * (n + 2.0) * 3.0) + 0.5 / (n + 4.0)) * y - 1.0)
            * (n + 1.0)
            / (n + 2.0)
            + 1.0 / y;
    }
    (n * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn students_t_is_that_of_the_tables() {
        for (freedom, t) in [
            (1, 12.7062),
            (2, 4.30265),
            (3, 3.18245),
            (4, 2.77645),
            (5, 2.57058),
            (10, 2.22814),
            (30, 2.04227),
            (1000, 1.96234),
        ] {
            assert!((student(freedom) / t - 1.0).abs() < 2e-5, "{freedom}: {} for {t}", student(freedom));
        }
    }

    #[test]
    fn covariance_is_the_inverse_and_flat_directions_are_found() {
        // A straight line over 0, 1, 2, 3: the inverse of [[4, 6], [6, 14]].
        let line: Vec<Vec<f64>> = (0..4).map(|k| vec![1.0, f64::from(k)]).collect();
        let found = known(&line, 2);
        assert!(found.flat.is_empty());
        for (a, b, wanted) in [(0, 0, 0.7), (0, 1, -0.3), (1, 1, 0.2)] {
            assert!((found.covariance[a][b] - wanted).abs() < 1e-12, "{:?}", found.covariance);
        }
        // The second does the opposite of three times the first.
        let ratio: Vec<Vec<f64>> = (1..5).map(|k| vec![f64::from(k), -3.0 * f64::from(k)]).collect();
        let found = known(&ratio, 2);
        let [direction] = &found.flat[..] else { panic!("{:?}", found.flat) };
        assert!((direction[0] / direction[1] - 3.0).abs() < 1e-9, "{direction:?}");
        // One without effect.
        let idle: Vec<Vec<f64>> = (1..5).map(|k| vec![f64::from(k), 0.0]).collect();
        let found = known(&idle, 2);
        assert!(found.flat.len() == 1 && found.flat[0][0].abs() < 1e-12, "{:?}", found.flat);
    }
}
