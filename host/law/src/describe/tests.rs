//! Malformed descriptions, each refused with what is malformed.

use std::marker::PhantomData;
use std::sync::Arc;

use super::super::descriptor::{Degree, LawDescriptor};
use super::super::loader::{LoadError, Plugin};
use super::super::memory::{InMemory, MemoryInputs, MemoryLaw, MemoryOutputs};
use super::super::table::chars;
use super::super::test_laws::{constant, plain};
use wearlaw_plugin_api::abi;

trait Fault: Send + Sync + 'static {
    fn table(_table: &mut abi::LawTable) {}
    fn quantity(_kind: i32, _index: i64, _quantity: &mut abi::Quantity) {}
}

struct Broken<F>(PhantomData<F>);

impl<F: Fault> MemoryLaw for Broken<F> {
    fn descriptor() -> LawDescriptor {
        LawDescriptor {
            constants: vec![constant("K"), constant("H")],
            pressure_degree: Degree::Constant(1),
            ..plain("broken")
        }
    }
    fn create(_options: Option<&str>) -> Result<Self, String> {
        Ok(Self(PhantomData))
    }
    fn evaluate(&self, _inputs: &MemoryInputs<'_>, _outputs: &mut MemoryOutputs<'_>) -> i32 {
        abi::WL_OK
    }
    fn tamper(table: &mut abi::LawTable) {
        F::table(table);
    }
    fn tamper_quantity(kind: i32, index: i64, quantity: &mut abi::Quantity) {
        F::quantity(kind, index, quantity);
    }
}

fn refusal<F: Fault>() -> String {
    match Plugin::from_entry(Arc::new(InMemory::<Broken<F>>::new())) {
        Ok(_) => "accepted".to_owned(),
        Err(error @ LoadError::Malformed { .. }) => {
            assert!(error.code_has_run());
            error.to_string()
        }
        Err(other) => panic!("{other}"),
    }
}

macro_rules! refused {
    ($name:ident, table |$table:ident| $change:expr, $words:literal) => {
        #[test]
        fn $name() {
            struct This;
            impl Fault for This {
                fn table($table: &mut abi::LawTable) {
                    { $change }
                }
            }
            assert_words(&refusal::<This>(), $words);
        }
    };
    ($name:ident, quantity $index:literal |$quantity:ident| $change:expr, $words:literal) => {
        #[test]
        fn $name() {
            struct This;
            impl Fault for This {
                fn quantity(kind: i32, index: i64, $quantity: &mut abi::Quantity) {
                    if kind == abi::WL_KIND_CONSTANT && index == $index {
                        { $change }
                    }
                }
            }
            assert_words(&refusal::<This>(), $words);
        }
    };
}

fn assert_words(said: &str, words: &str) {
    assert!(said.contains(words), "said: {said}\nexpected: {words}");
    assert!(!said.contains('\n'), "{said}");
}

refused!(an_untouched_table_is_accepted, table | _table | (), "accepted");
refused!(empty_name, table | table | table.name[0] = 0, "the law's name is \"\", expected letters");
refused!(name_with_a_blank, table | table | table.name = chars("two words"), "\"two words\"");
refused!(
    name_without_end,
    table | table | table.name = [65; 64],
    "the law's name is not closed by a NUL within its 64 bytes"
);
refused!(
    summary_not_utf8,
    table | table | {
        table.summary[0] = -1i8 as _;
        table.summary[1] = 0
    },
    "the law's summary is not UTF-8"
);
refused!(summary_of_two_lines, table | table | table.summary = chars("a\nb"), "not one line of text: \"a\\nb\"");
refused!(negative_count, table | table | table.state_count = -3, "`state_count` is -3, expected 0 to 4096");
refused!(absurd_count, table | table | table.constant_count = 1 << 40, "`constant_count` is 1099511627776");
refused!(count_beyond_the_described, table | table | table.constant_count = 3, "`describe` answered -1 for constant 2");
refused!(negative_mask, table | table | table.claims = i64::MIN, "`claims` is negative");
refused!(no_evaluate, table | table | table.evaluate = None, "no `evaluate` function");
refused!(
    no_describe,
    table | table | table.describe = None,
    "declares 2 constants, 0 state variables and 0 inputs, but has no `describe`"
);
refused!(
    degree_out_of_range,
    table | table | table.pressure_degree_constant = 2,
    "held by constant 2, expected -1 or an index below 2"
);
refused!(degree_far_below, table | table | table.pressure_degree_constant = -2, "held by constant -2");
refused!(two_degrees, table | table | table.pressure_degree = 1.0, "claimed twice: 1, and by constant 1");
refused!(state_never_written, table | table | table.state_count = 1, "1 state variables, but does not write `state`");
refused!(unknown_field_without_name, table | table | table.reads |= 1 << 40, "of bit 40, which it does not name");
refused!(duplicate_names, quantity 1 |quantity| quantity.name = chars("K"), "two constants are called `K`");
refused!(name_begins_with_a_digit, quantity 0 |quantity| quantity.name = chars("1K"), "the name of constant 0 is \"1K\"");
refused!(nan_bound, quantity 0 |quantity| quantity.minimum = f64::NAN, "the minimum of constant `K` is NaN");
refused!(bounds_upside_down, quantity 1 |quantity| { quantity.minimum = 2.0; quantity.maximum = 1.0 }, "constant `H` has the bounds 2 and 1");
refused!(infinite_default, quantity 1 |quantity| quantity.default_value = f64::INFINITY, "the default of constant `H` is inf");
refused!(default_out_of_bounds, quantity 1 |quantity| { quantity.minimum = 0.0; quantity.default_value = -1.0 }, "default -1, outside its bounds [0, inf)");
refused!(infinite_exponent, quantity 0 |quantity| quantity.kelvin = f64::INFINITY, "an exponent of constant `K` is inf");

#[test]
fn an_unknown_field_is_refused_by_the_laws_own_name_of_it() {
    struct Newer;
    impl Fault for Newer {
        fn table(table: &mut abi::LawTable) {
            table.reads |= 1 << 33;
            table.abi_minor = 4;
        }
        fn quantity(kind: i32, index: i64, quantity: &mut abi::Quantity) {
            if kind == abi::WL_KIND_FIELD && index == 33 {
                quantity.name = chars("humidity_of_air");
            }
        }
    }
    let said = refusal::<Newer>();
    assert_words(
        &said,
        "needs the field `humidity_of_air` (bit 33), which this host does not know (ABI 1.0; the law was built for ABI 1.4)",
    );
}

#[test]
fn two_constants_that_close_the_units_are_refused() {
    struct Both;
    impl Fault for Both {
        fn quantity(_kind: i32, _index: i64, quantity: &mut abi::Quantity) {
            quantity.flags = abi::WL_QUANTITY_CLOSES_UNITS;
        }
    }
    assert_words(&refusal::<Both>(), "constants `K` and `H` both close the units");
}

#[test]
fn bits_of_a_newer_law_that_a_host_may_pass_over_are_dropped() {
    struct Newer;
    impl Fault for Newer {
        fn table(table: &mut abi::LawTable) {
            table.uses |= 1 << 33;
            table.claims |= 1 << 33;
            table.writes |= 1 << 33;
        }
    }
    let plugin = Plugin::from_entry(Arc::new(InMemory::<Broken<Newer>>::new())).expect("it only uses the field");
    let law = plugin.laws()[0].descriptor();
    assert_eq!((law.uses.unknown(), law.claims.unknown(), law.writes.unknown()), (0, 0, 0));
    let json = serde_json::to_string(law).expect("a description is JSON");
    assert_eq!(&serde_json::from_str::<LawDescriptor>(&json).expect("its own text"), law);
}
