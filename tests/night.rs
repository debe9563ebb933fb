//! Nights that go wrong: killed, stopped, shared among processes and machines, out of room. In the
//! morning every frame is there, once, with the bytes of a night that went well.

mod claims;
mod desk;
mod kept;
mod kills;
mod news;
mod room;
mod shards;
mod signals;
mod strangers;
