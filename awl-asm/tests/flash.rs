//! `awl-asm --flash` from outside, with a script in avrdude's place: arguments, files, exit codes.
//! No board, no avrdude.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

const GOOD: &str = "LD I0.0\n= Q0.0\n";
const BAD: &str = "LD I0.9\n= Q0.0\n";
/// One record at address 0.
const FIRMWARE: &str = ":020000000C945E\n:00000001FF\n";

/// Notes its arguments and keeps the first and the last file.
const WRITES: &str = "echo \"$@\" > called\nfor word; do case $word in flash:*)\n\
                      file=${word#flash:?:}; file=${file%:i}\n\
                      [ -n \"$first\" ] || { first=$file; cp \"$file\" first; };; esac; done\n\
                      cp \"$file\" flashed\necho 'verified' >&2\n";
const FAILS: &str =
    "echo 'avrdude OS error: cannot open port /dev/none: Permission denied' >&2\nexit 1\n";

/// A folder with the program `p.awl` and what stands in for avrdude.
struct Bench(TempDir);

impl Bench {
    fn new(program: &str, avrdude: &str) -> Bench {
        let bench = Bench(tempfile::tempdir().unwrap());
        bench.write("p.awl", program);
        fs::create_dir(bench.path("bin")).unwrap();
        fs::create_dir(bench.path("tmp")).unwrap();
        bench.write("bin/avrdude", &format!("#!/bin/sh\n{avrdude}"));
        fs::set_permissions(bench.path("bin/avrdude"), fs::Permissions::from_mode(0o755)).unwrap();
        bench
    }

    fn path(&self, name: &str) -> std::path::PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    fn read(&self, name: &str) -> Option<String> {
        fs::read_to_string(self.path(name)).ok()
    }

    /// Exit code and standard error. Temporary files go where the test can see them.
    fn run(&self, arguments: &[&str]) -> (Option<i32>, String) {
        let mut path = self.path("bin").into_os_string();
        path.push(":");
        path.push(std::env::var_os("PATH").unwrap_or_default());
        self.run_with_path(arguments, Path::new(&path))
    }

    fn run_with_path(&self, arguments: &[&str], path: &Path) -> (Option<i32>, String) {
        let output = Command::new(env!("CARGO_BIN_EXE_awl-asm"))
            .current_dir(self.0.path())
            .env("PATH", path)
            .env("TMPDIR", self.path("tmp"))
            .env_remove("UNO200_FIRMWARE")
            .args(arguments)
            .output()
            .unwrap();
        assert_eq!(
            fs::read_dir(self.path("tmp")).unwrap().count(),
            0,
            "a temporary file is left behind"
        );
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    }

    /// Whether a file is there that only the assembler could have written.
    fn has_image(&self) -> bool {
        ["p.bin", "p.hex"].iter().any(|name| self.path(name).exists())
    }
}

#[test]
fn the_program_goes_to_the_board_and_nowhere_else() {
    let bench = Bench::new(GOOD, WRITES);
    let (code, errors) = bench.run(&["p.awl", "--flash", "/dev/port"]);
    assert_eq!(
        (code, errors.starts_with("/dev/port: 2 instructions, ")),
        (Some(0), true),
        "{errors}"
    );
    let called = bench.read("called").expect("avrdude was called");
    let start = "-c arduino -p m328p -P /dev/port -b 115200 -D -U flash:v:";
    assert!(
        called.starts_with(start)
            && called.ends_with(":i\n")
            && called.matches(" -U ").count() == 2,
        "{called}"
    );
    assert_eq!(called.matches(" -U flash:w:").count(), 1, "{called}");
    assert!(!bench.has_image());
    assert_eq!(bench.run(&["p.awl", "-o", "p.hex"]).0, Some(0));
    assert_eq!(bench.read("flashed"), bench.read("p.hex"));
}

#[test]
fn an_output_is_written_as_well_if_it_is_named() {
    let bench = Bench::new(GOOD, WRITES);
    let (code, errors) = bench.run(&["p.awl", "--flash", "/dev/port", "-o", "p.hex"]);
    assert_eq!(
        (code, errors.starts_with("p.hex, /dev/port: 2 instructions, ")),
        (Some(0), true),
        "{errors}"
    );
    assert!(bench.read("p.hex").is_some());
    assert_eq!(bench.read("flashed"), bench.read("p.hex"));
}

#[test]
fn a_program_with_errors_never_touches_the_board() {
    let bench = Bench::new(BAD, WRITES);
    let (code, errors) = bench.run(&["p.awl", "--flash", "/dev/port"]);
    assert_eq!((code, errors.contains("error[E0005]")), (Some(1), true), "{errors}");
    assert_eq!((bench.read("called"), bench.has_image()), (None, false));
}

#[test]
fn the_firmware_goes_first_in_the_same_session() {
    let bench = Bench::new(GOOD, WRITES);
    bench.write("mine.hex", FIRMWARE);
    assert_eq!(
        bench.run(&["p.awl", "--flash", "/dev/port", "--with-firmware", "mine.hex"]).0,
        Some(0)
    );
    let called = bench.read("called").expect("avrdude was called");
    assert_eq!(called.matches(" -U flash:w:").count(), 2, "{called}");
    assert_eq!(bench.read("first").as_deref(), Some(FIRMWARE));

    // Without a name: the one that is part of the program.
    assert_eq!(bench.run(&["p.awl", "--flash", "/dev/port", "--with-firmware"]).0, Some(0));
    assert!(bench.read("first").unwrap() == awl_asm::hex::FIRMWARE);
}

#[test]
fn what_is_no_firmware_never_touches_the_board() {
    let bench = Bench::new(GOOD, WRITES);
    assert_eq!(bench.run(&["p.awl", "-o", "program.hex"]).0, Some(0));
    for (arguments, words) in [
        (&["p.awl", "--flash", "/dev/port", "--with-firmware", "program.hex"][..], "program slot"),
        (&["p.awl", "--flash", "/dev/port", "--with-firmware", "none.hex"], "cannot read none.hex"),
        (&["--flash", "/dev/port", "--with-firmware", "p.awl"], "name the program before"),
        (&["p.awl", "--with-firmware"], "--flash <PORT|DRIVE>"),
        (
            &["p.awl", "--board", "pico", "--flash", "/dev/drive", "--with-firmware"],
            "the Pico gets its firmware with the program",
        ),
        (&["p.awl", "--flash", "/dev/port", "--check"], "cannot be used with"),
    ] {
        let (code, errors) = bench.run(arguments);
        assert_eq!((code, errors.contains(words)), (Some(2), true), "{arguments:?}: {errors}");
        assert_eq!(bench.read("called"), None, "{arguments:?}");
    }
}

#[test]
fn a_failure_is_explained_and_exit_2() {
    let bench = Bench::new(GOOD, FAILS);
    let (code, errors) = bench.run(&["p.awl", "--flash", "/dev/none"]);
    let expected =
        "error: no permission to open /dev/none\n  = help: Linux: sudo usermod -aG dialout";
    assert_eq!((code, errors.starts_with(expected)), (Some(2), true), "{errors}");
    let last = "avrdude's last lines:\n  avrdude OS error: cannot open port /dev/none: \
        Permission denied\n";
    assert!(errors.ends_with(last), "{errors}");
}

#[test]
fn without_avrdude_its_package_is_named() {
    let bench = Bench::new(GOOD, WRITES);
    let (code, errors) =
        bench.run_with_path(&["p.awl", "--flash", "/dev/port"], &bench.path("tmp"));
    assert_eq!((code, errors.contains("apt-get install avrdude")), (Some(2), true), "{errors}");
}
