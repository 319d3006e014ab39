//! The binary `mcm` from outside: exit status, messages, files.

mod bifurcation;
mod branches;
mod field;
mod fit;
mod follow;
mod init;
mod mesh;
mod multipoles;
mod pack;
mod picture;
mod plot;
mod reference;
mod shut;
mod solve;
mod steer;
mod study;
mod svg;
mod sweep;
mod uncertainty;

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// A folder of its own for one test, emptied first.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli").join(test);
    drop(std::fs::remove_dir_all(&folder));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn mcm(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mcm")).current_dir(folder).args(arguments).output().unwrap()
}

/// Starts `mcm` with its output caught.
fn start(folder: &Path, arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_mcm"))
        .current_dir(folder)
        .args(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Waits until it holds, at most half a minute.
fn wait_for(mut holds: impl FnMut() -> bool) {
    let start = Instant::now();
    while !holds() && start.elapsed() < Duration::from_secs(30) {
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// Ctrl-C, or an end without warning.
fn interrupt(child: &Child, at_once: bool) {
    let signal = if at_once { "KILL" } else { "INT" };
    let sent = Command::new("sh").args(["-c", &format!("kill -{signal} {}", child.id())]).status();
    assert!(sent.is_ok());
}

/// Runs `mcm` with a scene file of the given text, named in `arguments` as `scene.toml`.
fn with_scene(test: &str, scene: &str, arguments: &[&str]) -> (PathBuf, Output) {
    let folder = folder(test);
    std::fs::write(folder.join("scene.toml"), scene).unwrap();
    let output = mcm(&folder, arguments);
    (folder, output)
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn assert_status(output: &Output, expected: i32) {
    assert_eq!(output.status.code(), Some(expected), "stderr: {}", stderr(output));
}

/// The columns of a CSV file by name.
fn table(path: &Path) -> Vec<std::collections::HashMap<String, String>> {
    csv::Reader::from_path(path).unwrap().deserialize().map(Result::unwrap).collect()
}

#[test]
fn wrong_usage_is_bad_input_and_help_is_not() {
    let here = folder("usage");
    for arguments in
        [&[][..], &["slove"], &["solve"], &["solve", "a", "--jason"], &["sweep", "a", "--out", "b"]]
    {
        let output = mcm(&here, arguments);
        assert_status(&output, 1);
        assert!(stderr(&output).contains("Usage"), "{arguments:?}: {}", stderr(&output));
    }
    assert!(stderr(&mcm(&here, &["slove"])).contains("'solve'"));
    for arguments in
        [&["--help"][..], &["--version"], &["solve", "--help"], &["field", "-h"], &["sweep", "--help"]]
    {
        let output = mcm(&here, arguments);
        assert_status(&output, 0);
        assert!(!output.stdout.is_empty());
    }
}

#[test]
fn the_version_tells_the_instructions_in_use() {
    let here = folder("version");
    let version = format!("mcm {}", env!("CARGO_PKG_VERSION"));
    assert_eq!(stdout(&mcm(&here, &["--version"])).trim(), version);
    let told = stdout(&mcm(&here, &["--version", "--verbose"]));
    assert!(told.starts_with(&version) && told.contains("instructions for fields and products: "), "{told}");
    let forced = Command::new(env!("CARGO_BIN_EXE_mcm"))
        .args(["--version", "--verbose"])
        .env("MCM_PORTABLE", "1")
        .output()
        .unwrap();
    assert!(stdout(&forced).contains("products: portable\n"), "{}", stdout(&forced));
    assert_status(&mcm(&here, &["--verbose"]), 1);
}

#[test]
fn missing_file_names_the_nearest() {
    let (_, output) = with_scene("missing", "", &["solve", "scnee.toml"]);
    assert_status(&output, 1);
    let message = stderr(&output);
    assert!(
        message.contains("cannot read scnee.toml") && message.contains("did you mean scene.toml?"),
        "{message}"
    );
}

#[test]
fn unknown_key_names_line_and_nearest() {
    let (_, output) = with_scene("key", "[field]\nuniform_mT = [0, 1, 0]", &["solve", "scene.toml"]);
    assert_status(&output, 1);
    let expected = "error: scene.toml, line 2: unknown key `field.uniform_mT`; did you mean `uniform_mt`?\n";
    assert_eq!(stderr(&output), expected);
    assert!(output.stdout.is_empty());
}
