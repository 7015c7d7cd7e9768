//! Commands of other tools and arguments in the wrong place: which command of this one was meant.
//! Only what clap has refused comes here.

use clap::CommandFactory;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use uno200::args::Arguments;

const FLASH: &str = "`uno200 flash {files}` writes a program to the board";
const READ: &str = "`uno200 read-program` reads the program out of the PLC";
const WATCH: &str = "`uno200 watch I0.0 MW3` shows values as they change";
const SHOW: &str = "`uno200 show {files}` shows the program with its values";
const STATUS: &str = "`uno200 status` tells what the PLC does";
const BUILD: &str = "`uno200 build {files}` makes AWL or an image of it";
const CHECK: &str = "`uno200 build --check {files}` tells what is wrong with it";
const SIMULATE: &str = "`awl-sim {files}` simulates a program on this computer";
const RUN: &str = "`uno200 run` starts the program";
const STOP: &str = "`uno200 stop` stops it";
const CLEAR: &str = "`uno200 clear` forgets the fault that stopped the PLC";
const COMPARE: &str = "`uno200 compare {files}` compares the program in the PLC with a file";
const SET: &str = "`uno200 set MW3=5` writes values";
const TRACE: &str = "`uno200 trace I0.0 MW3` records operands scan by scan";
const SAVE: &str = "`uno200 retained save F.txt` saves retentive memory";
const RESTORE: &str = "`uno200 retained restore F.txt` restores retentive memory";

/// Commands of other tools, with the ones here that do what each may mean.
const WORDS: [(&[&str], &[&str]); 20] = [
    // To the board for some, out of it for others.
    (&["upload", "download", "transfer", "load"], &[FLASH, READ]),
    (&["burn", "program", "deploy", "install", "send", "put"], &[FLASH]),
    (&["write"], &[FLASH, SET]),
    (&["read", "get"], &[READ, WATCH]),
    (&["dump", "fetch", "pull"], &[READ]),
    (&["monitor", "online", "debug", "live", "view", "inspect"], &[SHOW, WATCH]),
    (&["connect", "info", "state", "ping", "identify", "version", "diagnose"], &[STATUS, SHOW]),
    (&["simulate", "simulator", "sim", "emulate", "serve"], &[SIMULATE]),
    (&["compile", "assemble", "make", "asm", "translate"], &[BUILD]),
    (&["check", "lint", "validate"], &[CHECK]),
    (&["format", "fmt"], &["`uno200 build --fmt {files}` writes the canonical layout"]),
    (&["start", "resume", "go"], &[RUN]),
    (&["halt", "pause", "kill"], &[STOP]),
    (&["reset", "restart", "reboot", "acknowledge"], &[STOP, RUN, CLEAR]),
    (&["verify", "diff"], &[COMPARE]),
    (&["record", "log", "plot", "scope"], &[TRACE, WATCH]),
    (&["step"], &["`uno200 scan` executes a single scan, from STOP"]),
    (&["release", "unlock"], &["`uno200 unforce --all` ends forcing"]),
    (&["backup", "save"], &[READ, SAVE]),
    (&["restore"], &[FLASH, RESTORE]),
];

/// What is said in place of clap's words. `arguments`: the command line without the program's name.
pub(super) fn told(error: &clap::Error, arguments: &[String]) -> Option<String> {
    match error.kind() {
        ErrorKind::InvalidSubcommand => {
            let word = context(error, ContextKind::InvalidSubcommand)?;
            let at = arguments.iter().position(|argument| argument == word)?;
            command_meant(word, &arguments[at + 1..])
        }
        ErrorKind::UnknownArgument => {
            let argument = context(error, ContextKind::InvalidArg)?;
            let command = Arguments::command();
            let mut names = command.get_subcommands().map(|command| command.get_name());
            let name = names.find(|name| arguments.iter().any(|argument| argument == name))?;
            argument_meant(name, argument)
        }
        _ => None,
    }
}

fn context(error: &clap::Error, kind: ContextKind) -> Option<&str> {
    match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text),
        _ => None,
    }
}

fn command_meant(word: &str, behind: &[String]) -> Option<String> {
    let is_it = |known: &&str| known.eq_ignore_ascii_case(word);
    let (_, meant) = WORDS.iter().find(|(words, _)| words.iter().any(is_it))?;
    let files =
        behind.iter().filter(|argument| !argument.starts_with('-') && !argument.contains('='));
    let files: Vec<&str> = files.map(String::as_str).collect();
    let files = if files.is_empty() { "F.awl".to_string() } else { files.join(" ") };
    let meant = meant.join(", ").replace("{files}", &files);
    Some(format!("there is no command {word}: {meant}"))
}

/// An argument that a command does not take.
fn argument_meant(command: &str, argument: &str) -> Option<String> {
    if argument.starts_with('-') {
        return None;
    }
    Some(match command {
        "run" => format!("run starts what the board holds; `uno200 flash {argument}` writes it"),
        "stop" | "clear" => format!("{command} is about what the board holds, and takes no file"),
        "status" => {
            format!("status takes no file; `uno200 --program {argument} status` knows its lines")
        }
        "read-program" => format!("the file is named by -o: `uno200 read-program -o {argument}`"),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    fn of(arguments: &[&str]) -> Option<String> {
        let line = [&["uno200"], arguments].concat();
        let arguments: Vec<String> = arguments.iter().map(|one| one.to_string()).collect();
        told(&Arguments::try_parse_from(line).unwrap_err(), &arguments)
    }

    #[test]
    fn commands_of_other_tools_lead_to_those_here() {
        let upload = "there is no command upload: `uno200 flash lamp.awl` writes a program to the \
            board, `uno200 read-program` reads the program out of the PLC";
        assert_eq!(of(&["upload", "lamp.awl"]).as_deref(), Some(upload));
        let expected = "there is no command write: `uno200 flash F.awl` writes a program to the \
            board, `uno200 set MW3=5` writes values";
        assert_eq!(of(&["--tcp", "plc:502", "write", "MW3=5"]).as_deref(), Some(expected));
        assert_eq!(of(&["rubbish"]), None);
    }

    #[test]
    fn every_row_names_commands_that_there_are() {
        let command = Arguments::command();
        let is_command = |name: &str| command.get_subcommands().any(|one| one.get_name() == name);
        for (words, meant) in WORDS {
            for word in words {
                assert!(!is_command(word), "{word} is a command");
            }
            for text in meant.iter().filter(|text| !text.starts_with("`awl-sim ")) {
                let (_, named) = text.split_once("`uno200 ").unwrap();
                assert!(is_command(named.split([' ', '`']).next().unwrap()), "{text}");
            }
        }
    }

    #[test]
    fn arguments_that_are_meant_for_another_command() {
        let expected = "run starts what the board holds; `uno200 flash lamp.awl` writes it";
        assert_eq!(of(&["run", "lamp.awl"]).as_deref(), Some(expected));
        let expected = "the file is named by -o: `uno200 read-program -o p.bin`";
        assert_eq!(of(&["read-program", "p.bin"]).as_deref(), Some(expected));
        assert!(of(&["stop", "p.awl"]).unwrap().contains("takes no file"));
        assert_eq!(of(&["run", "--fast"]), None);
    }
}
