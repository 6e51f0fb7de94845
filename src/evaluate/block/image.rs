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
use super::parts::{Block, Part, Parts};
use super::{Given, Place};

/// Extensions that an image's name may omit.
const ENDINGS: &[&str] =
    &[".png", ".jpg", ".jpeg", ".gif", ".tga", ".ppm", ".pgm", ".tiff", ".hdr", ".exr", ".bmp"];

/// Pictures that were read, by the names of their files.
pub(in crate::evaluate) type Pictures = Rc<HashMap<String, Arc<Picture>>>;

/// What an image block says before its picture is placed.
#[derive(Default)]
struct OpenImage {
    /// The word of the block.
    of: Option<Word>,
    /// Those of a `material_map`.
    textures: Vec<TextureId>,
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

impl Block for OpenImage {
    const PLACE: Place = Place::IMAGE;
    const PARTS: Parts<Self> = &[
        Part::Special(Word::GammaWord, |evaluator, token, image| {
            image.gamma = Some(evaluator.gamma_after(token, Word::GammaWord)?);
            Ok(())
        }),
        Part::Optional(Word::Premultiplied, |image, on, _| image.premultiplied = Some(on != 0.0)),
        Part::Choice(Word::MapType, "0, 1, 2 or 5", |image, number| {
            MapType::of_number(number).map(|map_type| image.map_type = map_type)
        }),
        Part::Flag(Word::Once, |image, (), _| image.once = true),
        Part::Choice(Word::Interpolate, "2, 3 or 4", |image, number| {
            Interpolation::of_number(number).map(|it| image.interpolation = it)
        }),
        Part::Flag(Word::UseColor, |image, (), _| image.source = Source::Color),
        Part::Flag(Word::UseIndex, |image, (), _| image.source = Source::Index),
        Part::Special(Word::UseAlpha, |evaluator, token, image| evaluator.use_alpha(token, image)),
        Part::Number(Word::BumpSize, |image, amount, _| image.amount = Some(amount)),
        Part::Special(Word::Filter, |evaluator, token, image| {
            evaluator.clear_color(token, Clear::Filter, image)
        }),
        Part::Special(Word::Transmit, |evaluator, token, image| {
            evaluator.clear_color(token, Clear::Transmit, image)
        }),
    ];

    fn other(&mut self, evaluator: &mut Evaluator, token: &Token) -> Option<Outcome<()>> {
        match token.kind {
            TokenKind::Word(Word::Texture) if self.of == Some(Word::MaterialMap) => {
                Some(evaluator.one_texture(token).map(|texture| {
                    self.textures.push(evaluator.add_texture(texture));
                }))
            }
            TokenKind::Word(_) => {
                Some(evaluator.other_item(token, Place { word: self.of, ..Place::IMAGE }))
            }
            TokenKind::Expression(id) if evaluator.misspelt_item(token, id, Word::ImageMap) => {
                Some(Err(Reported))
            }
            _ => None,
        }
    }
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
            if let Some(function @ Token { kind: TokenKind::Word(Word::Function), .. }) =
                evaluator.peek().cloned()
            {
                let name = word.name();
                let message = format!("`{name}` of a function is not supported yet");
                let diagnostic = Diagnostic::new(Code::NotSupportedYet, message)
                    .at(function.span, "only pictures in files are")
                    .help("`pigment { function { … } color_map { … } }` shows its values");
                return Err(evaluator.report(&function.here, diagnostic));
            }
            if let Some(Token { kind: TokenKind::Expression(id), .. }) = evaluator.peek().cloned()
                && let Some(first) = evaluator.peek().cloned()
                && evaluator.misspelt_kind(&first, id)
            {
                return Err(Reported);
            }
            let file = evaluator.named_file(token, "the name of a picture's file")?;
            let picture = evaluator.picture(&file);
            let mut open = OpenImage { of: Some(word), ..OpenImage::default() };
            let read = evaluator.parts(&mut open);
            let picture = picture?;
            read?;
            let textures = std::mem::take(&mut open.textures);
            Ok((evaluator.placed_image(picture, open)?, textures))
        })
    }

    fn placed_image(&mut self, picture: Arc<Picture>, open: OpenImage) -> Outcome<PlacedImage> {
        let purpose = match open.of {
            Some(Word::ImageMap) => Purpose::Colors(SceneGamma {
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
        image.source = match (open.of, open.source) {
            // Its values are brightness all the same (measured on POV-Ray 3.7, on pictures with and without a
            // palette).
            (Some(Word::ImagePattern), Source::Index) => Source::Color,
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

    fn use_alpha(&mut self, token: &Token, image: &mut OpenImage) -> Outcome<()> {
        if image.of != Some(Word::ImagePattern) {
            let place = Place { word: image.of, ..Place::IMAGE };
            let message = format!("`use_alpha` has no meaning {}", place.name());
            let diagnostic = Diagnostic::new(Code::ExtraPart, message)
                .at(token.span, "only the values of an `image_pattern` may be those of alpha")
                .help("leave it out");
            return Err(self.report(&token.here, diagnostic));
        }
        image.source = Source::Alpha;
        Ok(())
    }

    /// Reads `filter index, amount` and the like.
    fn clear_color(&mut self, token: &Token, which: Clear, image: &mut OpenImage) -> Outcome<()> {
        let index = match self.take_word(Word::All) {
            Some(_) => None,
            None => Some(self.number_after(token, "the index of a colour, or `all`")?),
        };
        let amount = self.number_after(token, "a number")?.value;
        // POV-Ray accepts -1, as 0 (measured).
        if let Some(given) = index.as_ref().filter(|it| !(-1.0..256.0).contains(&it.value)) {
            let word = if which == Clear::Filter { Word::Filter } else { Word::Transmit };
            return Err(self.out_of_range(given, word, "an index from 0 to 255, or `all`"));
        }
        let index = index.map(|Given { value, .. }| value as u8);
        image.clear.push((which, index, amount, token.clone()));
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
