//! Names of texts and the URIs of editors. The name of a file is its path, with `/`.

use std::path::{Path, PathBuf};

use lsp_types::Uri;
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};

const FILE: &str = "file://";

/// What a path in a URI has as it is.
const PLAIN: &AsciiSet =
    &NON_ALPHANUMERIC.remove(b'/').remove(b'-').remove(b'.').remove(b'_').remove(b'~');

/// The name of the text at a URI; of what is no file the URI itself.
pub(super) fn name_of(uri: &Uri) -> String {
    let Some(path) = uri.as_str().strip_prefix(FILE) else { return uri.as_str().to_owned() };
    let path = percent_decode_str(path).decode_utf8_lossy().into_owned();
    // `/c:/x` is a path of Windows.
    match path.strip_prefix('/') {
        Some(rest) if rest.as_bytes().get(1) == Some(&b':') => rest.to_owned(),
        _ => path,
    }
}

/// The URI of a text.
pub(super) fn uri_of(name: &str) -> Option<Uri> {
    let has_scheme = name.find(':').is_some_and(|at| at > 1);
    if has_scheme && !name.starts_with('/') {
        return name.parse().ok();
    }
    let root = if name.starts_with('/') { "" } else { "/" };
    format!("{FILE}{root}{}", utf8_percent_encode(name, PLAIN)).parse().ok()
}

/// The name of a file.
pub(super) fn name_of_path(path: &Path) -> Option<String> {
    path.to_str().map(|path| path.replace('\\', "/"))
}

/// The file of this name.
pub(super) fn path_of(name: &str) -> PathBuf {
    PathBuf::from(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_come_back() {
        let cases = [
            ("file:///a/b%20c/%C3%A4.awl", "/a/b c/ä.awl"),
            ("file:///c%3A/x/y.awl", "c:/x/y.awl"),
            ("untitled:Untitled-1", "untitled:Untitled-1"),
        ];
        for (uri, name) in cases {
            assert_eq!(name_of(&uri.parse().unwrap()), name);
            assert_eq!(uri_of(name).unwrap().as_str(), uri);
        }
    }
}
