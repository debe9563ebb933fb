//! Random damage to small model files: any answer will do but a panic.

use super::bad::write;
use super::blender::here;
use proptest::prelude::*;
use restframe::scene::model::load;

/// Overwrites, deletes or repeats bytes.
fn damage(bytes: &mut Vec<u8>, wounds: &[(usize, u8, u8)]) {
    for &(at, kind, value) in wounds {
        if bytes.is_empty() {
            return;
        }
        let at = at % bytes.len();
        match kind % 4 {
            0 => bytes[at] = value,
            1 => bytes[at] ^= 1 << (value % 8),
            2 => drop(bytes.drain(at..(at + usize::from(value)).min(bytes.len()))),
            _ => bytes.insert(at, value),
        }
    }
}

/// Replaces whole numbers in the text, lengths kept where they can be.
fn renumber(bytes: &mut [u8], at: usize, digit: u8) {
    let digits: Vec<usize> = (0..bytes.len())
        .filter(|&i| bytes[i].is_ascii_digit())
        .collect();
    if let Some(&i) = digits.get(at % digits.len().max(1)) {
        bytes[i] = b'0' + digit % 10;
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..Default::default() })]

    #[test]
    fn damaged_models_do_not_panic(
        which in 0usize..5,
        wounds in prop::collection::vec((any::<usize>(), any::<u8>(), any::<u8>()), 0..6),
        digits in prop::collection::vec((any::<usize>(), any::<u8>()), 0..4),
    ) {
        let file = ["units-spot.glb", "units-emissive.glb", "bar.obj", "bar.mtl", "zoo-groups.obj"][which];
        let mut bytes = std::fs::read(here("tests/models").join(file)).unwrap();
        damage(&mut bytes, &wounds);
        for (at, digit) in digits {
            // Only the text of a glb, which stands at its front.
            let end = bytes.len().min(if file.ends_with("glb") { 1600 } else { usize::MAX });
            renumber(&mut bytes[..end], at, digit);
        }
        let folder = tempfile::tempdir().unwrap();
        let path = match file.strip_suffix(".mtl") {
            Some(_) => {
                write(folder.path(), file, &bytes);
                let obj = std::fs::read(here("tests/models/bar.obj")).unwrap();
                write(folder.path(), "bar.obj", &obj)
            }
            None => write(folder.path(), file, &bytes),
        };
        if let Ok(model) = load(&path, &[]) {
            let total = model.area();
            prop_assert!(total >= 0.0 && model.bounds().is_some() || model.triangles() == 0);
            for mesh in &model.meshes {
                prop_assert!(mesh.positions.iter().all(|p| p.is_finite()));
            }
        }
    }
}
