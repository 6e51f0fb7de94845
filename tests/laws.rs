//! Laws of the whole road, from text to World and to Film; each law with a planted fault that it
//! catches.

#[path = "laws/bytes.rs"]
mod bytes;
#[path = "laws/picture.rs"]
mod picture;
#[path = "laws/spelling.rs"]
mod spelling;
#[path = "laws/text.rs"]
mod text;
