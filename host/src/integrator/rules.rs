//! Rules on the unit interval: where a rate is taken and how much of it counts.

/// A quadrature rule on [0, 1].
#[derive(Debug, PartialEq)]
pub struct Rule {
    /// Where the rate is taken.
    pub nodes: &'static [f64],
    /// How much each node counts; they sum to 1.
    pub weights: &'static [f64],
    /// The weights of a lower-order rule on the same nodes, where one is embedded.
    pub embedded: Option<&'static [f64]>,
}

impl Rule {
    /// One evaluation in the middle: exact where the rate is linear in time.
    pub const MIDPOINT: Rule = Rule { nodes: &[0.5], weights: &[1.0], embedded: None };
    /// Forward Euler: the rate at the start.
    pub const EXPLICIT_EULER: Rule = Rule { nodes: &[0.0], weights: &[1.0], embedded: None };
    /// Backward Euler: the rate at the end.
    pub const IMPLICIT_EULER: Rule = Rule { nodes: &[1.0], weights: &[1.0], embedded: None };
    /// TR-BDF2 in its DIRK form, gamma = 2 - sqrt 2 (Hosea and Shampine, 1996): what it does to a rate that depends on
    /// time alone.
    pub const TR_BDF2: Rule = Rule {
        nodes: &[0.0, 0.585_786_437_626_905, 1.0],
        weights: &[0.353_553_390_593_273_8, 0.353_553_390_593_273_8, 0.292_893_218_813_452_4],
        embedded: None,
    };
    /// Two-stage SDIRK of order 2, gamma = 1 - 1 / sqrt 2 (Alexander, 1977), on a rate that depends on time alone.
    pub const SDIRK2: Rule = Rule {
        nodes: &[0.292_893_218_813_452_4, 1.0],
        weights: &[std::f64::consts::FRAC_1_SQRT_2, 0.292_893_218_813_452_4],
        embedded: None,
    };
    /// Gauss rule with 3 nodes inside its Kronrod extension with 7 (Kronrod, 1965).
    pub const KRONROD_7: Rule = Rule {
        nodes: &[
            0.019754365645989858,
            0.11270166537925831,
            0.28287812532659873,
            0.5,
            0.7171218746734013,
            0.8872983346207417,
            0.9802456343540101,
        ],
        weights: &[
            0.05232811301323363,
            0.13424404493416672,
            0.20069870738798112,
            0.22545826932923707,
            0.20069870738798112,
            0.13424404493416672,
            0.05232811301323363,
        ],
        embedded: Some(&[0.0, 0.2777777777777778, 0.0, 0.4444444444444444, 0.0, 0.2777777777777778, 0.0]),
    };
    /// Gauss rule with 7 nodes inside its Kronrod extension with 15 (Kronrod, 1965).
    pub const KRONROD_15: Rule = Rule {
        nodes: &[
            0.00427231443959368,
            0.025446043828620736,
            0.06756778832011547,
            0.12923440720030277,
            0.20695638226615443,
            0.2970774243113014,
            0.39610752249605075,
            0.5,
            0.6038924775039493,
            0.7029225756886985,
            0.7930436177338456,
            0.8707655927996972,
            0.9324322116798845,
            0.9745539561713793,
            0.9957276855604064,
        ],
        weights: &[
            0.011467661005264612,
            0.03154604631498928,
            0.052395005161125094,
            0.07032662985776296,
            0.08450236331963396,
            0.09517528903239271,
            0.10221647003764944,
            0.10474107054236391,
            0.10221647003764944,
            0.09517528903239271,
            0.08450236331963396,
            0.07032662985776296,
            0.052395005161125094,
            0.03154604631498928,
            0.011467661005264612,
        ],
        embedded: Some(&[
            0.0,
            0.06474248308443485,
            0.0,
            0.13985269574463832,
            0.0,
            0.19091502525255946,
            0.0,
            0.2089795918367347,
            0.0,
            0.19091502525255946,
            0.0,
            0.13985269574463832,
            0.0,
            0.06474248308443485,
            0.0,
        ]),
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integral(rule: &Rule, weights: &[f64], power: i32) -> f64 {
        rule.nodes.iter().zip(weights).map(|(x, w)| w * x.powi(power)).sum()
    }

    /// Each rule integrates x^k exactly up to its degree and not beyond.
    #[test]
    fn degrees_are_what_they_should_be() {
        let rules = [
            (&Rule::MIDPOINT, 1),
            (&Rule::EXPLICIT_EULER, 0),
            (&Rule::IMPLICIT_EULER, 0),
            (&Rule::TR_BDF2, 1),
            (&Rule::SDIRK2, 1),
            (&Rule::KRONROD_7, 11),
            (&Rule::KRONROD_15, 23),
        ];
        for (rule, degree) in rules {
            for power in 0..=degree {
                let error = integral(rule, rule.weights, power) - 1.0 / f64::from(power + 1);
                assert!(error.abs() < 1e-15, "{rule:?} at power {power}: {error:e}");
            }
            let beyond = integral(rule, rule.weights, degree + 1) - 1.0 / f64::from(degree + 2);
            assert!(beyond.abs() > 1e-16, "{rule:?} is better than stated");
        }
        for (rule, degree) in [(&Rule::KRONROD_7, 5), (&Rule::KRONROD_15, 13)] {
            let low = rule.embedded.expect("Kronrod rules hold a Gauss rule");
            for power in 0..=degree {
                assert!((integral(rule, low, power) - 1.0 / f64::from(power + 1)).abs() < 1e-15);
            }
        }
    }
}
