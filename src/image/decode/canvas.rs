//! Assembly of an EXR's blocks: rows are developed as they arrive, and values that are not finite
//! are counted.

use super::file::MOST_CHANNELS;
use super::file::{Fault, exr_fault};
use crate::film::{self, Developed};
use ::exr::block::UncompressedBlock;
use ::exr::math::Vec2;
use ::exr::meta::attribute::{ChannelDescription, ChannelList, SampleType};
use ::exr::meta::{BlockDescription, header::Header};
use ::exr::prelude::f16;

/// Pixels of 8 bits, and the channels with values that are not finite, with the number of these.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decoded {
    /// Three bytes per pixel, row by row from the top.
    pub rgb8: Vec<u8>,
    /// By name.
    pub not_finite: Vec<(String, u64)>,
}

/// An EXR's image while its blocks arrive.
pub(super) struct Canvas {
    width: usize,
    channels: Vec<Channel>,
    encode: fn(f64) -> f64,
    rgb8: Vec<u8>,
    /// Whether each row has arrived.
    seen: Vec<bool>,
}

struct Channel {
    name: String,
    sample_type: SampleType,
    /// The displayed color of a channel, as index of red, green or blue; None for others.
    shown: Option<usize>,
    not_finite: u64,
}

impl Canvas {
    pub(super) fn new(header: &Header, encode: fn(f64) -> f64) -> Result<Self, Fault> {
        let damaged = |what: &str| Err(Fault::Damaged(what.to_owned()));
        if header.deep || header.blocks != BlockDescription::ScanLines {
            return damaged("its pixels are not in scan lines");
        }
        let list = &header.channels.list;
        let whole = |channel: &ChannelDescription| {
            channel.sample_type != SampleType::U32 && channel.sampling == Vec2(1, 1)
        };
        let channels: Vec<Channel> = list.iter().map(Channel::new).collect();
        let shown = channels.iter().filter(|channel| channel.shown.is_some());
        if shown.count() != 3 || channels.len() > MOST_CHANNELS || !list.iter().all(whole) {
            return damaged("its channels are not those of a frame");
        }
        let Vec2(width, height) = header.layer_size;
        Ok(Self {
            width,
            channels,
            encode,
            rgb8: vec![0; width * height * 3],
            seen: vec![false; height],
        })
    }

    /// Takes whole rows, with all of their channels.
    pub(super) fn take(
        &mut self,
        block: &UncompressedBlock,
        list: &ChannelList,
    ) -> Result<(), Fault> {
        let outside = || Fault::Damaged("a row lies outside of the picture".to_owned());
        let first = block.index.pixel_position.y();
        let rows = first..first + block.index.pixel_size.height();
        let seen = self.seen.get_mut(rows.clone()).ok_or_else(outside)?;
        seen.fill(true);
        let mut linear = vec![[0.0; 3]; rows.len() * self.width];
        for line in block.lines(list) {
            let at = line.location;
            let row = (at.position.y() - first) * self.width;
            let pixels = linear.get_mut(row..row + at.sample_count);
            let channel = self.channels.get_mut(at.channel);
            let (Some(pixels), Some(channel)) = (pixels, channel) else {
                return Err(outside());
            };
            match channel.sample_type {
                SampleType::F16 => {
                    channel.put(
                        line.read_samples::<f16>().map(|v| v.map(f16::to_f32)),
                        pixels,
                    )?;
                }
                _ => channel.put(line.read_samples::<f32>(), pixels)?,
            }
        }
        let developed = Developed {
            linear,
            saturated: 0,
        };
        let bytes = film::to_rgb8(&developed, self.encode);
        self.rgb8[first * self.width * 3..][..bytes.len()].copy_from_slice(&bytes);
        Ok(())
    }

    pub(super) fn finish(self) -> Result<Decoded, Fault> {
        if self.seen.contains(&false) {
            return Err(Fault::Truncated);
        }
        let channels = self.channels.into_iter();
        Ok(Decoded {
            rgb8: self.rgb8,
            not_finite: channels
                .filter(|channel| channel.not_finite > 0)
                .map(|channel| (channel.name, channel.not_finite))
                .collect(),
        })
    }
}

impl Channel {
    fn new(description: &ChannelDescription) -> Self {
        let name = description.name.to_string();
        Self {
            shown: ["R", "G", "B"].iter().position(|shown| *shown == name),
            name,
            sample_type: description.sample_type,
            not_finite: 0,
        }
    }

    /// Counts the values of a row that are not finite, and stores those that are displayed.
    fn put(
        &mut self,
        values: impl Iterator<Item = ::exr::error::Result<f32>>,
        pixels: &mut [[f32; 3]],
    ) -> Result<(), Fault> {
        for (value, pixel) in values.zip(pixels) {
            let value = value.map_err(exr_fault)?;
            self.not_finite += u64::from(!value.is_finite());
            if let Some(shown) = self.shown {
                pixel[shown] = value;
            }
        }
        Ok(())
    }
}
