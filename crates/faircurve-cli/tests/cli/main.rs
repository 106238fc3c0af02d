//! The program as its users meet it.

mod compare;
mod folder;
mod list;
mod measure;
mod messages;
mod solve;
