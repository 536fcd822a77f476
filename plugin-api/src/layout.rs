//! The types of the ABI as version 1.0 froze them, in a form that a host can compare with its own.
//!
//! The structs here are copies of the first fields of those in [`crate::abi`], made from one list of fields each, and
//! held to them at compile time: a frozen field that is renamed, moved or retyped in `abi` does not compile any more,
//! while a field appended there leaves this layout, and with it every law built before, as it was. Comparing two
//! layouts is the host's business and not here.

use abi_stable::StableAbi;
use abi_stable::library::AbiHeader;
use abi_stable::type_layout::TypeLayout;

/// What a law in Rust exports under [`LAYOUT_SYMBOL`](crate::abi::LAYOUT_SYMBOL).
#[repr(C)]
pub struct LayoutExport {
    /// Mark and version of the form in which the layout is written; to be looked at first.
    pub header: AbiHeader,
    /// The layout.
    pub layout: &'static TypeLayout,
}

/// Layout of the 1.0 part of the ABI structs that this crate was built with.
pub const LAYOUT: &TypeLayout = <frozen::Frozen10 as StableAbi>::LAYOUT;

/// [`LAYOUT`] with its header, as it is exported.
pub const EXPORT: LayoutExport = LayoutExport { header: AbiHeader::VALUE, layout: LAYOUT };

/// Makes the frozen copy of each struct, and the proof that the struct in `abi` still begins with it.
macro_rules! freeze {
    ($(struct $name:ident as $place:ident { $($field:ident: $type:ty,)+ })+) => {
        mod frozen {
            use abi_stable::StableAbi;
            use core::ffi::{c_char, c_void};

            $(#[repr(C)]
            #[derive(StableAbi)]
            pub struct $name { $(pub $field: $type,)+ })+

            /// All of them, so that one comparison reaches each and names it.
            #[repr(C)]
            #[derive(StableAbi)]
            pub struct Frozen10 { $(pub $place: $name,)+ }
        }

        /// Here the same words for types mean the structs of `abi`.
        mod live {
            use core::ffi::{c_char, c_void};
            use core::mem::{offset_of, size_of};

            use crate::abi::{$($name),+};

            $(const _: () = {
                assert!(size_of::<super::frozen::$name>() <= size_of::<$name>(), "a struct of the ABI has shrunk");
                $({
                    const fn _same_type(live: &$name) -> &$type {
                        &live.$field
                    }
                    assert!(
                        offset_of!($name, $field) == offset_of!(super::frozen::$name, $field),
                        concat!("the frozen field `", stringify!($field), "` of `", stringify!($name), "` has moved"),
                    );
                })+
            };)+
        }
    };
}

freeze! {
    struct Column as column {
        ptr: *const f64,
        step: i64,
    }
    struct IndexColumn as index_column {
        ptr: *const i64,
        step: i64,
    }
    struct View as view {
        struct_size: i64,
        points: i64,
        dimension: i64,
        request: i64,
        time: f64,
        dt: f64,
        step_time: f64,
        load_step: i64,
        substep: i64,
        cycle: i64,
        material: i64,
        pair: i64,
        body: i64,
        counter_body: i64,
        reference_temperature: f64,
        absolute_zero: f64,
        unit_metre: f64,
        unit_kilogram: f64,
        unit_second: f64,
        unit_kelvin: f64,
        constant_count: i64,
        constants: *const Column,
        input_count: i64,
        inputs: *const Column,
        state_count: i64,
        state: Column,
        pressure: Column,
        slip: Column,
        velocity: Column,
        slip_vector: Column,
        normal: Column,
        coordinates: Column,
        tangent: Column,
        temperature: Column,
        counter_temperature: Column,
        friction_stress: Column,
        friction_coefficient: Column,
        friction_work: Column,
        accumulated_wear: Column,
        accumulated_slip: Column,
        nodal_traction: Column,
        gap: Column,
        area: Column,
        contact_state: IndexColumn,
        point_id: IndexColumn,
        element_id: IndexColumn,
    }
    struct Output as output {
        struct_size: i64,
        increment: *mut f64,
        direction: *mut f64,
        state: *mut f64,
        status: *mut i32,
        first_bad: i64,
        dt_factor: f64,
        missing: i64,
        text: *mut c_char,
        text_size: i64,
        d_pressure: *mut f64,
    }
    struct Quantity as quantity {
        struct_size: i64,
        name: [c_char; 64],
        summary: [c_char; 256],
        metre: f64,
        kilogram: f64,
        second: f64,
        kelvin: f64,
        minimum: f64,
        maximum: f64,
        default_value: f64,
        flags: i64,
    }
    struct Host as host {
        struct_size: i64,
        abi_minor: i64,
        provides: i64,
        accepts: i64,
        name: [c_char; 64],
        version: [c_char; 32],
    }
    struct LawTable as law {
        struct_size: i64,
        abi_minor: i64,
        name: [c_char; 64],
        version: [c_char; 32],
        summary: [c_char; 256],
        source: [c_char; 256],
        reads: i64,
        uses: i64,
        writes: i64,
        claims: i64,
        flags: i64,
        constant_count: i64,
        state_count: i64,
        input_count: i64,
        pressure_degree: f64,
        pressure_degree_constant: i64,
        describe: Option<unsafe extern "C" fn(kind: i32, index: i64, quantity: *mut Quantity) -> i32>,
        create: Option<
            unsafe extern "C" fn(
                host: *const Host,
                options: *const c_char,
                instance: *mut *mut c_void,
                text: *mut c_char,
                text_size: i64,
            ) -> i32,
        >,
        evaluate: Option<unsafe extern "C" fn(instance: *mut c_void, view: *const View, output: *mut Output) -> i32>,
        destroy: Option<unsafe extern "C" fn(instance: *mut c_void)>,
        extension: Option<unsafe extern "C" fn(id: *const c_char) -> *const c_void>,
    }
}
