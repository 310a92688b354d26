//! Textured lights, cut into pieces that are as even as can be: the lobes' form factors of even ones are exact, so that
//! no sample has to make up for what a closed form does not know.

use std::ops::Range;

use glam::DVec3;

use super::levels::Texel;

/// A rectangle of an image's texels, of a polygon.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Its first column and row, and those after its last.
    pub low: [u32; 2],
    pub high: [u32; 2],
    /// What all of it shows.
    pub even: Option<DVec3>,
    /// The integral, by area, of the squared difference to its mean.
    rest: f64,
}

/// Values that differ by less, relative to the greatest, are the same.
const EVEN: f64 = 1e-5;
/// Of the square of what the whole shows: pieces with less of a rest stay whole.
const LEAST_REST: f64 = 1e-4;
/// The share of a rest that a cut must take away; otherwise halves are better for the cuts after it.
const LEAST_GAIN: f64 = 0.02;

impl Piece {
    /// How many texels there are in it.
    pub fn texels(&self) -> f32 {
        (self.high[0] - self.low[0]) as f32 * (self.high[1] - self.low[1]) as f32
    }

    fn side(&self, axis: usize) -> Range<u32> {
        self.low[axis]..self.high[axis]
    }
}

/// What of an image lies in some of its texels.
#[derive(Clone, Copy, Default)]
struct Sums {
    area: f64,
    /// Integrals of what it shows, and of its square.
    first: DVec3,
    second: f64,
}

impl Sums {
    fn with(self, other: Self) -> Self {
        Self { area: self.area + other.area, first: self.first + other.first, second: self.second + other.second }
    }

    fn without(self, other: Self) -> Self {
        Self { area: self.area - other.area, first: self.first - other.first, second: self.second - other.second }
    }

    /// Of one texel.
    fn of(texel: &Texel) -> Self {
        let Texel { mean, area } = *texel;
        Self { area, first: area * mean, second: area * mean.length_squared() }
    }

    fn rest(self) -> f64 {
        if self.area > 0.0 { (self.second - self.first.length_squared() / self.area).max(0.0) } else { 0.0 }
    }
}

/// At most so many pieces of an image of this size, and one at least: again and again the one that is least even is cut in
/// two, between the columns or rows where that leaves the least.
pub(super) fn pieces(texels: &[Texel], size: [u32; 2], most: usize) -> Vec<Piece> {
    let image = Image { texels, columns: size[0] as usize };
    let whole = image.sums([0, 0], size);
    let least = LEAST_REST * whole.first.length_squared() / whole.area;
    // Of what lies wholly beside its image nothing is known.
    let unknown = Piece { low: [0, 0], high: size, even: None, rest: 0.0 };
    let mut pieces = vec![image.piece([0, 0], size).unwrap_or(unknown)];
    while pieces.len() < most {
        let by_rest = |one: &usize, other: &usize| pieces[*one].rest.total_cmp(&pieces[*other].rest);
        let Some(index) = (0..pieces.len()).max_by(by_rest).filter(|&index| pieces[index].rest > least) else { break };
        let piece = pieces.swap_remove(index);
        let (axis, at) = image.cut(&piece);
        let (mut middle_high, mut middle_low) = (piece.high, piece.low);
        (middle_high[axis], middle_low[axis]) = (at, at);
        pieces.extend(image.piece(piece.low, middle_high));
        pieces.extend(image.piece(middle_low, piece.high));
    }
    pieces
}

struct Image<'a> {
    texels: &'a [Texel],
    columns: usize,
}

impl Image<'_> {
    fn rectangle(&self, low: [u32; 2], high: [u32; 2]) -> impl Iterator<Item = &Texel> {
        let row = move |row: u32| &self.texels[row as usize * self.columns..][low[0] as usize..high[0] as usize];
        (low[1]..high[1]).flat_map(row).filter(|texel| texel.area > 0.0)
    }

    fn sums(&self, low: [u32; 2], high: [u32; 2]) -> Sums {
        self.rectangle(low, high).map(Sums::of).fold(Sums::default(), Sums::with)
    }

    /// None where nothing of the polygon is in it.
    fn piece(&self, low: [u32; 2], high: [u32; 2]) -> Option<Piece> {
        let (mut least, mut greatest) = (DVec3::INFINITY, DVec3::ZERO);
        for texel in self.rectangle(low, high) {
            (least, greatest) = (least.min(texel.mean), greatest.max(texel.mean));
        }
        let sums = self.sums(low, high);
        let even = (greatest - least).cmple(EVEN * greatest).all().then(|| sums.first / sums.area);
        let rest = if even.is_some() { 0.0 } else { sums.rest() };
        (sums.area > 0.0).then_some(Piece { low, high, even, rest })
    }

    /// Between which columns (0) or rows (1) a piece of more than one texel is best cut.
    fn cut(&self, piece: &Piece) -> (usize, u32) {
        let mut best = (f64::INFINITY, 0, 0);
        for axis in 0..2 {
            let line = |at: u32| {
                let (mut low, mut high) = (piece.low, piece.high);
                (low[axis], high[axis]) = (at, at + 1);
                self.sums(low, high)
            };
            let lines: Vec<Sums> = piece.side(axis).map(line).collect();
            let all = lines.iter().copied().fold(Sums::default(), Sums::with);
            let mut before = Sums::default();
            for (sums, at) in lines.iter().zip(piece.side(axis).skip(1)) {
                before = before.with(*sums);
                let rest = before.rest() + all.without(before).rest();
                if rest < best.0 {
                    best = (rest, axis, at);
                }
            }
        }
        if best.0 < (1.0 - LEAST_GAIN) * piece.rest {
            return (best.1, best.2);
        }
        let sides = [0, 1].map(|axis| piece.side(axis).len());
        let axis = usize::from(sides[1] > sides[0]);
        (axis, piece.low[axis] + sides[axis] as u32 / 2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(columns: u32, rows: u32, value: impl Fn(u32, u32) -> f64) -> Vec<Texel> {
        let texel = |at: u32| Texel { mean: DVec3::splat(value(at % columns, at / columns)), area: 1.0 };
        (0..columns * rows).map(texel).collect()
    }

    /// Four panes, not of one size, and a board of squares: each piece is one of them, and all of them are there.
    #[test]
    fn panes_become_pieces() {
        let panes = |x: u32, y: u32| f64::from(1 + u32::from(x > 2) + 2 * u32::from(y > 6));
        let found = pieces(&image(20, 9, panes), [20, 9], 64);
        assert_eq!(found.len(), 4);
        let mut areas: Vec<f32> = found.iter().map(Piece::texels).collect();
        areas.sort_by(f32::total_cmp);
        assert_eq!(areas, [6.0, 21.0, 34.0, 119.0]);
        assert!(found.iter().all(|piece| piece.even == Some(DVec3::splat(panes(piece.low[0], piece.low[1])))));
        let board = |x: u32, y: u32| f64::from((x / 4 + y / 4) % 2);
        let found = pieces(&image(32, 32, board), [32, 32], 64);
        assert!(found.len() == 64 && found.iter().all(|piece| piece.even.is_some()));
    }

    /// What is not even is cut where that takes most of it away, and pieces are no more than there may be; together they
    /// are the whole, of which what is off the polygon is no part.
    #[test]
    fn pieces_are_the_whole() {
        let mut texels = image(31, 17, |x, y| f64::from(x * x) + (0.5 * f64::from(y)).sin());
        for most in [1, 2, 7, 20] {
            let found = pieces(&texels, [31, 17], most);
            assert_eq!(found.len(), most);
            assert_eq!(found.iter().map(Piece::texels).sum::<f32>(), 31.0 * 17.0);
        }
        let rest = |most: usize| pieces(&texels, [31, 17], most).iter().map(|piece| piece.rest).sum::<f64>();
        assert!(rest(8) < 0.03 * rest(1), "{} {}", rest(8), rest(1));
        texels.iter_mut().enumerate().filter(|(at, _)| at % 31 < 20).for_each(|(_, texel)| texel.area = 0.0);
        let found = pieces(&texels, [31, 17], 40);
        assert!(found.iter().all(|piece| piece.high[0] > 20));
        texels.iter_mut().for_each(|texel| texel.area = 0.0);
        assert_eq!(pieces(&texels, [31, 17], 40).len(), 1);
    }
}
