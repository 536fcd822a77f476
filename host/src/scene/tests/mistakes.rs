use super::*;
#[test]
fn look() {
    for (a, b) in [
        ("duration = 1.0", "durration = 1.0"),
        ("duration = 1.0", ""),
        ("duration = 1.0", "duration = \"abc\""),
        ("duration = 1.0", "duration = nan"),
        ("duration = 1.0", "duration = -1"),
        ("duration = 1.0", "duration = "),
        ("pressure", "load"),
        ("[law]", "[lwa]"),
        ("[law]", "[law]\nK.x=1"),
        ("[contact]", "[contact]\nhistory=\"µµ\"\ntolerance=2"),
        ("[law]", "[grid]\nsize=[2]\n[law]"),
        ("[law]", "[[law.table]]\ntime=1\n[law]"),
        ("[[step]]", "[[cycle]]\n[[cycle.step]]\n[[step]]"),
        ("[contact]\nmodel = \"prescribed\"", ""),
    ] {
        match parse(&PRESCRIBED.replace(a, b)) {
            Ok(s) => println!("OK {}", s.toml()),
            Err(e) => println!("{e}\n{}\n", e.render(false)),
        }
    }
    for o in [
        "step.0.load=4",
        "step.0.duration=-1",
        "step.3.duration=1",
        "step.duration=3",
        "foo",
        "law.constants.Q=nan",
        "law.constants.K=\"abc",
        "law.use=./foo.so",
        "title.x=3",
        "units.length=\"parsec\"",
        "output.times=[1,2,1]",
        "law.constants.H.x=3",
        "integrator.substeps=0",
    ] {
        match set(PRESCRIBED, &[o]) {
            Ok(s) => println!("OK {}", s.toml()),
            Err(e) => println!("{e}\n{}\n", e.render(false)),
        }
    }
}
