//! A PLC as one end of a line, driven from outside: requests in, answers out, and the time. It has
//! no clock, no sockets and no threads; whoever drives it has them.

use std::time::Duration;

use super::Access;
use super::pace::Pace;
use super::service::{Answer, Request, Service};
use crate::machine::host::Host;
use crate::machine::{Machine, MachineError, Mode};
use crate::plant::Plant;
use crate::run::{Course, Outcome};

/// A change that somebody at the machine would see: whether the program is executed, and the fault
/// that ended it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// Start of the last scan, in milliseconds.
    pub at_ms: u64,
    /// The mode since then.
    pub mode: Mode,
    /// In words and with its place in the program.
    pub fault: Option<String>,
}

/// A PLC that runs in real time and answers. Times are since any beginning and never decrease. `T`
/// is by what answers are known.
pub struct Endpoint<T> {
    course: Course,
    service: Service<T>,
    pace: Pace,
    outcome: Outcome,
    mode: Mode,
    now_ms: u64,
}

impl<T> Endpoint<T> {
    /// Before the first scan, which is due now; then there is one every `scan_ms` milliseconds.
    pub fn new(course: Course, scan_ms: u64, access: Access, now: Duration) -> Endpoint<T> {
        Endpoint {
            course,
            service: Service::new(access),
            pace: Pace::new(Duration::from_millis(scan_ms), now),
            outcome: Outcome { scan_ms, ..Outcome::default() },
            // As a new PLC is expected to be: that it is not is a change.
            mode: Mode::Run,
            now_ms: 0,
        }
    }

    /// How long until the next scan is due; zero when it is.
    pub fn until_next(&self, now: Duration) -> Duration {
        self.pace.until_next(now)
    }

    /// Runs the next scan, if it is due: at most one, so that nobody waits for ever. Fails only if
    /// the machine cannot access an operand, in the first scan.
    pub fn go_on(&mut self, host: &mut Host, now: Duration) -> Result<(), MachineError> {
        if !self.pace.until_next(now).is_zero() {
            return Ok(());
        }
        self.pace.scan_starts(now);
        self.now_ms = self.outcome.scans * self.outcome.scan_ms;
        self.course.go_on(self.now_ms, host, &mut self.outcome)?;
        host.scan(self.now_ms);
        self.outcome.scans += 1;
        if !self.course.expects_sent() {
            // Nobody will ask for it.
            host.take_sent()?;
        }
        self.service.go_on(host);
        Ok(())
    }

    /// What has changed since it was asked for last.
    pub fn change(&mut self, host: &Host) -> Option<Change> {
        let before = std::mem::replace(&mut self.mode, host.mode());
        let change = || Change { at_ms: self.now_ms, mode: host.mode(), fault: host.fault() };
        (before != host.mode()).then(change)
    }

    /// A client asks. Some requests are answered after a scan.
    pub fn ask(&mut self, host: &mut Host, request: Request<T>) {
        self.service.take(request, host);
    }

    /// The answers there are by now, in the order of the requests, once.
    pub fn answers(&mut self) -> impl Iterator<Item = Answer<T>> + use<T> {
        self.service.answers()
    }

    /// What is wired to it.
    pub fn plant(&self) -> Option<&dyn Plant> {
        self.course.plant()
    }

    /// The same, to be set.
    pub fn plant_mut(&mut self) -> Option<&mut dyn Plant> {
        self.course.plant_mut()
    }

    /// Milliseconds from the first scan to the last.
    pub fn time_ms(&self) -> u64 {
        self.now_ms
    }

    /// The end.
    pub fn finish(self) -> Outcome {
        let Endpoint { course, mut outcome, .. } = self;
        course.finish(&mut outcome);
        outcome
    }
}

#[cfg(test)]
mod tests {
    use core::net::Ipv4Addr;

    use awl_asm::assemble::assemble;
    use awl_asm::source::Source;

    use super::*;
    use crate::scenario::Scenario;

    const READ_M0_0: [u8; 5] = [1, 0x03, 0xE8, 0, 1];

    fn host(text: &str) -> Host {
        let assembly = assemble(&Source::new("p.awl", text).unwrap(), Vec::new());
        Host::new(assembly.image.unwrap(), Box::new(|_| String::new()))
    }

    fn endpoint(scan_ms: u64) -> Endpoint<char> {
        let course = Course::new(&Scenario::default(), None, scan_ms);
        Endpoint::new(course, scan_ms, Access::default(), Duration::ZERO)
    }

    #[test]
    fn scans_when_they_are_due_and_answers_in_between() {
        let (mut host, mut endpoint) = (host("LD SM0.1\nS M0.0, 1\n"), endpoint(10));
        let ask = |endpoint: &mut Endpoint<char>, host: &mut Host, from| {
            let client = Ipv4Addr::LOCALHOST.into();
            endpoint.ask(host, Request { client, pdu: READ_M0_0.to_vec(), from });
            let answers = endpoint.answers().map(|answer| (answer.to, answer.pdu));
            answers.collect::<Vec<_>>()
        };
        assert_eq!(ask(&mut endpoint, &mut host, 'a'), [('a', vec![1, 1, 0])]);
        for now_ms in 0..25 {
            endpoint.go_on(&mut host, Duration::from_millis(now_ms)).unwrap();
        }
        assert_eq!(endpoint.until_next(Duration::from_millis(24)), Duration::from_millis(6));
        assert_eq!(ask(&mut endpoint, &mut host, 'b'), [('b', vec![1, 1, 1])]);
        assert_eq!((endpoint.change(&host), endpoint.finish().scans), (None, 3));
    }

    #[test]
    fn a_change_is_told_once() {
        let (mut host, mut endpoint) = (host("LD SM0.0\nSTOP\n"), endpoint(5));
        endpoint.go_on(&mut host, Duration::ZERO).unwrap();
        let change = endpoint.change(&host).unwrap();
        assert_eq!((change.at_ms, change.mode, change.fault), (0, Mode::Stop, None));
        assert_eq!(endpoint.change(&host), None);
    }
}
