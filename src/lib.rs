//! descry: an interactive observatory for descriptor systems.
//!
//! ```text
//! E x' = A x + B u + D d          (discrete: E x[k+1] = ...)
//!    y = C x + F d                E may be singular, and need not be square
//! ```
//!
//! Layers, each of which may use only those to its left:
//! `numerics, expression` <- `lmi` <- `system` <- `observer` <- `simulation, paper, document` <- `session, headless` <-
//! `platform, gui`.

pub mod document;
pub mod expression;
#[cfg(feature = "gui")]
pub mod gui;
pub mod headless;
pub mod lmi;
pub mod numerics;
pub mod observer;
pub mod paper;
pub mod platform;
pub mod session;
pub mod simulation;
pub mod system;
