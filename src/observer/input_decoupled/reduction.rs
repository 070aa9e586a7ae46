//! The reduction to an ordinary pair: the paper's, and a general one that does not need (A1).
#![expect(non_snake_case, reason = "matrix letters follow paper 001")]

use nalgebra::DMatrix;

use super::Coordinates;
use super::noise::{cleaned_output, cleaned_state, size};
use crate::numerics::{NumericsError, RankDecision, Tolerance, pseudo_inverse, stack, subspaces};

/// An ordinary system that `x1` obeys on every trajectory of the plant, whatever its unknown inputs and free states do.
///
/// ```text
/// x1' = A x1 + B u + Y y
///  0  = C x1 - U_out u - Y_out y                     seen by s outputs that no unknown input reaches
/// [x2; d] = R1 x1 + R2 u + R3 y
/// ```
///
/// The multipliers say how each line follows from the algebraic equations `a = A3 x1 + A4 x2 + B2 u + D2 d = 0` and
/// from `y = C1 x1 + C2 x2 + F d`, identically in `x1`, `x2`, `d` and `u`:
/// ```text
/// A1 x1 + A2 x2 + B1 u + D1 d + state a = A x1 + B u + Y y
///                              output a = U_out u + Y_out y - C x1
///                               [x2; d] = R1 x1 + R2 u + R3 y + estimate a
/// ```
///
/// # Shapes
/// `A`: r x r; `B`: r x k; `Y`: r x p; `C`: s x r; `U_out`: s x k; `Y_out`: s x p; `R1`: (n - r + q) x r;
/// `R2`: (n - r + q) x k; `R3`: (n - r + q) x p; `state`: r x (e - r); `output`: s x (e - r);
/// `estimate`: (n - r + q) x (e - r).
///
/// # Tolerance
/// What of `A` and `C` is nothing but the rounding of the terms that they were computed from is zero.
#[derive(Clone, Debug)]
pub struct Reduction {
    /// State matrix of the pair (the paper's `A~1`).
    pub A: DMatrix<f64>,
    /// Known input (`B~1`).
    pub B: DMatrix<f64>,
    /// Injection of the output (`W1 W2+`).
    pub Y: DMatrix<f64>,
    /// Output matrix of the pair, without redundant rows (`Z' C_bar1`, with `Z Z' = I - W2 W2+`).
    pub C: DMatrix<f64>,
    /// The rank of `C / norm C`, judged against the terms that `C` was computed from.
    pub rank: RankDecision,
    /// Known input in the pair's output (`-Z' B_bar2`).
    pub U_out: DMatrix<f64>,
    /// Measured output in the pair's output (`Z'`).
    pub Y_out: DMatrix<f64>,
    /// Differential states in the estimate.
    pub R1: DMatrix<f64>,
    /// Known input in the estimate.
    pub R2: DMatrix<f64>,
    /// Measured output in the estimate.
    pub R3: DMatrix<f64>,
    /// Multiplier of the algebraic equations in the derivative.
    pub state: DMatrix<f64>,
    /// Multiplier of the algebraic equations in the pair's output.
    pub output: DMatrix<f64>,
    /// Multiplier of the algebraic equations in the estimate.
    pub estimate: DMatrix<f64>,
}

impl Reduction {
    /// `unit C`, as large as `A`, and `unit`, a power of two.
    ///
    /// What counts of `C` is no rounding: the unit of y, in which it is small or large, must not hide the dynamics.
    pub(super) fn output_in_unit_of_state(&self) -> (DMatrix<f64>, f64) {
        let (A, C) = (size(&self.A), size(&self.C));
        let unit = if A > 0.0 && C > 0.0 { (A.log2() - C.log2()).round().exp2() } else { 1.0 };
        let unit = if unit.is_normal() { unit } else { 1.0 };
        (&self.C * unit, unit)
    }
}

/// The paper's reduction, which needs (A1) and (A2).
///
/// ```text
/// [A4 D2] [Pa Pb] = [I 0],   Pa = [A4 D2]^+,   Pb = orthonormal basis of ker [A4 D2]
/// A_bar21 = X Pa,  C_bar21 = Y Pa,  W1 = X Pb,  W2 = Y Pb            X = [A2 D1],  Y = [C2 F]
/// A_bar1 = A1 - A_bar21 A3,  B_bar1 = B1 - A_bar21 B2,  C_bar1 = C1 - C_bar21 A3,  B_bar2 = -C_bar21 B2
/// A~1 = A_bar1 - W1 W2+ C_bar1,   B~1 = B_bar1 - W1 W2+ B_bar2,   Z = orthonormal basis of the left null space of W2
/// R1 = -Pa A3 - Pb W2+ C_bar1,   R2 = -Pa B2 - Pb W2+ B_bar2,   R3 = Pb W2+
/// ```
///
/// The paper splits `Pb` and `W2` by columns into n - m and p; no result depends on that split, so `w` stays whole.
///
/// # Errors
/// When a decomposition fails its check.
///
/// # Source
/// Paper 001, (3)-(6), Lemma 1 and Theorem 1.
// ERRATUM(001, (3), (4)): A_bar21, C_bar21, A_bar22, D_bar1, C_bar22 and F_bar are used without a definition.
pub fn paper_reduction(at: &Coordinates, tolerance: &Tolerance) -> Result<Reduction, NumericsError> {
    let Coordinates { A1, A3, B1, B2, C1, .. } = at;
    let (S, X, Y) = (at.algebraic(), at.differential(), at.measured());

    let Pa = pseudo_inverse(&S, tolerance)?;
    let Pb = subspaces(&S, at.scale, tolerance)?.null;

    let (A_bar21, C_bar21, W1, W2) = (&X * &Pa, &Y * &Pa, &X * &Pb, &Y * &Pb);
    let A_bar1 = A1 - &A_bar21 * A3;
    let B_bar1 = B1 - &A_bar21 * B2;
    let C_bar1 = C1 - &C_bar21 * A3;
    let B_bar2 = -(&C_bar21 * B2);

    // (5): w = W2+ (y - C_bar1 x1 - B_bar2 u)
    let W2_pinv = pseudo_inverse(&W2, tolerance)?;
    let W1W2_pinv = &W1 * &W2_pinv;
    let PbW2_pinv = &Pb * &W2_pinv;
    // what of the output does not depend on w
    let Zt = subspaces(&W2, at.scale, tolerance)?.left_null.transpose();

    // Pa A3 is known up to rounding in S Pa A3 = A3, and Z up to rounding in Z' W2 = 0
    let A3_terms = size(A3).max(size(&S) * size(&(&Pa * A3)));
    let C_bar1_terms = size(C1) + size(&C_bar21) * A3_terms;
    let state_terms = size(A1) + size(&A_bar21) * A3_terms + size(&W1W2_pinv) * C_bar1_terms;
    let output_terms = size(&(Zt.abs() * C1.abs()))
        + size(&(Zt.abs() * C_bar21.abs())) * A3_terms
        + size(&W2) * size(&(&W2_pinv * &C_bar1));
    let (C, rank) = cleaned_output(&(&Zt * &C_bar1), output_terms, tolerance)?;

    Ok(Reduction {
        A: cleaned_state(A_bar1 - &W1W2_pinv * &C_bar1, state_terms, tolerance),
        B: B_bar1 - &W1W2_pinv * &B_bar2,
        C,
        rank,
        U_out: -(&Zt * &B_bar2),
        R1: -(&Pa * A3) - &PbW2_pinv * &C_bar1,
        R2: -(&Pa * B2) - &PbW2_pinv * &B_bar2,
        state: &W1W2_pinv * &C_bar21 - &A_bar21,
        output: &Zt * &C_bar21,
        estimate: Pa - &PbW2_pinv * &C_bar21,
        Y: W1W2_pinv,
        Y_out: Zt,
        R3: PbW2_pinv,
    })
}

/// The general reduction, which needs (A2) alone.
///
/// ```text
/// Ms = [A4 D2; C2 F],   Ms^+ = [Ga Gy],   Z' Ms = 0,   Z = [Za; Zy]
/// [x2; d] = Ms^+ ([-B2 u; y] - [A3; C1] x1),      Z' ([-B2 u; y] - [A3; C1] x1) = 0
/// A = A1 - X Ms^+ [A3; C1],   B = B1 - X Ga B2,   Y = X Gy,   C = Z' [A3; C1]
/// ```
///
/// Under (A1) its pair differs from the paper's by output injection, so that the same poles can be placed.
///
/// # Errors
/// When a decomposition fails its check.
///
/// # Source
/// Generalisation of paper 001 (not in the paper): algebraic equations and outputs are treated alike.
pub fn general_reduction(at: &Coordinates, tolerance: &Tolerance) -> Result<Reduction, NumericsError> {
    let Coordinates { A1, A3, B1, B2, C1, .. } = at;
    let (S, X, Y) = (at.algebraic(), at.differential(), at.measured());
    let algebraic = S.nrows();

    let Ms = stack(&[&S, &Y]);
    let Ms_pinv = pseudo_inverse(&Ms, tolerance)?;
    let Zt = subspaces(&Ms, at.scale, tolerance)?.left_null.transpose();
    let split = |m: &DMatrix<f64>| {
        (m.columns(0, algebraic).into_owned(), m.columns(algebraic, Y.nrows()).into_owned())
    };
    let (Ga, Gy) = split(&Ms_pinv);
    let (Za, Zy) = split(&Zt);

    let A3C1 = stack(&[A3, C1]);
    let R1 = -(&Ms_pinv * &A3C1);
    // Z is known up to rounding in Z' Ms = 0
    let state_terms = size(A1) + size(&(&X * &Ms_pinv)) * size(&A3C1).max(size(&Ms) * size(&R1));
    let output_terms = size(&(Za.abs() * A3.abs() + Zy.abs() * C1.abs())) + size(&Ms) * size(&R1);
    let (C, rank) = cleaned_output(&(&Zt * &A3C1), output_terms, tolerance)?;
    Ok(Reduction {
        A: cleaned_state(A1 + &X * &R1, state_terms, tolerance),
        B: B1 - &X * &Ga * B2,
        Y: &X * &Gy,
        C,
        rank,
        U_out: -(&Za * B2),
        Y_out: Zy,
        R2: -(&Ga * B2),
        state: -(&X * &Ga),
        output: -Za,
        R1,
        R3: Gy,
        estimate: Ga,
    })
}
