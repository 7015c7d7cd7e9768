//! Which random blocks a run looks at.

/// The number in an environment variable.
pub fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok().and_then(|text| text.parse().ok())
}

/// The numbers of the blocks: `FB_BLOCKS` of them, or the one that `FB_SEED` says.
pub fn seeds(usual: u64) -> Vec<u64> {
    match number("FB_SEED") {
        Some(seed) => vec![seed],
        None => (0..number("FB_BLOCKS").unwrap_or(usual)).collect(),
    }
}
