//! Every size, offset, kind and constant of the ABI is the same in Rust, in C and in Fortran.

#[path = "support/native.rs"]
mod native;

use std::collections::BTreeMap;
use std::mem::{offset_of, size_of};
use std::path::Path;
use std::process::Command;

use wearlaw_plugin_api::abi::*;

/// What is compared of one field, by `struct.field`: offset, size and kind.
type Table = BTreeMap<String, (usize, usize, String)>;

trait Kind {
    const NAME: &'static str;
}
macro_rules! kinds {
    ($($kind:ty => $name:literal),* $(,)?) => { $(impl Kind for $kind { const NAME: &'static str = $name; })* };
}
kinds! {
    i64 => "integer", f64 => "real", *const f64 => "pointer", *mut f64 => "pointer", *const i64 => "pointer",
    *mut i32 => "pointer", *const Column => "pointer", *mut std::ffi::c_char => "pointer",
    Column => "column", IndexColumn => "index_column",
}
impl<const N: usize> Kind for [std::ffi::c_char; N] {
    const NAME: &'static str = "characters";
}
impl<F: Copy> Kind for Option<F> {
    const NAME: &'static str = "function";
}

fn size_and_kind<T, F: Kind>(_: fn(&T) -> &F) -> (usize, String) {
    (size_of::<F>(), F::NAME.to_owned())
}

/// Adds a struct to the table; a field that is not listed does not compile.
macro_rules! add {
    ($table:ident, $name:literal, $struct:ident { $($field:ident),* $(,)? }) => {
        let _every_field_is_listed = |x: $struct| { let $struct { $($field: _),* } = x; };
        $table.insert($name.to_owned(), (0, size_of::<$struct>(), "struct".to_owned()));
        $(
            let (size, kind) = size_and_kind::<$struct, _>(|x| &x.$field);
            $table.insert(format!("{}.{}", $name, stringify!($field)), (offset_of!($struct, $field), size, kind));
        )*
    };
}

#[rustfmt::skip]
fn in_rust() -> Table {
    let mut table = Table::new();
    add!(table, "wl_host", Host { struct_size, abi_minor, provides, accepts, name, version });
    add!(table, "wl_quantity", Quantity {
        struct_size, name, summary, metre, kilogram, second, kelvin, minimum, maximum, default_value, flags,
    });
    add!(table, "wl_column", Column { ptr, step });
    add!(table, "wl_index_column", IndexColumn { ptr, step });
    add!(table, "wl_view", View {
        struct_size, points, dimension, request, time, dt, step_time, load_step, substep, cycle, material, pair, body,
        counter_body, reference_temperature, absolute_zero, unit_metre, unit_kilogram, unit_second, unit_kelvin,
        constant_count, constants, input_count, inputs, state_count, state, pressure, slip, velocity, slip_vector,
        normal, coordinates, tangent, temperature, counter_temperature, friction_stress, friction_coefficient,
        friction_work, accumulated_wear, accumulated_slip, nodal_traction, gap, area, contact_state, point_id,
        element_id,
    });
    add!(table, "wl_output", Output {
        struct_size, increment, direction, state, status, first_bad, dt_factor, missing, text, text_size, d_pressure,
    });
    add!(table, "wl_law", LawTable {
        struct_size, abi_minor, name, version, summary, source, reads, uses, writes, claims, flags, constant_count,
        state_count, input_count, pressure_degree, pressure_degree_constant, describe, create, evaluate, destroy,
        extension,
    });
    table
}

/// Runs a generated program and reads its lines `name offset size kind`.
fn table_of(source: &Path, compiler: &mut Command) -> Table {
    let program = source.with_extension("out");
    let built = compiler.arg(source).arg("-o").arg(&program).output().expect("the compiler starts");
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    let run = Command::new(&program).output().expect("the program starts");
    assert!(run.status.success());
    let text = String::from_utf8(run.stdout).expect("a text");
    let number =
        |word: &str| word.parse::<i64>().map(|n| n as usize).unwrap_or_else(|_| panic!("{word} is no number: {text}"));
    text.lines()
        .map(|line| line.split_whitespace().collect::<Vec<_>>())
        .map(|w| (w[0].to_owned(), (number(w[1]), number(w[2]), w[3].to_owned())))
        .collect()
}

fn in_c(header: &str, folder: &Path) -> Table {
    let mut text = String::from(
        "#include \"wearlaw.h\"\n#include <stdio.h>\n\
         #define KIND(x) _Generic((x), int64_t: \"integer\", double: \"real\", const double *: \"pointer\", \\\n\
             double *: \"pointer\", const int64_t *: \"pointer\", int32_t *: \"pointer\", \\\n\
             const struct wl_column *: \"pointer\", wl_column: \"column\", wl_index_column: \"index_column\", \\\n\
             char *: sizeof(x) == sizeof(char *) ? \"pointer\" : \"characters\", default: \"function\")\n\
         #define FIELD(s, f) printf(\"%s.%s %zu %zu %s\\n\", #s, #f, offsetof(s, f), sizeof(((s *)0)->f), KIND(((s *)0)->f))\n\
         int main(void) {\n",
    );
    for name in in_rust().keys() {
        text += &match name.split_once('.') {
            Some((of, field)) => format!("    FIELD({of}, {field});\n"),
            None => format!("    printf(\"{name} 0 %zu struct\\n\", sizeof({name}));\n"),
        };
    }
    text += "    return 0;\n}\n";
    std::fs::write(folder.join("wearlaw.h"), header).expect("a writable folder");
    std::fs::write(folder.join("layout.c"), text).expect("a writable folder");
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".into());
    table_of(&folder.join("layout.c"), Command::new(compiler).args(["-std=c11", "-Wall", "-Werror", "-I"]).arg(folder))
}

/// The constants of the header, by name in lower case.
fn constants(header: &str) -> BTreeMap<String, i64> {
    let words = header.lines().filter_map(|line| line.strip_prefix("#define ")?.split_once(' '));
    words.filter_map(|(name, value)| Some((name.to_lowercase(), value.parse().ok()?))).collect()
}

/// The table in Fortran, with every constant as a row of its own (its value as the offset).
fn in_fortran(folder: &Path, constants: &BTreeMap<String, i64>) -> Table {
    let mut text = String::from(
        "program layout\n  use wearlaw\n  use, intrinsic :: iso_c_binding\n  implicit none\n  interface kind_of\n    \
         procedure integer_kind, real_kind, pointer_kind, characters_kind, column_kind, index_kind\n  \
         end interface\n",
    );
    let rust = in_rust();
    let structs = || rust.keys().filter(|name| !name.contains('.'));
    for name in structs() {
        text += &format!("  type({name}), target :: a_{name}\n");
    }
    for name in rust.keys() {
        text += &match name.split_once('.') {
            Some((of, field)) => format!(
                "  call row('{name}', c_loc(a_{of}), c_loc(a_{of}%{field}), &\n    \
                 c_sizeof(a_{of}%{field}), kind_of(a_{of}%{field}))\n"
            ),
            None => format!("  call row('{name}', c_loc(a_{name}), c_loc(a_{name}), c_sizeof(a_{name}), 0)\n"),
        };
    }
    for name in constants.keys() {
        text += &format!("  print '(a, 1x, i0, a)', '{name}', {name}, ' 0 constant'\n");
    }
    text += "contains\n  subroutine row(name, base, at, bytes, kind)\n    character(len=*), intent(in) :: name\n    integer, intent(in) :: kind\n    character(len=12), parameter :: kinds(0:6) = [character(len=12) :: 'struct', &\n      'integer', 'real', 'pointer', 'characters', 'column', 'index_column']\n    \
             type(c_ptr), intent(in) :: base, at\n    integer(c_size_t), intent(in) :: bytes\n    \
             print '(a, 1x, i0, 1x, i0, 1x, a)', name, transfer(at, 0_c_intptr_t) - transfer(base, 0_c_intptr_t), bytes, trim(kinds(kind))\n  \
             end subroutine\n";
    for (code, (function, declared)) in (1..).zip([
        ("integer_kind", "integer(c_int64_t), intent(in) :: x"),
        ("real_kind", "real(c_double), intent(in) :: x"),
        ("pointer_kind", "type(c_ptr), intent(in) :: x"),
        ("characters_kind", "character(kind=c_char), intent(in) :: x(:)"),
        ("column_kind", "type(wl_column), intent(in) :: x"),
        ("index_kind", "type(wl_index_column), intent(in) :: x"),
    ]) {
        text += &format!(
            "  function {function}(x) result(kind)\n    {declared}\n    integer :: kind\n    \
             kind = {code}\n  end function\n"
        );
    }
    text += "end program\n";
    std::fs::write(folder.join("layout.f90"), text).expect("a writable folder");
    let compiler = std::env::var("FC").unwrap_or_else(|_| "gfortran".into());
    let mut command = Command::new(compiler);
    command.args(["-std=f2008", "-J"]).arg(folder).arg(native::include().join("wearlaw.f90"));
    table_of(&folder.join("layout.f90"), &mut command)
}

fn assert_same(rust: &Table, other: &Table, language: &str) {
    for (name, row) in rust {
        assert_eq!(Some(row), other.get(name), "{name} in Rust and in {language}");
    }
    assert_eq!(rust.len(), other.len());
}

fn header() -> String {
    std::fs::read_to_string(native::include().join("wearlaw.h")).expect("the header is committed")
}

#[test]
fn layout_c() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    assert_same(&in_rust(), &in_c(&header(), folder.path()), "C");
}

#[test]
fn layout_fortran() {
    if !native::fortran("layout_fortran") {
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let constants = constants(&header());
    let mut table = in_fortran(folder.path(), &constants);
    assert!(constants.len() > 50);
    for (name, value) in constants {
        let row = table.remove(&name).unwrap_or_else(|| panic!("no constant {name} in Fortran"));
        // Read back through the offset column, where -1 is the largest number.
        assert_eq!(row.0 as i64, value, "{name}");
    }
    // gfortran 12 resolves a generic name alike for type(c_ptr) and type(c_funptr), so the text tells them apart.
    let mut rust = in_rust();
    let mut functions = Vec::new();
    for (name, row) in &mut rust {
        if row.2 == "function" {
            functions.extend(name.split_once('.').map(|(_, field)| field.to_owned()));
            row.2 = "pointer".to_owned();
        }
    }
    assert_same(&rust, &table, "Fortran");
    let text = std::fs::read_to_string(native::include().join("wearlaw.f90")).expect("the module is there");
    let declared = text.lines().filter_map(|line| line.trim().strip_prefix("type(c_funptr) :: "));
    let mut declared: Vec<&str> = declared.flat_map(|names| names.split(", ")).collect();
    declared.sort_unstable();
    assert_eq!(declared, functions);
}

#[test]
fn the_sizes_that_fortran_states_are_those_of_its_types() {
    let text = std::fs::read_to_string(native::include().join("wearlaw.f90")).expect("the module is there");
    for (name, bytes) in [("WL_VIEW_BYTES", size_of::<View>()), ("WL_OUTPUT_BYTES", size_of::<Output>())] {
        assert!(text.contains(&format!("{name} = {bytes}_c_int64_t")), "{name} is not {bytes}");
    }
}

#[test]
fn a_changed_struct_is_caught() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let header = header();
    let field = |kind: &str, name: &str| format!("  {kind}{name};\n");
    for (old, new) in [
        (field("int64_t ", "first_bad"), field("double ", "first_bad")),
        (field("double ", "dt_factor"), format!("{}{}", field("double ", "dt_factor"), field("double ", "more"))),
        (field("char ", "version[WL_VERSION_SIZE]"), field("char ", "version[WL_NAME_SIZE]")),
    ] {
        assert!(header.contains(&old), "{old}");
        let table = in_c(&header.replace(&old, &new), folder.path());
        assert_ne!(table, in_rust(), "{old} became {new} and nothing was noticed");
    }
}
