//! L4: native and web: threads or workers, files, clipboard.
