//! The program as its users meet it.

mod compare;
mod edit;
mod folder;
mod list;
mod measure;
mod messages;
mod solve;
