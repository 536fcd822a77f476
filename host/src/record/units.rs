//! The labels of a consistent set of units.

/// Labels of the scene's base units, from which the labels of all other quantities follow.
///
/// They label reports and plots and never change a number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Units {
    /// Label of lengths, `m` by default.
    pub length: String,
    /// Label of forces, `N` by default.
    pub force: String,
    /// Label of times, `s` by default.
    pub time: String,
    /// In 2-D a load is a force per length, a contact area a length and a worn volume an area.
    pub per_length: bool,
}

impl Default for Units {
    /// SI in three dimensions.
    fn default() -> Self {
        Self { length: "m".into(), force: "N".into(), time: "s".into(), per_length: false }
    }
}

impl Units {
    /// Label of pressures: `Pa` and `MPa` where the base units make them, else force per area.
    #[must_use]
    pub fn pressure(&self) -> String {
        match (self.force.as_str(), self.length.as_str()) {
            ("N", "m") => "Pa".into(),
            ("kN", "m") => "kPa".into(),
            ("N", "mm") | ("MN", "m") | ("µN" | "uN", "µm" | "um") => "MPa".into(),
            ("kN", "mm") => "GPa".into(),
            (force, length) => format!("{force}/{length}²"),
        }
    }

    /// Label of sliding velocities.
    #[must_use]
    pub fn velocity(&self) -> String {
        format!("{}/{}", self.length, self.time)
    }

    /// Label of loads, per length in 2-D.
    #[must_use]
    pub fn load(&self) -> String {
        if self.per_length { format!("{}/{}", self.force, self.length) } else { self.force.clone() }
    }

    /// Label of contact areas, a length in 2-D.
    #[must_use]
    pub fn area(&self) -> String {
        if self.per_length { self.length.clone() } else { format!("{}²", self.length) }
    }

    /// Label of worn volumes, an area in 2-D.
    #[must_use]
    pub fn volume(&self) -> String {
        let power = if self.per_length { '²' } else { '³' };
        format!("{}{power}", self.length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_follow_from_the_base_units() {
        let si = Units::default();
        assert_eq!(si.pressure(), "Pa");
        assert_eq!(si.velocity(), "m/s");
        assert_eq!((si.load(), si.area(), si.volume()), ("N".into(), "m²".into(), "m³".into()));
        let plane = Units { length: "mm".into(), per_length: true, ..Units::default() };
        assert_eq!(plane.pressure(), "MPa");
        assert_eq!((plane.load(), plane.area(), plane.volume()), ("N/mm".into(), "mm".into(), "mm²".into()));
        let odd = Units { force: "lbf".into(), length: "in".into(), ..Units::default() };
        assert_eq!(odd.pressure(), "lbf/in²");
    }
}
