//! Pictures of the screen, and what is measured on them.

/// Columns and rows: left, right, top, bottom.
pub type Area = [usize; 4];

/// A picture of the screen.
#[derive(Clone, PartialEq, Eq)]
pub struct Shot {
    width: usize,
    pixels: Vec<[u8; 3]>,
}

fn places([left, right, top, bottom]: Area) -> impl Iterator<Item = (usize, usize)> {
    (top..bottom).flat_map(move |y| (left..right).map(move |x| (x, y)))
}

fn size([left, right, top, bottom]: Area) -> f64 {
    ((right - left) * (bottom - top)) as f64
}

impl Shot {
    pub fn new(width: usize, pixels: Vec<[u8; 3]>) -> Self {
        Self { width, pixels }
    }

    fn at(&self, (x, y): (usize, usize)) -> [u8; 3] {
        self.pixels[y * self.width + x]
    }

    /// A part of it.
    pub fn cut(&self, area: Area) -> Self {
        Self { width: area[1] - area[0], pixels: places(area).map(|place| self.at(place)).collect() }
    }

    /// The share of pixels that differ from another picture's by more than `by` in some channel.
    pub fn differs(&self, other: &Self, area: Area, by: u8) -> f64 {
        let far = |one: [u8; 3], other: [u8; 3]| (0..3).any(|channel| one[channel].abs_diff(other[channel]) > by);
        places(area).filter(|&place| far(self.at(place), other.at(place))).count() as f64 / size(area)
    }

    /// Whether it shows the same there, to the last bit.
    pub fn shows(&self, other: &Self, area: Area) -> bool {
        self.differs(other, area, 0) == 0.0
    }

    /// How far a pixel is from the mean of its neighbours to the left and right, twice that, on the mean: what is drawn in few pixels, and
    /// straight between them, has little of it.
    pub fn sharpness(&self, [left, right, top, bottom]: Area) -> f64 {
        let area = [left + 1, right - 1, top, bottom];
        let green = |x, y| f64::from(self.at((x, y))[1]);
        let bend = |(x, y)| (green(x - 1, y) - 2.0 * green(x, y) + green(x + 1, y)).abs();
        places(area).map(bend).sum::<f64>() / size(area)
    }

    /// The mean of green.
    pub fn brightness(&self, area: Area) -> f64 {
        places(area).map(|place| f64::from(self.at(place)[1])).sum::<f64>() / size(area)
    }
}
