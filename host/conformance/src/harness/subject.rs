//! The law under test: its library, its table of functions and its instances, every call noted on the slate.
#![allow(unsafe_code)] // reason: opens a library and calls its functions through the C ABI.

use std::ffi::{CStr, CString, c_char, c_void};
use std::mem::ManuallyDrop;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use wearlaw_plugin_api::abi;

use super::super::message::{Judged, Task, Verdict, broken};
use super::super::outcome::{Finding, NOT_STARTED};
use super::super::slate::{Phase, Slate};
use wearlaw_law::describe::describe;
use wearlaw_law::file_facts::{FileFacts, LinkerRefusal};
use wearlaw_law::float_env::FloatEnv;
use wearlaw_law::loader::MOST_LAWS;
use wearlaw_law::table::{preset_quantity, preset_table, this_host};
use wearlaw_law::{LawDescriptor, LibraryFile, OutputItem, Source, embedded};

/// A library that is open, or this program's own laws.
pub(crate) struct Library {
    entry: abi::EntryFn,
    pub(crate) slate: &'static Slate,
    floats: Mutex<Vec<(Phase, String)>>,
    /// Whether the options of the task were good for an instance already.
    started: AtomicBool,
    /// Stays open to the end of the process unless it is closed: what goes wrong then is one check's finding and not all's.
    file: ManuallyDrop<Option<LibraryFile>>,
}

impl Library {
    /// Opens the library of a task.
    pub(crate) fn open(task: &Task, slate: &'static Slate) -> Judged<Self> {
        match &task.source {
            Source::Embedded(name) => match embedded::function(name) {
                Some(entry) => Ok(Self {
                    entry,
                    slate,
                    floats: Mutex::default(),
                    started: AtomicBool::new(false),
                    file: ManuallyDrop::new(None),
                }),
                None => broken(Finding::new(format!("this program holds no law `{name}`"))),
            },
            Source::File(path) => Self::open_file(path, slate),
        }
    }

    fn open_file(path: &Path, slate: &'static Slate) -> Judged<Self> {
        let mut floats = Vec::new();
        // SAFETY: running the law's code is what the check is for, in a process of its own.
        let opened = watched(slate, Phase::Opening, &mut floats, || unsafe { LibraryFile::open(path) });
        let file = match opened {
            Ok(file) => file,
            Err(error) => {
                let words = match FileFacts::examine(path) {
                    Ok(facts) => LinkerRefusal::from_error(&facts, &error).to_string(),
                    Err(_) => error.to_string(),
                };
                return broken(Finding::new(words));
            }
        };
        #[cfg(feature = "layout-check")]
        if let Err(mismatch) = file.check_layout() {
            return broken(Finding::new(format!("it was not built for this host: {mismatch}")));
        }
        let Some(address) = file.address(abi::ENTRY_SYMBOL) else {
            return broken(Finding::new("it exports no function `wearlaw_entry_1`"));
        };
        // SAFETY: by the ABI, a symbol of this name is a function of this type.
        let entry = unsafe { std::mem::transmute::<*const c_void, abi::EntryFn>(address) };
        Ok(Self {
            entry,
            slate,
            floats: Mutex::new(floats),
            started: AtomicBool::new(false),
            file: ManuallyDrop::new(Some(file)),
        })
    }

    /// Calls the entry with a table of the caller's.
    ///
    /// # Safety
    /// `table` and `host` lead to as many bytes as their `struct_size` says, live for the call.
    pub(crate) unsafe fn ask(&self, index: i32, host: *const abi::Host, table: *mut abi::LawTable) -> i32 {
        // SAFETY: the library is open; the caller answers for the pointers.
        self.watched(Phase::Entry, || unsafe { (self.entry)(index, host, table) })
    }

    /// The table of law `index`, or what the entry answered instead.
    pub(crate) fn table(&self, index: i32) -> Result<abi::LawTable, i32> {
        let mut table = preset_table();
        // SAFETY: host and table are whole structs that outlive the call.
        match unsafe { self.ask(index, this_host(), &mut table) } {
            abi::WL_OK => Ok(table),
            other => Err(other),
        }
    }

    /// The tables of all laws, in the order of their indices.
    pub(crate) fn tables(&self) -> Judged<Vec<abi::LawTable>> {
        let mut tables = Vec::new();
        for index in 0..=MOST_LAWS {
            match self.table(index) {
                Ok(table) => tables.push(table),
                Err(abi::WL_NO_MORE) if index > 0 => return Ok(tables),
                Err(abi::WL_NO_MORE) => {
                    return broken(Finding::new(
                        "it holds no law: its entry answers for index 0 that there are no more",
                    ));
                }
                Err(status) => {
                    let what = format!("its entry refuses law {index}");
                    return broken(Finding::new(what).with(
                        format!("status {status}"),
                        format!("{} for a law, {} past the last", abi::WL_OK, abi::WL_NO_MORE),
                    ));
                }
            }
        }
        broken(Finding::new(format!("its entry still gives laws after {MOST_LAWS}")))
    }

    /// The law of a task: of that name, or the first.
    pub(crate) fn law(&self, task: &Task) -> Judged<Law<'_>> {
        let tables = self.tables()?;
        let wanted = |table: &&abi::LawTable| task.law.as_ref().is_none_or(|name| chars_text(&table.name) == *name);
        match tables.iter().find(wanted) {
            Some(table) => Law::new(self, *table),
            None => broken(Finding::new(format!("it holds no law `{}`", task.law.as_deref().unwrap_or_default()))),
        }
    }

    /// Asks the function of a table to describe something.
    pub(crate) fn describe(&self, table: &abi::LawTable, kind: i32, index: i64) -> Option<(i32, abi::Quantity)> {
        let function = table.describe?;
        let mut quantity = preset_quantity();
        // SAFETY: the function belongs to the open library; the quantity is a whole struct.
        let status = self.watched(Phase::Describing, || unsafe { function(kind, index, &mut quantity) });
        Some((status, quantity))
    }

    /// As [`Library::describe`], into a struct of the caller's.
    ///
    /// # Safety
    /// `quantity` leads to as many bytes as its `struct_size` says, live for the call.
    pub(crate) unsafe fn describe_into(
        &self,
        table: &abi::LawTable,
        (kind, index): (i32, i64),
        quantity: *mut abi::Quantity,
    ) -> Option<i32> {
        let function = table.describe?;
        // SAFETY: the function belongs to the open library; the caller answers for the pointer.
        Some(self.watched(Phase::Describing, || unsafe { function(kind, index, quantity) }))
    }

    /// Asks the function of a table for an extension.
    pub(crate) fn extension(&self, table: &abi::LawTable, id: &CStr) -> Option<*const c_void> {
        let function = table.extension?;
        // SAFETY: the function belongs to the open library; the name is closed by a NUL.
        let found = self.watched(Phase::Extension, || unsafe { function(id.as_ptr()) });
        (!found.is_null()).then_some(found)
    }

    /// Changes of the floating-point environment so far, with what made them; each was put right.
    pub(crate) fn floats(&self) -> Vec<(Phase, String)> {
        self.floats.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Closes the library, which runs its destructors.
    pub(crate) fn close(mut self) {
        let file = self.file.take();
        watched(self.slate, Phase::Closing, &mut Vec::new(), || drop(file));
    }

    fn watched<T>(&self, phase: Phase, work: impl FnOnce() -> T) -> T {
        let before = FloatEnv::capture();
        let outer = self.slate.enter(phase);
        let result = work();
        self.slate.enter(outer);
        if let Some(change) = before.changed_since() {
            before.restore();
            let mut floats = self.floats.lock().unwrap_or_else(PoisonError::into_inner);
            // One that comes with every call is told once.
            if floats.len() < 64 {
                floats.push((phase, change.to_string()));
            }
        }
        result
    }
}

fn watched<T>(slate: &Slate, phase: Phase, floats: &mut Vec<(Phase, String)>, work: impl FnOnce() -> T) -> T {
    let before = FloatEnv::capture();
    let outer = slate.enter(phase);
    let result = work();
    slate.enter(outer);
    if let Some(change) = before.changed_since() {
        before.restore();
        floats.push((phase, change.to_string()));
    }
    result
}

/// One law of a library.
pub(crate) struct Law<'l> {
    pub(crate) library: &'l Library,
    pub(crate) table: abi::LawTable,
    pub(crate) about: LawDescriptor,
}

/// Bytes of the buffer for a law's text.
const TEXT_SIZE: usize = 512;

impl<'l> Law<'l> {
    fn new(library: &'l Library, table: abi::LawTable) -> Judged<Self> {
        let mut ask = |kind: i32, index: i64| {
            library.describe(&table, kind, index).unwrap_or((abi::WL_NO_MORE, preset_quantity()))
        };
        let described = match table.describe {
            Some(_) => describe(&table, Some(&mut ask)),
            None => describe(&table, None),
        };
        match described {
            Ok(about) => Ok(Self { library, table, about }),
            Err(error) => broken(Finding::new(format!("a host refuses the law: {error}"))),
        }
    }

    /// Makes an instance, or gives the law's status and text of refusal. The options live as long as the instance.
    pub(crate) fn create(&self, options: Option<&CStr>) -> Result<Instance<'_>, (i32, String)> {
        self.create_in(options.map(|words| words.to_bytes_with_nul().to_vec())).0
    }

    /// As [`Law::create`] with a text that ends with its NUL; also whether the law wrote to it.
    pub(crate) fn create_in(&self, words: Option<Vec<u8>>) -> (Result<Instance<'_>, (i32, String)>, bool) {
        let mut instance = Instance { law: self, pointer: std::ptr::null_mut(), words };
        let mut wrote = false;
        if let Some(create) = self.table.create {
            let mut text: [c_char; TEXT_SIZE] = [0; TEXT_SIZE];
            let before = instance.words.clone();
            let words = instance.words.as_mut().map_or(std::ptr::null(), |words| words.as_mut_ptr().cast_const());
            let mut pointer = std::ptr::null_mut();
            // SAFETY: the function belongs to the open library; all pointers lead to live values.
            let status = self.library.watched(Phase::Creating, || unsafe {
                create(this_host(), words.cast(), &mut pointer, text.as_mut_ptr(), TEXT_SIZE as i64)
            });
            wrote = instance.words != before;
            if status != abi::WL_OK {
                // There is nothing to destroy.
                let words = instance.words.take();
                std::mem::forget(instance);
                drop(words);
                return (Err((status, chars_text(&text))), wrote);
            }
            instance.pointer = pointer;
        }
        (Ok(instance), wrote)
    }

    /// Calls `create` with a buffer of the caller's for its text; destroys what it makes.
    ///
    /// # Safety
    /// `text` leads to `text_size` bytes, or is NULL with a size of 0.
    pub(crate) unsafe fn try_create(&self, options: Option<&CStr>, text: *mut c_char, text_size: i64) -> Option<i32> {
        let create = self.table.create?;
        let mut pointer = std::ptr::null_mut();
        let words = options.map_or(std::ptr::null(), CStr::as_ptr);
        // SAFETY: the function belongs to the open library; the caller answers for the buffer.
        let status = self
            .library
            .watched(Phase::Creating, || unsafe { create(this_host(), words, &mut pointer, text, text_size) });
        if status == abi::WL_OK {
            drop(Instance { law: self, pointer, words: None });
        }
        Some(status)
    }

    /// An instance with the options of the task.
    pub(crate) fn instance(&self, task: &Task) -> Judged<Instance<'_>> {
        let options = task.options.as_deref().map(CString::new).transpose();
        let Ok(options) = options else {
            return broken(Finding::new("the options hold a NUL character"));
        };
        match self.create(options.as_deref()) {
            Ok(instance) => {
                self.library.started.store(true, Ordering::Relaxed);
                Ok(instance)
            }
            Err((status, text)) if self.library.started.load(Ordering::Relaxed) => {
                let what = "create refuses what it accepted before: it keeps something from one instance to the next";
                broken(Finding::new(what).with(format!("status {status}, text {text:?}"), "an instance, as before"))
            }
            Err((_, text)) => Err(Box::new(Verdict::Skip(match task.options {
                None => format!("{NOT_STARTED} without options ({text}); give them with --options"),
                Some(_) => format!("{NOT_STARTED} with the options given ({text})"),
            }))),
        }
    }

    /// True if the law has a state or can write a direction or a derivative, whichever is asked.
    pub(crate) fn writes(&self, item: OutputItem) -> bool {
        self.about.writes(item)
    }
}

/// An instance; dropping it destroys it.
pub(crate) struct Instance<'l> {
    pub(crate) law: &'l Law<'l>,
    pointer: *mut c_void,
    /// The options that it was made with, to their NUL.
    words: Option<Vec<u8>>,
}

// SAFETY: the ABI lets an instance be used from any thread; checks that use several at once mind the flag SERIAL.
unsafe impl Send for Instance<'_> {}
// SAFETY: as for Send.
unsafe impl Sync for Instance<'_> {}

impl Instance<'_> {
    /// Writes other words over the options that it was made with: they are the host's.
    pub(crate) fn lose_options(&mut self) {
        if let Some((_, words)) = self.words.as_mut().and_then(|words| words.split_last_mut()) {
            words.fill(b'?');
        }
    }

    /// Calls the law.
    ///
    /// # Safety
    /// `view` and `output` are filled as the ABI says, and every array lives for the call.
    pub(crate) unsafe fn evaluate(&self, view: *const abi::View, output: *mut abi::Output) -> i32 {
        let Some(evaluate) = self.law.table.evaluate else { return abi::WL_FAILED };
        // SAFETY: the function belongs to the open library; the caller answers for the rest.
        self.law.library.watched(Phase::Evaluating, || unsafe { evaluate(self.pointer, view, output) })
    }
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        if let Some(destroy) = self.law.table.destroy {
            // SAFETY: `create` made the pointer, or there is no `create` and it is NULL; it is not used again.
            self.law.library.watched(Phase::Destroying, || unsafe { destroy(self.pointer) });
        }
    }
}

/// A text of a law up to its NUL, or all of it where there is none.
pub(crate) fn chars_text(chars: &[c_char]) -> String {
    let bytes: Vec<u8> = chars.iter().map(|byte| byte.to_ne_bytes()[0]).take_while(|byte| *byte != 0).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}
