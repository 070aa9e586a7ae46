//! Which states of a network a hierarchical observer estimates.

use nalgebra::DMatrix;

use super::HierarchicalObserver;

/// How much of a state may lie outside the whole, as a squared share, before the whole does not determine it any more.
///
/// Rounding leaves about `N eps` in the lengths of the rows of `N` and `M`.
const OUTSIDE: f64 = 1e-12;

impl HierarchicalObserver {
    /// The states whose estimate tends to the truth, numbered as in [`Network::expanded`](crate::system::Network::expanded)
    /// from zero, in ascending order.
    ///
    /// These are all states of a subsystem with a local observer. Of any other subsystem they are those that the whole
    /// determines, `(N N')_ii (M M')_jj = 1`: nothing of state j of subsystem i lies outside `z = sigma_z x`. What is
    /// written in the place of the others, `sigma_z^+ z_hat`, is no estimate.
    ///
    /// # Source
    /// Paper 003, (8) and Theorem 1.
    pub fn estimated_states(&self) -> Vec<usize> {
        let (of_subsystem, of_state) = (shares(&self.hierarchy.N), shares(&self.hierarchy.M));
        let n = of_state.len();
        let mut result = Vec::new();
        for (i, share) in of_subsystem.iter().enumerate() {
            let plugged = self.local(i).is_some();
            let determined = |j: &usize| plugged || share * of_state[*j] >= 1.0 - OUTSIDE;
            result.extend((0..n).filter(determined).map(|j| n * i + j));
        }
        result
    }
}

/// Squared length of each row of an orthonormal basis: the share of a unit vector that lies in its span.
fn shares(basis: &DMatrix<f64>) -> Vec<f64> {
    basis.row_iter().map(|row| row.norm_squared()).collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::dmatrix;

    use crate::numerics::{Complex64, Tolerance};
    use crate::observer::hierarchical::{conditions, design};
    use crate::observer::{Design, DesignChoice};
    use crate::system::Network;

    fn designed(psi: f64, plugged: Option<Vec<usize>>) -> Design {
        let network = Network {
            a: dmatrix![-1.0, 1.0; 0.0, -2.0],
            b: dmatrix![0.0; 1.0],
            c: dmatrix![1.0, 0.0],
            Gamma: dmatrix![-1.0, 1.0; 1.0, psi].into(),
            Psi: dmatrix![-1.0, 1.0],
            c_G: dmatrix![1.0, 0.0],
            c_L: dmatrix![1.0, 0.0],
            local: vec![0, 1],
        };
        let poles: Vec<Complex64> = [-3.0, -4.0, -5.0, -6.0].map(Complex64::from).into();
        let choice = DesignChoice { local_poles: poles.clone(), poles, plugged, ..DesignChoice::default() };
        let asked = conditions(&network, &Tolerance::default()).unwrap();
        design(&network, &choice, &asked, &Tolerance::default()).unwrap().common(&network).unwrap()
    }

    #[test]
    fn without_a_local_observer_only_what_the_whole_determines_is_estimated() {
        assert_eq!(designed(-1.0, None).estimated_states(4), [0, 1, 2, 3], "all are plugged in");
        assert_eq!(designed(-1.0, Some(vec![1])).estimated_states(4), [2, 3], "a difference tells no state");
        assert!(designed(-1.0, Some(Vec::new())).estimated_states(4).is_empty(), "nothing is plugged in");
    }

    #[test]
    fn a_coupling_of_full_rank_shows_every_state() {
        assert_eq!(designed(1.0, Some(Vec::new())).estimated_states(4), [0, 1, 2, 3], "z is x in other axes");
    }
}
