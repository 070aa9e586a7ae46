//! L3: the versioned file format, links, pasted matrices, exports.
