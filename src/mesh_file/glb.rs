//! Binary glTF: a header, the document, and a buffer that it may refer to.
//!
//! **Source:** Khronos Group, "glTF 2.0 Specification", section 4.4.

use gltf::binary::Error as BinaryError;

use super::{Fault, Place};

/// A file header of 12 bytes, and 8 before the document.
pub(super) const HEAD: usize = 20;

/// Splits a binary file into its document and its buffer.
pub(super) fn parts(bytes: &[u8]) -> Result<(&[u8], Option<Vec<u8>>), Fault> {
    let length = bytes.get(8..12).and_then(|length| length.try_into().ok()).map(u32::from_le_bytes);
    // The crate takes 12 from this number.
    if length.is_none_or(|length| length < 12) {
        return Err(Fault::new("its head tells no length").at(Place::Byte(8)));
    }
    let version =
        bytes.get(4..8).and_then(|four| four.try_into().ok()).map_or(0, u32::from_le_bytes);
    if version != 2 {
        let fault = Fault::new(format!("it is binary glTF of version {version}, and 2 is read"));
        return Err(fault.at(Place::Byte(4)));
    }
    let glb = gltf::Glb::from_slice(bytes).map_err(|error| {
        let is_kind = matches!(
            error,
            gltf::Error::Binary(BinaryError::ChunkType(_) | BinaryError::UnknownChunkType(_))
        );
        let reason = match bytes.get(16..20) {
            Some(b"JSON") if is_kind => "its second part is not `BIN`",
            Some(b"JSON") => "the file ends before its parts do",
            Some(_) => "its first part is not `JSON`",
            None => "the file ends in its head",
        };
        Fault::new(reason).at(Place::Byte(12))
    })?;
    let end = HEAD + glb.json.len();
    let text = bytes.get(HEAD..end).unwrap_or_default();
    Ok((text, glb.bin.map(|bytes| bytes.into_owned())))
}
