//! Calls: functions as subroutines, function blocks written out, subroutines in AWL.

use super::hardware::Device;
use super::logic::Logic;
use super::memory::instances;
use super::timers::Owner;
use super::writer::Storage;
use super::{Frame, Generator, Names};
use crate::model::{
    BlockCall, Expression, ExpressionKind, Place, Root, RoutineArgument, Step, Type, Unit, UnitKind,
};

impl Generator<'_> {
    /// A call of a function; its result goes to an operand.
    pub(super) fn call_into(&mut self, number: usize, arguments: &[Expression], to: &str) {
        let mut operands: Vec<String> =
            arguments.iter().map(|argument| self.argument(argument)).collect();
        operands.push(to.to_owned());
        let name = self.program.units.get(number).map_or("", |unit| unit.name.as_str());
        self.writer.boxed("CALL", &format!("{name}, {}", operands.join(", ")));
    }

    fn argument(&mut self, argument: &Expression) -> String {
        if argument.of_type == Type::Bool { self.bit(argument) } else { self.operand(argument) }
    }

    pub(super) fn routine_call(&mut self, name: &str, arguments: &[RoutineArgument]) {
        let mut operands = vec![name.to_owned()];
        let mut after = Vec::new();
        for argument in arguments {
            match argument {
                RoutineArgument::Value(value) => operands.push(self.argument(value)),
                RoutineArgument::Place(place) => {
                    let found = self.locate(place);
                    if !found.is_computed() && found.storage != Storage::ByteBit {
                        operands.push(found.text);
                        continue;
                    }
                    // An element goes through a temporary.
                    let storage = match found.storage {
                        Storage::ByteBit => Storage::Bit,
                        storage => storage,
                    };
                    let kept = self.writer.temporary(storage);
                    let value = read(place);
                    self.into(&value, &kept);
                    operands.push(kept.clone());
                    after.push((place.clone(), kept));
                }
            }
        }
        self.writer.boxed("CALL", &operands.join(", "));
        for (place, kept) in after {
            let root = Root::Address(kept);
            let value = Place { root, steps: Vec::new(), of_type: place.of_type.clone() };
            self.store(&place, &read(&value));
        }
    }

    /// A call of an instance: the block is written out here, or its subroutine called.
    pub(super) fn block_call(&mut self, call: &BlockCall) {
        let program = self.program;
        let Some(unit) = program.units.get(call.block) else { return };
        let frame = self.instance(&call.instance, call.block);
        if let Names::Static(name) = &frame.names
            && let Some(device) = self.devices.get(name).cloned()
        {
            let name = name.clone();
            self.device_call(&name, &device, call);
            return;
        }
        let is_done = match &frame.names {
            Names::Static(name) => self.edge_call(name, call),
            Names::Local => false,
        };
        if !is_done {
            self.block_body(&frame, unit, call);
        }
        for (at, place) in call.in_outs.iter().chain(&call.outputs) {
            let of_type = &place.of_type;
            match of_type.is_elementary() {
                true => self.take(&frame, *at, place),
                false => self.copy_whole(&parameter(call, *at, of_type), place, of_type),
            }
        }
    }

    /// Gives the parameters, then the block is written out, or its subroutine called.
    fn block_body(&mut self, frame: &Frame, unit: &Unit, call: &BlockCall) {
        for (at, value) in &call.inputs {
            match &value.kind {
                ExpressionKind::Read(from) if !value.of_type.is_elementary() => {
                    self.copy_whole(from, &parameter(call, *at, &value.of_type), &value.of_type);
                }
                _ => self.pass(frame, *at, value),
            }
        }
        for (at, place) in &call.in_outs {
            let of_type = &place.of_type;
            match of_type.is_elementary() {
                true => self.pass(frame, *at, &read(place)),
                false => self.copy_whole(place, &parameter(call, *at, of_type), of_type),
            }
        }
        if self.as_routines.contains(&call.block) {
            self.call_as_routine(frame, unit);
        } else {
            let around = std::mem::replace(&mut self.frame, frame.clone());
            let place = self.writer.place();
            self.reset_temporaries(unit);
            self.body(&unit.body);
            self.end_of_unit();
            self.frame = around;
            self.writer.go_on_at(&place);
        }
    }

    /// A call of an instance that is a timer or counter of the controller.
    fn device_call(&mut self, name: &str, device: &Device, call: &BlockCall) {
        // A preset is a constant; what else there is are conditions, the counter's reset last.
        let conditions: Vec<Logic> = call
            .inputs
            .iter()
            .filter(|(_, value)| value.of_type == Type::Bool)
            .map(|(_, value)| self.lower(value))
            .collect();
        for logic in &conditions {
            self.writer.forget();
            self.load(logic);
        }
        self.writer.boxed_here(device.mnemonic, &format!("{name}, {}", device.preset));
        self.writer.forget();
        for (_, place) in &call.outputs {
            let root = Root::Address(name.to_owned());
            let value = Place { root, steps: Vec::new(), of_type: place.of_type.clone() };
            self.store(place, &read(&value));
        }
    }

    /// The frame of an instance.
    fn instance(&self, place: &Place, block: usize) -> Frame {
        let found = self.locate(place);
        let owner = match place.root {
            Root::Local(at) => (Owner::Unit(self.frame.unit), at),
            Root::Global(at) => (Owner::Global, at),
            Root::Address(_) => (Owner::Global, usize::MAX),
        };
        let is_own = place.steps.iter().all(|step| matches!(step, Step::Element(_)));
        let short = self.short.get(&owner).filter(|_| is_own);
        Frame {
            unit: block,
            names: Names::Static(found.text),
            is_short: short.is_some(),
            preset: short.copied().flatten(),
            file: self.program.units.get(block).and_then(|unit| unit.file),
            end: None,
            loops: Vec::new(),
        }
    }

    /// A variable of an instance as a place of the unit that calls it, by its name.
    pub(super) fn operand_of(&self, frame: &Frame, at: usize) -> Option<(String, Type, Storage)> {
        let variable = self.program.units.get(frame.unit)?.variables.get(at)?;
        let Names::Static(prefix) = &frame.names else { return None };
        let text = format!("{prefix}.{}", variable.name);
        let storage = super::memory::storage(&variable.of_type, frame.is_short);
        Some((text, variable.of_type.clone(), storage))
    }

    /// Gives a parameter its value.
    fn pass(&mut self, frame: &Frame, at: usize, value: &Expression) {
        let Some((text, kind, storage)) = self.operand_of(frame, at) else { return };
        if kind == Type::Time && frame.is_short {
            // A constant: that is why the timer counts in a word.
            if frame.preset.is_none() {
                let from = self.operand(value);
                self.copy(Storage::Word, &from, &text);
            }
            return;
        }
        let is_known = matches!(value.kind, ExpressionKind::Constant(_));
        if storage == Storage::Bit && is_known {
            let target = Place { root: Root::Address(text), steps: Vec::new(), of_type: kind };
            self.assign(&target, value);
            return;
        }
        self.into(value, &text);
    }

    /// Gives a variable of the caller what a parameter holds.
    fn take(&mut self, frame: &Frame, at: usize, place: &Place) {
        let Some((text, kind, _)) = self.operand_of(frame, at) else { return };
        if frame.is_short && kind == Type::Time {
            let found = self.locate(place);
            if !found.is_computed() && found.storage == Storage::Double {
                self.writer.boxed("ITD", &format!("{text}, {}", found.text));
                return;
            }
            let kept = self.writer.temporary(Storage::Double);
            self.writer.boxed("ITD", &format!("{text}, {kept}"));
            let root = Root::Address(kept);
            self.store(place, &read(&Place { root, steps: Vec::new(), of_type: kind }));
            return;
        }
        let root = Root::Address(text);
        self.store(place, &read(&Place { root, steps: Vec::new(), of_type: kind }));
    }

    /// What all instances do at the start of the scan.
    pub(super) fn start_of_scan(&mut self) {
        let program = self.program;
        self.writer.section("Timers that run go on");
        for (at, variable) in program.globals.iter().enumerate() {
            let name = crate::names::safe_name(&variable.name);
            self.ticks_of(&variable.of_type, &name, (Owner::Global, at));
        }
        for (number, unit) in program.units.iter().enumerate() {
            if unit.kind != UnitKind::Program {
                continue;
            }
            for (at, variable) in unit.variables.iter().enumerate() {
                let name = format!("{}.{}", unit.name, variable.name);
                self.ticks_of(&variable.of_type, &name, (Owner::Unit(number), at));
            }
        }
    }

    /// What the instances that a variable is do at the start of the scan.
    fn ticks_of(&mut self, of_type: &Type, name: &str, owner: (Owner, usize)) {
        for (block, name) in instances(of_type, name) {
            self.ticks(block, &name, owner);
        }
    }

    /// What an instance and those in it do at the start of the scan.
    fn ticks(&mut self, block: usize, name: &str, owner: (Owner, usize)) {
        if self.devices.contains_key(name) {
            return;
        }
        let program = self.program;
        let Some(unit) = program.units.get(block) else { return };
        let short = self.short.get(&owner).copied();
        self.frame = Frame {
            unit: block,
            names: Names::Static(name.to_owned()),
            is_short: short.is_some(),
            preset: short.flatten(),
            file: None,
            end: None,
            loops: Vec::new(),
        };
        self.is_tick = short.is_some();
        self.body(&unit.every_scan);
        self.is_tick = false;
        for (at, variable) in unit.variables.iter().enumerate() {
            let name = format!("{name}.{}", variable.name);
            self.ticks_of(&variable.of_type, &name, (Owner::Unit(block), at));
        }
    }
}

/// A parameter of an instance as a place of the unit that calls it.
fn parameter(call: &BlockCall, at: usize, of_type: &Type) -> Place {
    let mut place = call.instance.clone();
    place.steps.push(Step::Member(at));
    place.of_type = of_type.clone();
    place
}

/// What is in a place.
fn read(place: &Place) -> Expression {
    let kind = ExpressionKind::Read(place.clone());
    let of_type = place.of_type.base().clone();
    Expression { kind, of_type, span: diagnostics::Span::default() }
}
