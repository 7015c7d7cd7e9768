//! Charts that never come to rest, whatever arrives: found before anything runs.

use crate::condition::{Condition, condition};
use crate::model::Block;

/// The states of a chart that is never at rest once it is in one of them: each has a transition
/// that always clears, and none that clears without an event leads out of them.
pub(crate) fn without_rest(block: &Block) -> Vec<usize> {
    let all: Vec<Option<Vec<usize>>> =
        (0..block.states.len()).map(|state| at_once(block, state)).collect();
    let mut restless: Vec<bool> = all.iter().map(Option::is_some).collect();
    loop {
        let stays = |state: usize| {
            let next = all.get(state).and_then(Option::as_ref);
            next.is_some_and(|next| next.iter().all(|to| restless.get(*to) == Some(&true)))
        };
        let still: Vec<bool> = (0..restless.len()).map(stays).collect();
        if still == restless {
            break;
        }
        restless = still;
    }
    (0..restless.len()).filter(|state| restless.get(*state) == Some(&true)).collect()
}

/// Where transitions without an event can lead, up to the first that always clears; `None` if there
/// is none of these.
fn at_once(block: &Block, state: usize) -> Option<Vec<usize>> {
    let name = &block.states.get(state)?.name.text;
    let mut destinations = Vec::new();
    for transition in block.transitions.iter().filter(|one| one.source.names(name)) {
        let Ok(Condition { event: None, guards }) = condition(block, transition) else { continue };
        destinations.push(block.state(&transition.destination.text)?);
        if guards.is_empty() {
            return Some(destinations);
        }
    }
    None
}
