//! L3: plant and observer together in time.
