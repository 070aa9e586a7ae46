//! Why a simulation was refused or could not be completed.

use crate::numerics::NumericsError;
use crate::numerics::integrate::IntegrationError;
use crate::system::{LipschitzError, SystemError};

/// A simulation that was refused, or that could not be completed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SimulationError {
    /// More or fewer equations than states.
    #[error(
        "E is {equations} x {states}, so the plant alone does not determine its motion; \
         a simulation needs as many equations as states"
    )]
    NotSquare {
        /// Rows of `E`.
        equations: usize,
        /// Columns of `E`.
        states: usize,
    },
    /// Algebraic equations that contain nothing they could determine.
    #[error(
        "{combinations} of the {algebraic} algebraic equations (as combinations) contain neither algebraic states nor \
         unknown inputs: they tie the differential states to the known inputs, both of which are given. At t = 0 they are \
         violated by {residual:.3e}. Remove equations that repeat others, or add the states or unknown inputs that they \
         determine"
    )]
    Overdetermined {
        /// Independent combinations without algebraic states and unknown inputs.
        combinations: usize,
        /// Number of algebraic equations.
        algebraic: usize,
        /// Largest entry of what is left of them at the start.
        residual: f64,
    },
    /// Uncertain entries in equations that repeat others.
    #[error(
        "the uncertainty of {entry} makes {equations} contradict the equations that it follows from. Take {entry} out of \
         the uncertainty, or remove the repetition"
    )]
    UncertainRepeats {
        /// The equations that repeat others, as text.
        equations: String,
        /// An entry of `A` that makes them differ.
        entry: String,
    },
    /// A feedback that leaves the free variables undetermined.
    #[error(
        "the feedback of the free variables cancels them: with v = v0 - K x the algebraic equations determine the states no \
         longer. Let K act on the differential states, or change it"
    )]
    FreeFeedback,
    /// The algebraic equations do not determine the algebraic states.
    #[error(
        "the plant is not of index 1: its {algebraic} algebraic equations do not determine as many states \
         (smallest singular value of A22 = U2' A V2 is {smallest:.1e}, {threshold:.1e} is needed); \
         impulses would occur, or the motion is not unique. Check the rows of A where E is zero"
    )]
    NotIndexOne {
        /// Number of algebraic equations.
        algebraic: usize,
        /// Smallest singular value of `A22`.
        smallest: f64,
        /// What it has to exceed.
        threshold: f64,
    },
    /// The uncertain algebraic equations become dependent on the way.
    #[error(
        "the plant loses index 1 at t = {time:.6}: the smallest singular value of A22(t) falls to {smallest:.1e}, \
         impulses would occur. Lower the amplitude of the uncertainty of {entries}"
    )]
    LosesIndexOne {
        /// First time at which this happens.
        time: f64,
        /// Smallest singular value of `A22` there.
        smallest: f64,
        /// The uncertain entries of `A` that enter `A22`, as text.
        entries: String,
    },
    /// The algebraic equations with their nonlinearity become dependent.
    #[error(
        "the plant is not of index 1 at t = {time:.6}: the smallest singular value of A22 + U2' G df/dx V2 falls to \
         {smallest:.1e}, its state would jump or have impulses. Start elsewhere, or change the nonlinearity of the \
         algebraic equations"
    )]
    SingularAlgebraic {
        /// First time at which this happens.
        time: f64,
        /// Smallest singular value there.
        smallest: f64,
    },
    /// No algebraic state was found.
    #[error(
        "the algebraic equations have no solution that could be found near the state at t = {time:.6}; give another x0 \
         as a first guess, or change the nonlinearity"
    )]
    NoAlgebraicSolution {
        /// Time of the attempt.
        time: f64,
    },
    /// No estimate was found.
    #[error(
        "the output equation x_hat = ... + M f(t, x_hat) of observer {} has no solution that could be found at \
         t = {time:.6}; a smaller Lipschitz constant or gain makes it contract",
        observer + 1
    )]
    NoEstimate {
        /// Which observer, from zero.
        observer: usize,
        /// Time of the attempt.
        time: f64,
    },
    /// A nonlinearity without value at a state.
    #[error(
        "f(t, x) has no finite value at t = {time:.6}, x = ({state}); the motion leaves the domain of its functions"
    )]
    Nonlinearity {
        /// Time of the evaluation.
        time: f64,
        /// The state, as text.
        state: String,
    },
    /// An observer with a nonlinearity beside a plant without.
    #[error("observer {} contains f(t, x_hat), but the plant has no nonlinearity f", observer + 1)]
    NoNonlinearity {
        /// Which observer, from zero.
        observer: usize,
    },
    /// Somebody said stop.
    #[error("the simulation was cancelled")]
    Cancelled,
    /// A matrix or vector that does not fit the others.
    #[error("{what} is {} x {}, but {} x {} is needed: {reason}", found.0, found.1, needed.0, needed.1)]
    Shape {
        /// Its name.
        what: String,
        /// Its shape.
        found: (usize, usize),
        /// The shape that fits.
        needed: (usize, usize),
        /// Why that shape is needed.
        reason: &'static str,
    },
    /// A given number that is infinite or not a number.
    #[error("{what} has an entry that is not a finite number")]
    NotFinite {
        /// The name of its matrix or vector.
        what: String,
    },
    /// A signal that has no finite value at some time.
    #[error("{signal} {} is not a finite number at t = {time:?}", index + 1)]
    Signal {
        /// Which vector of signals.
        signal: &'static str,
        /// Which component, from zero.
        index: usize,
        /// Time of the evaluation.
        time: f64,
    },
    /// A signal that jumps more often than can be followed.
    #[error(
        "the signal `{signal}` jumps at least {limit} times within the horizon, more than can be followed exactly; \
         choose a slower signal or a shorter horizon"
    )]
    TooManyJumps {
        /// The signal, as typed.
        signal: String,
        /// How many jumps are followed.
        limit: usize,
    },
    /// A horizon that is no positive number.
    #[error("the horizon is {found}, but a positive number of seconds (of steps in discrete time) is needed")]
    Horizon {
        /// What was given.
        found: f64,
    },
    /// Too few or too many samples.
    #[error("{found} samples, but between 2 and {most} are possible")]
    Samples {
        /// How many were asked for.
        found: usize,
        /// The limit.
        most: usize,
    },
    /// Too many states.
    #[error(
        "plant and observers have {found} states together, but at most {most} are possible; simulate fewer observers at once"
    )]
    TooLarge {
        /// States of plant and observers together.
        found: usize,
        /// The limit.
        most: usize,
    },
    /// The descriptor system itself is malformed.
    #[error(transparent)]
    System(#[from] SystemError),
    /// The nonlinearity is malformed.
    #[error(transparent)]
    Lipschitz(#[from] LipschitzError),
    /// A decomposition failed.
    #[error(transparent)]
    Numerics(#[from] NumericsError),
    /// The integrator failed.
    #[error(transparent)]
    Integration(#[from] IntegrationError),
}
