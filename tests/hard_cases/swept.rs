//! Scenes to be swept over speeds: VELOCITY stands for the velocity of what moves.

/// Name and shot of each; whoever adds an effect adds a scene. Each is rendered as it stands.
pub(crate) const SCENES: &[(&str, &str)] = &[
    ("inside a moving box", INSIDE),
    ("a ball before a moving sky", SKY),
    ("a moving camera", CAMERA),
    ("a moving mirror and moving glass", MIRROR_AND_GLASS),
    ("a moving sky with an image", IMAGE),
    ("moving stars", STARS),
    ("a moving panorama with a headlight", PANORAMA),
    ("a moving dome with a headlight", DOME),
    ("X-rays", X_RAYS),
    ("radio", RADIO),
    ("light beyond f32", GLARE),
];

/// The camera is in the middle of a box, so that light comes from all sides, under every Doppler
/// factor from e^-η to e^η. The box has every term that a surface has; lamps ride on it, on
/// another worldline, and rest; a ball at rest shadows them.
pub(crate) const INSIDE: &str = r#"
[image]
size = [24, 16]
samples = 2
[worldline.moving]
velocity = VELOCITY
[worldline.lamp]
velocity = [0.3, -0.2, 0.4]
[[model]]
file = "box.obj"
worldline = "moving"
scale = 3
material = "everything"
[[model]]
file = "ball.obj"
scale = 0.3
translate = [0.8, 0.1, -1.2]
material = "red"
[material.everything]
diffuse = { weight = 0.8, spectrum = "D65-like" }
highlight = { weight = 0.2, spectrum = { rgb = [0.2, 0.5, 0.9] }, exponent = 40 }
emission = { scale = 0.01, spectrum = { gaussian = { center = 589, width = 5 } } }
thermal = { temperature = 1200, emissivity = { points = [[400, 0.9], [600, 0.2], [900, 0.6]] } }
[material.red]
diffuse = { spectrum = { rgb = [0.8, 0.1, 0.1] } }
[spectrum.D65-like]
points = [[380, 0.5], [480, 0.9], [560, 0.8], [700, 0.6]]
[[light]]
kind = "point"
worldline = "lamp"
position = [0.4, 0.6, -0.5]
intensity = 100
[[light]]
kind = "spot"
worldline = "moving"
position = [-1, 1, 1]
direction = [1, -1, -1]
intensity = 100
spectrum = { blackbody = 3000 }
[[light]]
kind = "point"
position = [0.9, 0.3, -0.2]
scale = 1
spectrum = { gaussian = { center = 500, width = 3 } }
[camera]
hfov = 110
[sensor]
exposure = 0
"#;

/// A ball that passes four metres away when the light sets out that is seen, over a floor at rest,
/// before a sky that moves with it and has a spectrum.
const SKY: &str = r#"
[image]
size = [24, 16]
samples = 2
[worldline.moving]
velocity = VELOCITY
passes = [0, 0, -4]
at = -4
[[model]]
file = "ball.obj"
worldline = "moving"
material = "hot"
[[model]]
file = "wall.obj"
scale = 5
rotate = [-90, 0, 0]
translate = [0, -1.5, -4]
material = "grey"
[material.hot]
diffuse = { weight = 0.5, spectrum = { rgb = [0.9, 0.6, 0.2] } }
thermal = { temperature = 3000 }
[material.grey]
diffuse = { spectrum = 0.5 }
highlight = { weight = 0.3, spectrum = 1.0, exponent = 20 }
[background]
worldline = "moving"
spectrum = { points = [[400, 0.01], [500, 0.05], [650, 0.002]], beyond = "zero" }
[[light]]
kind = "point"
worldline = "moving"
position = [0, 3, 1]
intensity = 1000
[[light]]
kind = "sun"
direction = [0.2, -1, -0.3]
intensity = 1000
[camera]
hfov = 70
[sensor]
exposure = 0
"#;

/// What moves is who looks.
const CAMERA: &str = r#"
[image]
size = [24, 16]
samples = 2
[worldline.moving]
velocity = VELOCITY
[[model]]
file = "box.obj"
scale = 4
material = "painted"
[[model]]
file = "wall.obj"
translate = [0.5, 0.3, -2]
material = "glowing"
[material.painted]
diffuse = { spectrum = { rgb = [0.3, 0.8, 0.3] } }
emission = { scale = 1e-4, spectrum = "A" }
[material.glowing]
thermal = { temperature = 2000, curve = "peak", strength = 0.5 }
[[light]]
kind = "point"
position = [1, 2, 1]
intensity = 500
[background]
worldline = "lab"
spectrum = 0.01
[camera]
worldline = "moving"
hfov = 110
[sensor]
exposure = 0
"#;

/// A mirror and a glass ball that move, with what they show at rest, glass before a moving mirror,
/// and a lamp that lights both.
const MIRROR_AND_GLASS: &str = r#"
[image]
size = [24, 16]
samples = 2
[worldline.moving]
velocity = VELOCITY
passes = [0, 0, -4]
at = -4
[[model]]
file = "wall.obj"
worldline = "moving"
material = "mirror"
scale = 2
rotate = [0, 20, 0]
translate = [1, 0, 0]
[[model]]
file = "ball.obj"
worldline = "moving"
material = "glass"
translate = [-1, 0, 1]
[[model]]
file = "box.obj"
material = "painted"
scale = 8
[[model]]
file = "ball.obj"
material = "glass"
scale = 0.5
translate = [0.5, 0.25, -2]
[material.mirror]
mirror = { weight = 0.9, spectrum = { points = [[400, 0.4], [700, 0.9]] } }
diffuse = { weight = 0.1, spectrum = 1.0 }
[material.glass]
mirror = { weight = 1.0, spectrum = 1.0 }
refraction = { weight = 0.9, spectrum = 1.0, ior = 1.5 }
[material.painted]
diffuse = { weight = 0.7, spectrum = { rgb = [0.3, 0.8, 0.5] } }
emission = { scale = 1e-4, spectrum = "A" }
[[light]]
kind = "point"
position = [2, 3, 1]
intensity = 1000
[effects]
bounces = 6
[camera]
hfov = 80
[sensor]
exposure = 0
"#;

/// A sky with an image that moves, also in a mirror at rest.
const IMAGE: &str = r#"
[image]
size = [24, 16]
samples = 2
[worldline.moving]
velocity = VELOCITY
[[model]]
file = "ball.obj"
material = "silver"
translate = [0, 0, -3]
[material.silver]
mirror = { weight = 0.9, spectrum = 1.0 }
[background]
worldline = "moving"
image = "sky.hdr"
[camera]
hfov = 110
[sensor]
exposure = 0
"#;

/// Stars that move, behind a mirror at rest.
const STARS: &str = r#"
[image]
size = [24, 16]
samples = 2
[worldline.moving]
velocity = VELOCITY
[[model]]
file = "ball.obj"
material = "silver"
translate = [0, 0, -3]
[material.silver]
mirror = { weight = 0.9, spectrum = 1.0 }
[background]
worldline = "moving"
stars = { count = 500, size = 10, magnitude = [-20, -10] }
[camera]
hfov = 110
[sensor]
exposure = 0
"#;

/// The whole sky of a camera that moves, lit by a lamp that it carries.
const PANORAMA: &str = r#"
[image]
size = [24, 16]
samples = 2
[worldline.moving]
velocity = VELOCITY
[[model]]
file = "box.obj"
scale = 4
material = "painted"
[material.painted]
diffuse = { weight = 0.7, spectrum = { rgb = [0.3, 0.8, 0.5] } }
highlight = { weight = 0.2, spectrum = 1.0, exponent = 30 }
thermal = { temperature = 1000 }
[[light]]
kind = "spot"
worldline = "moving"
position = [0, 0, 0]
direction = [0, 0, -1]
inner = 30
outer = 80
intensity = 1000
[camera]
worldline = "moving"
projection = "equirectangular"
[sensor]
exposure = 0
"#;

/// A dome of a camera that moves, under a sky at rest, with a headlight.
const DOME: &str = r#"
[image]
size = [24, 16]
samples = 2
[worldline.moving]
velocity = VELOCITY
[[model]]
file = "wall.obj"
scale = 4
translate = [0, 0, -3]
material = "painted"
[material.painted]
diffuse = { weight = 0.7, spectrum = { rgb = [0.9, 0.4, 0.5] } }
[background]
worldline = "lab"
spectrum = { blackbody = 4000 }
[[light]]
kind = "point"
worldline = "moving"
position = [0, 0, 0]
intensity = 1000
[camera]
worldline = "moving"
projection = "fisheye"
vfov = 180
[sensor]
exposure = 0
"#;

/// A hot ball among its own lamps, in a window of X-rays.
const X_RAYS: &str = r#"
[image]
size = [24, 16]
samples = 2
[worldline.moving]
velocity = VELOCITY
passes = [0, 0, -4]
at = -4
[[model]]
file = "ball.obj"
worldline = "moving"
material = "hot"
[[model]]
file = "wall.obj"
scale = 8
translate = [0, 0, -8]
material = "grey"
[material.hot]
thermal = { temperature = 1e6 }
[material.grey]
diffuse = { spectrum = 0.5 }
emission = { scale = 1e-3, spectrum = { blackbody = 6000 } }
[[light]]
kind = "point"
worldline = "moving"
position = [0, 2, 1]
intensity = 1000
[camera]
hfov = 70
[sensor]
exposure = 0
window = [0.01, 10]
color = "bands"
"#;

/// Cold bodies in a window of radio, before a background at rest that all of it comes from.
const RADIO: &str = r#"
[image]
size = [24, 16]
samples = 2
[worldline.moving]
velocity = VELOCITY
passes = [0, 0, -4]
at = -4
[[model]]
file = "ball.obj"
worldline = "moving"
material = "cold"
[material.cold]
thermal = { temperature = 2.7 }
diffuse = { weight = 0.5, spectrum = 1.0 }
[background]
worldline = "moving"
spectrum = 1e-9
[[light]]
kind = "sun"
direction = [0.2, -0.5, -1]
scale = 1e-9
spectrum = 1.0
[camera]
hfov = 70
[sensor]
exposure = 0
window = [1e6, 1e9]
color = "bands"
"#;

/// A wall and a sky of all wavelengths, which D⁵ takes beyond f32 where they come on at γ = 10⁶: in
/// a view narrower than beaming, within 1/γ of their motion.
pub(crate) const GLARE: &str = r#"
[image]
size = [24, 16]
samples = 2
[worldline.moving]
velocity = VELOCITY
passes = [0, 0, -4]
at = -4
[[model]]
file = "wall.obj"
worldline = "moving"
material = "glaring"
scale = 1e-6
[material.glaring]
emission = { scale = 1e6, spectrum = 1.0 }
[background]
worldline = "moving"
spectrum = 1e6
[camera]
hfov = 1e-5
[sensor]
exposure = 0
"#;
