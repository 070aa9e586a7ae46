//! L0: scalar expressions that people type: entries of matrices, signals in time, nonlinearities.
