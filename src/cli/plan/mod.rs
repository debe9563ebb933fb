//! `restframe plan`: effects of each frame and their reasons, shared traces, time. Frames are
//! printed as they are planned, so that a reader need not wait for the last.

mod print;

pub(super) use print::run;
