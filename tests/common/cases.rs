//! Number of random cases of a test.

/// Returns true if the long run is requested by `EHL_LONG` in the environment.
pub fn long() -> bool {
    std::env::var_os("EHL_LONG").is_some()
}

/// Returns the number of cases of the ordinary or the long run.
pub fn cases(ordinary: usize, many: usize) -> usize {
    if long() { many } else { ordinary }
}
