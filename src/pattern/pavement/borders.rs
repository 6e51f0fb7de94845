//! The borders of tiles between the cells of each pavement.
//!
//! **Source:** measured on POV-Ray 3.7.

/// Which sides of cells are borders of tiles.
///
/// A cell is given by two indices. Its digit has a bit for each of the sides that it owns; the other sides
/// are owned by its neighbours.
#[derive(Debug, Clone, Copy)]
pub(super) struct Borders {
    /// The period of the second index.
    height: i64,
    /// The period of the first index, after which the second is shifted by `shift`.
    width: i64,
    shift: i64,
    /// `height` digits for each first index.
    digits: &'static str,
}

impl Borders {
    /// Returns whether a side of a cell is a border.
    pub fn has(&self, i: i64, j: i64, side: u32) -> bool {
        let periods = i.div_euclid(self.width);
        let i = i.rem_euclid(self.width);
        let j = (j - periods * self.shift).rem_euclid(self.height);
        let digit = self.digits.as_bytes()[(i * self.height + j) as usize];
        (digit - b'0') >> side & 1 == 1
    }
}

/// Returns the pavements of tiles of so many cells, which have 3, 4 or 6 sides; empty if there are none.
pub(super) fn pavements(sides: usize, cells: usize) -> &'static [Borders] {
    let by_cells = match sides {
        3 => TRIANGLES,
        4 => SQUARES,
        _ => HEXAGONS,
    };
    by_cells.get(cells.wrapping_sub(1)).copied().unwrap_or(&[])
}

const fn borders(height: i64, width: i64, shift: i64, digits: &'static str) -> Borders {
    Borders { height, width, shift, digits }
}

/// Bits: the sides at the bottom, left and right of the triangle that points up.
const TRIANGLES: &[&[Borders]] = &[
    &[borders(1, 1, 0, "7")],
    &[borders(1, 1, 0, "5")],
    &[borders(3, 1, 1, "315")],
    &[borders(2, 1, 1, "51"), borders(2, 1, 1, "25"), borders(2, 2, 0, "3650")],
    &[
        borders(5, 1, 3, "31115"),
        borders(5, 1, 3, "31162"),
        borders(5, 1, 3, "55142"),
        borders(5, 1, 2, "36013"),
    ],
    &[
        borders(1, 3, 0, "311"),
        borders(1, 3, 0, "611"),
        borders(3, 1, 1, "611"),
        borders(6, 1, 2, "315016"),
        borders(6, 1, 2, "323013"),
        borders(6, 1, 4, "323112"),
        borders(6, 1, 3, "351142"),
        borders(6, 1, 3, "340153"),
        borders(6, 1, 2, "321055"),
        borders(1, 3, 0, "341"),
        borders(3, 1, 1, "305"),
        borders(3, 1, 1, "214"),
    ],
];

/// Bits: the sides at the left and at the bottom.
const SQUARES: &[&[Borders]] = &[
    &[borders(1, 1, 0, "3")],
    &[borders(2, 1, 0, "31")],
    &[borders(1, 3, 0, "322"), borders(2, 3, 0, "313221")],
    &[
        borders(1, 4, 0, "3222"),
        borders(2, 4, 0, "31322221"),
        borders(2, 2, 1, "3221"),
        borders(2, 2, 0, "3120"),
        borders(4, 1, 2, "2330"),
    ],
    &[
        borders(1, 5, 0, "32222"),
        borders(2, 5, 0, "3132222221"),
        borders(10, 1, 6, "2331302020"),
        borders(5, 1, 2, "32122"),
        borders(5, 1, 2, "32301"),
        borders(10, 1, 9, "3112232211"),
        borders(10, 1, 9, "1312123212"),
        borders(10, 1, 3, "3130212231"),
        borders(5, 1, 4, "31221"),
        borders(10, 1, 6, "3121321302"),
        borders(10, 1, 2, "2330222330"),
        borders(5, 2, 1, "3310221123"),
    ],
    &[
        borders(1, 6, 0, "322222"),
        borders(2, 6, 0, "312322222230"),
        borders(2, 6, 0, "322123222230"),
        borders(2, 6, 0, "322221232230"),
        borders(6, 1, 1, "322230"),
        borders(2, 6, 0, "312023223020"),
        borders(2, 6, 0, "233020322120"),
        borders(6, 1, 1, "322302"),
        borders(2, 3, 0, "233020"),
        borders(2, 3, 0, "312020"),
        borders(3, 4, 0, "311320212201"),
        borders(6, 1, 5, "322121"),
        borders(3, 4, 0, "331212230212"),
        borders(4, 3, 0, "321021122323"),
        borders(6, 1, 2, "330021"),
        borders(3, 2, 2, "301320"),
        borders(12, 1, 10, "330123223012"),
        borders(12, 1, 10, "311232222301"),
        borders(6, 1, 5, "312211"),
        borders(6, 1, 1, "130223"),
        borders(6, 1, 1, "122231"),
        borders(3, 4, 0, "312230231212"),
        borders(3, 4, 0, "113321023211"),
        borders(6, 2, 2, "330132211222"),
        borders(3, 2, 0, "321212"),
        borders(3, 2, 0, "312201"),
        borders(3, 2, 0, "301232"),
        borders(6, 1, 5, "312212"),
        borders(6, 2, 2, "321312212230"),
        borders(4, 3, 2, "232130231212"),
        borders(4, 3, 2, "312223300213"),
        borders(3, 2, 1, "303122"),
        borders(4, 3, 0, "331122322102"),
        borders(12, 1, 5, "312230303221"),
        borders(6, 2, 3, "111223323011"),
    ],
];

/// Bits: the sides at the top, at the upper right and at the lower right.
const HEXAGONS: &[&[Borders]] = &[
    &[borders(1, 1, 0, "7")],
    &[borders(1, 2, 0, "37")],
    &[borders(3, 2, 2, "766667"), borders(3, 2, 1, "314677"), borders(1, 3, 0, "357")],
    &[
        borders(4, 2, 3, "76666667"),
        borders(2, 2, 0, "1734"),
        borders(1, 4, 0, "5357"),
        borders(4, 1, 0, "7726"),
        borders(4, 2, 0, "37572567"),
        borders(4, 2, 0, "71426776"),
        borders(2, 2, 0, "7275"),
    ],
    &[
        borders(5, 2, 4, "7666666667"),
        borders(5, 1, 0, "72667"),
        borders(5, 2, 4, "3166466677"),
        borders(5, 2, 4, "7164266776"),
        borders(5, 1, 0, "72676"),
        borders(5, 2, 4, "3027067667"),
        borders(5, 2, 4, "1403076766"),
        borders(10, 1, 3, "7173243667"),
        borders(5, 2, 3, "5567356673"),
        borders(5, 2, 0, "3327375675"),
        borders(5, 2, 3, "3037065567"),
        borders(5, 1, 1, "71436"),
        borders(5, 2, 1, "5732567557"),
        borders(5, 1, 4, "76556"),
        borders(5, 1, 4, "76655"),
        borders(5, 2, 3, "5667516437"),
        borders(5, 2, 2, "3366716437"),
        borders(5, 2, 3, "3366756657"),
        borders(5, 2, 1, "6732765765"),
        borders(5, 2, 4, "3167465657"),
        borders(5, 1, 4, "76565"),
        borders(5, 2, 3, "3726757665"),
    ],
];
