//! Gauss–Legendre rules for [−½, ½], by pairs of nodes.
//!
//! Computed with 40 digits by Newton's method on the Legendre polynomials; the tests hold each rule
//! to its defining property, exactness for polynomials up to degree 2n − 1.

#![allow(clippy::excessive_precision, reason = "18 digits, as computed")]

/// Half a rule of `2 · N` nodes: node −s and node +s share the weight.
pub(crate) struct PairedRule<const N: usize> {
    /// The positive nodes, in (0, ½).
    pub(crate) nodes: [f64; N],
    /// Twice the weight of each node, so that a sum over pairs weighs an even function rightly.
    pub(crate) pair_weights: [f64; N],
}

/// The rule of 8 nodes.
pub(crate) const GAUSS_8: PairedRule<4> = PairedRule {
    nodes: [0.0917173212478249025, 0.262766204958164493, 0.39833323870681337, 0.480144928248768116],
    pair_weights: [
        0.362683783378361983,
        0.313706645877887287,
        0.222381034453374471,
        0.101228536290376259,
    ],
};

/// The rule of 12 nodes.
pub(crate) const GAUSS_12: PairedRule<6> = PairedRule {
    nodes: [
        0.0626167042557344577,
        0.183915749499090097,
        0.293658977143308724,
        0.384951337097152344,
        0.452058628185237428,
        0.490780317123359625,
    ],
    pair_weights: [
        0.249147045813402785,
        0.233492536538354809,
        0.203167426723065922,
        0.160078328543346226,
        0.106939325995318431,
        0.0471753363865118272,
    ],
};

/// The rule of 16 nodes.
pub(crate) const GAUSS_16: PairedRule<8> = PairedRule {
    nodes: [
        0.0475062549188187201,
        0.140801775389629457,
        0.229008388828613693,
        0.308938122201321874,
        0.377702204177501517,
        0.432815601193915872,
        0.472287511536616288,
        0.494700467495824966,
    ],
    pair_weights: [
        0.189450610455068496,
        0.182603415044923589,
        0.169156519395002538,
        0.149595988816576732,
        0.124628971255533872,
        0.0951585116824927848,
        0.0622535239386478929,
        0.0271524594117540949,
    ],
};

/// The rule of 24 nodes.
pub(crate) const GAUSS_24: PairedRule<12> = PairedRule {
    nodes: [
        0.032028446431302813,
        0.0955594337368081546,
        0.157521339848081687,
        0.216896753813022569,
        0.272710735694419768,
        0.324046825968487785,
        0.370062095789277182,
        0.410000992986951461,
        0.443207763502200517,
        0.469137276001366379,
        0.487364277985654749,
        0.49759360999851068,
    ],
    pair_weights: [
        0.127938195346752157,
        0.125837456346828296,
        0.121670472927803391,
        0.115505668053725601,
        0.107444270115965635,
        0.0976186521041138883,
        0.0861901615319532759,
        0.0733464814110803057,
        0.0592985849154367807,
        0.0442774388174198062,
        0.0285313886289336632,
        0.0123412297999871995,
    ],
};

/// The rule of 32 nodes.
pub(crate) const GAUSS_32: PairedRule<16> = PairedRule {
    nodes: [
        0.0241538328438691581,
        0.0722359807913982467,
        0.119643681126068537,
        0.165934301141063825,
        0.210675638065317673,
        0.253449954466114695,
        0.293857878620381165,
        0.3315221334651076,
        0.36609105937014484,
        0.397241897983971203,
        0.424683806866284985,
        0.448160577883026062,
        0.467453037968869845,
        0.482381127793753215,
        0.492805755772634168,
        0.498631930924740782,
    ],
    pair_weights: [
        0.0965400885147278006,
        0.0956387200792748594,
        0.0938443990808045656,
        0.0911738786957638847,
        0.0876520930044038111,
        0.0833119242269467552,
        0.0781938957870703065,
        0.0723457941088485062,
        0.0658222227763618468,
        0.0586840934785355471,
        0.0509980592623761762,
        0.0428358980222266807,
        0.0342738629130214331,
        0.0253920653092620595,
        0.0162743947309056706,
        0.0070186100094700966,
    ],
};

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_exact<const N: usize>(rule: &PairedRule<N>) {
        for degree in (0..4 * N as i32).step_by(2) {
            let sum: f64 = (0..N).map(|i| rule.pair_weights[i] * rule.nodes[i].powi(degree)).sum();
            let exact = 0.5f64.powi(degree) / f64::from(degree + 1);
            assert!((sum / exact - 1.0).abs() < 1e-14, "{N} pairs, degree {degree}: {sum} {exact}");
        }
    }

    #[test]
    fn rules_are_exact_for_polynomials_up_to_twice_their_order() {
        assert_exact(&GAUSS_8);
        assert_exact(&GAUSS_12);
        assert_exact(&GAUSS_16);
        assert_exact(&GAUSS_24);
        assert_exact(&GAUSS_32);
    }
}
