use super::*;
use crate::law::{Claims, Degree, Flags, OutputItems};

fn quantity(name: &str, default: Option<f64>) -> Quantity {
    Quantity {
        name: name.to_owned(),
        summary: String::new(),
        exponents: [-1.0, 1.0, -2.0, 0.0],
        minimum: 0.0,
        maximum: f64::INFINITY,
        default,
        closes_units: false,
        above_minimum: true,
        below_maximum: false,
    }
}

fn law(reads: &[Field]) -> LawDescriptor {
    LawDescriptor {
        name: "some".to_owned(),
        version: "1.0.0".to_owned(),
        summary: String::new(),
        source: String::new(),
        abi_minor: 0,
        reads: reads.iter().copied().collect(),
        uses: Fields::default(),
        writes: OutputItems::default(),
        claims: Claims::default(),
        flags: Flags::default(),
        constants: vec![quantity("H", None), quantity("p_0", Some(2e6))],
        state: Vec::new(),
        inputs: Vec::new(),
        pressure_degree: Degree::Unclaimed,
    }
}

fn made(form: Form, law: &LawDescriptor, constants: &[(&str, f64)]) -> Result<String, String> {
    let constants = constants.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let library = format!("/a/folder of {}'s/{}/lib.so", "somebody", "long".repeat(20));
    let wanted = Wanted { form, law, library, sha256: "ab12".repeat(16), constants, units: [1e-3, 1e3, 1.0] };
    source(&wanted).map_err(|error| error.to_string())
}

#[test]
fn a_shim_sets_what_the_law_reads_and_nothing_else() {
    let text = made(Form::Uwearindex, &law(&[Field::Pressure, Field::Normal, Field::PointId]), &[]).unwrap();
    assert!(!text.contains('@'), "something was not filled in");
    for part in [
        "wlh_set_field(surface, WL_FIELD_PRESSURE, c_loc(shim%pressure), one, zero",
        "wlh_set_field(surface, WL_FIELD_NORMAL, c_loc(shim%normal), three, zero",
        "wlh_set_index_field(surface, WL_FIELD_POINT_ID, c_loc(shim%point_id), one, zero",
        "    '/a/folder of somebody''s/longlong",
        "    'ab12ab12",
        "constant_count = 2, state_count = 0",
        "subroutine uwearindex(wrnd",
        "call quit(9999)",
    ] {
        assert!(text.contains(part), "{part}");
    }
    assert!(!text.contains("WL_FIELD_SLIP, c_loc") && !text.contains("subroutine umeshmotion"));
    assert!(text.lines().all(|line| line.chars().count() <= 132), "lines are no longer than Fortran has them");
}

#[test]
fn constants_are_written_in_the_units_of_the_solver() {
    let reads = [Field::Pressure, Field::Slip, Field::Temperature];
    let text = made(Form::Umeshmotion, &law(&reads), &[("H", 2e3)]).unwrap();
    // Megapascal: the default of 2e6 Pa is 2 of them.
    assert!(text.contains("constants(2) = [2e3_c_double, &\n    2e0_c_double]"), "{text}");
    assert!(text.contains("call getvrn(node, 'NT'") && !text.contains("'CNAREA'") && text.contains("call xit()"));
}

#[test]
fn what_cannot_be_mapped_is_said() {
    let reads = law(&[Field::Pressure, Field::Tangent]);
    let said = made(Form::Uwearindex, &reads, &[]).unwrap_err();
    assert!(
        said.starts_with("law `some` reads `tangent`, which uwearindex is not given; it is given pressure"),
        "{said}"
    );
    let good = law(&[Field::Pressure]);
    for (form, constants, expected) in [
        (Form::Umeshmotion, &[][..], "constant `H` of law `some` has no value: --constants H=.."),
        (Form::Umeshmotion, &[("H", -1.0)], "found -1 for constant `H`, expected it in (0, inf) (SI)"),
        (Form::Umeshmotion, &[("H", 1.0), ("K", 1.0)], "law `some` has no constant `K`; it has H, p_0"),
        (Form::Uwearindex, &[("H", 1.0)], "found a value for `H`, expected none"),
    ] {
        let said = made(form, &good, constants).unwrap_err();
        assert!(said.contains(expected), "{said}");
    }
    let turns = LawDescriptor { writes: [OutputItem::Direction].into_iter().collect(), ..law(&[Field::Pressure]) };
    assert!(made(Form::Uwearindex, &turns, &[]).unwrap_err().contains("wear direction of its own"));
    let memory = LawDescriptor { state: vec![quantity("oxide", None)], ..law(&[Field::Pressure]) };
    assert!(made(Form::Uwearindex, &memory, &[]).unwrap_err().contains("`oxide` of law `some` has no initial value"));
}
