//! Name resolution: which value a name has at the current point of evaluation.
//!
//! There is one table for the main file, one for each include being read and one for each macro being run;
//! the newest table that has the name wins (dynamic scoping, as in POV-Ray). **Invariant:** an open table
//! keeps its slots, so a by-reference parameter always refers to its caller's variable.

use std::collections::HashMap;

use crate::source::Site;

use super::array::{element, element_mut};
use super::value::Value;

/// An interned name, the same for every file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(u32);

/// Index of a declared macro.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct MacroId(pub u32);

/// Index of the storage for a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Slot(u32);

impl Slot {
    /// Slot of an optional parameter that a call omitted; it hides other bindings of its name.
    pub const NONE: Self = Self(u32::MAX);
}

/// Which kind of scope first declared a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Owner {
    /// The main file itself.
    Main,
    /// A macro of the main file, by `#local`.
    Macro,
    /// An include, a loop, or a macro that uses `#declare`, whose result its caller reads.
    Other,
}

/// Where a name was declared, for messages.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Declared {
    pub site: Site,
    pub used: bool,
    pub of: Owner,
    /// Where `#undef` last removed it.
    pub undone: Option<Site>,
}

/// Contents of a slot.
#[derive(Debug)]
enum Kept {
    Value(Value),
    /// An element of the array in another slot: a parameter that refers to `A[i]`.
    Element(Slot, Box<[f64]>),
}

#[derive(Debug, Default)]
struct SymbolState {
    /// Newest last: the depth of the table, and the slot.
    bindings: Vec<(u32, Slot)>,
    declared: Option<Declared>,
    /// Whether its value is from outside and has not been read yet.
    is_unread: bool,
}

impl SymbolState {
    #[inline]
    fn mark_used(&mut self) {
        self.is_unread = false;
        if let Some(declared) = &mut self.declared {
            declared.used = true;
        }
    }
}

/// All tables of one evaluation.
#[derive(Debug)]
pub struct Scopes {
    names: Vec<String>,
    by_name: HashMap<String, Symbol>,
    states: Vec<SymbolState>,
    slots: Vec<Kept>,
    /// Approximate size in bytes of the values in the slots.
    held: u64,
    /// Slots whose table has closed.
    free: Vec<Slot>,
    /// The bindings of each open table, and whether the slot is its own. The first table is the main file's,
    /// which never closes and lists none.
    tables: Vec<Vec<(Symbol, bool)>>,
    /// Closed tables, kept for reuse.
    spare: Vec<Vec<(Symbol, bool)>>,
}

impl Default for Scopes {
    fn default() -> Self {
        Self {
            names: Vec::new(),
            by_name: HashMap::new(),
            states: Vec::new(),
            slots: Vec::new(),
            held: 0,
            free: Vec::new(),
            tables: vec![Vec::new()],
            spare: Vec::new(),
        }
    }
}

impl Scopes {
    pub fn intern(&mut self, name: &str) -> Symbol {
        if let Some(&symbol) = self.by_name.get(name) {
            return symbol;
        }
        let symbol = Symbol(self.names.len() as u32);
        self.names.push(name.to_owned());
        self.by_name.insert(name.to_owned(), symbol);
        self.states.push(SymbolState::default());
        symbol
    }

    pub fn name(&self, symbol: Symbol) -> &str {
        &self.names[symbol.0 as usize]
    }

    /// Returns the symbol of a name, if it was ever interned.
    pub fn symbol(&self, name: &str) -> Option<Symbol> {
        self.by_name.get(name).copied()
    }

    pub fn slot(&self, symbol: Symbol) -> Option<Slot> {
        let &(_, slot) = self.states[symbol.0 as usize].bindings.last()?;
        (slot != Slot::NONE).then_some(slot)
    }

    /// Returns whether the name is an optional parameter that was omitted.
    pub fn is_left_out(&self, symbol: Symbol) -> bool {
        let bindings = &self.states[symbol.0 as usize].bindings;
        bindings.last().is_some_and(|&(_, slot)| slot == Slot::NONE)
    }

    /// Returns the value of a name; this counts as a use.
    #[inline]
    pub fn read(&mut self, symbol: Symbol) -> Option<&Value> {
        let state = &mut self.states[symbol.0 as usize];
        state.mark_used();
        let &(_, slot) = state.bindings.last()?;
        self.value(slot)
    }

    /// As [`Self::read`], but for messages: does not count as a use.
    pub fn look(&self, symbol: Symbol) -> Option<&Value> {
        self.value(self.slot(symbol)?)
    }

    #[inline]
    fn value(&self, slot: Slot) -> Option<&Value> {
        match self.slots.get(slot.0 as usize)? {
            Kept::Value(value) => Some(value),
            Kept::Element(array, indices) => element(self.value(*array)?, indices).ok(),
        }
    }

    /// Returns the value of a slot, mutably; `None` if the array no longer has the element.
    #[inline]
    fn value_mut(&mut self, slot: Slot) -> Option<&mut Value> {
        if let Kept::Element(array, indices) = self.slots.get(slot.0 as usize)? {
            let (array, indices) = (*array, indices.clone());
            return element_mut(self.value_mut(array)?, &indices);
        }
        match self.slots.get_mut(slot.0 as usize)? {
            Kept::Value(value) => Some(value),
            Kept::Element(..) => None,
        }
    }

    pub fn open(&mut self) {
        let table = self.spare.pop().unwrap_or_default();
        self.tables.push(table);
    }

    /// Closes the newest table and forgets its names.
    pub fn close(&mut self) {
        let mut table = self.tables.pop().unwrap_or_default();
        while let Some((symbol, own)) = table.pop() {
            if let Some((_, slot)) = self.states[symbol.0 as usize].bindings.pop()
                && own
            {
                self.release(slot);
                self.free.push(slot);
            }
        }
        self.spare.push(table);
    }

    pub fn depth(&self) -> usize {
        self.tables.len()
    }

    /// `#local`: assigns in the newest table, unless the name is already bound there.
    pub fn assign_local(&mut self, symbol: Symbol, value: Value) {
        self.assign_in(self.home(symbol, true), symbol, value);
    }

    /// `#declare`: assigns where the name is found, even if it is local in a caller (so a parameter passes
    /// the value out), otherwise in the main file's table.
    pub fn assign(&mut self, symbol: Symbol, value: Value) {
        self.assign_in(self.home(symbol, false), symbol, value);
    }

    /// Returns the table in which a `#declare` (or `#local`) of a name would assign now. Its value may come
    /// from a macro that has a parameter of that name, so this must be called before the value is read.
    pub fn home(&self, symbol: Symbol, local: bool) -> u32 {
        let found = self.states[symbol.0 as usize].bindings.last().filter(|_| !local);
        found.map_or(if local { self.tables.len() as u32 - 1 } else { 0 }, |&(depth, _)| depth)
    }

    /// Returns the value of a name in the table that [`Self::home`] returned.
    pub fn held_in(&self, depth: u32, symbol: Symbol) -> Option<&Value> {
        let bindings = &self.states[symbol.0 as usize].bindings;
        let &(_, slot) = bindings.iter().rev().find(|&&(other, _)| other == depth)?;
        self.value(slot)
    }

    /// Assigns in the table that [`Self::home`] returned, or in the newest if that has closed.
    pub fn assign_in(&mut self, depth: u32, symbol: Symbol, value: Value) {
        let depth = depth.min(self.tables.len() as u32 - 1);
        let bindings = &self.states[symbol.0 as usize].bindings;
        // Usually the newest is meant.
        if let Some(&(newest, slot)) = bindings.last()
            && newest == depth
            && slot != Slot::NONE
        {
            return self.put(slot, value);
        }
        let at = bindings.partition_point(|&(other, _)| other <= depth);
        match bindings[..at].last() {
            Some(&(other, Slot::NONE)) if other == depth => {
                let slot = self.keep(value);
                self.states[symbol.0 as usize].bindings[at - 1].1 = slot;
                let table = &mut self.tables[depth as usize];
                if let Some((_, own)) = table.iter_mut().rev().find(|(other, _)| *other == symbol) {
                    *own = true;
                }
            }
            Some(&(other, slot)) if other == depth => self.put(slot, value),
            _ => {
                let slot = self.keep(value);
                self.states[symbol.0 as usize].bindings.insert(at, (depth, slot));
                // The main file's table never closes.
                if depth > 0 {
                    self.tables[depth as usize].push((symbol, true));
                }
            }
        }
    }

    /// Takes the value of the newest binding, to be changed and put back by [`Self::overwrite`].
    pub fn take(&mut self, symbol: Symbol) -> Value {
        let Some(held) = self.slot(symbol).and_then(|slot| self.value_mut(slot)) else {
            return Value::Broken;
        };
        let value = std::mem::replace(held, Value::Broken);
        self.held = self.held.saturating_sub(value.bytes());
        value
    }

    /// Replaces the value of the newest binding, if there is one.
    pub fn overwrite(&mut self, symbol: Symbol, value: Value) {
        if let Some(slot) = self.slot(symbol) {
            self.put(slot, value);
        }
    }

    /// Binds a parameter: to a slot of its `own`, which is freed when the table closes; to the caller's
    /// variable; or to [`Slot::NONE`], which leaves its name undeclared until it is assigned.
    pub fn bind(&mut self, symbol: Symbol, slot: Slot, own: bool) {
        let depth = self.tables.len() as u32 - 1;
        self.states[symbol.0 as usize].bindings.push((depth, slot));
        if let Some(table) = self.tables.last_mut() {
            table.push((symbol, own));
        }
    }

    /// `#undef`: removes the newest binding. Returns `false` if there is none.
    pub fn undefine(&mut self, symbol: Symbol) -> bool {
        let Some((depth, _)) = self.states[symbol.0 as usize].bindings.pop() else {
            return false;
        };
        let table = &mut self.tables[depth as usize];
        if let Some(at) = table.iter().rposition(|&(other, _)| other == symbol) {
            table.remove(at);
        }
        true
    }

    /// Records where a name was first declared, for messages and lints.
    pub fn note_declaration(&mut self, symbol: Symbol, site: Site, of: Owner) {
        let declared = &mut self.states[symbol.0 as usize].declared;
        if declared.is_none() {
            *declared = Some(Declared { site, used: false, of, undone: None });
        }
    }

    /// Records where a name was undefined, for messages.
    pub fn note_undone(&mut self, symbol: Symbol, site: Site) {
        if let Some(declared) = &mut self.states[symbol.0 as usize].declared {
            declared.undone = Some(site);
        }
    }

    pub fn declared(&self, symbol: Symbol) -> Option<&Declared> {
        self.states[symbol.0 as usize].declared.as_ref()
    }

    #[inline]
    pub fn mark_used(&mut self, symbol: Symbol) {
        self.states[symbol.0 as usize].mark_used();
    }

    /// Declares a value from outside the scene, which exists before its first line.
    pub fn give(&mut self, name: &str, value: Value) {
        let symbol = self.intern(name);
        self.assign(symbol, value);
        self.states[symbol.0 as usize].is_unread = true;
    }

    /// Returns whether a name's value from outside was never read; clears the flag.
    pub fn take_unread(&mut self, symbol: Symbol) -> bool {
        std::mem::take(&mut self.states[symbol.0 as usize].is_unread)
    }

    /// Returns the names that have a value now, in the order in which they were first seen.
    pub fn visible(&self) -> impl Iterator<Item = &str> {
        let bound = self.states.iter().map(|state| {
            let value = state.bindings.last().and_then(|&(_, slot)| self.value(slot));
            // A name that is known only because it was reported is not a suggestion for another.
            value.is_some_and(|value| *value != Value::Broken || state.declared.is_some())
        });
        self.names.iter().zip(bound).filter(|(_, bound)| *bound).map(|(name, _)| name.as_str())
    }

    /// Returns every name that was declared and is still bound, with its value.
    pub fn declarations(&self) -> impl Iterator<Item = (&str, &Declared, Option<&Value>)> {
        self.names.iter().zip(&self.states).filter_map(|(name, state)| {
            let value = state.bindings.last().and_then(|&(_, slot)| self.value(slot));
            Some((name.as_str(), state.declared.as_ref()?, value))
        })
    }

    /// Allocates a slot for a value that has no name yet.
    #[inline]
    pub fn keep(&mut self, value: Value) -> Slot {
        self.held = self.held.saturating_add(value.bytes());
        self.fill(Kept::Value(value))
    }

    /// Allocates a slot that refers to an existing element of the array in another slot.
    pub fn refer(&mut self, array: Slot, indices: Box<[f64]>) -> Slot {
        self.fill(Kept::Element(array, indices))
    }

    #[inline]
    fn fill(&mut self, kept: Kept) -> Slot {
        if let Some(slot) = self.free.pop() {
            self.slots[slot.0 as usize] = kept;
            return slot;
        }
        self.slots.push(kept);
        Slot(self.slots.len() as u32 - 1)
    }

    fn release(&mut self, slot: Slot) {
        let kept = &mut self.slots[slot.0 as usize];
        if let Kept::Value(value) = kept {
            self.held = self.held.saturating_sub(value.bytes());
        }
        *kept = Kept::Value(Value::Broken);
    }

    fn put(&mut self, slot: Slot, value: Value) {
        let bytes = value.bytes();
        if let Some(held) = self.value_mut(slot) {
            let before = held.bytes();
            *held = value;
            self.held = (self.held + bytes).saturating_sub(before);
        }
    }

    /// Returns the approximate size in bytes of the values of all names.
    pub fn held(&self) -> u64 {
        self.held
    }
}

#[cfg(test)]
mod tests;
