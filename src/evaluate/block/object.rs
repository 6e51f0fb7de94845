//! Shapes, unions and uses of objects, with their modifiers in source order.

use crate::diagnostic::{Code, Diagnostic};
use crate::scene::{Modifier, ModifierKind, Object, ObjectId, ObjectKind, Operation};
use crate::vocabulary::{Dialect, Family, Word};

use super::super::stream::{Token, TokenKind};
use super::super::value::Value;
use super::super::{Evaluator, Outcome, Reported};
use super::{Place, opens_object};

/// Properties of an object, resolved through all levels of use.
#[derive(Debug, Clone, Copy)]
pub(in crate::evaluate) struct Made {
    /// Keyword of its kind.
    pub(super) word: Word,
    /// Whether it, or the object that it uses, has its own texture.
    pub(super) textured: bool,
}

fn own_word(kind: &ObjectKind) -> Word {
    match kind {
        ObjectKind::Solid(solid) => solid.word(),
        ObjectKind::Union(_) | ObjectKind::Use(_) => Word::Union,
        ObjectKind::Csg { operation, .. } => operation.word(),
        ObjectKind::LightSource(_) => Word::LightSource,
    }
}

impl Evaluator<'_> {
    /// Reads the object that `token` opens; returns an object, or poison.
    pub(super) fn object(&mut self, token: &Token, word: Word) -> Outcome<Value> {
        let outer = self.poison.take();
        let built = match word {
            Word::Union => self.shape(token, word, Self::union),
            Word::Merge => self.csg(token, word, Operation::Merge),
            Word::Intersection => self.csg(token, word, Operation::Intersection),
            Word::Difference => self.csg(token, word, Operation::Difference),
            Word::Object => self.shape(token, word, Self::object_use),
            Word::LightSource => self.light_source(token),
            Word::LightGroup => self.light_group(token),
            _ => match Self::parts_of(word) {
                Some(parts) => self.shape(token, word, |evaluator, token| {
                    parts(evaluator, token).map(ObjectKind::Solid)
                }),
                None => Err(self.unbuilt_word(token, word)),
            },
        };
        match (std::mem::replace(&mut self.poison, outer), built) {
            (Some(poison), _) => Ok(Value::Poison(poison)),
            (None, built) => built.map(Value::Object),
        }
    }

    /// Reads the block of a word that contains one object: `looks_like { … }`.
    pub(super) fn object_block(&mut self, token: &Token) -> Outcome<ObjectId> {
        self.shape(token, Word::Object, Self::object_use)
    }

    pub(super) fn add_object(&mut self, object: Object) -> Outcome<ObjectId> {
        let limit = self.options.limits.objects;
        if self.scene.objects.len() as u64 >= limit {
            let expansion = object.site.expansion;
            let diagnostic = Diagnostic::new(
                Code::ObjectLimit,
                format!("the scene has more than {limit} objects"),
            )
            .at(object.site.span, "this object is one too many")
            .help("raise the limit with `--limit objects=N`");
            return Err(self.halt(expansion, diagnostic));
        }
        self.stored += size_of_val(&object.modifiers[..]) as u64;
        let used = match object.kind {
            ObjectKind::Use(used) => self.made.get(used.index()).copied(),
            _ => None,
        };
        let textured = |m: &Modifier| matches!(m.kind, ModifierKind::Texture(_));
        self.made.push(Made {
            word: used.map_or_else(|| own_word(&object.kind), |used| used.word),
            textured: object.modifiers.iter().any(textured) || used.is_some_and(|u| u.textured),
        });
        self.scene.objects.push(object);
        Ok(ObjectId(self.scene.objects.len() as u32 - 1))
    }

    /// Reads a block of `parts` followed by modifiers, or a declared object of the same kind.
    fn shape(
        &mut self,
        token: &Token,
        word: Word,
        parts: impl FnOnce(&mut Self, &Token) -> Outcome<ObjectKind>,
    ) -> Outcome<ObjectId> {
        let site = token.here.site(token.span);
        let mut modifiers = Vec::new();
        let kind = self.block(token, word, |evaluator| {
            let kind = match evaluator.declared_object(word) {
                Some(kind) => kind,
                None => parts(evaluator, token),
            };
            if kind.is_err() {
                evaluator.skip_shape_parts();
            }
            modifiers.extend(evaluator.paint_of_file());
            let used = match kind {
                Ok(ObjectKind::Use(used)) => Some(used),
                _ => None,
            };
            let (owed, before) = (evaluator.owed.take(), evaluator.reports);
            let modified = evaluator.modifiers(word, used, &mut modifiers);
            if let Some((here, diagnostic)) = owed
                && evaluator.reports == before
            {
                evaluator.report(&here, diagnostic);
            }
            modified?;
            kind
        })?;
        modifiers.shrink_to_fit();
        self.add_object(Object { kind, modifiers, site, item: None })
    }

    /// Reads a declared object in place of the parts: `sphere { Ball … }`.
    fn declared_object(&mut self, word: Word) -> Option<Outcome<ObjectKind>> {
        match *self.peek_declared()? {
            Value::Object(object) => {
                let token = self.next()?;
                let copy = match word.family() {
                    Family::Csg => self.copy_without_word(&token, &Value::Object(object)),
                    _ => None,
                };
                if let Some(reported) = copy {
                    // The others are read for their own mistakes.
                    let _: Outcome<ObjectKind> = self.union(&token);
                    return Some(Err(reported));
                }
                if word.family() == Family::Csg && self.object_follows() {
                    let text = self.sources.text(token.span).to_owned();
                    let diagnostic = Diagnostic::new(
                        Code::WrongType,
                        format!("`{text}` stands in a `{}` without `object`", word.name()),
                    )
                    .at(token.span, "a declared object")
                    .help(format!("write `object {{ {text} }}`"))
                    .fix(token.span, format!("object {{ {text} }}"));
                    let reported = self.report(&token.here, diagnostic);
                    // The others are read for their own mistakes.
                    let _: Outcome<ObjectKind> = self.union(&token);
                    return Some(Err(reported));
                }
                if let Some(reported) = self.wrong_kind(&token, word, object) {
                    return Some(Err(reported));
                }
                Some(Ok(ObjectKind::Use(object)))
            }
            Value::Poison(poison) => {
                self.next();
                if let Some(comma) = self.next_if(|kind| matches!(kind, TokenKind::Comma)) {
                    self.warn_of_comma(&comma, Place::shape(word));
                }
                self.set_poison(poison);
                Some(Err(Reported))
            }
            Value::Broken => {
                let token = self.next()?;
                // Its own mistake was reported; its intended kind is known.
                let symbol = self.scopes.symbol(self.sources.text(token.span));
                let own = symbol.and_then(|symbol| self.declared_as(symbol)).map(|(own, _)| own);
                let is_object = |own: &Word| matches!(own.family(), Family::Shape | Family::Csg);
                if let Some(own) = own.filter(is_object) {
                    self.wrong_kind_of(&token, word, own);
                }
                Some(Err(Reported))
            }
            _ => None,
        }
    }

    /// Returns whether another object comes next, with or without a comma before it.
    fn object_follows(&mut self) -> bool {
        let Some(next) = self.peek().cloned() else { return false };
        let name = match next.kind {
            TokenKind::Word(word) => return opens_object(word),
            TokenKind::Expression(_) => self.sources.text(next.span),
            TokenKind::Comma => {
                let text = &self.sources.get(next.span.file).text;
                let behind = text.get(next.span.end as usize..).unwrap_or("").trim_start();
                let of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
                let name = &behind[..behind.len() - behind.trim_start_matches(of_name).len()];
                if Word::from_name(name).is_some_and(opens_object) {
                    return true;
                }
                name
            }
            _ => return false,
        };
        let value = self.scopes.symbol(name).and_then(|symbol| self.scopes.look(symbol));
        matches!(value, Some(Value::Object(_)))
    }

    /// Reports a declared object in a block of another kind, which only `object` accepts: `plane { Ball }`.
    pub(super) fn wrong_kind(
        &mut self,
        token: &Token,
        word: Word,
        object: ObjectId,
    ) -> Option<Reported> {
        self.wrong_kind_of(token, word, self.made[object.index()].word)
    }

    fn wrong_kind_of(&mut self, token: &Token, word: Word, own: Word) -> Option<Reported> {
        if own == word || matches!(word, Word::Object | Word::Union) {
            return None;
        }
        let text = self.sources.text(token.span).to_owned();
        let message = format!("`{text}` is a `{}`, and stands in a `{}`", own.name(), word.name());
        let mut diagnostic = Diagnostic::new(Code::WrongType, message)
            .at(token.span, format!("this is a `{}`", own.name()))
            .help(format!("a declared object of any kind is placed by `object {{ {text} }}`"));
        let symbol = self.scopes.symbol(&text);
        if let Some(declared) = symbol.and_then(|symbol| self.scopes.declared(symbol)) {
            diagnostic = diagnostic.also(declared.site.span, "declared here");
        }
        self.opinion(&token.here, diagnostic).err()
    }

    /// Takes a name of an unsupported value, and records it.
    pub(super) fn takes_poison(&mut self) -> bool {
        let Some(Token { kind: TokenKind::Expression(id), here, .. }) = self.peek() else {
            return false;
        };
        let (id, here) = (*id, here.clone());
        match self.named(&here, id) {
            Some(Value::Poison(poison)) => {
                self.next();
                self.set_poison(poison);
                true
            }
            _ => false,
        }
    }

    /// Reads `object { Name … }` or `object { sphere { … } … }`.
    fn object_use(&mut self, token: &Token) -> Outcome<ObjectKind> {
        self.skip_commas();
        let Some(next) = self.peek().cloned() else {
            return Err(self.expected("a declared object", None, (&token.here, token.span)));
        };
        let value = match next.kind {
            TokenKind::Word(word) if opens_object(word) => {
                self.next();
                self.object(&next, word)?
            }
            TokenKind::Expression(id) => {
                self.next();
                match self.misspelt_block(&next, id) {
                    Some(reported) => return Err(reported),
                    None => self.expression(&next.here, id)?,
                }
            }
            // Items that an object accepts remain, and are read as such.
            _ => {
                if let TokenKind::Word(word) = next.kind
                    && word.family() == Family::Pattern
                {
                    self.next();
                    return Err(self.word_for_object(&next, word));
                }
                if let TokenKind::Word(Word::Ttf | Word::Internal) = next.kind {
                    return Err(self.letters_in_object(token, &next));
                }
                if let Some(reported) = self.late_parts(token, &next, "the declared object") {
                    return Err(reported);
                }
                let at = (&token.here, token.span);
                return Err(self.expected("a declared object", Some(&next), at));
            }
        };
        match value {
            Value::Object(object) => Ok(ObjectKind::Use(object)),
            Value::Poison(poison) => {
                self.set_poison(poison);
                Err(Reported)
            }
            other => Err(self.wrong_type(&next.here, next.span, "an object", &other)),
        }
    }

    /// Reports text in an object: `object { ttf "…" … }`.
    fn letters_in_object(&mut self, opener: &Token, font: &Token) -> Reported {
        let told =
            Diagnostic::new(Code::ExpectedExpression, "letters stand in `text`, not in `object`")
                .at(font.span, "expected a declared object")
                .also(opener.span, "did you mean `text`?")
                .help("write `text { ttf \"file\" \"string\" thickness, offset }`")
                .fix(opener.span, "text");
        let reported = self.report(&font.here, told);
        self.next();
        self.skip_values();
        reported
    }

    /// Reports a keyword where a declared name is meant: `object { marble }` with a declared `Marble`.
    fn word_for_object(&mut self, next: &Token, word: Word) -> Reported {
        let name = word.name();
        let message = format!("expected a declared object, found `{name}`");
        let diagnostic = Diagnostic::new(Code::ExpectedExpression, message);
        let meant = self.scopes.visible().find(|declared| declared.eq_ignore_ascii_case(name));
        let diagnostic = match meant.map(str::to_owned) {
            Some(meant) => diagnostic
                .at(next.span, format!("did you mean `{meant}`?"))
                .help(format!("replace it with `{meant}`"))
                .fix(next.span, meant),
            None => diagnostic.at(next.span, "expected a declared object"),
        };
        self.report(&next.here, diagnostic)
    }

    fn csg(&mut self, token: &Token, word: Word, operation: Operation) -> Outcome<ObjectId> {
        let (told, lost, mut count) = (self.diagnostics.len(), self.lost_children, 0);
        let shape = self.shape(token, word, |evaluator, _| {
            let children = evaluator.children();
            count = children.len();
            evaluator.lint_light_of_csg(word, operation, &children);
            Ok(ObjectKind::Csg { operation, children })
        });
        // If a part was misread, that is reported.
        if count == 1 && self.diagnostics.len() == told && self.lost_children == lost {
            self.lint_lone_child(token, operation);
        }
        shape
    }

    fn union(&mut self, token: &Token) -> Outcome<ObjectKind> {
        let (told, lost) = (self.diagnostics.len(), self.lost_children);
        let children = self.children();
        let is_lost = self.diagnostics.len() != told || self.lost_children != lost;
        if children.is_empty() && !is_lost && self.poison.is_none() {
            self.lint_empty_union(token);
        }
        Ok(ObjectKind::Union(children))
    }

    /// Warns of an empty union, `union { pigment { … } }`, unless it contains directives.
    fn lint_empty_union(&mut self, token: &Token) {
        let is_plain =
            self.within_block().is_some_and(|block| !self.sources.text(block.span).contains('#'));
        let by_macro = self.silent.is_some();
        let next = self.peek().map(|next| next.kind.clone());
        let ends = match next {
            None => true,
            Some(TokenKind::Word(word)) => Place::csg(Word::Union).holds(word),
            _ => false,
        };
        if !is_plain || by_macro || !ends || token.kind != TokenKind::Word(Word::Union) {
            return;
        }
        let diagnostic = Diagnostic::new(Code::DegenerateShape, "this union has nothing in it")
            .at(token.span, "no object stands in its block");
        // Unless they come too late.
        self.owed = Some((token.here.clone(), diagnostic));
    }

    /// Reads the objects of a block before its modifiers.
    pub(super) fn children(&mut self) -> Vec<ObjectId> {
        let mut children = Vec::new();
        self.more_children(&mut children, false);
        children
    }

    /// As [`Self::children`]; with `names`, the first may also be a bare name.
    pub(super) fn more_children(&mut self, children: &mut Vec<ObjectId>, names: bool) {
        loop {
            let sign = |kind: &TokenKind| matches!(kind, TokenKind::Semicolon | TokenKind::Comma);
            if let Some(token) = self.next_if(sign) {
                let opener = self.openers.last().map(|opener| self.sources.text(*opener));
                let word = opener.and_then(Word::from_name).unwrap_or(Word::Union);
                match token.kind {
                    TokenKind::Comma => self.warn_of_comma(&token, Place::csg(word)),
                    _ => self.warn_of_semicolon(&token, Place::csg(word)),
                }
                continue;
            }
            if (names || !children.is_empty())
                && let Some(child) = self.lone_child()
            {
                children.extend(child);
                continue;
            }
            let Some(Token { kind: TokenKind::Word(word), .. }) = self.peek() else { break };
            let word = *word;
            if !opens_object(word) {
                break;
            }
            let Some(token) = self.next() else { break };
            match self.object(&token, word) {
                Ok(Value::Object(child)) => {
                    self.note_item(child, &token);
                    children.push(child);
                }
                Ok(Value::Poison(poison)) => self.set_poison(poison),
                // Reported; the others still make a union.
                Ok(_) | Err(Reported) => self.lost_children += 1,
            }
        }
    }

    /// Reads a bare name as a child, as POV-Ray takes `Ball` for `object { Ball }` after the first child:
    /// `union { sphere { … } Ball }`.
    fn lone_child(&mut self) -> Option<Option<ObjectId>> {
        if self.options.dialect != Dialect::Pov {
            return None;
        }
        let &Value::Object(used) = self.peek_declared()? else { return None };
        let token = self.next()?;
        let site = token.here.site(token.span);
        let kind = ObjectKind::Use(used);
        let child = self.add_object(Object { kind, modifiers: Vec::new(), site, item: None });
        Some(child.ok().inspect(|child| self.note_item(*child, &token)))
    }
}
