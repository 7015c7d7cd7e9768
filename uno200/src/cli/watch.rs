//! `watch`: values as they change.

use std::io::{self, Write};
use std::thread::sleep;
use std::time::{Duration, Instant};

use anyhow::Result;
use client::Operand;
use client::service::Watched;
use client::trace::{counted_scans, write_csv_header, write_csv_row};

use super::context::{Context, notice};
use uno200::args::{Watch, WatchFormat};

/// Longest time to wait for a cable that is plugged in again.
const UNPLUGGED: Duration = Duration::from_secs(600);
/// Narrowest column.
const WIDTH: usize = 6;

pub(super) fn watch(context: &mut Context, arguments: &Watch) -> Result<bool> {
    let operands = context.operands(&arguments.operands)?;
    let mut rows = Rows {
        operands: &operands,
        format: arguments.format,
        base: context.base,
        before: None,
        has_header: false,
        scans: None,
    };
    let begin = Instant::now();
    let is_over = || arguments.duration.is_some_and(|duration| begin.elapsed() >= duration);
    let mut next = begin;
    loop {
        let at = begin.elapsed();
        match context.client.watch_operands(&operands) {
            Ok(watched) => rows.row(at, &watched)?,
            Err(error) if error.is_passing() => {
                anstream::eprintln!("{error}; waiting for the connection");
                let left = arguments
                    .duration
                    .map_or(UNPLUGGED, |duration| duration.saturating_sub(begin.elapsed()));
                context.client.connect_within(left, &mut notice)?;
                // What answers now may have begun to count anew.
                rows.scans = None;
            }
            Err(error) => return Err(error.into()),
        }
        // Rows that are late are left out, not made up for.
        let now = Instant::now();
        while next <= now && !arguments.every.is_zero() {
            next += arguments.every;
        }
        if arguments
            .duration
            .is_some_and(|duration| next.saturating_duration_since(begin) >= duration)
            || is_over()
        {
            return Ok(true);
        }
        sleep(next.saturating_duration_since(now));
    }
}

/// What is written.
struct Rows<'a> {
    operands: &'a [Operand],
    format: WatchFormat,
    base: client::value::Base,
    before: Option<Vec<u32>>,
    has_header: bool,
    /// Scans since RUN: the PLC tells their low word.
    scans: Option<u64>,
}

impl Rows<'_> {
    fn header(&self) -> io::Result<()> {
        let mut out = io::stdout().lock();
        match self.format {
            WatchFormat::Csv => write_csv_header(self.operands, &mut out)?,
            WatchFormat::Table => {
                write!(out, "{:>10} {:>8}", "time", "scan")?;
                for operand in self.operands {
                    write!(out, "  {:>WIDTH$}", operand.name)?;
                }
                writeln!(out)?;
            }
        }
        out.flush()
    }

    fn row(&mut self, at: Duration, watched: &Watched) -> io::Result<()> {
        if !self.has_header {
            self.header()?;
            self.has_header = true;
        }
        let scan = *self.scans.insert(counted_scans(self.scans, watched.scan));
        let mut out = io::stdout().lock();
        match self.format {
            WatchFormat::Csv => {
                let ms = at.as_millis() as f64;
                write_csv_row(ms, scan, self.operands, &watched.values, self.base, &mut out)?;
            }
            WatchFormat::Table => {
                if self.before.as_ref() == Some(&watched.values) {
                    return Ok(());
                }
                write!(out, "{:>8.3} s {scan:>8}", at.as_secs_f64())?;
                for (operand, &value) in self.operands.iter().zip(&watched.values) {
                    let width = operand.name.chars().count().max(WIDTH);
                    write!(out, "  {:>width$}", operand.text(value, self.base))?;
                }
                writeln!(out)?;
                self.before = Some(watched.values.clone());
            }
        }
        out.flush()
    }
}
