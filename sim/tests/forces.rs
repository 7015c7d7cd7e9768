//! Forces, single scans and the status of instructions on the host machine, scan by scan.

use awl_asm::assemble::assemble;
use awl_asm::source::Source;
use awl_sim::machine::host::Host;
use awl_sim::machine::{Machine, Mode};
use awl_sim::operand::Operand;

/// Reads what it has written before anybody else can: Q0.1 and VW2 show it.
const PROGRAM: &str = "
LD SM0.0
= Q0.0
LD Q0.0
= Q0.1
LD I0.0
= Q0.2
LD SM0.0
MOVW 5, VW0
MOVW VW0, VW2
INCW VW4
LD SM0.1
INCW VW6
";

/// References: area and size, offset.
const Q0_0: [u8; 3] = [0x10, 0, 0];
const I0_0: [u8; 3] = [0x00, 0, 0];
const VW0: [u8; 3] = [0x89, 0, 0];

/// A host with its time.
struct Plc {
    host: Host,
    now_ms: u64,
}

impl Plc {
    fn new(text: &str) -> Plc {
        let assembly = assemble(&Source::new("p.awl", text).unwrap(), Vec::new());
        let image = assembly.image.unwrap_or_else(|| panic!("{:?}", assembly.diagnostics));
        let mut plc =
            Plc { host: Host::new(image, Box::new(|at| format!("byte {at}"))), now_ms: 0 };
        plc.scan();
        plc
    }

    fn scan(&mut self) {
        self.host.scan(self.now_ms);
        self.now_ms += 1;
    }

    fn get(&mut self, operand: &str) -> i32 {
        self.host.read(Operand::parse(operand, &[]).unwrap()).unwrap()
    }

    fn set(&mut self, operand: &str, value: i32) {
        self.host.write(Operand::parse(operand, &[]).unwrap(), value).unwrap();
    }

    fn ask(&mut self, request: &[u8]) -> Vec<u8> {
        assert!(self.host.take_request(request));
        loop {
            if let Some(answer) = self.host.answer() {
                self.host.carry_out();
                return answer;
            }
            self.scan();
        }
    }

    /// Forces an operand and gives how many there are.
    fn force(&mut self, reference: [u8; 3], value: u32) -> u8 {
        let answer = self.ask(&[&[68, 1][..], &reference, &value.to_be_bytes()].concat());
        assert_eq!(answer[0], 68);
        answer[1]
    }

    fn forced(&mut self) -> u8 {
        self.ask(&[68, 0])[1]
    }
}

#[test]
fn a_forced_operand_survives_a_program_that_writes_it() {
    let mut plc = Plc::new(PROGRAM);
    assert_eq!((plc.get("Q0.0"), plc.get("VW0"), plc.get("SM4.7")), (1, 5, 0));
    assert_eq!(plc.force(Q0_0, 0), 1);
    assert_eq!(plc.force(VW0, 1234), 2);
    assert_eq!(plc.force(I0_0, 1), 3);
    for scan in 0..10_000 {
        plc.scan();
        assert_eq!((plc.get("Q0.0"), plc.get("VW0")), (0, 1234), "scan {scan}");
        // Within the scan the program reads what it has written.
        assert_eq!((plc.get("Q0.1"), plc.get("VW2")), (1, 5), "scan {scan}");
        // An input is not written by the program: it sees the forced value all the time.
        assert_eq!((plc.get("Q0.2"), plc.get("SM4.7")), (1, 1), "scan {scan}");
    }
    assert_eq!(plc.ask(&[68, 3])[1], 0);
    plc.scan();
    assert_eq!((plc.get("Q0.0"), plc.get("VW0"), plc.get("Q0.2"), plc.get("SM4.7")), (1, 5, 0, 0));
}

#[test]
fn forces_end_with_run_and_those_of_stop_with_the_next() {
    let mut plc = Plc::new(PROGRAM);
    plc.force(Q0_0, 0);
    plc.scan();
    plc.ask(&[66, 0, 0, 0]);
    plc.scan();
    assert_eq!(
        (plc.host.mode(), plc.get("Q0.0"), plc.forced(), plc.get("SM4.7")),
        (Mode::Stop, 0, 0, 0)
    );
    plc.ask(&[66, 1, 0, 0]);
    plc.scan();
    assert_eq!((plc.host.mode(), plc.get("Q0.0")), (Mode::Run, 1));

    plc.ask(&[66, 0, 0, 0]);
    plc.force(Q0_0, 0);
    plc.ask(&[66, 1, 0, 0]);
    for _ in 0..10 {
        plc.scan();
        assert_eq!((plc.get("Q0.0"), plc.get("Q0.1"), plc.forced()), (0, 1, 1));
    }
    plc.ask(&[66, 0, 0, 0]);
    assert_eq!(plc.forced(), 0);
}

#[test]
fn forces_end_with_a_fault() {
    let mut plc = Plc::new("LBL 1\nLD M0.0\nJMP 1\nLD SM0.0\n= Q0.0\n");
    plc.force(Q0_0, 1);
    assert_eq!(plc.forced(), 1);
    plc.set("M0.0", 1);
    plc.scan();
    assert_eq!((plc.host.mode(), plc.forced(), plc.get("Q0.0")), (Mode::Stop, 0, 0));
}

#[test]
fn single_scans_go_on_where_the_program_stood() {
    let mut plc = Plc::new(PROGRAM);
    assert_eq!((plc.get("VW4"), plc.get("VW6")), (1, 1));
    // Only from STOP.
    assert_eq!(plc.ask(&[66, 3, 0, 1]), [66 | 0x80, 4]);
    plc.ask(&[66, 0, 0, 0]);
    for done in 1..=5 {
        assert_eq!(plc.ask(&[66, 3, 0, 1]), [66, 3, 0, 1]);
        for _ in 0..3 {
            plc.scan();
        }
        assert_eq!((plc.host.mode(), plc.get("VW4"), plc.get("Q0.0")), (Mode::Stop, 1 + done, 0));
    }
    plc.ask(&[66, 3, 0, 200]);
    for _ in 0..300 {
        plc.scan();
    }
    // RUN had one first scan; single scans none.
    assert_eq!((plc.get("VW4"), plc.get("VW6")), (206, 1));
    plc.ask(&[66, 1, 0, 0]);
    plc.scan();
    assert_eq!((plc.get("VW4"), plc.get("VW6")), (207, 2));
}

#[test]
fn the_status_is_that_of_one_scan() {
    let mut plc = Plc::new("LD I0.0\nEU\n= M0.0\nLD I0.1\nJMP 1\nINCW VW0\nLBL 1\n");
    // Where the instructions are is seen in the image; the first is where the code begins.
    let code = plc_link::Station::plc(&plc.host).program().unwrap().code_at();
    let [high, low] = code.to_be_bytes();
    plc.set("I0.0", 1);
    let request = [69, 1, high, low, I0_0[0], I0_0[1], I0_0[2]];
    let answer = plc.ask(&request);
    assert_eq!(answer[0], 69);
    assert_eq!(answer[3..], [0x80, 1, 0, 0, 0, 1]);
    plc.ask(&[66, 0, 0, 0]);
    assert_eq!(plc.ask(&request)[3..], [0; 6]);
}
