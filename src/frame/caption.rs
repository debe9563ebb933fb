//! What a caption says of one frame: the largest speed, the highest temperature, the time.

use super::values::Frame;
use crate::plot::quantity::without_zeros;
use crate::relativity::Celerity;
use crate::shot::{Shot, Switch};

/// From this speed on its digits are all nines, and the Lorentz factor is told in its place.
const NEARLY_LIGHT: f64 = 0.999;

/// What is told of one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Caption {
    /// Number of the frame.
    pub frame: u32,
    /// The fastest motion of a model, light or background relative to the camera.
    pub fastest: Celerity,
    /// Temperature of the hottest material, K; none where all are at 0 or thermal light is off.
    pub temperature_k: Option<f64>,
    /// Lab time of the exposure, s; none in a shot whose time stands still.
    pub time_s: Option<f64>,
}

impl Caption {
    /// What is told of frame number `number` of a shot, as text; of one that is refused its number.
    pub fn text_of(shot: &Shot, number: u32) -> String {
        let caption = Frame::new(shot, number).map(|frame| Self::new(&frame).text());
        caption.unwrap_or_else(|_| format!("frame {number}"))
    }

    /// What is told of a frame.
    pub fn new(frame: &Frame<'_>) -> Self {
        let camera = frame.celerity(frame.camera.worldline);
        let mut fastest = Celerity::REST;
        for (_, worldline) in frame.moving_things() {
            let relative = frame.celerity(worldline).seen_from(camera);
            if relative.magnitude() > fastest.magnitude() {
                fastest = relative;
            }
        }
        let shown = frame.effects.thermal == Switch::Auto;
        let materials = frame.materials.values().filter(|_| shown);
        let temperatures = materials.filter_map(|m| Some(m.thermal?.temperature_k));
        let stands_still = frame.shot.shot.time.is_constant();
        Self {
            frame: frame.number,
            fastest,
            temperature_k: temperatures.filter(|t| *t > 0.0).max_by(f64::total_cmp),
            time_s: (!stands_still).then_some(frame.time_s),
        }
    }

    /// `β 0.25`, or `γ 1.5e6` where β is nearly 1.
    pub fn speed(&self) -> String {
        let beta = self.fastest.beta().length();
        if beta < NEARLY_LIGHT {
            format!("β {}", rounded(beta))
        } else {
            format!("γ {}", rounded(self.fastest.lorentz_factor()))
        }
    }

    /// `frame 12   β 0.25   2000 K   t = 1.2 s`, without what there is nothing to say of.
    pub fn text(&self) -> String {
        let temperature = self.temperature_k.map(|t| format!("{} K", rounded(t)));
        let time = self.time_s.map(|t| format!("t = {} s", rounded(t)));
        let mut words = vec![format!("frame {}", self.frame), self.speed()];
        words.extend(temperature);
        words.extend(time);
        words.join("   ")
    }
}

/// A number to four digits, without zeros at its end; whole up to 100 000.
fn rounded(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    let plain = match size {
        1000.0..99_999.5 => format!("{value:.0}"),
        1.0..1000.0 => format!("{value:.*}", 3 - size.log10() as usize),
        0.001..1.0 => format!("{value:.4}"),
        _ => {
            let text = format!("{value:.3e}");
            let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
            return format!("{}e{power}", without_zeros(digits));
        }
    };
    without_zeros(&plain).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shot::parse;
    use std::path::Path;

    fn shot(text: &str) -> Shot {
        let text = format!(
            "{text}\n[[model]]\nfile = \"tests/bad-shots/models/ball.obj\"\nworldline = \"a\"\n[camera]\n"
        );
        parse(&text, Path::new("a.toml")).expect("no mistakes")
    }

    #[test]
    fn numbers_have_four_digits_and_no_zeros_at_their_end() {
        for (value, text) in [
            (0.0, "0"),
            (0.25, "0.25"),
            (0.5 / 48.0, "0.0104"),
            (0.99876, "0.9988"),
            (1.5, "1.5"),
            (22.366, "22.37"),
            (999.96, "1000"),
            (2000.0, "2000"),
            (99_999.0, "99999"),
            (1.5e6, "1.5e6"),
            (1.234_56e-7, "1.235e-7"),
            (-1.25, "-1.25"),
        ] {
            assert_eq!(rounded(value), text, "{value}");
        }
    }

    #[test]
    fn the_caption_tells_the_fastest_motion_as_the_camera_sees_it() {
        let shot = shot(
            "[shot]\nframes = 3\n[worldline.a]\nvelocity = { from = [0, 0, 0], to = [0.5, 0, 0] }\n\
             [worldline.b]\nvelocity = [-0.5, 0, 0]\n[[light]]\nkind = \"sun\"\ndirection = [0, 0, -1]\n\
             intensity = 1\nworldline = \"a\"",
        );
        let caption = |frame| Caption::new(&Frame::new(&shot, frame).expect("it moves")).text();
        assert_eq!(caption(1), "frame 1   β 0");
        assert_eq!(caption(2), "frame 2   β 0.25");
        assert_eq!(caption(3), "frame 3   β 0.5");
    }

    #[test]
    fn near_the_speed_of_light_it_tells_the_lorentz_factor_and_what_else_moves() {
        let shot = shot(
            "[shot]\nframes = 3\ntime = { from = 0, to = 2.4 }\n\
             [worldline.a]\nvelocity = { gamma = 1.5e6, direction = [1, 0, 0] }\n\
             [material.hot]\nthermal = { temperature = { from = 0, to = 2000 } }\n\
             [material.warm]\nthermal = { temperature = { from = 0, to = 300 } }",
        );
        let caption = |frame| Caption::new(&Frame::new(&shot, frame).expect("it moves")).text();
        assert_eq!(caption(1), "frame 1   γ 1.5e6   t = 0 s");
        assert_eq!(caption(3), "frame 3   γ 1.5e6   2000 K   t = 2.4 s");
    }
}
