//! How much a random test does: a bounded run by default, as long as wanted by an environment
//! variable.

/// The number in the environment variable, or the default. A value that is no number is an error,
/// not a default.
pub fn effort(variable: &str, default: u64) -> u64 {
    match std::env::var(variable) {
        Ok(text) => text
            .replace('_', "")
            .parse()
            .unwrap_or_else(|_| panic!("{variable}={text} is no number")),
        Err(_) => default,
    }
}
