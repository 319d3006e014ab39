//! Reads the pictures that `mcm` draws: what is drawn, and where on the axes.

use std::collections::HashMap;
use std::path::Path;

use quick_xml::Reader;
use quick_xml::escape::unescape;
use quick_xml::events::{BytesStart, Event};

/// An element of a picture.
#[derive(Debug, Clone)]
pub(super) struct Element {
    pub(super) name: String,
    attributes: HashMap<String, String>,
    /// What stands in it, if it has no elements.
    pub(super) text: String,
    /// Number of elements around it.
    depth: usize,
}

impl Element {
    /// An attribute; empty where it is not set.
    pub(super) fn get(&self, name: &str) -> &str {
        self.attributes.get(name).map_or("", String::as_str)
    }

    fn number(&self, name: &str) -> f64 {
        self.get(name).parse().unwrap()
    }

    /// The corners of a path, or the centre of a circle, pixels.
    pub(super) fn places(&self) -> Vec<[f64; 2]> {
        if self.name == "circle" {
            return vec![[self.number("cx"), self.number("cy")]];
        }
        let place = |pair: &str| {
            let (x, y) = pair.split_once(',').unwrap();
            [x.parse().unwrap(), y.parse().unwrap()]
        };
        self.get("d").split(['M', 'L', 'Z']).filter(|pair| !pair.is_empty()).map(place).collect()
    }
}

/// All elements in order; what is no XML fails.
pub(super) fn elements(path: &Path) -> Vec<Element> {
    let text = std::fs::read_to_string(path).unwrap();
    let mut reader = Reader::from_str(&text);
    let mut found: Vec<Element> = Vec::new();
    let mut depth = 0;
    let element = |start: &BytesStart, depth| {
        let pairs = start.attributes().map(|attribute| {
            let attribute = attribute.unwrap();
            let value = unescape(&attribute.value).unwrap().into_owned();
            (attribute.key.as_ref().to_owned(), value)
        });
        let name = start.name().as_ref().to_owned();
        Element { name, attributes: pairs.collect(), text: String::new(), depth }
    };
    loop {
        match reader.read_event().unwrap() {
            Event::Start(start) => {
                found.push(element(&start, depth));
                depth += 1;
            }
            Event::Empty(start) => found.push(element(&start, depth)),
            Event::End(_) => depth -= 1,
            Event::Text(text) => {
                if let Some(last) = found.last_mut() {
                    last.text += text.as_ref();
                }
            }
            Event::GeneralRef(reference) => {
                let letter = unescape(&format!("&{};", reference.as_ref())).unwrap().into_owned();
                found.last_mut().unwrap().text += &letter;
            }
            Event::Eof => break,
            _ => {}
        }
    }
    for element in &mut found {
        element.text = element.text.trim().to_owned();
    }
    found
}

/// One pair of axes: a part of a picture, and the values that its places mean.
pub(super) struct Axes {
    /// What is drawn inside.
    pub(super) inside: Vec<Element>,
    /// Pixels and values of the numbers at the axes.
    x: Vec<[f64; 2]>,
    y: Vec<[f64; 2]>,
}

impl Axes {
    /// All axes of a picture from top to bottom; those without numbers at the abscissa share it with the next ones.
    pub(super) fn of(elements: &[Element]) -> Vec<Self> {
        let starts = elements.iter().enumerate().skip(1).filter(|(_, element)| element.name == "svg");
        let starts: Vec<usize> = starts.map(|(number, _)| number).collect();
        let mut out: Vec<Self> = Vec::new();
        for (number, &start) in starts.iter().enumerate() {
            let part = &elements[start..starts.get(number + 1).copied().unwrap_or(elements.len())];
            let after = part[1..].iter().position(|element| element.depth <= part[0].depth);
            let (inside, outside) = part.split_at(after.map_or(part.len(), |after| after + 1));
            let numbers = |class: &str, place: &str| {
                let own = outside.iter().filter(|element| element.get("class") == class);
                own.map(|element| [element.number(place), element.text.parse().unwrap()]).collect()
            };
            out.push(Self { inside: inside.to_vec(), x: numbers("x", "x"), y: numbers("y", "y") });
        }
        let mut below = Vec::new();
        for axes in out.iter_mut().rev() {
            if axes.x.is_empty() {
                axes.x.clone_from(&below);
            }
            below.clone_from(&axes.x);
        }
        out
    }

    /// The values at a place.
    pub(super) fn values(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let on = |numbers: &[[f64; 2]], place: f64| {
            let ([first, low], [last, high]) = (numbers[0], numbers[numbers.len() - 1]);
            low + (high - low) * (place - first) / (last - first)
        };
        [on(&self.x, x), on(&self.y, y)]
    }

    /// Ranges of the numbers at the axes.
    pub(super) fn ranges(&self) -> [f64; 2] {
        [&self.x, &self.y].map(|numbers| (numbers[numbers.len() - 1][1] - numbers[0][1]).abs())
    }

    /// The parts of each curve: paths, points and rings.
    pub(super) fn curves(&self) -> Vec<Vec<&Element>> {
        let mut out: Vec<Vec<&Element>> = Vec::new();
        let mut depth = usize::MAX;
        for element in &self.inside {
            if element.get("class") == "curve" {
                out.push(Vec::new());
                depth = element.depth;
            } else if element.depth > depth {
                out.last_mut().unwrap().push(element);
            } else {
                depth = usize::MAX;
            }
        }
        out
    }

    /// Left, lower, right and upper end of what is drawn, in values.
    pub(super) fn bounds(&self, element: &Element) -> [f64; 4] {
        let start = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        element
            .places()
            .into_iter()
            .map(|place| self.values(place))
            .fold(start, |ends, [x, y]| [ends[0].min(x), ends[1].min(y), ends[2].max(x), ends[3].max(y)])
    }

    /// Stops unless these places are those of the values.
    #[track_caller]
    pub(super) fn assert_at(&self, places: &[[f64; 2]], expected: &[[f64; 2]]) {
        assert_eq!(places.len(), expected.len());
        let ranges = self.ranges();
        for (place, expected) in places.iter().zip(expected) {
            let got = self.values(*place);
            for axis in 0..2 {
                let error = (got[axis] - expected[axis]).abs() / ranges[axis];
                assert!(error <= crate::tolerance::DRAWN, "{got:?} drawn, expected {expected:?}: {error:e}");
            }
        }
    }
}

/// The names of all curves of a picture, in the order in which they stand there.
pub(super) fn names(elements: &[Element]) -> Vec<&str> {
    elements
        .iter()
        .filter(|element| element.get("class") == "name")
        .map(|element| element.text.as_str())
        .collect()
}
