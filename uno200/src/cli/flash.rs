//! `flash`: writes the program to the board, and asks the board then whether it is the one in
//! force. Over the line where the board takes it so; otherwise avrdude writes, and how it is called
//! and what its failures mean is the assembler's part.

use std::io::IsTerminal;

use anyhow::{Context as _, Error, Result, bail, ensure};
use awl_asm::flash::{Firmware, flash as write};
use awl_asm::native::translate;
use awl_asm::report::{MessageFormat, Messages, Report};
use client::fault;
use client::service::{Command, Identity};
use client::{Program, compare};
use plc_isa::Op;
use project::{Findings, join};
use uno200::Client;
use uno200::program::shown;
use uno200::transport::{Target, ports};

use super::context::notice;
use uno200::args::Flash;

const NOT_ASKED: &str =
    "not asked whether it runs: in freeport mode the program has the line for itself";

/// Nothing is asked or written before the program is known to be good.
pub(super) fn flash(target: Target, mut program: Program, arguments: &Flash) -> Result<bool> {
    let image = image(&mut program, arguments.native)?;
    tell_periods(&program, arguments.native);
    if program.assembly.profile().takes_downloads {
        return over_the_line(target, &program, &image, arguments);
    }
    let Target::Serial(mut settings) = target else {
        bail!("a PLC on the network is not flashed: --port names the port of a board");
    };
    let firmware = Firmware::asked_for(arguments.with_firmware.as_ref())?;
    let port = settings.port.take().map_or_else(ports::only_port, Ok)?;
    let echo = std::io::stderr().is_terminal();
    write(&port, &firmware, &image, program.source.stem(), echo)?;
    eprintln!("{port}: {} written and verified", compare::size(&image));
    if has_freeport(&program) {
        eprintln!("{NOT_ASKED}");
        return Ok(true);
    }
    settings.port = Some(port);
    is_in_force(Target::Serial(settings), &program, &image)
}

/// Writes it to a board that goes on with its old program meanwhile.
fn over_the_line(
    target: Target,
    program: &Program,
    image: &[u8],
    arguments: &Flash,
) -> Result<bool> {
    let profile = program.assembly.profile();
    let title = profile.title;
    let by_drive = format!(
        "hold its button BOOTSEL while you plug it in, and drag the file there that `uno200 build \
         {} -o {}.uf2` makes: it has the firmware, too",
        program.source.name,
        program.source.stem()
    );
    ensure!(
        arguments.with_firmware.is_none(),
        "the firmware of {title} does not come over its line: {by_drive}"
    );
    let mut client = Client::new(target, notice);
    let place = client.place();
    let identity = client.identify().with_context(|| {
        format!("no firmware of {title} answers at {place}; if there is none on it yet, {by_drive}")
    })?;
    ensure!(
        identity.takes_downloads,
        "what answers at {place} is not {title}: its programs do not come over the line"
    );
    let fault = client.download(image, identity.room).context("the board keeps its old program")?;
    if let Some(fault) = fault::text(fault, Some(program)) {
        bail!("the board keeps its old program: {fault}");
    }
    eprintln!("{place}: {} written and checked", compare::size(image));
    // In RUN the new one has begun already.
    if !identity.is_running {
        client.control(Command::Run)?;
    }
    if has_freeport(program) {
        eprintln!("{NOT_ASKED}");
        return Ok(true);
    }
    let (text, is_good) = in_force(&client.identify()?, program, image);
    notice(&text);
    Ok(is_good)
}

/// The image that the board gets.
fn image(program: &mut Program, is_native: bool) -> Result<Vec<u8>> {
    if !program.assembly.profile().takes_downloads {
        program.require_board().map_err(shown)?;
    }
    if !is_native {
        return Ok(program.image.clone());
    }
    let error = match translate(&program.image) {
        Ok(translated) => return Ok(translated.image),
        Err(error) => error,
    };
    match error.diagnostic(&program.assembly) {
        Some(diagnostic) => Err(shown(program.error(vec![diagnostic]))),
        None => Err(Error::new(error)),
    }
}

/// Tells which clocks have a period that is shorter than a scan.
fn tell_periods(program: &Program, is_native: bool) {
    let Ok(joined) = join(program.texts.clone()) else { return };
    let messages = Messages { message_format: MessageFormat::Human, quiet: false };
    for Findings { source, diagnostics } in
        joined.periods(&program.image, &program.assembly, is_native)
    {
        Report::new(messages, false).show(&source, &diagnostics);
    }
}

fn has_freeport(program: &Program) -> bool {
    program.assembly.code.iter().any(|selected| matches!(selected.op, Op::Xmt | Op::Rcv))
}

/// Whether the board runs what was written; says what it does.
fn is_in_force(target: Target, program: &Program, image: &[u8]) -> Result<bool> {
    let identity = Client::new(target, |_| {}).identify().context(
        "the program is written, but nothing on the board answers: \
         `uno200 flash --with-firmware` writes the firmware, too",
    )?;
    let (text, is_good) = in_force(&identity, program, image);
    notice(&text);
    Ok(is_good)
}

fn in_force(identity: &Identity, program: &Program, image: &[u8]) -> (String, bool) {
    let crc = image.last_chunk().map_or(0, |bytes| u32::from_le_bytes(*bytes));
    if let Some(fault) = fault::text(identity.fault, Some(program)) {
        return (format!("the board has stopped: {fault}"), false);
    }
    match (identity.has_program, identity.image_crc == crc, identity.is_running) {
        (false, ..) => ("the board holds no valid program".into(), false),
        (true, false, _) => {
            let other = identity.image_crc;
            (
                format!(
                    "the board holds another program, with CRC {other:08X} instead of {crc:08X}"
                ),
                false,
            )
        }
        (true, true, false) => ("the program is in force, in STOP".into(), true),
        (true, true, true) => ("the program runs".into(), true),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use awl_asm::source::Source;

    #[test]
    fn what_the_board_says_of_itself() {
        let source = Source::new("p.awl", "LD I0.0\n= Q0.0\n").unwrap();
        let program = Program::assembled(source, Vec::new()).unwrap();
        let said = |change: fn(&mut Identity)| {
            let mut identity = Identity {
                has_program: true,
                is_running: true,
                image_crc: program.crc(),
                ..Identity::default()
            };
            change(&mut identity);
            in_force(&identity, &program, &program.image)
        };
        assert_eq!(said(|_| {}), ("the program runs".into(), true));
        assert!(said(|identity| identity.is_running = false).1);
        let (text, is_good) = said(|identity| identity.image_crc ^= 1);
        assert!(!is_good && text.contains("another program"), "{text}");
        assert!(!said(|identity| identity.has_program = false).1);
        let (text, is_good) = said(|identity| identity.fault = [2, 0, 0, 0]);
        assert!(!is_good && text.contains("watchdog"), "{text}");
    }
}
