//! L4: the commands of the command line.
