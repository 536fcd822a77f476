#![allow(unsafe_code)] // reads the layout that a loaded library exports
//! The type layouts of laws written in Rust, compared with this host's before the law is called.
//!
//! An extra net over the C ABI, behind the feature `layout-check`: a library that exports its layout is held to
//! it, one that does not (C, C++, Fortran) needs none. The crate's report of a hundred lines becomes five.

use std::fmt;

use abi_stable::abi_stability::abi_checking::{
    AbiInstability as Fault, AbiInstabilityError, ExpectedFound, check_layout_compatibility,
};
use abi_stable::library::AbiHeader;
use abi_stable::type_layout::{TLFieldOrFunction, TLFunction, TypeLayout};
use libloading::os::unix::Library;
use wearlaw_plugin_api::abi::LAYOUT_SYMBOL;
use wearlaw_plugin_api::layout::{LAYOUT, LayoutExport};

/// Most lines of a report, its head included.
const MOST_LINES: usize = 5;

/// Why a library's type layout is not this host's.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LayoutMismatch {
    /// The layouts are written down in a form that this host cannot read.
    #[error("its type layout is of abi_stable {}.{}, expected {}.{}", found.0, found.1, expected.0, expected.1)]
    OtherForm {
        /// Version of the layout crate in the library.
        found: (u32, u32),
        /// Version of the layout crate in this host.
        expected: (u32, u32),
    },
    /// Something else than a layout stands under the layout's name.
    #[error("its type layout does not begin with the mark of abi_stable")]
    NoLayout,
    /// The types differ.
    #[error("its types differ from the wear-law ABI:{}", lines(differences))]
    Differs {
        /// Each difference that counts, at most four: field path, what was expected, what was found.
        differences: Vec<Difference>,
    },
}

/// One difference between two layouts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// Type and fields from the outside in, such as `Frozen.view.slip`.
    pub place: String,
    /// What this host has.
    pub expected: String,
    /// What the library has.
    pub found: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: found {}, expected {}", self.place, self.found, self.expected)
    }
}

fn lines(differences: &[Difference]) -> String {
    differences.iter().map(|difference| format!("\n  {difference}")).collect()
}

/// Compares the layout that a library exports with this host's; a library that exports none is passed.
///
/// # Errors
/// What stands under the layout's name is none, or it is another one than this host's.
pub fn check_library(library: &Library) -> Result<(), LayoutMismatch> {
    // SAFETY: whoever exports this name exports a layout behind its header, as `export_laws!` does. The
    // header is all that is read until it has said that the rest has this host's form.
    unsafe {
        let Ok(header) = library.get::<*const AbiHeader>(LAYOUT_SYMBOL) else {
            return Ok(());
        };
        let header: *const AbiHeader = *header;
        let Some(found) = header.as_ref() else {
            return Err(LayoutMismatch::NoLayout);
        };
        check_header(found)?;
        check_layout(LAYOUT, (*header.cast::<LayoutExport>()).layout)
    }
}

/// Checks the mark and version in front of an exported layout, before the layout itself is looked at.
///
/// # Errors
/// It is no such mark, or of an incompatible version.
pub fn check_header(found: &AbiHeader) -> Result<(), LayoutMismatch> {
    let host = AbiHeader::VALUE;
    if found.magic_string != host.magic_string {
        Err(LayoutMismatch::NoLayout)
    } else if !found.is_valid() {
        let version = |header: &AbiHeader| (header.abi_major, header.abi_minor);
        Err(LayoutMismatch::OtherForm { found: version(found), expected: version(&host) })
    } else {
        Ok(())
    }
}

/// Compares a library's layout with this host's; the version of the crate that declares the types does not count.
///
/// # Errors
/// The types differ in a name, a size, a field or a function's signature.
pub fn check_layout(expected: &'static TypeLayout, found: &'static TypeLayout) -> Result<(), LayoutMismatch> {
    let Err(report) = check_layout_compatibility(expected, found) else {
        return Ok(());
    };
    let mut differences: Vec<(bool, Difference)> = Vec::new();
    for error in report.errors.iter() {
        for fault in error.errs.iter() {
            // The layout decides, not the number: the crate's rule would part 0.1 from 0.2.
            if matches!(fault, Fault::PackageVersion(_)) {
                continue;
            }
            let difference = describe(expected.name(), error, fault);
            let follows = matches!(fault, Fault::Size(_) | Fault::Alignment(_) | Fault::FieldCountMismatch(_));
            if !differences.iter().any(|(_, known)| *known == difference) {
                differences.push((follows, difference));
            }
        }
    }
    if differences.is_empty() {
        return Ok(());
    }
    // A size differs because a field does: the fields come first, and those inside before those around them.
    differences.sort_by_key(|(follows, difference)| (*follows, usize::MAX - difference.place.matches('.').count()));
    let kept = differences.into_iter().map(|(_, difference)| difference).take(MOST_LINES - 1);
    Err(LayoutMismatch::Differs { differences: kept.collect() })
}

fn describe(root: &str, error: &AbiInstabilityError, fault: &Fault) -> Difference {
    let mut place = root.to_owned();
    for step in error.stack_trace.iter() {
        match &step.expected {
            TLFieldOrFunction::Field(field) => place = format!("{place}.{}", field.name()),
            TLFieldOrFunction::Function(_) => place += "()",
        }
    }
    let functions = error.stack_trace.iter().rev().find_map(|step| match (&step.expected, &step.found) {
        (TLFieldOrFunction::Function(expected), TLFieldOrFunction::Function(found)) => {
            Some(signatures(expected, found))
        }
        _ => None,
    });
    let (expected, found) = match fault {
        Fault::Name(pair) => typed(pair, |name| format!("type {name}")),
        Fault::Package(pair) => typed(pair, |name| format!("a type of the crate {name}")),
        Fault::Size(pair) => typed(pair, |size| format!("{size} bytes")),
        Fault::Alignment(pair) => typed(pair, |size| format!("alignment to {size} bytes")),
        // In a function's signature the parameters are the fields.
        Fault::UnexpectedField(_) | Fault::FieldCountMismatch(_) if functions.is_some() => {
            functions.unwrap_or_default()
        }
        Fault::FnQualifierMismatch(pair) => typed(pair, ToString::to_string),
        Fault::UnexpectedField(pair) => typed(pair, |field| format!("field `{}`: {}", field.name(), field.full_type())),
        Fault::FieldCountMismatch(pair) => typed(pair, |count| format!("{count} fields")),
        Fault::MismatchedPrimitive(pair) => typed(pair, |primitive| format!("{primitive:?}")),
        Fault::MismatchedConstParam(pair) => typed(pair, |value| format!("array length or constant {value:?}")),
        Fault::ReprAttr(pair) => typed(pair, |repr| format!("representation {repr:?}")),
        Fault::NonZeroness(pair) => typed(pair, |never| if *never { "never zero" } else { "possibly zero" }.to_owned()),
        _ => ("the same".to_owned(), "another form of type".to_owned()),
    };
    let one_line = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    Difference { place, expected: one_line(expected), found: one_line(found) }
}

/// Two signatures by their types; the crate's own text runs the parameters' names together.
fn signatures(expected: &TLFunction, found: &TLFunction) -> (String, String) {
    let text = |function: &TLFunction| {
        let name = |layout: extern "C" fn() -> &'static TypeLayout| layout().full_type().to_string().trim().to_owned();
        let parameters: Vec<_> = function.param_type_layouts.iter().map(name).collect();
        let result = function.return_type_layout().map_or_else(|| "()".to_owned(), name);
        format!("fn({}) -> {result}", parameters.join(", "))
    };
    let (expected, mut found) = (text(expected), text(found));
    if found == expected {
        found += " with other parameter names";
    }
    (expected, found)
}

fn typed<T>(pair: &ExpectedFound<T>, words: impl Fn(&T) -> String) -> (String, String) {
    (words(&pair.expected), words(&pair.found))
}

#[cfg(test)]
mod tests {
    use super::{LayoutMismatch, check_header, check_layout};
    use abi_stable::StableAbi;
    use abi_stable::library::AbiHeader;

    /// The same two types with a body of their own per module: a host's and its authors'.
    macro_rules! types {
        ($name:ident { $($view:tt)* } { $($call:tt)* }) => {
            mod $name {
                use abi_stable::StableAbi;

                #[repr(C)]
                #[derive(StableAbi)]
                pub struct View { pub struct_size: i64, $($view)* }

                #[repr(C)]
                #[derive(StableAbi)]
                pub struct Law { pub view: View, pub evaluate: Option<unsafe extern "C" fn($($call)*) -> i32> }
            }
        };
    }

    types!(host { pub pressure: *const f64, pub slip: *const f64, pub name: [u8; 64] } { view: *const View });
    types!(same { pub pressure: *const f64, pub slip: *const f64, pub name: [u8; 64] } { view: *const View });
    types!(renamed { pub pressure: *const f64, pub slide: *const f64, pub name: [u8; 64] } { view: *const View });
    types!(swapped { pub slip: *const f64, pub pressure: *const f64, pub name: [u8; 64] } { view: *const View });
    types!(retyped { pub pressure: *const f64, pub slip: i64, pub name: [u8; 64] } { view: *const View });
    types!(appended { pub pressure: *const f64, pub slip: *const f64, pub name: [u8; 64], pub gap: i64 } { view: *const View });
    types!(longer { pub pressure: *const f64, pub slip: *const f64, pub name: [u8; 72] } { view: *const View });
    types!(recalled { pub pressure: *const f64, pub slip: *const f64, pub name: [u8; 64] } { view: *const View, n: i64 });

    fn said<T: StableAbi>() -> String {
        let refused = check_layout(<host::Law as StableAbi>::LAYOUT, <T as StableAbi>::LAYOUT).unwrap_err();
        let text = refused.to_string();
        assert!(text.lines().count() <= 5, "{text}");
        text
    }

    #[test]
    fn the_same_types_pass() {
        assert_eq!(check_layout(<host::Law as StableAbi>::LAYOUT, <same::Law as StableAbi>::LAYOUT), Ok(()));
        assert_eq!(check_header(&AbiHeader::VALUE), Ok(()));
    }

    #[test]
    fn each_difference_names_type_and_field() {
        let first = |text: String| text.lines().nth(1).unwrap().trim().to_owned();
        assert_eq!(
            first(said::<renamed::Law>()),
            "Law.view: found field `slide`: *const f64, expected field `slip`: *const f64"
        );
        assert_eq!(
            first(said::<swapped::Law>()),
            "Law.view: found field `slip`: *const f64, expected field `pressure`: *const f64"
        );
        assert_eq!(first(said::<retyped::Law>()), "Law.view.slip: found type i64, expected type *const f64");
        let longer = said::<longer::Law>();
        assert!(longer.contains("Law.view.name") && longer.contains("72") && longer.contains("64"), "{longer}");
        let appended = said::<appended::Law>();
        assert!(appended.contains("Law.view: found 5 fields, expected 4 fields"), "{appended}");
        assert_eq!(
            first(said::<recalled::Law>()),
            "Law.evaluate(): found fn(*const View, i64) -> i32, expected fn(*const View) -> i32"
        );
    }

    #[test]
    fn what_is_no_layout_is_told() {
        let mut header = AbiHeader::VALUE;
        header.abi_minor += 1;
        assert!(matches!(check_header(&header), Err(LayoutMismatch::OtherForm { .. })));
        header.magic_string = [0; 32];
        assert_eq!(check_header(&header), Err(LayoutMismatch::NoLayout));
    }
}
