//! What the page was told last of each kind: what has not changed is not told again.

use crate::protocol::Event;

/// Kinds of events that are a state, with the last of each.
#[derive(Debug, Default)]
pub struct Told(Vec<Event>);

impl Told {
    /// The event, unless the page knows it already.
    pub fn news(&mut self, event: Event) -> Option<Event> {
        let is_like =
            |old: &&mut Event| std::mem::discriminant(*old) == std::mem::discriminant(&event);
        match self.0.iter_mut().find(is_like) {
            Some(old) if *old == event => None,
            Some(old) => {
                *old = event.clone();
                Some(event)
            }
            None => {
                self.0.push(event.clone());
                Some(event)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_is_told_once() {
        let mut told = Told::default();
        let forced = || Event::Forced { values: Vec::new() };
        assert!(told.news(forced()).is_some());
        assert!(told.news(Event::Watched { values: Vec::new() }).is_some());
        assert!(told.news(forced()).is_none());
    }
}
