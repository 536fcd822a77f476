//! The names a history file may use, and the set of them that a plan wants.

/// A column of a history, apart from `time` and `point`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Column {
    /// `pressure`: contact pressure, positive in compression; zero or less means open.
    Pressure,
    /// `velocity`: sliding velocity; may change sign, its magnitude counts.
    Velocity,
    /// `slip`: signed relative displacement since the first row.
    Slip,
    /// `slip_x`: first component of the relative displacement since the first row.
    SlipX,
    /// `slip_y`: second component; zero where the file has `slip_x` only.
    SlipY,
    /// `slip_z`: third component; zero where the file leaves it out.
    SlipZ,
    /// `temperature` of the surface.
    Temperature,
    /// `shear`: friction stress.
    Shear,
    /// `friction`: friction stress over pressure where the point slides, at least zero.
    Friction,
    /// `nx`: first component of the outward normal of the wearing body.
    NormalX,
    /// `ny`: second component; zero where the file leaves it out (2-D).
    NormalY,
    /// `nz`: third component.
    NormalZ,
    /// `sxx`: nodal stress, positive in tension.
    StressXx,
    /// `syy`: nodal stress; zero where the file leaves out the y parts (2-D).
    StressYy,
    /// `szz`: nodal stress.
    StressZz,
    /// `sxy`: nodal stress; zero where the file leaves out the y parts (2-D).
    StressXy,
    /// `syz`: nodal stress; zero where the file leaves out the y parts (2-D).
    StressYz,
    /// `sxz`: nodal stress.
    StressXz,
    /// `area` of surface that the point stands for, greater than zero.
    Area,
    /// `x` coordinate.
    X,
    /// `y` coordinate; zero where the file leaves it out (2-D).
    Y,
    /// `z` coordinate; zero where the file leaves it out.
    Z,
    /// A further input that the law declared by name: its index in [`Needs::further`].
    Further(u16),
}

impl Column {
    /// The columns whose names are fixed, in the order of the documentation.
    pub const NAMED: [(Column, &'static str); 22] = [
        (Column::Pressure, "pressure"),
        (Column::Velocity, "velocity"),
        (Column::Slip, "slip"),
        (Column::SlipX, "slip_x"),
        (Column::SlipY, "slip_y"),
        (Column::SlipZ, "slip_z"),
        (Column::Temperature, "temperature"),
        (Column::Shear, "shear"),
        (Column::Friction, "friction"),
        (Column::NormalX, "nx"),
        (Column::NormalY, "ny"),
        (Column::NormalZ, "nz"),
        (Column::StressXx, "sxx"),
        (Column::StressYy, "syy"),
        (Column::StressZz, "szz"),
        (Column::StressXy, "sxy"),
        (Column::StressYz, "syz"),
        (Column::StressXz, "sxz"),
        (Column::Area, "area"),
        (Column::X, "x"),
        (Column::Y, "y"),
        (Column::Z, "z"),
    ];

    /// The three components of the slip vector.
    pub const SLIP_VECTOR: [Column; 3] = [Column::SlipX, Column::SlipY, Column::SlipZ];
    /// The three components of the normal.
    pub const NORMAL: [Column; 3] = [Column::NormalX, Column::NormalY, Column::NormalZ];
    /// The six components of the nodal stress.
    pub const STRESS: [Column; 6] =
        [Column::StressXx, Column::StressYy, Column::StressZz, Column::StressXy, Column::StressYz, Column::StressXz];
    /// The three coordinates.
    pub const COORDINATES: [Column; 3] = [Column::X, Column::Y, Column::Z];

    /// The column of a fixed name, if `name` is one.
    pub fn from_name(name: &str) -> Option<Column> {
        let hit = Self::NAMED.iter().find(|(_, known)| *known == name);
        hit.map(|(column, _)| *column)
    }

    /// The fixed name of this column; `None` for a further input.
    pub fn fixed_name(self) -> Option<&'static str> {
        let hit = Self::NAMED.iter().find(|(column, _)| *column == self);
        hit.map(|(_, name)| *name)
    }

    /// What is wrong with a value of this column that is a number, if something is: what was expected.
    pub(super) fn refusal(self, value: f64) -> Option<&'static str> {
        match self {
            Column::Area if value <= 0.0 => Some("more than 0"),
            Column::Friction if value < 0.0 => Some("at least 0"),
            _ => None,
        }
    }

    fn bit(self) -> u32 {
        let at = Self::NAMED.iter().position(|(column, _)| *column == self);
        at.map_or(0, |at| 1 << at)
    }
}

/// What a plan wants from a history: columns that it does not name are neither parsed nor kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    bits: u32,
    further: Vec<String>,
    allowed: Vec<String>,
}

impl Needs {
    /// Nothing but times and points.
    pub fn none() -> Needs {
        Needs::default()
    }

    /// The given columns; a further input is asked for with [`Needs::add_further`].
    pub fn of(columns: &[Column]) -> Needs {
        columns.iter().fold(Needs::none(), |needs, c| needs.with(*c))
    }

    /// This set and one column more.
    #[must_use]
    pub fn with(mut self, column: Column) -> Needs {
        self.add(column);
        self
    }

    /// Adds a column with a fixed name; [`Column::Further`] changes nothing.
    pub fn add(&mut self, column: Column) {
        self.bits |= column.bit();
    }

    /// Adds a further input by its name and returns the column under which it is found.
    pub fn add_further(&mut self, name: &str) -> Column {
        let at = self.further.iter().position(|known| known == name);
        let at = at.unwrap_or_else(|| {
            self.further.push(name.to_string());
            self.further.len() - 1
        });
        Column::Further(u16::try_from(at).unwrap_or(u16::MAX))
    }

    /// Says that a file may hold a column of this name, which is passed over.
    pub fn allow(&mut self, name: &str) {
        self.allowed.push(name.to_string());
    }

    /// Whether the column is asked for.
    pub fn has(&self, column: Column) -> bool {
        match column {
            Column::Further(at) => usize::from(at) < self.further.len(),
            named => self.bits & named.bit() != 0,
        }
    }

    /// Names of the further inputs that are asked for.
    pub fn further(&self) -> &[String] {
        &self.further
    }

    /// Names that a file may use without being read.
    pub fn allowed(&self) -> &[String] {
        &self.allowed
    }

    /// Every column that is asked for, fixed names first.
    pub fn columns(&self) -> impl Iterator<Item = Column> + '_ {
        let named = Column::NAMED.iter().map(|(column, _)| *column);
        let further = (0..self.further.len()).map(|at| Column::Further(at as u16));
        named.filter(|column| self.has(*column)).chain(further)
    }

    /// The name of a column, a further input's included.
    pub fn name(&self, column: Column) -> &str {
        match column {
            Column::Further(at) => self.further.get(usize::from(at)).map_or("", String::as_str),
            named => named.fixed_name().unwrap_or(""),
        }
    }

    /// The column that a name in a file stands for, if it is asked for.
    pub fn wanted(&self, name: &str) -> Option<Column> {
        let further = self.further.iter().position(|known| known == name);
        let column = match further {
            Some(at) => Some(Column::Further(at as u16)),
            None => Column::from_name(name),
        };
        column.filter(|column| self.has(*column))
    }
}
