//! The colours of curves, the same on screen and on paper.

/// Colours of Okabe and Ito, told apart by people with any kind of colour vision; red, green, blue.
///
/// The order puts the colours with the best contrast on white first; black, the last, belongs to unknown inputs.
///
/// # Source
/// M. Okabe and K. Ito, Color universal design, 2008.
pub const PALETTE: [(u8, u8, u8); 8] = [
    (0, 114, 178),
    (213, 94, 0),
    (0, 158, 115),
    (204, 121, 167),
    (86, 180, 233),
    (230, 159, 0),
    (240, 228, 66),
    (0, 0, 0),
];

/// The colour with a number; numbers beyond the palette start again.
pub fn colour(number: usize) -> (u8, u8, u8) {
    PALETTE[number % PALETTE.len()]
}
