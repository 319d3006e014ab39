//! How far a study is.

/// What a study tells of its progress; `()` does not listen.
pub trait Progress: Sync {
    /// There are this many more parts to do.
    fn more(&self, parts: usize);

    /// One part is done.
    fn done(&self);
}

impl Progress for () {
    fn more(&self, _: usize) {}

    fn done(&self) {}
}
