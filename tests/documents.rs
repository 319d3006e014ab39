//! The pages: links lead somewhere, every picture is shown, and the first page stays short.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path, PathBuf};

const LONGEST_FIRST_PAGE: (usize, usize) = (200, 15_000); // lines, bytes

pub(crate) fn package() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files of the project with this ending below a folder, from the package's folder, but those that others bring.
fn files(folder: &Path, ending: &str, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() && !name.starts_with('.') && !["node_modules", "target"].contains(&name.as_str()) {
            files(&path, ending, found);
        } else if path.extension().is_some_and(|extension| extension == ending) {
            found.push(path);
        }
    }
}

/// A page without what stands between fences.
pub(crate) fn prose(text: &str) -> String {
    text.split("\n```").step_by(2).collect::<Vec<_>>().join("\n")
}

/// Where the links and pictures of a page lead.
fn links(page: &str) -> Vec<String> {
    let mut out = Vec::new();
    for (before, after) in [("](", ')'), ("href=\"", '"'), ("src=\"", '"')] {
        out.extend(page.split(before).skip(1).filter_map(|rest| Some(rest.split_once(after)?.0.to_owned())));
    }
    out
}

/// The anchors of a page's headings, as GitHub makes them.
fn anchors(page: &str) -> BTreeSet<String> {
    let headings = page.lines().filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| {
        let title = heading.trim_start_matches('#').trim().to_lowercase();
        let kept = title.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    headings.map(anchor).collect()
}

/// A path without `..`.
fn plain(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        if part == Component::ParentDir {
            out.pop();
        } else {
            out.push(part);
        }
    }
    out
}

/// What of the links of a page, in this folder, leads nowhere; and the files that it does lead to.
fn followed(page: &Path) -> (Vec<String>, BTreeSet<PathBuf>) {
    let text = prose(&fs::read_to_string(page).unwrap());
    let (mut dead, mut met) = (Vec::new(), BTreeSet::new());
    for link in links(&text).into_iter().filter(|link| !link.contains("://")) {
        let (path, anchor) = link.split_once('#').unwrap_or((&link, ""));
        let target = if path.is_empty() { page.into() } else { plain(&page.parent().unwrap().join(path)) };
        let found = target.exists()
            && (anchor.is_empty() || anchors(&prose(&fs::read_to_string(&target).unwrap())).contains(anchor));
        if !found {
            dead.push(format!("{}: {link}", page.display()));
        }
        met.insert(target);
    }
    (dead, met)
}

pub(crate) fn pages() -> Vec<PathBuf> {
    let mut pages = vec![package().join("README.md")];
    for folder in ["src", "fmu", "tests"] {
        files(&package().join(folder), "md", &mut pages);
    }
    assert!(pages.len() > 10, "only {} pages found", pages.len());
    pages
}

#[test]
fn links_of_all_pages_lead_somewhere_and_every_page_is_linked() {
    let (mut dead, mut met) = (Vec::new(), BTreeSet::new());
    for page in pages() {
        let (lost, found) = followed(&page);
        dead.extend(lost);
        met.extend(found);
    }
    assert!(dead.is_empty(), "{}", dead.join("\n"));
    let mut shown = pages();
    files(&package().join("tests/charts"), "png", &mut shown);
    shown.retain(|path| !met.contains(path) && *path != package().join("README.md"));
    assert!(shown.is_empty(), "no page leads to {shown:?}");
}

#[test]
fn the_first_page_is_short() {
    let page = fs::read_to_string(package().join("README.md")).unwrap();
    let size = (page.lines().count(), page.len());
    assert!(size.0 <= LONGEST_FIRST_PAGE.0 && size.1 <= LONGEST_FIRST_PAGE.1, "{size:?}");
}

#[test]
fn dead_links_are_seen() {
    let text = "# A b: c\n[x](y.md#z) <img src=\"p.png\">\n```\n[no](no.md)\n```\n## More-or less (1)\n";
    assert_eq!(links(&prose(text)), ["y.md#z", "p.png"]);
    assert_eq!(anchors(text), ["a-b-c", "more-or-less-1"].map(String::from).into());
    assert_eq!(plain(Path::new("a/b/../c.md")), Path::new("a/c.md"));
}

/// Code without what stands in quotation marks and comments.
fn bare(code: &str) -> String {
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.map(|line| line.split('"').step_by(2).collect::<String>() + "\n").collect()
}

#[test]
fn the_page_of_magnets_and_coils_lists_the_files_that_know_of_coils() {
    let page = fs::read_to_string(package().join("src/magnetics/README.md")).unwrap();
    let section = page.split("\n## ").find(|part| part.starts_with("Which files know of sources")).unwrap();
    let rows = section.lines().filter(|line| line.starts_with("| "));
    let listed: BTreeSet<String> = rows
        .flat_map(|row| row.split('`').skip(1).step_by(2))
        .filter(|name| Path::new(name).extension().is_some_and(|extension| extension == "rs"))
        .map(str::to_owned)
        .collect();
    let mut found = Vec::new();
    files(&package().join("src"), "rs", &mut found);
    let knows = |path: &PathBuf| {
        let code = bare(&fs::read_to_string(path).unwrap()).to_lowercase().replace("recoil", "");
        code.contains("coil")
    };
    let known: BTreeSet<String> = found
        .iter()
        .filter(|path| knows(path))
        .map(|path| path.strip_prefix(package().join("src")).unwrap().to_string_lossy().into_owned())
        // Studies use sources as anybody does.
        .filter(|name| {
            !["magnetics/", "studies/", "bin/mcm/study.rs"].iter().any(|own| name.starts_with(own))
        })
        .collect();
    assert_eq!(listed, known);
}

/// What cells of a table name between backticks as files or folders: from `src` or from the package's folder, or, without a folder,
/// beside the one that is named before.
fn files_named(cells: &str) -> Vec<PathBuf> {
    let mut out: Vec<PathBuf> = Vec::new();
    for name in cells.split('`').skip(1).step_by(2).filter(|name| !name.contains([' ', '=', '*'])) {
        let path = if name.contains('/') {
            let of_source = package().join("src").join(name);
            if of_source.exists() { of_source } else { package().join(name) }
        } else if name.contains('.') {
            let before = out.last().unwrap_or_else(|| panic!("no folder for {name}"));
            let folder = if before.is_dir() { before } else { before.parent().unwrap() };
            folder.join(name)
        } else {
            continue;
        };
        out.push(path);
    }
    out
}

#[test]
fn files_that_an_addition_touches_exist() {
    let page = fs::read_to_string(package().join("src/README.md")).unwrap();
    let (_, table) = page.split_once("| new | files |\n| --- | --- |\n").unwrap();
    let rows: Vec<&str> = table.lines().take_while(|line| line.starts_with('|')).collect();
    assert!(rows.len() > 6, "{rows:?}");
    for row in rows {
        let named = files_named(row);
        assert!(!named.is_empty(), "no file in {row}");
        for path in named {
            assert!(path.exists(), "there is no {}, named by {row}", path.display());
        }
    }
}
