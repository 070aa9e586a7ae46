//! Every entry of the reference file is compared, within the tolerances that the file gives.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use descry::observer::PointEvidence;

/// A tolerance of the file.
fn allowed(name: &str) -> f64 {
    reference()["tolerances"][name].as_f64().unwrap()
}

fn number(value: &Value) -> usize {
    usize::try_from(value.as_u64().unwrap()).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    serde_json::from_value(value.clone()).unwrap()
}

fn flag(value: &Value) -> bool {
    value.as_bool().unwrap()
}

fn points(condition: &Condition) -> Vec<&[PointEvidence]> {
    let mut found = Vec::new();
    for evidence in &condition.evidence {
        if let Evidence::Points { points, .. } = evidence {
            found.push(points.as_slice());
        }
    }
    found
}

#[test]
fn the_file_holds_nothing_that_no_test_compares() {
    let reference = reference();
    let keys = |value: &Value| {
        let mut keys: Vec<String> = value.as_object().unwrap().keys().cloned().collect();
        keys.sort();
        keys.join(" ")
    };
    for (place, expected) in [
        (
            "",
            "conditions description design design_exists gauge_invariant id inputs paper printed rank_O20 simulation \
             tolerances unobservable_modes_of_A_C",
        ),
        ("/inputs", "Gam I I_one_based Psi aI bI cG cI cL"),
        ("/tolerances", "eig_rel_multi_output eig_rel_single_output matrix_rel rank sim_abs tf_rel"),
        ("/conditions", "cond11 global_detectable local local_detectable mu n_z nu theorem2"),
        ("/conditions/cond11", "Psi_residual cG_residual holds"),
        (
            "/conditions/theorem2",
            "claim cond_eigvec_Gamma_nu detectable direct i ii ii_sigma iii iii_list iii_star rankPsiN same unobs",
        ),
        ("/conditions/theorem2/iii_list/0", "dimV pi smin theta"),
        ("/conditions/local/0", "lam sigma_rel unobservable"),
        ("/gauge_invariant", "MMt NNt eig_A eig_Gamma_nu eig_alpha_z"),
        (
            "/design",
            "H_unique eig_global eig_local fixed_global fixed_local gauge_invariant_NkronM_H poles_H poles_h reference",
        ),
        ("/design/reference", "Gamma_nu H M N alpha_z az beta_z bz cz gamma_z h_local"),
        ("/printed", "Gamma_nu N N_correction note"),
        ("/simulation", "rows x0 x4hat0 z0"),
    ] {
        assert_eq!(keys(reference.pointer(place).unwrap()), expected, "keys of `{place}`: compare new ones");
    }
    assert_eq!(reference["tolerances"]["rank"], "exact", "ranks are compared as they are");
}

#[test]
fn the_inputs_are_those_of_the_tests() {
    let (reference, network) = (reference(), network());
    let zero_based: Vec<usize> = reference["inputs"]["I"].as_array().unwrap().iter().map(number).collect();
    let one_based: Vec<usize> =
        reference["inputs"]["I_one_based"].as_array().unwrap().iter().map(number).collect();
    assert_eq!(network.local, zero_based, "I");
    assert_eq!(one_based, zero_based.iter().map(|i| i + 1).collect::<Vec<_>>(), "I as the paper counts");
    let design = &reference["design"];
    assert_eq!(choice().poles, real(&numbers(&design["poles_H"])), "poles of the global observer");
    assert_eq!(choice().local_poles, real(&numbers(&design["poles_h"])), "poles of the local ones");
    let simulation = &reference["simulation"];
    assert_eq!(simulation["x0"], "x0_k = 5 sin(k), k=1..20 (stacked x1..x4)", "as `x0` computes it");
    assert_eq!(
        numbers(&simulation["rows"][0]["z"]).len(),
        number(&reference["conditions"]["n_z"]),
        "rows of z"
    );
    assert_eq!(
        (number(&simulation["z0"]), number(&simulation["x4hat0"])),
        (0, 0),
        "observers start from zero"
    );
}

#[test]
fn sizes_and_inclusions_are_those_of_the_file() {
    let (reference, network) = (reference(), network());
    let conditions_of = &reference["conditions"];
    let found = Hierarchy::of(&network, &tolerance()).unwrap();
    let sizes = [found.N.ncols(), found.M.ncols(), found.order()];
    let expected = ["nu", "mu", "n_z"].map(|key| number(&conditions_of[key]));
    assert_eq!(sizes, expected, "nu, mu, n_z");
    let cond11 = &conditions_of["cond11"];
    let outside =
        |rows: &DMatrix<f64>, Q: &DMatrix<f64>| (rows - rows * Q * Q.transpose()).norm() / rows.norm();
    let ours = [outside(&network.Psi, &found.N), outside(&network.c_G, &found.M)];
    let theirs = ["Psi_residual", "cG_residual"].map(|key| cond11[key].as_f64().unwrap());
    for (ours, theirs) in ours.into_iter().zip(theirs) {
        assert!((ours - theirs).abs() < 1e-14, "both are rounding: {ours:.1e} and {theirs:.1e}");
    }
    let asked = conditions(&network, &tolerance()).unwrap();
    for id in ["003-11-Psi", "003-11-cG"] {
        assert_eq!(find(&asked, id).verdict.holds(), flag(&cond11["holds"]), "{id}");
    }
}

#[test]
fn the_numbers_of_theorem_2_are_those_of_the_file() {
    let (reference, network) = (reference(), network());
    let expected = &reference["conditions"]["theorem2"];
    let asked = conditions(&network, &tolerance()).unwrap();
    for (id, key) in
        [("003-T2-i", "i"), ("003-T2-ii", "ii"), ("003-T2-iii", "iii"), ("003-C1-iii", "iii_star")]
    {
        assert_eq!(find(&asked, id).verdict.holds(), flag(&expected[key]), "{id}");
    }
    let rank = find(&asked, "003-T2-i").evidence.iter().find_map(|evidence| match evidence {
        Evidence::Rank { decision, .. } => Some(decision.rank),
        _ => None,
    });
    assert_eq!(rank, Some(number(&expected["rankPsiN"])), "rank Psi N");
    let second = find(&asked, "003-T2-ii");
    assert_eq!(second.summary.contains("same row space"), flag(&expected["same"]), "{}", second.summary);
    let third = find(&asked, "003-T2-iii");
    let condition = format!("condition {:.2e}", expected["cond_eigvec_Gamma_nu"].as_f64().unwrap());
    assert!(third.summary.contains(&condition), "{condition} in: {}", third.summary);
    let dimensions = third.evidence.iter().find_map(|evidence| match evidence {
        Evidence::Sets { sets, .. } => Some(sets),
        _ => None,
    });
    for entry in expected["iii_list"].as_array().unwrap() {
        let pi = spectrum(&Value::Array(vec![entry["pi"].clone()]))[0];
        let set = dimensions.unwrap().iter().find(|set| (set.element - pi).norm() < 1e-9).unwrap();
        assert_eq!(set.dimension, number(&entry["dimV"]), "dim V at {pi}");
    }
}

/// The file has absolute singular values, the program distances relative to the norm of the pair.
#[test]
fn the_blocks_are_as_far_from_unobservable_as_in_the_file() {
    let (reference, network) = (reference(), network());
    let expected = reference["conditions"]["theorem2"]["ii_sigma"].as_object().unwrap().clone();
    let h = Hierarchy::of(&network, &tolerance()).unwrap();
    let asked = conditions(&network, &tolerance()).unwrap();
    let blocks = points(find(&asked, "003-T2-ii"));
    let lambdas = spectrum(&reference["gauge_invariant"]["eig_Gamma_nu"]);
    assert_eq!(blocks.len(), expected.len(), "one block for each lambda");
    for lambda in lambdas {
        let sigma = expected[&format!("({:.0}+0j)", lambda.re)].as_f64().unwrap();
        let A = &h.a_z + &h.b_z * &h.c_z * lambda.re.round();
        let size = A.norm().hypot(h.c_GM.norm());
        let least =
            |block: &&[PointEvidence]| block.iter().map(|p| p.distance * size).fold(f64::INFINITY, f64::min);
        assert!(
            blocks.iter().any(|block| (least(block) - sigma).abs() < 1e-9),
            "lambda = {lambda}: {sigma} among {:?}",
            blocks.iter().map(least).collect::<Vec<_>>()
        );
    }
}

#[test]
fn detectability_and_the_design_are_those_of_the_file() {
    let (reference, network) = (reference(), network());
    let (conditions_of, design) = (&reference["conditions"], &reference["design"]);
    let theorem = &conditions_of["theorem2"];
    let asked = conditions(&network, &tolerance()).unwrap();
    let (global, local) = (find(&asked, "003-P1-global"), find(&asked, "003-P1-local"));
    assert_eq!(global.verdict.holds(), flag(&conditions_of["global_detectable"]), "{}", global.summary);
    assert_eq!(global.verdict.holds(), flag(&theorem["detectable"]), "{}", global.summary);
    assert_eq!(local.verdict.holds(), flag(&conditions_of["local_detectable"]), "{}", local.summary);
    let hidden = points(global).concat().iter().filter(|point| point.loses_rank).count();
    assert_eq!(hidden, theorem["unobs"].as_array().unwrap().len(), "unobservable modes of the whole");
    assert_eq!((hidden == 0, hidden == 0), (flag(&theorem["direct"]), flag(&theorem["claim"])), "observable");
    for entry in conditions_of["local"].as_array().unwrap() {
        let s = spectrum(&Value::Array(vec![entry["lam"].clone()]))[0];
        let all = points(local).concat();
        let point = all.iter().find(|point| (point.s - s).norm() < 1e-9).unwrap();
        assert_eq!(point.loses_rank, flag(&entry["unobservable"]), "the mode {s} of a subsystem");
    }
    let made = designed(&network);
    assert_eq!(made.verification.verified(), flag(&reference["design_exists"]), "a design exists");
    let observer = &made.observer;
    let fixed = [
        (&observer.global.placement.fixed_modes, "fixed_global"),
        (&observer.local(3).unwrap().placement.fixed_modes, "fixed_local"),
    ];
    for (found, key) in fixed {
        assert_eq!(found.len(), design[key].as_array().unwrap().len(), "{key}");
    }
    // one output and nothing fixed: another seed finds the same gain
    let other = DesignChoice { seed: 77, ..choice() };
    let again = descry::observer::hierarchical::design(&network, &other, &asked, &tolerance())
        .unwrap()
        .observer
        .global
        .H;
    let same = (&again - &observer.global.H).norm() <= allowed("matrix_rel") * again.norm();
    assert_eq!(same, flag(&design["H_unique"]), "H of another seed");
    close(&again, &matrix(&design["reference"]["H"]), allowed("matrix_rel"), "H");
    let spectra = &made.verification.spectrum;
    near(&spectra[..6], &spectrum(&design["eig_global"]), 6.0 * allowed("eig_rel_single_output"), "global");
    near(&spectra[6..], &spectrum(&design["eig_local"]), 6.0 * allowed("eig_rel_multi_output"), "local");
}

#[test]
fn the_corrections_of_the_print_are_those_of_the_file() {
    let reference = reference();
    let found = Hierarchy::of(&network(), &tolerance()).unwrap();
    assert_eq!(reference["printed"]["N_correction"], "entry (2,2) is -0.41", "what is compared here");
    assert!((found.N[(1, 1)] + 0.41).abs() < 0.005, "N(2,2) = {}", found.N[(1, 1)]);
    assert_eq!(
        reference["printed"]["note"], "printed Gamma_nu(3,2)=0.83, computed 0.82496",
        "what is compared here"
    );
    assert!((found.Gamma_nu[(2, 1)] - 0.82496).abs() < 5e-6, "Gamma_nu(3,2) = {}", found.Gamma_nu[(2, 1)]);
}
