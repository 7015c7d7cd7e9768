//! The event function blocks of IEC 61499-1, annex A, that are basic ones: blocks of our own with
//! their interfaces, and what they must do. `FB_LIBRARY=FOLDER` looks at files of these names in a
//! folder instead, such as those of a public library.

use std::path::Path;

use diagnostics::{Severity, Source};
use fb::parsed::parse;
use fb::session::{Done, Session};
use fb::{matlab, xml};

/// A block, and commands with what must follow.
struct Standard {
    name: &'static str,
    /// Events in: `CU PV` is CU with PV.
    takes: &'static [&'static str],
    sends: &'static [&'static str],
    inputs: &'static str,
    outputs: &'static str,
    /// `STATE algorithm event`; `-` is none.
    states: &'static [&'static str],
    /// `FROM TO condition`
    transitions: &'static [&'static str],
    algorithms: &'static [(&'static str, &'static str)],
    script: &'static str,
}

const BISTABLE: Standard = Standard {
    name: "E_SR",
    takes: &["S", "R"],
    sends: &["EO Q"],
    inputs: "",
    outputs: "Q BOOL",
    states: &["START - -", "SET On EO", "RESET Off EO"],
    transitions: &["START SET S", "SET RESET R", "RESET SET S"],
    algorithms: &[("On", "Q := TRUE;"), ("Off", "Q := FALSE;")],
    script: "event R; expect EO = 0, Q = FALSE; event S; expect EO = 1, Q = TRUE;
        event S; expect EO = 0, Q = TRUE; event R; expect EO = 1, Q = FALSE;
        event R; expect EO = 0; event S; expect EO = 1, Q = TRUE",
};

const STANDARD: [Standard; 15] = [
    Standard {
        name: "E_SPLIT",
        takes: &["EI"],
        sends: &["EO1", "EO2"],
        inputs: "",
        outputs: "",
        states: &["START - -", "SPLIT - EO1 - EO2"],
        transitions: &["START SPLIT EI", "SPLIT START 1"],
        algorithms: &[],
        script: "event EI; expect EO1 = 1, EO2 = 1, State = START; event EI; expect EO1 = 1",
    },
    Standard {
        name: "E_MERGE",
        takes: &["EI1", "EI2"],
        sends: &["EO"],
        inputs: "",
        outputs: "",
        states: &["START - -", "SENT - EO"],
        transitions: &["START SENT EI1", "START SENT EI2", "SENT START 1"],
        algorithms: &[],
        script: "event EI1; expect EO = 1; event EI2; expect EO = 1, State = START",
    },
    Standard {
        name: "E_REND",
        takes: &["EI1", "EI2", "R"],
        sends: &["EO"],
        inputs: "",
        outputs: "",
        states: &["START - -", "FIRST - -", "SECOND - -", "BOTH - EO"],
        transitions: &[
            "START FIRST EI1",
            "START SECOND EI2",
            "FIRST BOTH EI2",
            "FIRST START R",
            "SECOND BOTH EI1",
            "SECOND START R",
            "BOTH START 1",
        ],
        algorithms: &[],
        script: "event EI1; expect EO = 0; event EI1; expect EO = 0; event EI2; expect EO = 1;
            event EI2; event R; event EI1; expect EO = 0; event EI2; expect EO = 1;
            event EI2; expect EO = 0; event EI1; expect EO = 1",
    },
    Standard {
        name: "E_SELECT",
        takes: &["EI0 G", "EI1 G"],
        sends: &["EO"],
        inputs: "G BOOL",
        outputs: "",
        states: &["START - -", "SENT - EO"],
        transitions: &["START SENT EI0[NOT G]", "START SENT EI1[G]", "SENT START 1"],
        algorithms: &[],
        script: "event EI0; expect EO = 1; event EI1; expect EO = 0;
            G = TRUE; event EI0; expect EO = 0; event EI1; expect EO = 1",
    },
    Standard {
        name: "E_SWITCH",
        takes: &["EI G"],
        sends: &["EO0", "EO1"],
        inputs: "G BOOL",
        outputs: "",
        states: &["START - -", "LOW - EO0", "HIGH - EO1"],
        transitions: &["START LOW EI[NOT G]", "START HIGH EI[G]", "LOW START 1", "HIGH START 1"],
        algorithms: &[],
        script: "event EI; expect EO0 = 1, EO1 = 0; G = TRUE; event EI; expect EO0 = 0, EO1 = 1",
    },
    Standard {
        name: "E_PERMIT",
        takes: &["EI PERMIT"],
        sends: &["EO"],
        inputs: "PERMIT BOOL",
        outputs: "",
        states: &["START - -", "SENT - EO"],
        transitions: &["START SENT EI[PERMIT]", "SENT START 1"],
        algorithms: &[],
        script: "event EI; expect EO = 0; PERMIT = TRUE; event EI; expect EO = 1;
            PERMIT = FALSE; event EI; expect EO = 0",
    },
    Standard {
        name: "E_DEMUX",
        takes: &["EI K"],
        sends: &["EO0", "EO1", "EO2", "EO3"],
        inputs: "K UINT",
        outputs: "",
        states: &["START - -", "A - EO0", "B - EO1", "C - EO2", "D - EO3"],
        transitions: &[
            "START A EI[K = 0]",
            "START B EI[K = 1]",
            "START C EI[K = 2]",
            "START D EI[K = 3]",
            "A START 1",
            "B START 1",
            "C START 1",
            "D START 1",
        ],
        algorithms: &[],
        script: "event EI; expect EO0 = 1, EO1 = 0; K = 2; event EI; expect EO2 = 1, EO0 = 0;
            K = 3; event EI; expect EO3 = 1; K = 4; event EI;
            expect EO0 = 0, EO1 = 0, EO2 = 0, EO3 = 0; K = 1; event EI; expect EO1 = 1",
    },
    Standard {
        name: "E_D_FF",
        takes: &["CLK D"],
        sends: &["EO Q"],
        inputs: "D BOOL",
        outputs: "Q BOOL",
        states: &["START - -", "SET Latch EO", "RESET Latch EO"],
        transitions: &["START SET CLK[D]", "SET RESET CLK[NOT D]", "RESET SET CLK[D]"],
        algorithms: &[("Latch", "Q := D;")],
        script: "event CLK; expect EO = 0; D = TRUE; expect Q = FALSE; event CLK;
            expect EO = 1, Q = TRUE; event CLK; expect EO = 0; D = FALSE; event CLK;
            expect EO = 1, Q = FALSE",
    },
    Standard {
        name: "E_T_FF",
        takes: &["CLK"],
        sends: &["EO Q"],
        inputs: "",
        outputs: "Q BOOL",
        states: &["START - -", "SENT Toggle EO"],
        transitions: &["START SENT CLK", "SENT START 1"],
        algorithms: &[("Toggle", "Q := NOT Q;")],
        script: "event CLK; expect EO = 1, Q = TRUE; event CLK; expect EO = 1, Q = FALSE",
    },
    BISTABLE,
    Standard { name: "E_RS", takes: &["R", "S"], ..BISTABLE },
    Standard {
        name: "E_CTU",
        takes: &["CU PV", "R"],
        sends: &["CUO Q CV", "RO Q CV"],
        inputs: "PV UINT",
        outputs: "Q BOOL, CV UINT",
        states: &["START - -", "UP Count CUO", "ZERO Reset RO"],
        transitions: &["START UP CU[CV < 65535]", "UP START 1", "START ZERO R", "ZERO START 1"],
        algorithms: &[("Count", "CV := CV + 1; Q := CV >= PV;"), ("Reset", "CV := 0; Q := FALSE;")],
        script: "PV = 2; event CU; expect CUO = 1, CV = 1, Q = FALSE; event CU;
            expect CUO = 1, CV = 2, Q = TRUE; event R; expect RO = 1, CUO = 0, CV = 0, Q = FALSE",
    },
    Standard {
        name: "E_CTD",
        takes: &["CD", "LD PV"],
        sends: &["CDO Q CV", "LDO Q CV"],
        inputs: "PV UINT",
        outputs: "Q BOOL, CV UINT",
        states: &["START - -", "DOWN Count CDO", "SET Load LDO"],
        transitions: &["START DOWN CD[CV > 0]", "DOWN START 1", "START SET LD", "SET START 1"],
        algorithms: &[("Count", "CV := CV - 1; Q := CV = 0;"), ("Load", "CV := PV; Q := CV = 0;")],
        script: "PV = 2; event CD; expect CDO = 0; event LD; expect LDO = 1, CV = 2, Q = FALSE;
            event CD; expect CDO = 1, CV = 1; event CD; expect CV = 0, Q = TRUE; event CD;
            expect CDO = 0",
    },
    Standard {
        name: "E_CTUD",
        takes: &["CU PV", "CD", "R", "LD PV"],
        sends: &["CO QU CV QD", "RO QU CV QD", "LDO QU CV QD"],
        inputs: "PV UINT",
        outputs: "QU BOOL, QD BOOL, CV UINT",
        states: &[
            "START - -",
            "UP Up - Compare CO",
            "DOWN Down - Compare CO",
            "ZERO Reset - Compare RO",
            "SET Load - Compare LDO",
        ],
        transitions: &[
            "START UP CU[CV < 65535]",
            "START DOWN CD[CV > 0]",
            "START ZERO R",
            "START SET LD",
            "UP START 1",
            "DOWN START 1",
            "ZERO START 1",
            "SET START 1",
        ],
        algorithms: &[
            ("Up", "CV := CV + 1;"),
            ("Down", "CV := CV - 1;"),
            ("Reset", "CV := 0;"),
            ("Load", "CV := PV;"),
            ("Compare", "QU := CV >= PV; QD := CV = 0;"),
        ],
        script: "PV = 2; event CD; expect CO = 0; event CU; expect CO = 1, CV = 1, QU = FALSE;
            event CU; expect CV = 2, QU = TRUE, QD = FALSE; event CD; expect CO = 1, CV = 1;
            event R; expect RO = 1, CV = 0, QD = TRUE; event LD;
            expect LDO = 1, CV = 2, QU = TRUE, QD = FALSE",
    },
    Standard {
        name: "E_TABLE_CTRL",
        takes: &["INIT DT N", "CLK"],
        sends: &["CLKO DTO CV"],
        inputs: "DT TIME 4, N UINT",
        outputs: "DTO TIME, CV UINT",
        states: &["START - -", "INIT Begin -", "FIRST - CLKO", "NEXT Step CLKO"],
        transitions: &[
            "START INIT INIT",
            "INIT START [N = 0]",
            "INIT FIRST [N > 0]",
            "FIRST START 1",
            "START NEXT CLK[CV < MIN(3, N - 1)]",
            "NEXT START 1",
        ],
        algorithms: &[
            ("Begin", "CV := 0; DTO := DT[0];"),
            ("Step", "CV := CV + 1; DTO := DT[CV];"),
        ],
        script: "DT = [T#1s, T#2s, T#3s, T#4s]; event INIT; expect CLKO = 0; N = 3; event INIT;
            expect CLKO = 1, CV = 0, DTO = T#1s; event CLK; expect CLKO = 1, CV = 1, DTO = T#2s;
            event CLK; expect CLKO = 1, CV = 2, DTO = T#3s; event CLK; expect CLKO = 0, CV = 2;
            DT[1] = T#9s, N = 7; event INIT; event CLK; expect DTO = T#9s; event CLK; event CLK;
            expect CLKO = 1, CV = 3, DTO = T#4s; event CLK; expect CLKO = 0, CV = 3",
    },
];

fn events(list: &[&str]) -> String {
    let event = |text: &&str| {
        let mut words = text.split(' ');
        let name = words.next().unwrap_or("");
        let with: String = words.map(|one| format!("<With Var='{one}'/>")).collect();
        format!("<Event Name='{name}'>{with}</Event>")
    };
    list.iter().map(event).collect()
}

fn variables(list: &str) -> String {
    let variable = |text: &str| {
        let (name, of) = text.split_once(' ')?;
        let (of, size) = of.split_once(' ').unwrap_or((of, ""));
        Some(format!("<VarDeclaration Name='{name}' Type='{of}' ArraySize='{size}'/>"))
    };
    list.split(", ").filter_map(variable).collect()
}

impl Standard {
    /// Our own block of this description.
    fn text(&self) -> String {
        let states = self.states.iter().map(|text| {
            let words: Vec<&str> = text.split(' ').collect();
            let said = |name, word: &str| match word {
                "-" => String::new(),
                word => format!(" {name}='{word}'"),
            };
            let actions = words[1..].chunks(2).filter(|one| *one != ["-", "-"]).map(|one| {
                format!("<ECAction{}{}/>", said("Algorithm", one[0]), said("Output", one[1]))
            });
            format!("<ECState Name='{}'>{}</ECState>", words[0], actions.collect::<String>())
        });
        let transitions = self.transitions.iter().map(|text| {
            let mut words = text.splitn(3, ' ');
            let mut next = || words.next().unwrap_or("").replace('<', "&lt;");
            let (from, to) = (next(), next());
            format!("<ECTransition Source='{from}' Destination='{to}' Condition='{}'/>", next())
        });
        let algorithms = self.algorithms.iter().map(|(name, text)| {
            format!("<Algorithm Name='{name}'><ST Text='{text}'/></Algorithm>")
        });
        format!(
            "<FBType Name='{}'><InterfaceList><EventInputs>{}</EventInputs>
            <EventOutputs>{}</EventOutputs><InputVars>{}</InputVars>
            <OutputVars>{}</OutputVars></InterfaceList>
            <BasicFB><ECC>{}{}</ECC>{}</BasicFB></FBType>",
            self.name,
            events(self.takes),
            events(self.sends),
            variables(self.inputs),
            variables(self.outputs),
            states.collect::<String>(),
            transitions.collect::<String>(),
            algorithms.collect::<String>(),
        )
    }
}

/// The text of a block: of a library, where one is asked for.
fn text(standard: &Standard) -> String {
    match std::env::var("FB_LIBRARY") {
        Ok(folder) => {
            let path = Path::new(&folder).join(standard.name).with_extension("fbt");
            std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path:?}: {error}"))
        }
        Err(_) => standard.text(),
    }
}

#[test]
fn the_blocks_do_what_their_description_says() {
    for standard in &STANDARD {
        let name = standard.name;
        let source = Source::new(format!("{name}.fbt"), text(standard)).expect("a short text");
        let read = xml::read(&source);
        let is_error = |one: &&fb::Diagnostic| one.severity() == Severity::Error;
        assert!(!read.diagnostics.iter().any(|one| is_error(&one)), "{name}");
        let block = read.block.expect(name);
        let again = Source::new("again.fbt", xml::write(&block)).expect("a short text");
        assert_eq!(xml::read(&again).block.as_ref(), Some(&block), "{name}");
        let written = matlab::write(&block, &source);
        let written = written.text.unwrap_or_else(|| panic!("{name}: {:?}", written.diagnostics));
        let from_matlab = Source::new("again.m", written).expect("a short text");
        let read = matlab::read(&from_matlab);
        assert!(read.block.is_some(), "{name}: {:?}", read.diagnostics);
        let parsed = parse(&block, &source);
        let mut session = Session::new(&block, &parsed).expect(name);
        for line in standard.script.split(';').map(str::trim) {
            match session.obey(line) {
                Ok(Done::Said(_)) => {}
                // A file of another is in other states.
                Err(_) if line.contains("State =") && std::env::var("FB_LIBRARY").is_ok() => {}
                other => panic!("{name}, {line}: {other:?}"),
            }
        }
    }
}
