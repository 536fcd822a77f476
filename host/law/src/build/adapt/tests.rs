use super::*;

const SOURCE: &str = "\
c     Archard, as its author wrote it for another solver: 'param' and relvelnd
      subroutine uwearindex ( wrnd,n,nuser,inc,time,timinc,coord,i2or3,
     &  normal,cofornd,frfornd,costrs,frstrs,
     &  param,tempi,relvelnd,itouch,ibody1,
     &  ibody2,fric)
      real*8 wrnd,time,timinc,coord,normal,cofornd
      real*8 frfornd,costrs,frstrs,param,tempi,relvelnd,fric
      integer n,nuser,inc,i2or3,itouch,ibody1,ibody2
      dimension coord(*),normal(*),param(*)
      wrnd=(param(1)/param(2))*costrs*relvelnd ! not frstrs
      return
      end
      subroutine other(fric)
      fric = 1
      end
";

fn layer(source: &str, parameters: &str) -> Result<String, String> {
    let adaptation = Adaptation::parse("uwearindex", parameters)?;
    adaptation.layer(Path::new("/a/wear.f"), source, "wear").map_err(|error| error.to_string())
}

#[test]
fn a_law_reads_what_the_subroutine_mentions() {
    let text = layer(SOURCE, "K,H:pascal").unwrap();
    assert!(text.contains("#define LAW_READS(F) F(pressure) F(velocity)\n"), "{text}");
    assert!(text.contains("C(K, WL_NUMBER, WL_ANY WL_CLOSES_UNITS, WL_REQUIRED, \"param(1) of wear.f\")"), "{text}");
    assert!(text.contains("C(H, WL_PASCAL, WL_ANY, WL_REQUIRED, \"param(2) of wear.f\")"), "{text}");
    assert!(
        text.contains("#define LAW_CLAIMS WL_CLAIM_LINEAR_IN_DT\n") && text.contains("param[] = {c->K, c->H};"),
        "{text}"
    );
    assert!(text.contains("double fric = 0;") && text.contains("double coord[3] = {0, 0, 0};"), "{text}");
}

#[test]
fn what_lasts_or_hangs_on_the_increment_is_not_claimed_to_be_linear() {
    for (from, to) in [
        ("      return\n", "      wrnd = wrnd * (1 + timinc)\n"),
        ("      dimension coord", "      save\n      dimension coord"),
        ("      dimension coord", "      common /own/ worn\n      dimension coord"),
        ("      integer n", "      real*8, save :: worn\n      integer n"),
    ] {
        let text = layer(&SOURCE.replacen(from, to, 1), "K,H").unwrap();
        assert!(text.contains("#define LAW_CLAIMS 0\n"), "{to}: {text}");
    }
}

#[test]
fn all_arguments_can_be_mentioned() {
    let every = "      wrnd = wrnd + n+nuser+inc+time+timinc+coord(1)+i2or3+normal(1)\n     & +cofornd+frfornd+frstrs+tempi+itouch+ibody1\n     & +ibody2+fric\n      return\n";
    let text = layer(&SOURCE.replacen("      return\n", every, 1), "K,H").unwrap();
    let reads = "F(point_id) F(coordinates) F(normal) F(pressure) F(area) F(friction_stress) F(temperature) F(velocity) \
                 F(friction_coefficient)";
    assert!(text.contains(&format!("#define LAW_READS(F) {reads}\n")), "{text}");
    assert!(text.contains("double normal[3] = {in->normal[0], in->normal[1], in->normal[2]};"), "{text}");
}

#[test]
fn free_form_is_read_too() {
    let free = "SUBROUTINE UWEARINDEX(w, n, nu, i, t, dt, x, d, nn, cf, ff, cs, &\n  & fs, p, temp, v, it, b1, b2, mu) ! all of them\n\
                real(8) :: w, cs, v, p(*)\n  w = p(1) * cs * v; end subroutine\n";
    let adaptation = Adaptation::parse("uwearindex", "k").unwrap();
    let text = adaptation.layer(Path::new("wear.f90"), free, "wear").unwrap();
    assert!(text.contains("#define LAW_READS(F) F(pressure) F(velocity)\n"), "{text}");
}

#[test]
fn what_cannot_be_mapped_is_said() {
    for (source, parameters, expected) in [
        ("      end\n", "K", "found no `subroutine uwearindex(..)`"),
        ("      subroutine uwearindex(a,b)\n      end\n", "K", "with 2 arguments, expected 20"),
        (SOURCE, "", "it reads 2 of `param`, found names for 0"),
        (SOURCE, "K", "it reads 2 of `param`, found names for 1"),
        (SOURCE, "K,K", "found `K` twice"),
        (SOURCE, "K,2H", "found name `2H`"),
        (SOURCE, "K,H:bar", "found unit `bar`, expected one of number"),
    ] {
        let said = layer(source, parameters).unwrap_err();
        assert!(said.contains(expected), "{said}");
    }
    assert!(Adaptation::parse("umat", "").unwrap_err().contains("expected uwearindex"));
}
