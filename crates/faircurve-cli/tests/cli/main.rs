//! The program as its users meet it.

mod folder;
mod list;
mod messages;
mod solve;
