//! What is wired to the PLC, what people set in it, and scenarios, which need plants of their own.

use awl_sim::scenario::plant_of;

use super::{Done, Session, answer};
use crate::protocol::File;
use crate::protocol::plant::PlantInfo;
use crate::simulator::built;
use crate::{apart, build};

impl Session {
    /// What a page needs to know of a plant.
    pub(super) fn about_plant(&self, spec: &str) -> Done {
        let spec = self.editor.plant(spec)?;
        answer(PlantInfo::of(&spec, &*built(&spec)?))
    }

    /// Another plant: what it is wired to is switched on anew with it.
    pub(super) fn wire(&mut self, spec: Option<String>) -> Result<(), String> {
        self.bench.plant = match spec {
            Some(text) => {
                let spec = self.editor.plant(&text)?;
                built(&spec)?;
                Some((text, spec))
            }
            None => None,
        };
        self.bench.handled.clear();
        let is_on = self.simulator.is_some() || self.chip.is_some();
        if is_on { self.download() } else { Ok(()) }
    }

    /// The file of the plant may have been edited.
    pub(super) fn renew_plant(&mut self) -> Result<(), String> {
        if let Some((text, spec)) = &mut self.bench.plant {
            *spec = self.editor.plant(text)?;
        }
        Ok(())
    }

    /// Sets something in the plant, now and after the next download.
    pub(super) fn handle(&mut self, name: String, value: i64) -> Result<(), String> {
        let is_known = match (&mut self.simulator, &mut self.chip) {
            (Some(simulator), _) => simulator.handle(&name, value),
            (None, Some(chip)) => chip.handle(&name, value),
            (None, None) => {
                let plant = self.bench.new_plant()?;
                plant.is_some_and(|plant| plant.controls().iter().any(|one| one.is_named(&name)))
            }
        };
        if !is_known {
            return Err(format!("nothing can be set in the plant by the name {name}"));
        }
        self.bench.handled.insert(name, value);
        Ok(())
    }

    /// Runs a scenario of the project.
    pub(super) fn test(&self, file: &str) -> Done {
        let text = self.editor.text(file).ok_or_else(|| format!("there is no file {file}"))?;
        let program = self.editor.program_of(file).ok_or("the project has no program")?;
        let plant = self.editor.plant_of(file, text)?;
        let files = build::files_of(&self.editor, &program);
        answer(apart::test(&files, file, text, plant.as_ref())?)
    }

    /// Runs a scenario that is not in the project.
    pub(super) fn check(&self, name: &str, text: &str, plants: &[File]) -> Done {
        let mut read = |file: &str| {
            let found = plants.iter().find(|plant| plant.name == file);
            found.map(|plant| plant.text.clone()).ok_or_else(|| format!("there is no file {file}"))
        };
        let plant = plant_of(name, text, &mut read).map_err(|error| error.to_string())?;
        answer(apart::test(&build::files(&self.editor)?, name, text, plant.as_ref())?)
    }
}
