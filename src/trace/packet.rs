//! Rays side by side, and what they meet.

use super::media::Within;
use super::way::Way;
use crate::geometry::Hit;
use crate::math::wide::{ROW, Rays, numbers};

/// Rays of one generation, side by side, each with what it meets once that is found.
#[derive(Debug)]
pub(super) struct Packet {
    pub rays: Rays,
    pub hits: [Hit; ROW],
    /// The number in its batch of the first ray, if they are the camera's: nothing else is known of these.
    camera: Option<u32>,
    ways: [Way; ROW],
}

impl Packet {
    /// Returns the way of the ray of this number.
    #[inline(always)]
    pub fn way(&self, number: usize) -> Way {
        match self.camera {
            Some(first) => Way::from_camera(self.rays.at(number), first + number as u32),
            None => self.ways[number],
        }
    }

    /// Returns the level of the ray of this number: 1 for the camera's.
    #[inline(always)]
    pub fn level(&self, number: usize) -> u32 {
        self.camera.map_or(self.ways[number].level, |_| 1)
    }

    /// Returns the solids that the ray of this number is in.
    #[inline(always)]
    pub fn within(&self, number: usize) -> Within {
        match self.camera {
            Some(first) => Within::Start(first + number as u32),
            None => self.ways[number].within,
        }
    }

    /// Returns whether its rays are the camera's.
    #[inline(always)]
    pub fn is_of_camera(&self) -> bool {
        self.camera.is_some()
    }

    /// Adds a ray that goes on from a surface.
    #[inline(always)]
    fn set(&mut self, number: usize, way: &Way) {
        self.rays.set(number, &way.ray);
        self.ways[number] = *way;
    }

    /// Returns a bit for each ray that something has mirrored.
    pub fn mirrored(&self) -> u32 {
        match self.camera {
            Some(_) => 0,
            None => {
                let mirrored = |number: &usize| self.ways[*number].mirrored;
                numbers(self.rays.mask).filter(mirrored).fold(0, |all, number| all | 1 << number)
            }
        }
    }
}

/// The packets of a batch, kept for their memory.
#[derive(Debug, Default)]
pub(super) struct Packets {
    all: Vec<Packet>,
    used: usize,
}

impl Packets {
    pub fn len(&self) -> usize {
        self.used
    }

    pub fn clear(&mut self) {
        self.used = 0;
    }

    pub fn truncate(&mut self, len: usize) {
        self.used = self.used.min(len);
    }

    /// Returns those from `first` on.
    pub fn from(&mut self, first: usize) -> &mut [Packet] {
        &mut self.all[first..self.used]
    }

    #[inline(always)]
    pub fn at(&self, place: usize) -> &Packet {
        &self.all[place]
    }

    /// Adds a packet of the camera's rays, none so far.
    #[inline(always)]
    pub fn of_camera(&mut self) -> &mut Packet {
        let first = (self.used * ROW) as u32;
        let packet = self.another();
        packet.camera = Some(first);
        packet
    }

    /// Adds packets of rays that go on from surfaces.
    pub fn extend<'a>(&mut self, mut ways: impl Iterator<Item = &'a Way>) {
        let mut next = ways.next();
        while next.is_some() {
            let packet = self.another();
            packet.camera = None;
            for number in 0..ROW {
                let Some(way) = next else { break };
                packet.set(number, way);
                next = ways.next();
            }
        }
    }

    #[inline(always)]
    fn another(&mut self) -> &mut Packet {
        if self.used == self.all.len() {
            self.grow();
        }
        let packet = &mut self.all[self.used];
        self.used += 1;
        packet.rays.mask = 0;
        packet
    }

    #[cold]
    #[inline(never)]
    fn grow(&mut self) {
        let rays = Rays::NONE;
        let way = Way::from_camera(rays.at(0), 0);
        let (hits, ways) = ([Hit::NOTHING; ROW], [way; ROW]);
        self.all.push(Packet { rays, hits, camera: None, ways });
    }
}
