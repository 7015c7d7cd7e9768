//! A folder of this computer as the project of a page: which of its files belong to it, their
//! texts, and how they are written so that nothing is lost that somebody else has changed. Who may
//! ask for that, and how, is not known here.

use std::collections::VecDeque;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use anyhow::{Context, Result, bail};
use awl_asm::files::write_whole;
use awl_asm::source::{Encoding, Source};

/// What a file of a project may end with. The page has the same list.
pub const ENDINGS: [&str; 12] =
    ["awl", "st", "sfc", "fbd", "fbt", "xml", "scn", "csv", "txt", "md", "json", "plant"];
/// More files than any project has, and more bytes in all of them. The page takes no more.
const FILES_MAX: usize = 200;
const BYTES_MAX: usize = 4_000_000;
/// Parts of a file's name: folders in folders, and the file.
const PARTS_MAX: usize = 5;
/// Bytes of such a part.
const PART_LEN_MAX: usize = 80;
/// Whoever has opened a folder with more entries has meant another one.
const ENTRIES_MAX: usize = 20_000;

/// The folder.
#[derive(Debug)]
pub struct Folder {
    /// Without links.
    root: PathBuf,
    /// Looking and writing are one step for everybody.
    writing: Mutex<()>,
}

/// What is in a folder.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// The files of the project, those that are less deep first, by name.
    pub files: Vec<Listed>,
    /// Files that would belong to it, and why they do not.
    pub left_out: Vec<LeftOut>,
}

/// A file of the project.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Listed {
    /// From the folder on, with `/` between parts.
    pub name: String,
    /// Another one whenever its bytes are others.
    pub version: String,
}

/// A file that is left out.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct LeftOut {
    /// As [`Listed::name`].
    pub name: String,
    /// Why.
    pub why: String,
}

/// What came of writing or removing a file.
#[derive(Debug, PartialEq, Eq)]
pub enum Written {
    /// It is done.
    Done {
        /// What it is now; empty of a file that is gone.
        version: String,
        /// What else happened to it.
        note: Option<String>,
    },
    /// It is not: meanwhile the file is another one, of this version, or is not there.
    Changed(Option<String>),
}

impl Folder {
    /// The folder at a path.
    pub fn new(path: &Path) -> Result<Folder> {
        let root = fs::canonicalize(path).with_context(|| format!("{}", path.display()))?;
        if !root.is_dir() {
            bail!("{}: a project is a folder; this is a file", path.display());
        }
        Ok(Folder { root, writing: Mutex::default() })
    }

    /// Its own name.
    pub fn name(&self) -> String {
        self.root.file_name().unwrap_or(self.root.as_os_str()).to_string_lossy().into_owned()
    }

    /// What tells it from other folders.
    pub fn id(&self) -> String {
        version_of(self.root.as_os_str().as_encoded_bytes())
    }

    /// What is in it now.
    pub fn listing(&self) -> Result<Listing, String> {
        let mut listing = Listing::default();
        let mut folders = VecDeque::from([String::new()]);
        let (mut entries, mut bytes) = (0, 0);
        while let Some(folder) = folders.pop_front() {
            for (name, kind) in self.entries(&folder)? {
                entries += 1;
                if entries > ENTRIES_MAX {
                    return Err(format!(
                        "{} holds more than {ENTRIES_MAX} files and folders: start `uno200 ide` \
                         with the folder of the project alone",
                        self.root.display()
                    ));
                }
                if kind.is_dir() {
                    folders.push_back(name);
                } else if has_known_ending(&name) {
                    match self.fitting(&name, kind, listing.files.len(), &mut bytes) {
                        Ok(version) => listing.files.push(Listed { name, version }),
                        Err(why) => listing.left_out.push(LeftOut { name, why }),
                    }
                }
            }
        }
        Ok(listing)
    }

    /// Names and kinds of what is in a folder, by name; what begins with a dot is not seen, nor
    /// what is too deep.
    fn entries(&self, folder: &str) -> Result<Vec<(String, fs::FileType)>, String> {
        let path = self.root.join(folder);
        let failed = |error| format!("cannot read the folder {}: {error}", path.display());
        let mut entries = Vec::new();
        for entry in fs::read_dir(&path).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let name = entry.file_name().to_string_lossy().into_owned();
            let name = if folder.is_empty() { name } else { format!("{folder}/{name}") };
            let is_seen = !entry.file_name().to_string_lossy().starts_with('.');
            if is_seen && name.split('/').count() <= PARTS_MAX {
                entries.push((name, entry.file_type().map_err(failed)?));
            }
        }
        entries.sort_by(|(one, _), (other, _)| one.cmp(other));
        Ok(entries)
    }

    /// The version of a file that belongs to the project, or why it does not.
    fn fitting(
        &self,
        name: &str,
        kind: fs::FileType,
        files: usize,
        bytes: &mut usize,
    ) -> Result<String, String> {
        if kind.is_symlink() {
            return Err(LINK.to_owned());
        }
        if !kind.is_file() {
            return Err("it is no file".to_owned());
        }
        if files == FILES_MAX {
            return Err(format!("a project has at most {FILES_MAX} files"));
        }
        let path = self.place(name)?;
        let len = fs::metadata(&path).map_or(0, |metadata| metadata.len());
        if len > (BYTES_MAX - *bytes) as u64 {
            return Err(format!("a project has at most {} MB", BYTES_MAX / 1_000_000));
        }
        let contents = fs::read(&path).map_err(|error| error.to_string())?;
        if let Err(error) = Source::from_bytes("it", &contents) {
            return Err(error.to_string());
        }
        *bytes += contents.len();
        Ok(version_of(&contents))
    }

    /// The text of a file, with line feeds alone between its lines, and its version.
    pub fn read(&self, name: &str) -> Result<(String, String), String> {
        let contents = self.contents(name)?;
        let contents = contents.ok_or_else(|| format!("{name} is not there any more"))?;
        let source = Source::from_bytes(name, &contents).map_err(|error| error.to_string())?;
        Ok((source.text.replace("\r\n", "\n"), version_of(&contents)))
    }

    /// Writes a file whole, or not at all, if it is still what `base` says; no file for `None`. It
    /// keeps its encoding and its line ends.
    pub fn save(&self, name: &str, text: &str, base: Option<&str>) -> Result<Written, String> {
        if text.len() > BYTES_MAX {
            return Err(format!("{name}: a project has at most {} MB", BYTES_MAX / 1_000_000));
        }
        let _alone = self.alone();
        let path = self.place(name)?;
        let there = self.contents(name)?;
        if let Some(changed) = changed(there.as_deref(), base) {
            return Ok(changed);
        }
        let (contents, note) = encoded(name, text, there.as_deref());
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)
                .map_err(|error| format!("cannot make the folder of {name}: {error}"))?;
        }
        write_whole(&path, &contents).map_err(|error| format!("{error:#}"))?;
        Ok(Written::Done { version: version_of(&contents), note })
    }

    /// Removes a file, if it is still what `base` says.
    pub fn remove(&self, name: &str, base: &str) -> Result<Written, String> {
        let _alone = self.alone();
        let there = self.contents(name)?;
        if there.is_some() {
            if let Some(changed) = changed(there.as_deref(), Some(base)) {
                return Ok(changed);
            }
            fs::remove_file(self.place(name)?)
                .map_err(|error| format!("cannot remove {name}: {error}"))?;
        }
        Ok(Written::Done { version: String::new(), note: None })
    }

    fn alone(&self) -> std::sync::MutexGuard<'_, ()> {
        self.writing.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The bytes of a file; `None` where there is none.
    fn contents(&self, name: &str) -> Result<Option<Vec<u8>>, String> {
        let path = self.place(name)?;
        match fs::metadata(&path) {
            Ok(metadata) if !metadata.is_file() => Err(format!("{name}: it is no file")),
            Ok(metadata) if metadata.len() > BYTES_MAX as u64 => {
                Err(format!("{name}: a project has at most {} MB", BYTES_MAX / 1_000_000))
            }
            Ok(_) => {
                fs::read(&path).map(Some).map_err(|error| format!("cannot read {name}: {error}"))
            }
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(format!("cannot read {name}: {error}")),
        }
    }

    /// Where a file is, or would be: below the folder, and nowhere else. Who can put a link there
    /// right after this can write there anyway.
    fn place(&self, name: &str) -> Result<PathBuf, String> {
        let parts: Vec<&str> = name.split('/').collect();
        if !has_known_ending(name) || parts.len() > PARTS_MAX || !parts.iter().all(is_part) {
            return Err(format!(
                "“{name}” cannot be the name of a file here: letters and digits, at most {} \
                 folders, and one of the endings .{}",
                PARTS_MAX - 1,
                ENDINGS.join(" .")
            ));
        }
        let mut path = self.root.clone();
        for part in parts {
            path.push(part);
            if fs::symlink_metadata(&path).is_ok_and(|metadata| metadata.is_symlink()) {
                return Err(format!("{name}: {LINK}"));
            }
        }
        Ok(path)
    }
}

const LINK: &str = "it is a link, and links are not followed";

/// Whether a part of a name leads nowhere else, on any system.
fn is_part(part: &&str) -> bool {
    let is_other = |letter: char| letter.is_control() || "\\:*?\"<>|".contains(letter);
    (1..=PART_LEN_MAX).contains(&part.len()) && !part.starts_with('.') && !part.contains(is_other)
}

fn has_known_ending(name: &str) -> bool {
    let ending = Path::new(name).extension().unwrap_or_default();
    ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(known))
}

/// Tells contents apart; protects nothing.
fn version_of(contents: &[u8]) -> String {
    let mut hasher = DefaultHasher::new();
    contents.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

/// What is told where the file that is there is not the one that was read.
fn changed(there: Option<&[u8]>, base: Option<&str>) -> Option<Written> {
    let version = there.map(version_of);
    (version.as_deref() != base).then_some(Written::Changed(version))
}

/// The bytes of a text, as the file that is there is encoded.
fn encoded(name: &str, text: &str, there: Option<&[u8]>) -> (Vec<u8>, Option<String>) {
    let there = there.and_then(|contents| Source::from_bytes(name, contents).ok());
    let Some(there) = there else { return (text.as_bytes().to_vec(), None) };
    let text = match there.text.contains("\r\n") {
        true => text.replace("\r\n", "\n").replace('\n', "\r\n"),
        false => text.to_owned(),
    };
    match there.encoding.encode(&text) {
        Some(contents) => (contents, None),
        None => {
            let lacks = |letter: &char| there.encoding.encode(&letter.to_string()).is_none();
            let letter = text.chars().find(lacks).unwrap_or_default();
            let note = format!("{name} is UTF-8 now: its old encoding has no “{letter}”");
            (Encoding::Utf8.encode(&text).unwrap_or_default(), Some(note))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Case {
        _outer: tempfile::TempDir,
        path: PathBuf,
        folder: Folder,
    }

    /// A folder with these files, in one that has others.
    fn case(files: &[(&str, &[u8])]) -> Case {
        let outer = tempfile::tempdir().unwrap();
        let path = outer.path().join("lamp");
        fs::create_dir(&path).unwrap();
        fs::write(outer.path().join("secret.txt"), "secret").unwrap();
        for (name, contents) in files {
            let file = path.join(name);
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            fs::write(file, contents).unwrap();
        }
        let folder = Folder::new(&path).unwrap();
        Case { _outer: outer, path, folder }
    }

    fn names(folder: &Folder) -> Vec<String> {
        folder.listing().unwrap().files.into_iter().map(|file| file.name).collect()
    }

    fn done(written: Result<Written, String>) -> String {
        match written.unwrap() {
            Written::Done { version, note: None } => version,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn its_own_texts_belong_to_a_project_and_nothing_else() {
        let case = case(&[
            ("lamp.awl", b"LD I0.0\n"),
            ("tests/lamp.scn", b"run 1s\n"),
            ("a/b/c/d/e.awl", b"deep"),
            ("a/b/c/d/e/f.awl", b"too deep"),
            (".git/config.txt", b"x"),
            (".hidden.awl", b"x"),
            ("run.sh", b"x"),
            ("picture.json", b"\x7fELF\0\0\0"),
        ]);
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("../secret.txt", case.path.join("link.txt")).unwrap();
            std::os::unix::fs::symlink("..", case.path.join("outer")).unwrap();
        }
        assert_eq!(names(&case.folder), ["lamp.awl", "tests/lamp.scn", "a/b/c/d/e.awl"]);
        let left_out = case.folder.listing().unwrap().left_out;
        let why =
            |name: &str| left_out.iter().find(|file| file.name == name).map(|file| &*file.why);
        assert!(why("picture.json").is_some(), "{left_out:?}");
        #[cfg(unix)]
        assert_eq!(why("link.txt"), Some(LINK));
    }

    #[test]
    fn no_name_leads_out_of_it() {
        let case = case(&[("lamp.awl", b"LD I0.0\n")]);
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("../secret.txt", case.path.join("link.txt")).unwrap();
            std::os::unix::fs::symlink("..", case.path.join("outer")).unwrap();
        }
        for name in [
            "../secret.txt",
            "/etc/passwd.txt",
            "a/../../secret.txt",
            "./lamp.awl",
            "lamp.sh",
            "lamp",
            ".lamp.awl",
            "C:\\lamp.awl",
            "a\0b.awl",
            "",
            #[cfg(unix)]
            "link.txt",
            #[cfg(unix)]
            "outer/secret.txt",
        ] {
            assert!(case.folder.read(name).is_err(), "{name}");
            assert!(case.folder.save(name, "x", None).is_err(), "{name}");
            assert!(case.folder.remove(name, "").is_err(), "{name}");
        }
        assert_eq!(fs::read(case.path.join("../secret.txt")).unwrap(), b"secret");
        assert!(case.folder.read("gone.awl").unwrap_err().contains("not there any more"));
    }

    #[test]
    fn what_somebody_else_has_changed_is_not_overwritten() {
        let case = case(&[("lamp.awl", b"one\n")]);
        let file = case.path.join("lamp.awl");
        let (text, base) = case.folder.read("lamp.awl").unwrap();
        assert_eq!(text, "one\n");
        let base = done(case.folder.save("lamp.awl", "two\n", Some(&base)));
        assert_eq!(fs::read(&file).unwrap(), b"two\n");
        fs::write(&file, "by vim\n").unwrap();
        let vim = case.folder.read("lamp.awl").unwrap().1;
        let changed = Written::Changed(Some(vim.clone()));
        assert_eq!(case.folder.save("lamp.awl", "three\n", Some(&base)).unwrap(), changed);
        assert_eq!(case.folder.save("lamp.awl", "three\n", None).unwrap(), changed);
        assert_eq!(case.folder.remove("lamp.awl", &base).unwrap(), changed);
        assert_eq!(fs::read(&file).unwrap(), b"by vim\n");
        fs::remove_file(&file).unwrap();
        let gone = case.folder.save("lamp.awl", "three\n", Some(&vim)).unwrap();
        assert_eq!(gone, Written::Changed(None));
        let new = done(case.folder.save("parts/new.awl", "new\n", None));
        assert_eq!(names(&case.folder), ["parts/new.awl"]);
        done(case.folder.remove("parts/new.awl", &new));
        // Gone is gone, whoever did it.
        done(case.folder.remove("parts/new.awl", &new));
        // Nothing temporary is left.
        assert_eq!(fs::read_dir(case.path.join("parts")).unwrap().count(), 0);
    }

    #[test]
    fn encoding_and_line_ends_stay() {
        let case = case(&[("lamp.awl", b"// L\xFCfter\r\nLD I0.0\r\n")]);
        let (text, base) = case.folder.read("lamp.awl").unwrap();
        assert_eq!(text, "// Lüfter\nLD I0.0\n");
        let base = done(case.folder.save("lamp.awl", "// Lüfter\nLD I0.1\n", Some(&base)));
        let file = case.path.join("lamp.awl");
        assert_eq!(fs::read(&file).unwrap(), b"// L\xFCfter\r\nLD I0.1\r\n");
        let written = case.folder.save("lamp.awl", "// a → b\n", Some(&base)).unwrap();
        let Written::Done { note: Some(note), .. } = written else { panic!("{written:?}") };
        assert!(note.contains("UTF-8") && note.contains('→'), "{note}");
        assert_eq!(fs::read(&file).unwrap(), "// a → b\r\n".as_bytes());
    }

    #[test]
    fn sizes_are_limited() {
        let large = vec![b'x'; BYTES_MAX - 10];
        let case = case(&[("a.awl", b"LD I0.0\n"), ("b.txt", &large), ("c.awl", b"LD I0.1\n")]);
        let Listing { files, left_out } = case.folder.listing().unwrap();
        assert_eq!((files.len(), left_out.len()), (2, 1));
        assert!(left_out[0].name == "c.awl" && left_out[0].why.contains("4 MB"), "{left_out:?}");
        let larger = "x".repeat(BYTES_MAX + 1);
        assert!(case.folder.save("d.awl", &larger, None).unwrap_err().contains("4 MB"));
        for number in 0..FILES_MAX {
            fs::write(case.path.join(format!("a{number}.awl")), "").unwrap();
        }
        let Listing { files, left_out } = case.folder.listing().unwrap();
        assert_eq!((files.len(), left_out.len()), (FILES_MAX, 3));
        assert!(left_out[2].why.contains("200 files"), "{left_out:?}");
    }

    #[test]
    fn the_page_knows_the_same_endings() {
        let page = include_str!("../../../ide/page/src/project/project.ts");
        let quoted = |line: &str| line.matches("\".").count();
        let lists = page
            .lines()
            .filter(|line| line.contains("PROGRAMS = [") || line.contains("ENDINGS = ["));
        assert_eq!(lists.map(quoted).sum::<usize>(), ENDINGS.len());
        for ending in ENDINGS {
            assert!(page.contains(&format!("\".{ending}\"")), "{ending}");
        }
    }
}
