//! L5: the screen.
