//! Numbers from buffers, with every range checked before a byte is read.
//!
//! An accessor without a buffer view is all zeros except for its sparse values. Source: Khronos
//! glTF 2.0 specification, section 3.6.2 (accessors, including sparse ones).

use super::extensions::unsupported;
use super::source::Source;
use crate::model::ModelError;
use ::gltf::json::accessor::{Accessor, ComponentType, Type, sparse::Sparse};
use ::gltf::json::buffer::View;
use ::gltf::json::validation::Checked;
use ::gltf::json::{Index, validation::USize64};

/// Number of accessor elements decoded for one file at most; shared accessors count each time.
pub(super) const MAX_ELEMENTS: u64 = 1 << 27;

/// Number of elements of an all-zero accessor at most, since these cost the file no bytes.
const MAX_ZEROS: u64 = 1 << 22;

/// Size of one element at most: four numbers of 4 bytes.
const MAX_BYTES: usize = 16;

/// Layout of an accessor's elements.
#[derive(Clone, Copy)]
struct Layout {
    component: ComponentType,
    components: usize,
}

impl Layout {
    fn bytes(self) -> usize {
        self.component.size() * self.components
    }
}

impl Source<'_> {
    /// Vectors of N numbers, of one of the given component types. Integers are normalized.
    pub(super) fn vectors<const N: usize>(
        &self,
        index: Index<Accessor>,
        accepted: &[ComponentType],
        from: &str,
    ) -> Result<Vec<[f64; N]>, ModelError> {
        let (accessor, layout, at) = self.accessor(index, from)?;
        if layout.components != N || !accepted.contains(&layout.component) {
            let found = format!(
                "{} numbers of type {:?}",
                layout.components, layout.component
            );
            let problem = format!(
                "has {found}, expected {N} of {accepted:?}; quantized or compressed geometry is not supported: export without"
            );
            return Err(self.invalid(&at, problem));
        }
        let size = layout.component.size();
        let decode = |bytes: &[u8]| {
            let mut vector = [0.0; N];
            for (value, bytes) in vector.iter_mut().zip(bytes.chunks_exact(size)) {
                *value = number(bytes, layout.component);
            }
            vector
        };
        self.elements(accessor, layout, &at, decode)
    }

    /// Vertex indices.
    pub(super) fn indices(
        &self,
        index: Index<Accessor>,
        from: &str,
    ) -> Result<Vec<u32>, ModelError> {
        let (accessor, layout, at) = self.accessor(index, from)?;
        if layout.components != 1 || !is_index(layout.component) {
            let found = format!(
                "{} numbers of type {:?}",
                layout.components, layout.component
            );
            return Err(self.invalid(&at, format!("has {found}, expected 1 of U8, U16 or U32")));
        }
        self.elements(accessor, layout, &at, unsigned)
    }

    /// Number of elements of an accessor that the file really contains. Zeros cost it no bytes, and
    /// would be as many instances in one place.
    pub(super) fn written(&self, index: Index<Accessor>, from: &str) -> Result<u64, ModelError> {
        let (accessor, _, at) = self.accessor(index, from)?;
        let count = accessor.count.0;
        let replaced = accessor.sparse.as_ref().map_or(0, |s| s.count.0);
        if accessor.buffer_view.is_none() && replaced < count.div_ceil(2) {
            let problem = format!(
                "has {count} instances of which the file holds only {replaced}, expected a buffer view: export the instances again, or as nodes"
            );
            return Err(self.invalid(&at, problem));
        }
        Ok(count)
    }

    fn accessor(
        &self,
        index: Index<Accessor>,
        from: &str,
    ) -> Result<(&Accessor, Layout, String), ModelError> {
        let accessor = self.item(&self.root.accessors, index, "accessor", from)?;
        let at = format!("accessor {}, of {from},", index.value());
        let (Checked::Valid(kind), Checked::Valid(component)) =
            (accessor.type_, accessor.component_type)
        else {
            return Err(self.invalid(&at, "is of unknown type"));
        };
        if matches!(kind, Type::Mat2 | Type::Mat3 | Type::Mat4) {
            return Err(self.invalid(&at, "holds matrices, expected vectors or numbers"));
        }
        let layout = Layout {
            component: component.0,
            components: kind.multiplicity(),
        };
        Ok((accessor, layout, at))
    }

    fn elements<T: Clone>(
        &self,
        accessor: &Accessor,
        layout: Layout,
        at: &str,
        decode: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<T>, ModelError> {
        let count = accessor.count.0;
        self.spend(count)?;
        let mut elements = match accessor.buffer_view {
            Some(view) => {
                let offset = accessor.byte_offset.unwrap_or_default().0;
                let bytes = self.strided(view, offset, count, layout.bytes(), at)?;
                bytes.map(&decode).collect()
            }
            None if count <= MAX_ZEROS => {
                vec![decode(&[0; MAX_BYTES][..layout.bytes()]); count as usize]
            }
            None => {
                let problem = format!(
                    "has {count} elements and no buffer view, expected at most {MAX_ZEROS}"
                );
                return Err(self.invalid(at, problem));
            }
        };
        if let Some(sparse) = &accessor.sparse {
            self.replace(&mut elements, sparse, layout, at, decode)?;
        }
        Ok(elements)
    }

    fn replace<T>(
        &self,
        elements: &mut [T],
        sparse: &Sparse,
        layout: Layout,
        at: &str,
        decode: impl Fn(&[u8]) -> T,
    ) -> Result<(), ModelError> {
        let (indices, values) = (&sparse.indices, &sparse.values);
        let component = match indices.component_type {
            Checked::Valid(kind) if is_index(kind.0) => kind.0,
            _ => return Err(self.invalid(at, "has sparse indices of unknown type")),
        };
        let count = sparse.count.0;
        self.spend(count)?;
        let places = self.strided(
            indices.buffer_view,
            indices.byte_offset.0,
            count,
            component.size(),
            at,
        )?;
        let values = self.strided(
            values.buffer_view,
            values.byte_offset.0,
            count,
            layout.bytes(),
            at,
        )?;
        let total = elements.len();
        for (place, value) in places.map(unsigned).zip(values) {
            let element = elements.get_mut(place as usize).ok_or_else(|| {
                self.invalid(at, format!("replaces element {place} but has only {total}"))
            })?;
            *element = decode(value);
        }
        Ok(())
    }

    /// The bytes of `count` elements within a buffer view.
    fn strided(
        &self,
        view: Index<View>,
        offset: u64,
        count: u64,
        size: usize,
        at: &str,
    ) -> Result<impl Iterator<Item = &[u8]>, ModelError> {
        let bytes = self.view(view, at)?;
        // A stride of 0 violates a rule and means none, as in OpenGL.
        let stride = self.root.buffer_views[view.value()].byte_stride;
        let stride = stride.map(|s| s.0).filter(|&s| s > 0).unwrap_or(size);
        if stride < size {
            let problem = format!("has a stride of {stride} bytes, expected at least {size}");
            return Err(self.invalid(at, problem));
        }
        let span = match count {
            0 => Some(0),
            _ => (count - 1)
                .checked_mul(stride as u64)
                .and_then(|v| v.checked_add(size as u64)),
        };
        let end = span.and_then(|span| span.checked_add(offset));
        let fitting = end.filter(|&end| end <= bytes.len() as u64);
        let (Some(end), Some(span)) = (fitting, span) else {
            let problem = format!(
                "has {count} elements of {size} bytes from byte {offset} on, beyond the {} bytes of buffer view {}: the file is cut short or broken",
                bytes.len(),
                view.value()
            );
            return Err(self.invalid(at, problem));
        };
        let data = &bytes[(end - span) as usize..end as usize];
        Ok(data.chunks(stride).map(move |chunk| &chunk[..size]))
    }

    fn view(&self, index: Index<View>, at: &str) -> Result<&[u8], ModelError> {
        let view = self.item(&self.root.buffer_views, index, "buffer view", at)?;
        let from = format!("buffer view {}", index.value());
        let buffer = self.item(&self.root.buffers, view.buffer, "buffer", &from)?;
        let buffer = self.buffers.bytes(view.buffer.value(), buffer);
        let buffer = buffer.map_err(|error| {
            // The fallback of a compressed view may have no bytes at all.
            let extensions = &self.raw["bufferViews"][index.value()]["extensions"];
            let names = ["EXT_meshopt_compression", "KHR_meshopt_compression"];
            let name = names.into_iter().find(|name| extensions[name].is_object());
            name.map_or(error, |name| unsupported(name, &self.file))
        })?;
        let start = view.byte_offset.unwrap_or_default().0;
        let USize64(length) = view.byte_length;
        let range = usize::try_from(start)
            .ok()
            .zip(usize::try_from(length).ok());
        range
            .and_then(|(start, length)| buffer.get(start..)?.get(..length))
            .ok_or_else(|| {
                let total = buffer.len();
                let problem =
                    format!("has {length} bytes from byte {start} on, beyond its buffer's {total}");
                self.invalid(&from, problem)
            })
    }

    /// Counts elements against [`MAX_ELEMENTS`].
    pub(super) fn spend(&self, count: u64) -> Result<(), ModelError> {
        let left = self.elements_left.get().checked_sub(count);
        self.elements_left
            .set(left.ok_or_else(|| ModelError::TooMany {
                file: self.file.clone(),
                what: "vertices and indices",
                count: count.saturating_add(MAX_ELEMENTS - self.elements_left.get()),
                limit: MAX_ELEMENTS,
            })?);
        Ok(())
    }
}

fn is_index(component: ComponentType) -> bool {
    matches!(
        component,
        ComponentType::U8 | ComponentType::U16 | ComponentType::U32
    )
}

/// A little-endian unsigned number of up to 4 bytes.
fn unsigned(bytes: &[u8]) -> u32 {
    bytes
        .iter()
        .rev()
        .fold(0, |value, &byte| value << 8 | u32::from(byte))
}

/// One component; integers are normalized (glTF 2.0, section 3.6.2.2).
fn number(bytes: &[u8], component: ComponentType) -> f64 {
    let bits = unsigned(bytes);
    match component {
        ComponentType::F32 => f64::from(f32::from_bits(bits)),
        ComponentType::I8 => (f64::from(bits as u8 as i8) / 127.0).max(-1.0),
        ComponentType::I16 => (f64::from(bits as u16 as i16) / 32767.0).max(-1.0),
        ComponentType::U8 => f64::from(bits) / 255.0,
        ComponentType::U16 => f64::from(bits) / 65535.0,
        ComponentType::U32 => f64::from(bits) / f64::from(u32::MAX),
    }
}
