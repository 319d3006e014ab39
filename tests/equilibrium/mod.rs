//! Equilibria against the independent energy model and closed forms.

mod derivatives;
mod reference;
