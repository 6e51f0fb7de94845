//! `image_map`, `image_pattern` and `bump_map`: a picture's file, and how it is placed.
//!
//! **Source:** POV-Ray 3.7 manual, section 3.4.6.1.4 "Image Map"; defaults measured.

use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

use crate::color::Gamma;
use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::picture::read;
use crate::scene::TextureId;
use crate::syntax::ast::ExpressionId;
use crate::texture::ImageMap;
use crate::texture::image::conversion::{Purpose, SceneGamma};
use crate::texture::image::{Clear, Interpolation, MapType, NoIndex, Source};
use crate::texture::picture::Picture;
use crate::vocabulary::{Family, Word};

use super::super::include::missing_file;
use super::super::stream::{Token, TokenKind};
use super::super::{Evaluator, Outcome, Reported};
use super::named::{NamedFile, is_of_picture};
use super::{Given, Place};

/// Extensions that an image's name may omit.
const ENDINGS: &[&str] =
    &[".png", ".jpg", ".jpeg", ".gif", ".tga", ".ppm", ".pgm", ".tiff", ".hdr", ".exr", ".bmp"];

/// Pictures that were read, by the names of their files.
pub(in crate::evaluate) type Pictures = Rc<HashMap<String, Arc<Picture>>>;

/// What an image block says before its picture is placed.
#[derive(Default)]
struct OpenImage {
    gamma: Option<Gamma>,
    premultiplied: Option<bool>,
    map_type: MapType,
    once: bool,
    interpolation: Interpolation,
    source: Source,
    /// `filter` and `transmit`, with the index of a colour, or for all.
    clear: Vec<(Clear, Option<u8>, f64, Token)>,
    /// `bump_size`.
    amount: Option<f64>,
}

/// An image with the `bump_size` in its block.
pub(super) struct PlacedImage {
    pub image: ImageMap,
    pub amount: Option<f64>,
}

impl Evaluator<'_> {
    /// Reads the block of `image_map` and the like, after its keyword.
    pub(super) fn image(&mut self, token: &Token, word: Word) -> Outcome<PlacedImage> {
        self.image_with(token, word).map(|(placed, _)| placed)
    }

    /// Reads the block of `material_map`, after its keyword: an image and textures.
    pub(super) fn image_of_textures(
        &mut self,
        token: &Token,
    ) -> Outcome<(ImageMap, Vec<TextureId>)> {
        let (placed, textures) = self.image_with(token, Word::MaterialMap)?;
        if textures.is_empty() {
            let diagnostic =
                Diagnostic::new(Code::MissingPart, "this `material_map` has no textures")
                    .at(token.span, "expected `texture { … }` for each colour of the picture");
            return Err(self.report(&token.here, diagnostic));
        }
        Ok((placed.image, textures))
    }

    fn image_with(&mut self, token: &Token, word: Word) -> Outcome<(PlacedImage, Vec<TextureId>)> {
        self.block(token, word, |evaluator| {
            if let Some(Token { kind: TokenKind::Word(kind), .. }) = evaluator.peek()
                && kind.family() == Family::FileKind
            {
                evaluator.next();
            }
            if let Some(Token { kind: TokenKind::Expression(id), .. }) = evaluator.peek().cloned()
                && let Some(first) = evaluator.peek().cloned()
                && evaluator.misspelt_kind(&first, id)
            {
                return Err(Reported);
            }
            let file = evaluator.named_file(token, "the name of a picture's file")?;
            let picture = evaluator.picture(&file);
            let mut open = OpenImage::default();
            let (mut failed, mut textures) = (false, Vec::new());
            while let Some(token) = evaluator.next() {
                if word == Word::MaterialMap && token.kind == TokenKind::Word(Word::Texture) {
                    match evaluator.one_texture(&token) {
                        Ok(texture) => textures.push(evaluator.add_texture(texture)),
                        Err(Reported) => failed = true,
                    }
                    continue;
                }
                if evaluator.image_item(&token, word, &mut open) == Err(Reported) {
                    failed = true;
                    evaluator.skip_values();
                }
            }
            let picture = picture?;
            if failed {
                return Err(Reported);
            }
            Ok((evaluator.placed_image(word, picture, open)?, textures))
        })
    }

    fn placed_image(
        &mut self,
        word: Word,
        picture: Arc<Picture>,
        open: OpenImage,
    ) -> Outcome<PlacedImage> {
        let purpose = match word {
            Word::ImageMap => Purpose::Colors(SceneGamma {
                assumed: self.scene.settings.assumed_gamma,
                is_stated: self.says_gamma,
                is_old: self.is_before(3.7),
            }),
            _ => Purpose::Values,
        };
        let mut image = ImageMap::new(picture, purpose, open.gamma, open.premultiplied);
        image.map_type = open.map_type;
        image.once = open.once;
        image.interpolation = open.interpolation;
        image.source = match (word, open.source) {
            // Its values are brightness all the same (measured on POV-Ray 3.7, on pictures with and without a
            // palette).
            (Word::ImagePattern, Source::Index) => Source::Color,
            (_, source) => source,
        };
        for (which, index, amount, token) in open.clear {
            let Err(fault) = image.set_clear(which, index, amount) else { continue };
            let name = if which == Clear::Filter { "filter" } else { "transmit" };
            let message = match fault {
                NoIndex::NoPalette => {
                    format!("`{name}` with an index needs a picture with a palette")
                }
                NoIndex::Beyond(count) => {
                    format!("the palette of this picture has {count} colours")
                }
            };
            let diagnostic = Diagnostic::new(Code::OutOfRange, message)
                .at(token.span, "there is no colour of this index")
                .help(format!("write `{name} all {amount}` for all colours"));
            return Err(self.report(&token.here, diagnostic));
        }
        Ok(PlacedImage { image, amount: open.amount })
    }

    fn image_item(&mut self, token: &Token, of: Word, open: &mut OpenImage) -> Outcome<()> {
        let word = match &token.kind {
            TokenKind::Word(word) => *word,
            TokenKind::Comma => return Ok(()),
            TokenKind::Expression(id) if self.misspelt_item(token, *id, Word::ImageMap) => {
                return Err(Reported);
            }
            _ => {
                self.unexpected(token, Place::IMAGE);
                return Err(Reported);
            }
        };
        match word {
            Word::GammaWord => {
                open.gamma = Some(match self.take_word(Word::Srgb) {
                    Some(_) => Gamma::Srgb,
                    None => Gamma::Power(self.number_of(token, word)?.value),
                });
            }
            Word::Premultiplied => open.premultiplied = Some(self.optional_flag(token)?),
            Word::MapType => {
                let given = self.number_after(token, "0, 1, 2 or 5")?;
                match whole(&given).and_then(MapType::of_number) {
                    Some(map_type) => open.map_type = map_type,
                    None => return Err(self.out_of_range(&given, word, "0, 1, 2 or 5")),
                }
            }
            Word::Once => open.once = true,
            Word::Interpolate => {
                let given = self.number_after(token, "2, 3 or 4")?;
                match whole(&given).and_then(Interpolation::of_number) {
                    Some(interpolation) => open.interpolation = interpolation,
                    None => return Err(self.out_of_range(&given, word, "2, 3 or 4")),
                }
            }
            Word::UseColor => open.source = Source::Color,
            Word::UseIndex => open.source = Source::Index,
            Word::UseAlpha if of != Word::ImagePattern => {
                let message = format!("`use_alpha` has no meaning in `{}`", of.name());
                let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                    .at(token.span, "only the values of an `image_pattern` may be those of alpha")
                    .help("leave it out");
                return Err(self.report(&token.here, diagnostic));
            }
            Word::UseAlpha => open.source = Source::Alpha,
            Word::BumpSize => open.amount = Some(self.number_after(token, "a number")?.value),
            Word::Filter | Word::Transmit => {
                let which = if word == Word::Filter { Clear::Filter } else { Clear::Transmit };
                let index = match self.take_word(Word::All) {
                    Some(_) => None,
                    None => Some(self.number_after(token, "the index of a colour, or `all`")?),
                };
                let amount = self.number_after(token, "a number")?.value;
                // POV-Ray accepts -1, as 0 (measured).
                if let Some(given) = index.as_ref().filter(|it| !(-1.0..256.0).contains(&it.value))
                {
                    return Err(self.out_of_range(given, word, "an index from 0 to 255, or `all`"));
                }
                let index = index.map(|Given { value, .. }| value as u8);
                open.clear.push((which, index, amount, token.clone()));
            }
            _ => {
                self.unexpected(token, Place { word: Some(of), ..Place::IMAGE });
                return Err(Reported);
            }
        }
        Ok(())
    }

    /// Returns the picture of a file, which is read once.
    fn picture(&mut self, file: &NamedFile) -> Outcome<Arc<Picture>> {
        let NamedFile { name, here, span } = file;
        let found = match self.read_named(file, ENDINGS) {
            Ok(found) => found,
            Err(error) => {
                let diagnostic = missing_file(name, *span, error, is_of_picture);
                return Err(self.report(here, diagnostic));
            }
        };
        if let Some(known) = self.pictures.get(&found.name) {
            return Ok(known.clone());
        }
        match read::read(&found.bytes) {
            Ok(picture) => {
                let picture = Arc::new(picture);
                self.stored += found.bytes.len() as u64;
                Rc::make_mut(&mut self.pictures).insert(found.name, picture.clone());
                Ok(picture)
            }
            Err(fault) => {
                let message = format!("`{name}` cannot be read as a picture: {fault}");
                let diagnostic = Diagnostic::new(Code::UnreadableFile, message)
                    .at(*span, "expected a PNG, GIF, JPEG, TGA, TIFF, PPM, PGM, BMP, HDR or EXR");
                Err(self.report(here, diagnostic))
            }
        }
    }

    /// Reports another tool's name for an image type: `jpg "file"`.
    fn misspelt_kind(&mut self, token: &Token, id: ExpressionId) -> bool {
        if self.unknown_name(&token.here, id).is_none() {
            return false;
        }
        let name = self.sources.text(token.span).to_owned();
        let kinds = || {
            let kinds = Word::ALL.iter().filter(|word| word.family() == Family::FileKind);
            kinds.map(|word| word.name())
        };
        let near = suggest::foreign(&name)
            .find(|ours| kinds().any(|kind| kind == *ours))
            .or_else(|| suggest::closest(&name, kinds()));
        let Some(near) = near else { return false };
        let message = format!("`{name}` is not a kind of picture");
        let diagnostic = Diagnostic::new(Code::UnknownWord, message)
            .at(token.span, format!("did you mean `{near}`?"))
            .help(format!("replace it with `{near}`"))
            .fix(token.span, near);
        self.report(&token.here, diagnostic);
        self.skip_values();
        true
    }
}

/// Returns a number without its fraction; `None` below 0.
fn whole(given: &Given<f64>) -> Option<u32> {
    (given.value > -1.0).then_some(given.value as u32)
}
