//! Every claim of every catalogue entry is measured and holds; what an entry doesn't claim has a
//! witness against it, where that can be had.

use std::sync::LazyLock;

use faircurve::catalog::{self, Claim, ENTRIES, SplineInfo};
use faircurve::measure::{Grade, Laws, Verdict};

/// What was measured of every entry, each in a thread of its own.
static MEASURED: LazyLock<Vec<(&'static SplineInfo, Laws)>> = LazyLock::new(|| {
    std::thread::scope(|scope| {
        let measure = |info: &&'static SplineInfo| {
            let info = *info;
            scope.spawn(move || (info, Laws::measure(&*catalog::spline(info.name).unwrap())))
        };
        let running: Vec<_> = ENTRIES.iter().map(measure).collect();
        running.into_iter().map(|thread| thread.join().unwrap()).collect()
    })
});

fn laws(name: &str) -> Option<&'static Laws> {
    MEASURED.iter().find(|(info, _)| info.name == name).map(|(_, laws)| laws)
}

#[test]
fn every_claim_is_measured_and_holds() {
    for (info, laws) in MEASURED.iter() {
        for claim in info.claims {
            let verdict = Verdict::on(claim, laws);
            assert!(verdict.holds(), "{} claims {claim}: {verdict:?}", info.name);
        }
    }
}

/// A property that few drawings show the lack of (monotone curvature, existence, …) may be missing
/// without a witness; these may not.
#[test]
fn what_is_not_claimed_has_a_witness_against_it() {
    for (info, laws) in MEASURED.iter() {
        for property in [Claim::Round, Claim::Extensional, Claim::AffineInvariant] {
            if !info.claims.contains(&property) {
                let verdict = Verdict::on(&property, laws);
                assert!(!verdict.holds(), "{} doesn't claim {property}: {verdict:?}", info.name);
            }
        }
        // A κ-curve is one parabola on both sides of a knot; it breaks between knots.
        let is_all = info.continuity() == 4 || info.name == "kappa";
        let more = Verdict::on(&Claim::Continuity(info.continuity() + 1), laws);
        assert!(!more.holds() || is_all, "{}: {:?}", info.name, laws.jumps);
    }
}

#[test]
fn everything_passes_through_its_knots_and_is_finite() {
    for (info, laws) in MEASURED.iter() {
        assert!(laws.misses < 1e-12, "{}: {:e}", info.name, laws.misses);
        let mut numbers = vec![
            laws.invariance.similarity,
            laws.invariance.affine,
            laws.roundness.uneven,
            laws.extensionality.inside,
            laws.extensionality.at_ends,
            laws.locality.ripple,
            laws.monotone,
            laws.moves.jumps,
            laws.share_solved(),
        ];
        numbers.extend(laws.jumps.unwrap_or_default());
        numbers.extend(laws.roundness.even.iter().map(|even| even.1));
        assert!(numbers.into_iter().all(f64::is_finite), "{}: {laws:?}", info.name);
    }
}

/// Thesis 4.6.1 and 2.6: the ripple of the Euler spiral spline is 2 − √3.
#[test]
fn eulers_ripple_is_known_exactly() {
    let ripple = laws("euler").unwrap().locality.ripple;
    assert!((ripple - (2.0 - 3f64.sqrt())).abs() < 1e-7, "{ripple}");
    // Theorem 1, with κ″ = 0.
    assert_eq!(laws("euler").unwrap().spread, Some(0.0));
}

#[test]
fn wrong_claims_are_contradicted() {
    let (euler, spiro) = (laws("euler").unwrap(), laws("spiro").unwrap());
    for (claim, laws) in [
        (Claim::Parameters(4), euler),
        (Claim::Parameters(2), spiro),
        (Claim::Continuity(3), euler),
        (Claim::MonotoneCurvature, spiro),
        (Claim::GeneratingCurve, spiro),
        (Claim::AffineInvariant, euler),
        (Claim::Ripple(0.3), euler),
        (Claim::FiniteSupport(3), euler),
        (Claim::Continuous, euler),
    ] {
        assert!(matches!(Verdict::on(&claim, laws), Verdict::Contradicted(_)), "{claim}");
    }
    assert_eq!(Verdict::on(&Claim::RoundToOrder(4), euler), Verdict::Unknown);
}

/// Thesis Table 4.1, as far as its grades agree with numbers; `measure/verdict.rs` says where they
/// don't.
#[test]
fn grades_are_those_of_the_thesis() {
    use Grade::{Minus, Plus, PlusPlus, PlusPlusPlus};
    for (name, extensionality, roundness, locality) in [
        ("mec", PlusPlusPlus, Minus, Plus),
        ("euler", PlusPlusPlus, PlusPlusPlus, Plus),
        ("log-aesthetic", PlusPlusPlus, PlusPlusPlus, PlusPlus),
        ("hobby", Minus, Minus, Plus),
        ("kurgla1", Minus, PlusPlusPlus, Plus),
        ("circle", Minus, PlusPlusPlus, PlusPlusPlus),
    ] {
        // Those that the catalogue has.
        let Some(laws) = laws(name) else { continue };
        assert_eq!(laws.extensionality_grade(), extensionality, "{name}: {laws:?}");
        assert_eq!(laws.roundness_grade(), roundness, "{name}: {laws:?}");
        assert_eq!(laws.locality_grade(), locality, "{name}: {laws:?}");
    }
    assert_eq!(laws("euler").unwrap().robustness_grade(), PlusPlus);
}
