//! L4: the application without a screen.
