//! Nights that go wrong: killed, stopped, shared among processes and machines, out of room. In the
//! morning every frame is there, once, with the bytes of a night that went well.

#![expect(
    clippy::unwrap_used,
    reason = "a test that cannot be set up has failed"
)]

#[path = "night/claims.rs"]
mod claims;
#[path = "night/desk.rs"]
mod desk;
#[path = "night/kept.rs"]
mod kept;
#[path = "night/kills.rs"]
mod kills;
#[path = "night/news.rs"]
mod news;
#[path = "night/room.rs"]
mod room;
#[path = "night/shards.rs"]
mod shards;
#[path = "night/signals.rs"]
mod signals;
#[path = "night/strangers.rs"]
mod strangers;
