//! The built-in exact answers by name, as `[reference] kind` spells them.

/// A built-in exact answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NamedReference {
    /// Archard wear of a prescribed scene whose pressure, velocity and constants are linear pieces in time.
    ArchardPrescribed,
    /// Contact of a sphere or cylinder before any wear: [`Hertz`](super::hertz::Hertz).
    Hertz,
    /// The growing scar of a sphere or cylinder: [`Scar`](super::scar::Scar).
    HertzScar,
    /// A parabolic body on a foundation, as a continuum: [`WornParabola`](super::foundation::parabola::WornParabola).
    WinklerParabola,
    /// The cells of a foundation: [`follow`](super::foundation::discrete::follow).
    WinklerDiscrete,
    /// One cell of a foundation: [`SpringPoint`](super::foundation::point::SpringPoint).
    WinklerPoint,
    /// A wavy surface in full contact: [`WavyWear`](super::modes::WavyWear).
    ModeDecay,
    /// The limit of wear around a stick zone: [`StickLimit`](super::stick::StickLimit).
    StickLimit,
    /// Published depths of a fretted flat: [`mccoll`](super::mccoll).
    McCollFretting,
}

impl NamedReference {
    /// All of them, in the order in which they are listed.
    pub const ALL: [NamedReference; 9] = [
        NamedReference::ArchardPrescribed,
        NamedReference::Hertz,
        NamedReference::HertzScar,
        NamedReference::WinklerParabola,
        NamedReference::WinklerDiscrete,
        NamedReference::WinklerPoint,
        NamedReference::ModeDecay,
        NamedReference::StickLimit,
        NamedReference::McCollFretting,
    ];

    /// The name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            NamedReference::ArchardPrescribed => "archard-prescribed",
            NamedReference::Hertz => "hertz",
            NamedReference::HertzScar => "hertz-scar",
            NamedReference::WinklerParabola => "winkler-parabola",
            NamedReference::WinklerDiscrete => "winkler-discrete",
            NamedReference::WinklerPoint => "winkler-point",
            NamedReference::ModeDecay => "mode-decay",
            NamedReference::StickLimit => "stick-limit",
            NamedReference::McCollFretting => "mccoll-fretting",
        }
    }

    /// Whether it is the answer of the cells or points themselves, and not of the continuum that a grid stands for.
    pub fn is_of_the_points(self) -> bool {
        match self {
            Self::ArchardPrescribed | Self::WinklerDiscrete | Self::WinklerPoint | Self::ModeDecay => true,
            Self::Hertz | Self::HertzScar | Self::WinklerParabola | Self::StickLimit | Self::McCollFretting => false,
        }
    }

    /// One line for the list.
    pub fn description(self) -> &'static str {
        match self {
            NamedReference::ArchardPrescribed => {
                "wear depth of Archard's law under a prescribed history, from the scene's own tables: \
                 pressure, velocity, K, H, m and n linear in time between rows and table points"
            }
            NamedReference::Hertz => {
                "contact pressure of a sphere (3-D) or cylinder (2-D) on a half-space, under a load, before any wear"
            }
            NamedReference::HertzScar => {
                "wear depth and contact pressure of a sphere (3-D) or cylinder (2-D) that grows a scar on a half-space \
                 under a constant load, m = 1, contact zone fixed in space"
            }
            NamedReference::WinklerParabola => {
                "wear depth and contact pressure of a sphere (3-D) or cylinder (2-D) on an elastic foundation under a \
                 constant load, m = 1, as a continuum: a grid is off by its cells"
            }
            NamedReference::WinklerDiscrete => {
                "wear depth and contact pressure of every cell of an elastic foundation, m = 1, any surface, loads, \
                 approaches, ramps and speeds: exact for the grid itself"
            }
            NamedReference::WinklerPoint => {
                "wear depth and contact pressure of an elastic foundation at a constant approach, any m, each cell by itself"
            }
            NamedReference::ModeDecay => {
                "wear depth and contact pressure of a wavy periodic half-space in full contact under a constant load, m = 1"
            }
            NamedReference::StickLimit => {
                "wear depth and contact pressure of a sphere (3-D) or cylinder (2-D) on a half-space with a stick zone, \
                 after so much wear that nothing changes any more"
            }
            NamedReference::McCollFretting => {
                "published largest wear depth of a fretted flat (McColl 2004) after 1000, 5000, 10000 or 18000 cycles"
            }
        }
    }

    /// The answer of that name.
    pub fn from_name(name: &str) -> Option<NamedReference> {
        Self::ALL.into_iter().find(|reference| reference.name() == name)
    }

    /// The name nearest to one that is misspelt, if it is near enough to be meant.
    pub fn nearest(name: &str) -> Option<&'static str> {
        let scored = Self::ALL.map(|r| (strsim::jaro_winkler(name, r.name()), r.name()));
        let best = scored.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        (best.0 >= 0.75).then_some(best.1)
    }
}

#[cfg(test)]
mod tests {
    use super::NamedReference;

    #[test]
    fn every_name_leads_back_to_its_answer() {
        for reference in NamedReference::ALL {
            assert_eq!(NamedReference::from_name(reference.name()), Some(reference));
            assert!(!reference.description().contains('\n'));
        }
        assert_eq!(NamedReference::from_name("winkler"), None);
        assert_eq!(NamedReference::nearest("archard_prescribed"), Some("archard-prescribed"));
        assert_eq!(NamedReference::nearest("hertzscar"), Some("hertz-scar"));
    }
}
