//! Parameters, numbers and expressions in the fields of wear commands.

use super::{constants, wrong};

/// The value of an expression after some lines that set parameters.
fn value_after(before: &str, expression: &str) -> f64 {
    constants(&format!("{before}\nTB,WEAR,1,,1,USER\nTBDATA,1,{expression}\n"))[0]
}

fn value(expression: &str) -> f64 {
    value_after("", expression)
}

/// Message and column inside the expression, from 1.
#[track_caller]
fn refused(expression: &str, column: usize, underlined: &str, message: &str) {
    let text = format!("TB,WEAR,1,,1,USER\nTBDATA,1,{expression}");
    let message = format!("value 1 of TBDATA: {message}");
    wrong(&text, 2, 9 + column, underlined, &message);
}

#[test]
fn numbers_as_fortran_writes_them() {
    let numbers = [
        ("1.d-4", 1e-4),
        ("1D-4", 1e-4),
        ("1.5E+3", 1.5e3),
        (".5", 0.5),
        ("5.", 5.0),
        ("+7", 7.0),
        ("-7.25d0", -7.25),
        ("0.1", 0.1),
        ("4.9406564584124654e-324", f64::from_bits(1)),
        ("0e-999", 0.0),
        ("1.7976931348623157d308", f64::MAX),
    ];
    for (text, expected) in numbers {
        assert_eq!(value(text).to_bits(), f64::to_bits(expected), "{text}");
    }
}

#[test]
fn the_documented_order_of_evaluation() {
    let values = [
        ("1+2*3", 7.0),
        ("(1+2)*3", 9.0),
        ("2-3-4", -5.0),
        ("16/4/2", 2.0),
        ("2**3**2", 512.0),
        ("-2**2", -4.0),
        ("2**-1", 0.5),
        ("2*-3", -6.0),
        ("- -3", 3.0),
        ("--+-3", -3.0),
        ("2 + 3", 5.0),
        ("1e-4*1e4", 1e-4 * 1e4),
        ("1/3", 1.0 / 3.0),
        ("((((((((5))))))))", 5.0),
        ("sqrt(16)+Abs(-2)+EXP(0)+LOG(1)+log10(1000)", 10.0),
        ("SQRT( ABS(-9) )", 3.0),
    ];
    for (text, expected) in values {
        assert_eq!(value(text), expected, "{text}");
    }
}

#[test]
fn parameters_hold_their_value_at_the_time() {
    let before = "K=1e-4 $ hard = 2*K $ *SET,_n1,hard+1 $ k=7";
    assert_eq!(value_after(before, "HARD"), 2e-4);
    assert_eq!(value_after(before, "_N1*1"), 2e-4 + 1.0);
    assert_eq!(value_after(before, "K"), 7.0);
    assert_eq!(value_after("a=1\na=a+1\n*set , A , a+1", "A"), 3.0);
    assert_eq!(value_after("A=5\n*DO,I,1,3\nB=7\n*ENDDO\nB=A", "B"), 5.0);
}

#[test]
fn a_wrong_parameter_that_no_wear_command_needs_does_no_harm() {
    assert_eq!(value_after("A=B+1\nC='text'\nD=UX(3)\n*GET,E,NODE,1", "3"), 3.0);
}

#[test]
fn an_undefined_parameter_names_the_nearest() {
    refused("HARDNES", 1, "HARDNES", "`HARDNES` is neither a number nor a parameter defined above");
    let text = "hardness=1e10\nTB,WEAR,1,,2,USER\nTBDATA,1,1,2*HARDNES\n";
    wrong(
        text,
        3,
        14,
        "HARDNES",
        "value 2 of TBDATA: `HARDNES` is neither a number nor a parameter defined above; did you mean `HARDNESS`?",
    );
    let removed = "K=1\nK=\nTB,WEAR,1,,1,USER\nTBDATA,1,K";
    wrong(removed, 4, 10, "K", "value 1 of TBDATA: `K` is neither a number nor a parameter defined above");
    let deleted = removed.replace("K=\n", "*DEL,ALL\n");
    assert!(super::diagnostic(&deleted).to_string().contains("neither a number"));
}

#[test]
fn an_unknown_parameter_says_who_set_it() {
    let text = "K=1\n*GET,K,NODE,1,U,X\nTB,WEAR,1,,1,USER\nTBDATA,1,k\n";
    wrong(
        text,
        4,
        10,
        "k",
        "value 1 of TBDATA: parameter `k` is set by *GET on line 2, which is not evaluated: expected `k=` and a number",
    );
    let block = "*IF,A,GT,1,THEN\nK=1\n*ELSE\nK=2\n*ENDIF\nTB,WEAR,1,,1,USER\nTBDATA,1,K";
    assert!(super::diagnostic(block).to_string().contains("set by *IF on line 4"));
}

#[test]
fn a_wrong_definition_is_shown_where_it_stands() {
    let text = "K=1e-4*\nL=K\nTB,WEAR,1,,1,USER\nTBDATA,1,L";
    wrong(text, 1, 8, "", "parameter K: the expression ends where a number, a parameter or `(` was expected");
    let picture = super::diagnostic(text).render();
    assert!(picture.contains("TBDATA,1,L") && picture.contains("needed here"), "{picture}");
}

#[test]
fn each_wrong_expression_is_underlined() {
    refused("1.2.3", 1, "1.2.3", "`1.2.3` is not a number");
    refused("12abc", 1, "12abc", "`12abc` is not a number");
    refused("1e", 1, "1e", "`1e` is not a number");
    refused(".", 1, ".", "`.` is not a number");
    refused("1e999", 1, "1e999", "`1e999` is beyond what a 64-bit number holds");
    refused("1e-999", 1, "1e-999", "`1e-999` is beyond what a 64-bit number holds");
    refused("1/0", 1, "1/0", "the result is not finite");
    refused("2+(1e300*1e300)", 4, "1e300*1e300", "the result is not finite");
    refused("SQRT(-1)", 1, "SQRT(-1)", "the result is not finite");
    refused("(-8)**0.5", 1, "(-8)**0.5", "the result is not finite");
    refused(
        "TANH(1)",
        1,
        "TANH",
        "unknown function `TANH`: expected SQRT, ABS, EXP, LOG or LOG10 (array elements are not read)",
    );
    refused("(1+2", 5, "", "the expression ends where `)` was expected");
    refused("1)", 2, ")", "found `)`, expected an operator or the end of the field");
    refused("1 2", 3, "2", "found `2`, expected an operator or the end of the field");
    refused("'1'", 1, "'", "found `\\'`, expected a number, a parameter or `(`");
    refused("2+", 3, "", "the expression ends where a number, a parameter or `(` was expected");
    refused(
        "2 *3",
        3,
        "*3",
        "a blank before `*` makes the rest of the line a comment for the solver: expected no blank, or `!`",
    );
}

#[test]
fn nesting_is_bounded() {
    let deep = format!("{}1{}", "(".repeat(60), ")".repeat(60));
    assert_eq!(value(&deep), 1.0);
    for deep in ["(".repeat(100_000), "2**".repeat(100_000), "SQRT(".repeat(100_000)] {
        let text = format!("TB,WEAR,1,,1,USER\nTBDATA,1,{deep}");
        let found = super::diagnostic(&text).to_string();
        assert!(found.contains("more than 64 deep"), "{found:.200}");
    }
    assert_eq!(value(&format!("{}1", "-".repeat(100_000))), 1.0);
}
