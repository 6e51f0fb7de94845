//! Laws of the whole road, from text to World and to Film; each law with a planted fault that it
//! catches.

mod alpha;
mod bytes;
mod picture;
mod spelling;
mod text;
