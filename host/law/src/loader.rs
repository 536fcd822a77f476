//! From a file, or from a law of this program, to laws that can be called.
#![allow(unsafe_code)] // reason: opens a shared library, which runs its constructors.

use std::ffi::{CStr, CString, c_void};
use std::path::Path;
use std::sync::Arc;

use thiserror::Error;

use super::describe::DescribeError;
use super::descriptor::LawDescriptor;
use super::entry::{Entry, LibraryFile};
use super::file_facts::{FileFacts, FileFactsError, LinkerRefusal, PinMismatch, check_pin};
use super::float_env::FloatEnv;
use super::handle::LawInstance;
use super::table::{Answer, BoundLaw, Created};

/// More laws than any library has: an entry that goes on beyond it never answers `WL_NO_MORE`.
pub const MOST_LAWS: i32 = 1024;

/// What is demanded of a library before it is opened.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// SHA-256 that the file must have.
    pub sha256: Option<String>,
}

/// Why a library gives no law.
#[derive(Debug, Error)]
pub enum LoadError {
    /// The file is not a library that can be loaded; none of its code has run.
    #[error(transparent)]
    File(#[from] FileFactsError),
    /// The file is not the one that was pinned; none of its code has run.
    #[error(transparent)]
    Pin(#[from] PinMismatch),
    /// The dynamic linker refused it; none of its code has run.
    #[error(transparent)]
    Linker(#[from] LinkerRefusal),
    /// The law was built with other structs than this host's; none of its functions has been called.
    #[cfg(feature = "layout-check")]
    #[error("`{library}` was not built for this host: {mismatch}")]
    Layout {
        /// The library.
        library: String,
        /// What differs.
        #[source]
        mismatch: super::layout_check::LayoutMismatch,
    },
    /// The entry answered an error.
    #[error(
        "the entry of `{library}` answered {status} for law {index}, expected {} or {}",
        wearlaw_plugin_api::abi::WL_OK,
        wearlaw_plugin_api::abi::WL_NO_MORE
    )]
    EntryStatus {
        /// The library.
        library: String,
        /// Index of the law, from 0.
        index: i32,
        /// The answer.
        status: i32,
    },
    /// The entry has no law at all.
    #[error("`{library}` holds no law: its entry answers for index 0 that there are no more")]
    NoLaws {
        /// The library.
        library: String,
    },
    /// The entry never stops.
    #[error(
        "the entry of `{library}` still gives laws after {MOST_LAWS}, expected {} past the last",
        wearlaw_plugin_api::abi::WL_NO_MORE
    )]
    TooManyLaws {
        /// The library.
        library: String,
    },
    /// The description of a law is malformed.
    #[error("law {index} (`{name}`) of `{library}` is malformed: {error}")]
    Malformed {
        /// The library.
        library: String,
        /// Index of the law, from 0.
        index: i32,
        /// Its name, as far as it can be read.
        name: String,
        /// What is wrong.
        #[source]
        error: Box<DescribeError>,
    },
    /// Two laws of one name.
    #[error("`{library}` holds two laws called `{name}`")]
    SameName {
        /// The library.
        library: String,
        /// The name.
        name: String,
    },
    /// No law of that name.
    #[error("`{library}` holds no law `{wanted}`, it has {}", known.join(", "))]
    NoSuchLaw {
        /// The library.
        library: String,
        /// The name wanted.
        wanted: String,
        /// The names it has.
        known: Vec<String>,
    },
    /// Several laws, and none was named.
    #[error("`{library}` holds {} laws, name one of {}", known.len(), known.join(", "))]
    Ambiguous {
        /// The library.
        library: String,
        /// The names it has.
        known: Vec<String>,
    },
    /// The options hold a NUL, which a C text cannot.
    #[error("the options of law `{law}` hold a NUL character at byte {position}")]
    OptionsNul {
        /// The law.
        law: String,
        /// Where.
        position: usize,
    },
    /// The law refused to be created.
    #[error("law `{law}` of `{library}` refused to start (status {status}){}", if text.is_empty() { String::new() } else { format!(": {text}") })]
    Refused {
        /// The law.
        law: String,
        /// The library.
        library: String,
        /// What `create` answered.
        status: i32,
        /// The law's own words; may be empty.
        text: String,
    },
}

impl LoadError {
    /// True if code of the library has run by then: the law failed, where otherwise the input was wrong.
    pub fn code_has_run(&self) -> bool {
        match self {
            Self::File(_) | Self::Pin(_) | Self::Linker(_) => false,
            // A name or an option that does not fit is the scene's mistake, not the law's.
            Self::NoSuchLaw { .. } | Self::Ambiguous { .. } | Self::OptionsNul { .. } => false,
            // Its constructors have run, when it was opened.
            #[cfg(feature = "layout-check")]
            Self::Layout { .. } => true,
            Self::EntryStatus { .. }
            | Self::NoLaws { .. }
            | Self::TooManyLaws { .. }
            | Self::Malformed { .. }
            | Self::SameName { .. }
            | Self::Refused { .. } => true,
        }
    }
}

/// The laws of one library, or of this program.
pub struct Plugin {
    name: String,
    facts: Option<FileFacts>,
    laws: Vec<Law>,
    warnings: Vec<String>,
}

impl std::fmt::Debug for Plugin {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("Plugin").field("name", &self.name).field("laws", &self.laws).finish_non_exhaustive()
    }
}

impl Plugin {
    /// Reads a library's facts, checks its pin, opens it and asks for its laws.
    ///
    /// # Errors
    /// Everything that is wrong with the file (before any of its code has run), with its entry or with a description.
    pub fn open(path: impl AsRef<Path>, options: &LoadOptions) -> Result<Self, LoadError> {
        let path = path.as_ref();
        let facts = FileFacts::read(path)?;
        if let Some(pin) = &options.sha256 {
            check_pin(&facts, pin)?;
        }
        let library = facts.path.display().to_string();
        let mut warnings = Vec::new();
        let opened = guarded(&library, "when it was opened", &mut warnings, || {
            // SAFETY: running a law's code is what the user asked for; the file's facts are those of a wear law.
            unsafe { LibraryFile::open(path) }
        });
        let file = opened.map_err(|error| LinkerRefusal::from_error(&facts, &error))?;
        #[cfg(feature = "layout-check")]
        file.check_layout().map_err(|mismatch| LoadError::Layout { library, mismatch })?;
        let mut plugin = Self::from_entry(Arc::new(file))?;
        warnings.append(&mut plugin.warnings);
        Ok(Self { facts: Some(facts), warnings, ..plugin })
    }

    /// Asks an entry for its laws.
    ///
    /// # Errors
    /// Everything that is wrong with the entry or with a description.
    pub fn from_entry(entry: Arc<dyn Entry>) -> Result<Self, LoadError> {
        let name = entry.name().to_owned();
        let mut warnings = Vec::new();
        let laws = guarded(&name, "while it described its laws", &mut warnings, || ask_all(&entry))?;
        Ok(Self { name, facts: None, laws, warnings })
    }

    /// What messages call it: a path, or a name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The facts of its file, if it is one.
    pub fn facts(&self) -> Option<&FileFacts> {
        self.facts.as_ref()
    }

    /// Its laws, in the order of their indices.
    pub fn laws(&self) -> &[Law] {
        &self.laws
    }

    /// What was put right while it was loaded.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The law of that name, or the only one.
    ///
    /// # Errors
    /// No law of that name, or no name where there are several.
    pub fn law(&self, name: Option<&str>) -> Result<&Law, LoadError> {
        let known = || self.laws.iter().map(|law| law.descriptor().name.clone()).collect();
        match (name, self.laws.as_slice()) {
            (None, [only]) => Ok(only),
            (None, _) => Err(LoadError::Ambiguous { library: self.name.clone(), known: known() }),
            (Some(wanted), laws) => laws.iter().find(|law| law.descriptor().name == wanted).ok_or_else(|| {
                LoadError::NoSuchLaw { library: self.name.clone(), wanted: wanted.to_owned(), known: known() }
            }),
        }
    }
}

fn ask_all(entry: &Arc<dyn Entry>) -> Result<Vec<Law>, LoadError> {
    let library = || entry.name().to_owned();
    let mut laws: Vec<Law> = Vec::new();
    for index in 0..=MOST_LAWS {
        match BoundLaw::ask(entry, index) {
            Answer::NoMore if index == 0 => return Err(LoadError::NoLaws { library: library() }),
            Answer::NoMore => return Ok(laws),
            Answer::Status(status) => {
                return Err(LoadError::EntryStatus { library: library(), index, status });
            }
            Answer::Malformed { name, error } => {
                return Err(LoadError::Malformed { library: library(), index, name, error });
            }
            Answer::Law(law) => {
                let name = &law.descriptor.name;
                if laws.iter().any(|other| other.descriptor().name == *name) {
                    return Err(LoadError::SameName { library: library(), name: name.clone() });
                }
                laws.push(Law { law });
            }
        }
    }
    Err(LoadError::TooManyLaws { library: library() })
}

/// Runs `work` and puts the floating-point environment back if it was changed meanwhile.
fn guarded<T>(library: &str, when: &str, warnings: &mut Vec<String>, work: impl FnOnce() -> T) -> T {
    let before = FloatEnv::capture();
    let result = work();
    if let Some(change) = before.changed_since() {
        before.restore();
        warnings.push(format!("`{library}` changed the floating-point environment {when} ({change}); it was put back"));
    }
    result
}

/// One law, described but not created; it keeps its library open.
#[derive(Clone)]
pub struct Law {
    law: Arc<BoundLaw>,
}

impl std::fmt::Debug for Law {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("Law").field("name", &self.descriptor().name).finish_non_exhaustive()
    }
}

impl Law {
    /// What the law is.
    pub fn descriptor(&self) -> &LawDescriptor {
        &self.law.descriptor
    }

    /// Address of an extension, valid as long as this value or an instance of it lives.
    pub fn extension(&self, id: &CStr) -> Option<*const c_void> {
        self.law.extension(id)
    }

    /// Creates an instance, with the scene's options for laws that take any.
    ///
    /// # Errors
    /// Options that are no C text, or the law's refusal in its own words.
    pub fn create(&self, options: Option<&str>) -> Result<LawInstance, LoadError> {
        let law = &self.law.descriptor.name;
        let options = options
            .map(CString::new)
            .transpose()
            .map_err(|error| LoadError::OptionsNul { law: law.clone(), position: error.nul_position() })?;
        let mut warnings = Vec::new();
        let created = guarded(self.law.library(), "when a law was created", &mut warnings, || {
            Created::new(Arc::clone(&self.law), options)
        });
        match created {
            Ok(created) => Ok(LawInstance::new(created, warnings)),
            Err(refusal) => Err(LoadError::Refused {
                law: law.clone(),
                library: self.law.library().to_owned(),
                status: refusal.status,
                text: refusal.text,
            }),
        }
    }
}
