//! Runs that are killed, stopped, shared among processes and machines, or out of room: at the end
//! every frame is there, once, with the bytes of an undisturbed run.

mod claims;
mod desk;
mod kept;
mod kills;
mod news;
mod room;
mod shards;
mod signals;
mod strangers;
