//! How many cases a test takes that draws them at random.

/// Whether the long run was asked for: where the environment has `EHL_LONG`.
pub fn long() -> bool {
    std::env::var_os("EHL_LONG").is_some()
}

/// As many cases as the ordinary run takes, or as the long one does.
pub fn cases(ordinary: usize, many: usize) -> usize {
    if long() { many } else { ordinary }
}
