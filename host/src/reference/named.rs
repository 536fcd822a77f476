//! The built-in exact answers by name, as `[reference] kind` spells them.

/// A built-in exact answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NamedReference {
    /// Archard wear of a prescribed scene whose pressure, velocity and constants are linear pieces in time.
    ArchardPrescribed,
}

impl NamedReference {
    /// All of them, in the order in which they are listed.
    pub const ALL: [NamedReference; 1] = [NamedReference::ArchardPrescribed];

    /// The name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            NamedReference::ArchardPrescribed => "archard-prescribed",
        }
    }

    /// One line for the list.
    pub fn description(self) -> &'static str {
        match self {
            NamedReference::ArchardPrescribed => {
                "wear depth of Archard's law under a prescribed history, from the scene's own tables: \
                 pressure, velocity, K, H, m and n linear in time between rows and table points"
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
        assert_eq!(NamedReference::from_name("hertz"), None);
        assert_eq!(NamedReference::nearest("archard_prescribed"), Some("archard-prescribed"));
    }
}
