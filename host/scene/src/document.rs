//! The scene as a whole: from text to typed values and back.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::Serialize;
use toml::de::DeTable;

use super::contact::{Boundary, Contact, Model, ModelKind, SOLVED};
use super::drive::Drive;
use super::error::{Problem, SceneError};
use super::geometry::{Grid, Surface};
use super::law::Law;
use super::loading::{Cycle, Loading, Step};
use super::method::{Integrator, Scaling, Stop};
use super::output::{Output, Reference};
use super::overrides::{Override, one_line};
use super::place::{Located, Location, Source};
use super::reader::{Key, Section};
use super::tree::{Node, Places};
use super::units::Units;

/// What was asked, in the scene's units: a valid scene with its defaults filled in.
///
/// Serialised it has the form of a scene file, so that a report can carry it and [`Scene::parse`] reads it again. There
/// is no other way in, which keeps every scene valid.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scene {
    /// One line on what this is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Labels of the units.
    pub units: Units,
    /// The wear law and what the host does with it.
    pub law: Law,
    /// Where the pressure comes from.
    pub contact: Contact,
    /// The points of a solved contact; `None` in prescribed scenes only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grid: Option<Grid>,
    /// The initial gap of a solved contact; `None` in prescribed scenes only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface: Option<Surface>,
    /// Load steps before the cycles.
    #[serde(rename = "step", skip_serializing_if = "Vec::is_empty")]
    pub steps: Vec<Step>,
    /// Cycles, after all `steps`; a step written after a cycle is a cycle of one here.
    #[serde(rename = "cycle", skip_serializing_if = "Vec::is_empty")]
    pub cycles: Vec<Cycle>,
    /// How wear is advanced.
    pub integrator: Integrator,
    /// Scaling of the wear increment.
    #[serde(skip_serializing_if = "Scaling::is_default")]
    pub scaling: Scaling,
    /// When to end early.
    #[serde(skip_serializing_if = "Stop::is_default")]
    pub stop: Stop,
    /// What to write.
    pub output: Output,
    /// What the answer should be.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference: Option<Reference>,
    /// The scene file, which relative paths start from.
    #[serde(skip)]
    pub file: PathBuf,
    #[serde(skip)]
    places: Places,
}

const KEYS: &[Key] = &[
    ("title", &[]),
    ("units", &[]),
    ("law", &[]),
    ("contact", &[]),
    ("grid", SOLVED),
    ("surface", SOLVED),
    ("step", &[]),
    ("cycle", &[]),
    ("integrator", &[]),
    ("scaling", &[]),
    ("stop", &[]),
    ("output", &[]),
    ("reference", &[]),
];

impl Scene {
    /// Reads a scene file and applies the overrides in order.
    ///
    /// # Errors
    /// [`Problem::Read`] where the file cannot be read, and all that [`Scene::parse`] finds.
    pub fn read(file: impl AsRef<Path>, overrides: &[Override]) -> Result<Self, SceneError> {
        let file = file.as_ref();
        let bytes = std::fs::read(file)
            .map_err(|error| Located::new(Problem::Read { path: file.to_owned(), kind: error.kind() }, None))?;
        match String::from_utf8(bytes) {
            Ok(text) => Self::parse(&text, file, overrides),
            Err(error) => {
                let start = error.utf8_error().valid_up_to();
                let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
                let end = start + text[start..].chars().next().map_or(0, char::len_utf8);
                let source = file_source(file, text);
                Err(Located::new(Problem::NotUtf8, Some(Location { source, span: start..end, key: String::new() })))
            }
        }
    }

    /// Types and checks the text of a scene. `file` names it in errors and is where its relative paths start.
    ///
    /// # Errors
    /// The first [`Problem`] found, with its place in the text or in the override that brought it in.
    pub fn parse(text: &str, file: impl AsRef<Path>, overrides: &[Override]) -> Result<Self, SceneError> {
        let file = file.as_ref();
        let source = file_source(file, text.to_owned());
        let table = DeTable::parse(text).map_err(|error| {
            let span = error.span().unwrap_or(0..0);
            let location = Location { source: source.clone(), span, key: String::new() };
            Located::new(Problem::Syntax { message: one_line(error.message()) }, Some(location))
        })?;
        let mut tree = Node::root(&table);
        let mut texts = vec![source];
        for (index, change) in overrides.iter().enumerate() {
            let source = change.source();
            change.apply(&mut tree, index + 1, &source)?;
            texts.push(source);
        }
        let mut places = Places::new(texts);
        places.note("", None, &tree);
        let root = Section::root(&places, &tree);
        let (mut scene, moved) = Self::typed(&root, file)?;
        places.rename(&moved);
        scene.places = places;
        Ok(scene)
    }

    fn typed(root: &Section<'_>, file: &Path) -> Result<(Self, Vec<(String, String)>), SceneError> {
        // The model decides which keys there are, but a misspelt section is the better thing to say first.
        let model = root.get("contact").and_then(|item| item.section().ok()?.get("model")?.word().ok());
        root.keys(KEYS, model.unwrap_or(ModelKind::HalfSpace)).or_else(|error| match *error.problem {
            Problem::OtherModel { .. } if model.is_none() => Ok(()),
            _ => Err(error),
        })?;
        let contact_item = root.need("contact")?;
        let contact_section = contact_item.section()?;
        let contact = Contact::read(&contact_section)?;
        let (model, dimension) = (contact.model.kind(), contact.dimension);
        let units = optional(root, "units", |section| Units::read(section, model))?.unwrap_or_default();
        let law = Law::read(&root.need("law")?.section()?, model, dimension, &units)?;
        let (mut grid, mut surface) = (None, None);
        if model != ModelKind::Prescribed {
            let needed =
                |key: &'static str| root.get(key).ok_or_else(|| root.missing(key, "because the contact is solved"));
            grid = Some(Grid::read(&needed("grid")?.section()?, model, dimension)?);
            surface = Some(Surface::read(&needed("surface")?.section()?, model, dimension)?);
        }
        let loading = Loading::read(root, &contact, &units)?;
        check_datum(&contact_section, &contact, &loading)?;
        let scene = Self {
            title: root.get("title").map(|item| item.text()).transpose()?,
            units,
            law,
            contact,
            grid,
            surface,
            steps: loading.steps,
            cycles: loading.cycles,
            integrator: optional(root, "integrator", |section| Integrator::read(section, model))?.unwrap_or_default(),
            scaling: optional(root, "scaling", |section| Scaling::read(section, model))?.unwrap_or_default(),
            stop: optional(root, "stop", |section| Stop::read(section, model))?.unwrap_or_default(),
            output: optional(root, "output", |section| Output::read(section, model))?.unwrap_or_default(),
            reference: optional(root, "reference", |section| Reference::read(section, model))?,
            file: file.to_owned(),
            places: Places::default(),
        };
        Ok((scene, loading.moved))
    }

    /// The scene as a scene file, with its defaults and overrides written out.
    pub fn toml(&self) -> String {
        // Every type of a scene is a table, list, string or finite number, all of which TOML has.
        toml::to_string(self).unwrap_or_default()
    }

    /// A path of the scene, seen from the folder of the scene file unless it is absolute.
    pub fn resolve(&self, path: impl AsRef<Path>) -> PathBuf {
        match self.file.parent() {
            Some(folder) => folder.join(path),
            None => path.as_ref().to_owned(),
        }
    }

    /// Where a key was written; `None` where it is a default. Steps and cycles count as in [`Scene::steps`] and
    /// [`Scene::cycles`], whatever their order in the file.
    pub fn locate(&self, key: &str) -> Option<Location> {
        self.places.locate(key)
    }

    /// Ties an error of another module to a key, or to the nearest section around it that was written.
    pub fn error_at<E>(&self, key: &str, problem: E) -> Located<E> {
        let mut around = key;
        loop {
            if let Some(found) = self.locate(around) {
                return Located::new(problem, Some(Location { key: key.to_owned(), ..found }));
            }
            match around.rfind('.') {
                Some(dot) => around = &around[..dot],
                None if around.is_empty() => return Located::new(problem, None),
                None => around = "",
            }
        }
    }
}

fn file_source(file: &Path, text: String) -> Arc<Source> {
    Arc::new(Source { name: file.display().to_string(), text, file: true })
}

fn optional<T>(
    root: &Section<'_>,
    key: &str,
    read: impl FnOnce(&Section<'_>) -> Result<T, SceneError>,
) -> Result<Option<T>, SceneError> {
    match root.get(key) {
        Some(item) => read(&item.section()?).map(Some),
        None => Ok(None),
    }
}

/// Displacements of a 2-D half-space have no natural zero: an approach means something only with a datum.
fn check_datum(section: &Section<'_>, contact: &Contact, loading: &Loading) -> Result<(), SceneError> {
    let Model::HalfSpace(half_space) = &contact.model else {
        return Ok(());
    };
    let steps = loading.steps.iter().chain(loading.cycles.iter().flat_map(|cycle| &cycle.steps));
    let approach = steps.into_iter().any(|step| matches!(step.drive, Some(Drive::Approach(_))));
    let wanted = contact.dimension == 2 && half_space.boundary == Boundary::Free && approach;
    match half_space.datum {
        Some(_) if !wanted => {
            let condition = "in 2-D contact with a free boundary under `approach`";
            Err(section.error("datum", Problem::Misplaced { key: "contact.datum".to_owned(), condition }))
        }
        None if wanted => {
            Err(section.missing("datum", "because in 2-D free contact an approach has no zero of its own"))
        }
        _ => Ok(()),
    }
}
