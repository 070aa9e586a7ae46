//! Steps of controlled length over stretches of time, explicit until stiffness shows.

use super::dense::Dense;
use super::explicit::Explicit;
use super::implicit::Implicit;
use super::{Flow, IntegrationError, Segment};

/// States that hardly move are measured by this part of the largest.
const LEAST: f64 = 1e-6;
/// Largest and smallest change of the step from one to the next.
const GROWTH: (f64, f64) = (0.2, 5.0);
/// The dense output of an implicit step may be this many times less accurate than its end.
const INSIDE: f64 = 10.0;
/// A new step aims at this part of the tolerance, in its length.
const SAFETY: f64 = 0.9;
/// Change of a step whose stages have no value.
const RETREAT: f64 = 0.25;
/// Steps with a fast mode after which the implicit method is tried, and steps without after which counting restarts.
const STIFF: (u32, u32) = (15, 6);
/// Implicit steps after which the trial is judged.
const TRIAL: u32 = 15;
/// After a trial in vain, this many times as many steps pass before the next.
const PATIENCE: u32 = 4;
/// An implicit step must be this many times as long to be worth its cost, and more by each of so many states.
const WORTH: (f64, f64) = (3.0, 10.0);

/// Accuracy and work of an integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepOptions {
    /// Error of a step, relative to the largest value that each state has had so far.
    pub relative: f64,
    /// The first step is at most this.
    pub first_step: f64,
    /// Smallest step.
    pub smallest_step: f64,
    /// Number of steps after which the integration is given up.
    pub limit: usize,
}

/// Why an integration came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The end of the stretch of time.
    Reached,
    /// The flow asked for it.
    Stopped,
}

/// One-step methods with error control: steps end at kinks, and start afresh after jumps.
///
/// Explicit steps of order 5 (Dormand and Prince) as long as the solution limits them. Where a fast mode seems to,
/// linearly implicit ones of order 5 (`Rodas5P`) are tried, and keep the run when they are so much longer that they pay.
/// Neither has a memory of earlier steps, so that a kink costs nothing but the end of a step.
#[derive(Clone, Debug)]
pub struct Integrator {
    options: StepOptions,
    state: Vec<f64>,
    next: Vec<f64>,
    rate: Vec<f64>,
    error: Vec<f64>,
    scale: Vec<f64>,
    sizes: Vec<f64>,
    inside: Vec<f64>,
    explicit: Explicit,
    implicit: Implicit,
    dense: Dense,
    step: f64,
    stiff: bool,
    trial: Trial,
    steps: usize,
}

/// Whether the implicit method is worth its cost.
#[derive(Clone, Copy, Debug)]
struct Trial {
    /// Steps with a fast mode, and steps without since.
    limited: u32,
    free: u32,
    /// How many of the former start a trial.
    wanted: u32,
    /// Implicit steps so far, and the longest explicit step before.
    steps: u32,
    longest: f64,
}

impl Integrator {
    /// Prepares an integration from a state.
    pub fn new(start: &[f64], options: StepOptions) -> Self {
        let order = start.len();
        let zeros = vec![0.0; order];
        Self {
            options,
            state: start.to_vec(),
            next: zeros.clone(),
            rate: zeros.clone(),
            error: zeros.clone(),
            scale: zeros.clone(),
            sizes: start.iter().map(|x| x.abs()).collect(),
            inside: zeros,
            explicit: Explicit::new(order),
            implicit: Implicit::new(order),
            dense: Dense::new(order),
            step: options.first_step,
            stiff: false,
            trial: Trial { limited: 0, free: 0, wanted: STIFF.0, steps: 0, longest: 0.0 },
            steps: 0,
        }
    }

    /// Number of steps so far, accepted or not.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Whether the implicit method has the run.
    pub fn is_stiff(&self) -> bool {
        self.stiff
    }

    /// Integrates over a segment, and hands its samples and every accepted step to the flow.
    ///
    /// # Errors
    /// [`IntegrationError`]: a derivative without value, too many steps, or steps that become too small.
    pub fn over(&mut self, flow: &mut dyn Flow, segment: &Segment) -> Result<Ending, IntegrationError> {
        let mut samples = segment.samples.iter().copied().peekable();
        while let Some((index, t)) = samples.next_if(|(_, t)| *t <= segment.start) {
            if !flow.sample(index, t, &self.state) {
                return Ok(Ending::Stopped);
            }
        }
        if self.state.is_empty() {
            // nothing moves by itself
            let mut rest = samples;
            let going = rest.all(|(index, t)| flow.sample(index, t, &[]) && flow.accepted(t, &[]));
            return Ok(if going { Ending::Reached } else { Ending::Stopped });
        }
        let mut now = segment.start;
        if !flow.derivative(now, &self.state, &mut self.rate) {
            return Err(IntegrationError::NotFinite { time: now });
        }
        self.implicit.forget();
        let inner = segment.kinks.iter().copied().filter(|t| *t > segment.start && *t < segment.end);
        for stop in inner.chain([segment.end]) {
            while now < stop {
                let before = now;
                now = self.advance(flow, now, stop)?;
                let h = now - before;
                while let Some((index, t)) = samples.next_if(|(_, t)| *t <= now) {
                    self.dense.at(((t - before) / h).min(1.0), &mut self.inside);
                    if !flow.sample(index, t, &self.inside) {
                        return Ok(Ending::Stopped);
                    }
                }
                std::mem::swap(&mut self.state, &mut self.next);
                if !flow.accepted(now, &self.state) {
                    return Ok(Ending::Stopped);
                }
            }
        }
        Ok(Ending::Reached)
    }

    /// One accepted step towards a stop: leaves its end in `next`, its inside in `dense`, its rate in `rate`.
    fn advance(&mut self, flow: &mut dyn Flow, now: f64, stop: f64) -> Result<f64, IntegrationError> {
        let mut rejected = false;
        loop {
            if self.steps >= self.options.limit {
                return Err(IntegrationError::TooManySteps { time: now, limit: self.options.limit });
            }
            self.steps += 1;
            let rest = stop - now;
            // two equal steps rather than one that leaves a crumb
            let (h, last) = match self.step {
                step if step >= rest * (1.0 - 1e-9) => (rest, true),
                step if step > 0.5 * rest => (0.5 * rest, false),
                step => (step, false),
            };
            if h < self.options.smallest_step && !last {
                return Err(IntegrationError::Collapsed { time: now });
            }
            let ends = (self.next.as_mut_slice(), self.error.as_mut_slice());
            let valid = if self.stiff {
                self.implicit.attempt(flow, (now, h), &self.state, &self.rate, ends)
            } else {
                self.explicit.attempt(flow, (now, h), &self.state, &self.rate, ends)
            };
            let mut error = if valid { self.error_norm() } else { f64::INFINITY };
            if self.stiff && error <= 1.0 {
                error = error.max(self.dense_error(flow, (now, h)));
            }
            let end = if last { stop } else { now + h };
            let accepted = error <= 1.0 && self.finish(flow, h, end);
            if accepted {
                let growth = (SAFETY * error.powf(-0.2)).min(if rejected { 1.0 } else { GROWTH.1 });
                // a step that was cut at a stop says little about the next
                self.step = if last { self.step.max(h * growth) } else { h * growth.max(GROWTH.0) };
                return Ok(end);
            }
            let too_large = error > 1.0 && error.is_finite();
            self.step = h * if too_large { (SAFETY * error.powf(-0.2)).max(GROWTH.0) } else { RETREAT };
            rejected = true;
            if self.step < self.options.smallest_step {
                return Err(IntegrationError::Collapsed { time: now });
            }
        }
    }

    /// Largest error of the attempted step in units of what is allowed.
    fn error_norm(&mut self) -> f64 {
        let mut largest = 0.0_f64;
        for (i, size) in self.sizes.iter().enumerate() {
            self.scale[i] = size.max(self.next[i].abs());
            largest = largest.max(self.scale[i]);
        }
        let mut worst = 0.0_f64;
        for (scale, error) in self.scale.iter_mut().zip(&self.error) {
            *scale = scale.max(LEAST * largest).max(f64::MIN_POSITIVE);
            let relative = error.abs() / (self.options.relative * *scale);
            // not a number counts as infinite
            worst = if relative.is_nan() { f64::INFINITY } else { worst.max(relative) };
        }
        if self.next.iter().all(|x| x.is_finite()) { worst } else { f64::INFINITY }
    }

    /// The error inside an implicit step, in units of what is allowed there.
    fn dense_error(&mut self, flow: &mut dyn Flow, step: (f64, f64)) -> f64 {
        self.implicit.dense(&self.state, &self.next, &mut self.dense);
        if self.implicit.dense_error(flow, step, &self.dense, &mut self.error) {
            self.error_norm() / INSIDE
        } else {
            f64::INFINITY
        }
    }

    /// Takes an attempted step over; false when the derivative at its end has no value.
    fn finish(&mut self, flow: &mut dyn Flow, h: f64, end: f64) -> bool {
        if self.stiff {
            if !flow.derivative(end, &self.next, &mut self.inside) {
                return false;
            }
            std::mem::swap(&mut self.rate, &mut self.inside);
            self.judge();
        } else {
            self.rate.copy_from_slice(self.explicit.last());
            self.explicit.dense(h, &self.state, &self.next, &mut self.dense);
            self.watch_stiffness(h);
        }
        for (size, x) in self.sizes.iter_mut().zip(&self.next) {
            *size = size.max(x.abs());
        }
        true
    }

    /// Starts a trial of the implicit method after enough steps with a fast mode.
    fn watch_stiffness(&mut self, h: f64) {
        let trial = &mut self.trial;
        if self.explicit.meets_fast_mode(h, &self.next, &self.scale) {
            trial.free = 0;
            trial.limited += 1;
            trial.longest = trial.longest.max(h);
            self.stiff = trial.limited >= trial.wanted;
        } else {
            trial.free += 1;
            if trial.free >= STIFF.1 {
                (trial.limited, trial.longest) = (0, 0.0);
            }
        }
    }

    /// Ends a trial whose steps did not grow enough.
    fn judge(&mut self) {
        let trial = &mut self.trial;
        if trial.steps > TRIAL {
            return;
        }
        trial.steps += 1;
        let worth = WORTH.0 + self.state.len() as f64 / WORTH.1;
        if trial.steps == TRIAL && self.step < worth * trial.longest {
            self.stiff = false;
            self.step = trial.longest;
            let wanted = trial.wanted.saturating_mul(PATIENCE);
            *trial = Trial { limited: 0, free: 0, wanted, steps: 0, longest: 0.0 };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::segments;
    use super::*;
    use nalgebra::{DMatrix, dmatrix};

    /// `w' = A w + b s(t)` with records of its samples.
    struct Linear {
        a: DMatrix<f64>,
        input: fn(f64) -> f64,
        samples: Vec<(f64, Vec<f64>)>,
        last_step: f64,
    }

    impl Flow for Linear {
        fn derivative(&mut self, t: f64, state: &[f64], out: &mut [f64]) -> bool {
            for (i, out) in out.iter_mut().enumerate() {
                let own: f64 = (0..state.len()).map(|j| self.a[(i, j)] * state[j]).sum();
                *out = own + (self.input)(t);
            }
            out.iter().all(|x| x.is_finite())
        }
        fn jacobian(&mut self, _t: f64, _state: &[f64], out: &mut DMatrix<f64>) -> bool {
            out.copy_from(&self.a);
            true
        }
        fn sample(&mut self, _index: usize, t: f64, state: &[f64]) -> bool {
            self.samples.push((t, state.to_vec()));
            true
        }
        fn accepted(&mut self, t: f64, _state: &[f64]) -> bool {
            self.last_step = t;
            true
        }
    }

    fn options(relative: f64) -> StepOptions {
        StepOptions { relative, first_step: 1e-3, smallest_step: 1e-14, limit: 100_000 }
    }

    fn grid(end: f64, count: u32) -> Vec<f64> {
        (0..=count).map(|k| end * f64::from(k) / f64::from(count)).collect()
    }

    fn run(a: DMatrix<f64>, input: fn(f64) -> f64, start: &[f64], relative: f64) -> (Linear, Integrator) {
        let mut flow = Linear { a, input, samples: Vec::new(), last_step: 0.0 };
        let mut integrator = Integrator::new(start, options(relative));
        for segment in segments(&grid(4.0, 101), &[], &[]) {
            integrator.over(&mut flow, &segment).unwrap();
        }
        (flow, integrator)
    }

    #[test]
    fn an_oscillation_is_followed_inside_the_steps_too() {
        let (flow, integrator) = run(dmatrix![0.0, 3.0; -3.0, 0.0], |_| 0.0, &[0.0, 1.0], 1e-9);
        let worst = flow.samples.iter().map(|(t, w)| (w[0] - (3.0 * t).sin()).abs()).fold(0.0, f64::max);
        println!("{worst:.1e} in {} steps", integrator.steps());
        assert!(worst < 2e-8 && !integrator.is_stiff(), "{worst:.1e}");
        assert!(integrator.steps() < 300, "{} steps", integrator.steps());
        assert_eq!((flow.samples.len(), flow.last_step), (102, 4.0), "every sample, to the end");
    }

    #[test]
    fn stiffness_is_noticed_and_stays_accurate() {
        // w' = -k (w - cos t) - sin t has the solution cos t
        for k in [1e3, 1e6] {
            let input =
                if k < 1e4 { |t: f64| 1e3 * t.cos() - t.sin() } else { |t: f64| 1e6 * t.cos() - t.sin() };
            let (flow, integrator) = run(dmatrix![-k], input, &[0.0], 1e-9);
            let late = flow.samples.iter().filter(|(t, _)| *t > 0.1);
            let worst = late.map(|(t, w)| (w[0] - t.cos()).abs()).fold(0.0, f64::max);
            println!("k = {k}: {worst:.1e} in {} steps", integrator.steps());
            assert!(integrator.is_stiff(), "k = {k} is stiff");
            assert!(worst < 2e-8, "k = {k}: {worst:.1e}");
            assert!(integrator.steps() < 1500, "k = {k}: {} steps", integrator.steps());
        }
    }

    #[test]
    fn both_methods_have_order_five() {
        // fixed steps of w' = -2 w + cos 3 t
        let exact = |t: f64| {
            let forced = |t: f64| (2.0 * (3.0 * t).cos() + 3.0 * (3.0 * t).sin()) / 13.0;
            forced(t) - forced(0.0) * (-2.0 * t).exp()
        };
        let a = dmatrix![-2.0];
        let end_error = |stiff: bool, count: u32| {
            let mut flow =
                Linear { a: a.clone(), input: |t| (3.0 * t).cos(), samples: Vec::new(), last_step: 0.0 };
            let h = 1.0 / f64::from(count);
            let (mut explicit, mut implicit) = (Explicit::new(1), Implicit::new(1));
            let (mut state, mut dense, mut inside) = ([0.0], Dense::new(1), 0.0_f64);
            for k in 0..count {
                let t = h * f64::from(k);
                let (mut rate, mut end, mut error) = ([0.0], [0.0], [0.0]);
                assert!(flow.derivative(t, &state, &mut rate), "finite");
                let ends = (end.as_mut_slice(), error.as_mut_slice());
                if stiff {
                    assert!(implicit.attempt(&mut flow, (t, h), &state, &rate, ends), "regular");
                    implicit.dense(&state, &end, &mut dense);
                } else {
                    assert!(explicit.attempt(&mut flow, (t, h), &state, &rate, ends), "finite");
                    explicit.dense(h, &state, &end, &mut dense);
                }
                let mut out = [0.0];
                dense.at(0.37, &mut out);
                inside = inside.max((out[0] - exact(t + 0.37 * h)).abs());
                state = end;
            }
            ((state[0] - exact(1.0)).abs(), inside)
        };
        for stiff in [false, true] {
            let (coarse, fine) = (end_error(stiff, 8), end_error(stiff, 16));
            let order = (coarse.0 / fine.0).log2();
            let inner = (coarse.1 / fine.1).log2();
            println!("stiff {stiff}: order {order:.2}, inside {inner:.2}, errors {fine:?}");
            assert!(order > 4.6 && inner > 3.8, "stiff {stiff}: {order:.2}, inside {inner:.2}");
        }
    }

    #[test]
    fn kinks_end_steps_and_cost_no_restart() {
        let kinks: Vec<f64> = (1..80).map(|k| 0.05 * f64::from(k)).collect();
        let input = |t: f64| ((t / 0.05).rem_euclid(2.0) - 1.0).abs();
        let mut flow = Linear { a: dmatrix![-1.0], input, samples: Vec::new(), last_step: 0.0 };
        let mut integrator = Integrator::new(&[0.0], options(1e-9));
        for segment in segments(&[0.0, 4.0], &[], &kinks) {
            integrator.over(&mut flow, &segment).unwrap();
        }
        println!("{} steps for 79 kinks", integrator.steps());
        assert!(integrator.steps() < 3 * 80, "{} steps", integrator.steps());
    }

    #[test]
    fn a_solution_that_ends_is_reported_with_its_time() {
        /// `w' = 1 / (2 w)` backwards: `w = sqrt(1 - t)`.
        struct Ends;
        impl Flow for Ends {
            fn derivative(&mut self, _t: f64, state: &[f64], out: &mut [f64]) -> bool {
                out[0] = -0.5 / state[0];
                state[0] > 0.0
            }
            fn jacobian(&mut self, _t: f64, state: &[f64], out: &mut DMatrix<f64>) -> bool {
                out[(0, 0)] = 0.5 / (state[0] * state[0]);
                state[0] > 0.0
            }
            fn sample(&mut self, _index: usize, _t: f64, _state: &[f64]) -> bool {
                true
            }
            fn accepted(&mut self, _t: f64, _state: &[f64]) -> bool {
                true
            }
        }
        let mut integrator = Integrator::new(&[1.0], options(1e-9));
        let part = segments(&[0.0, 2.0], &[], &[]).remove(0);
        let error = integrator.over(&mut Ends, &part).unwrap_err();
        let IntegrationError::Collapsed { time } = error else { panic!("{error}") };
        assert!((time - 1.0).abs() < 1e-4, "the solution ends at 1, found {time}");
    }
}
