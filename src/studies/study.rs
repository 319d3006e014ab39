//! What a study is: columns of numbers, how they are drawn, what they say beside the paper.

/// One figure of the paper, computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// What it shows, in a line.
    pub title: &'static str,
    /// The numbers, all columns of equal length.
    pub columns: Vec<Column>,
    /// How they are drawn.
    pub panels: Vec<Panel>,
    /// What they say beside the paper.
    pub comparison: Vec<Comparison>,
}

/// One column of numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name that ends with the unit, as in `length_mm`; a pure number has none.
    pub name: String,
    /// One value for each row; NaN where there is none.
    pub values: Vec<f64>,
}

/// One set of axes.
#[derive(Debug, Clone, PartialEq)]
pub enum Panel {
    /// Columns against a column.
    Curves {
        /// What is drawn.
        title: String,
        /// Label with unit, and column of the abscissa.
        x: (String, String),
        /// Label with unit of the ordinate.
        y: String,
        /// What is drawn.
        curves: Vec<Curve>,
        /// What else is drawn.
        marks: Vec<Mark>,
    },
    /// Points on logarithmic axes; what is not positive is left out.
    Places {
        /// What is drawn.
        title: String,
        /// Label with unit of the abscissa.
        x: String,
        /// Label with unit of the ordinate.
        y: String,
        /// What is drawn.
        series: Vec<Series>,
        /// What else is drawn.
        marks: Vec<Mark>,
    },
    /// A column as colours over the grid of two others.
    Map {
        /// What is drawn.
        title: String,
        /// Label with unit, and column of the abscissa.
        x: (String, String),
        /// Label with unit, and column of the ordinate.
        y: (String, String),
        /// Column of the colour; a cell without a value stays empty.
        value: String,
        /// What else is drawn.
        marks: Vec<Mark>,
    },
    /// Horizontal bars from zero, in groups, each with its label before it and its numbers behind it.
    Bars {
        /// What is drawn.
        title: String,
        /// Label with unit of the abscissa.
        x: String,
        /// Ends of the abscissa; a bar that goes on is cut there.
        range: [f64; 2],
        /// What the bars of a row belong to, for the legend.
        series: Vec<String>,
        /// The rows, from above.
        bars: Vec<Bar>,
    },
    /// Many small maps of kinds on axes of one range, in rows and columns.
    Atlas {
        /// Label with unit of the abscissa.
        x: String,
        /// Label with unit of the ordinate.
        y: String,
        /// The kinds of cells.
        kinds: Vec<Kind>,
        /// Names of the columns, and of groups of as many columns each.
        columns: [Vec<String>; 2],
        /// The maps.
        rows: Vec<AtlasRow>,
    },
}

/// A row of bars.
#[derive(Debug, Clone, PartialEq)]
pub struct Bar {
    /// What the rows from here on belong to; empty: to the same as the row above.
    pub group: String,
    /// What it shows.
    pub label: String,
    /// Its numbers, in words.
    pub numbers: String,
    /// Number of the colour of the first of its bars, from 0; the others are the next ones.
    pub colour: usize,
    /// Least and largest value of each series, on both sides of zero; none where there is no value.
    pub ends: Vec<Option<[f64; 2]>>,
}

/// A kind of cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Kind {
    /// What the legend calls it.
    pub label: String,
    /// Its colour.
    pub tint: Tint,
}

/// A colour of cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tint {
    /// The colour of this number, from 0.
    Colour(usize),
    /// Light grey.
    Light,
    /// Dark grey.
    Dark,
}

/// A row of small maps.
#[derive(Debug, Clone, PartialEq)]
pub struct AtlasRow {
    /// What the rows from here on belong to; empty: to the same as the row above.
    pub group: String,
    /// What it shows.
    pub label: String,
    /// For each column the cells: abscissa, ordinate and number of the kind.
    pub maps: Vec<Vec<([f64; 2], usize)>>,
}

/// A column drawn against the panel's abscissa.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// What the legend calls it.
    pub label: String,
    /// Column of the ordinate; gaps where it has no value.
    pub column: String,
    /// Number of the colour, from 0; curves that belong together share one.
    pub colour: usize,
    /// How it is drawn.
    pub stroke: Stroke,
}

/// Points that belong together, in their order.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// What the legend calls it.
    pub label: String,
    /// Number of the colour, from 0.
    pub colour: usize,
    /// How they are joined.
    pub stroke: Stroke,
    /// Abscissa and ordinate of each.
    pub places: Vec<[f64; 2]>,
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// A line.
    Solid,
    /// A dashed line.
    Dashed,
    /// A dot for each value.
    Dots,
}

/// What is drawn beside the columns, mostly a number of the paper.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A horizontal line at a height.
    Level(String, f64),
    /// A horizontal band between two heights.
    Band(String, [f64; 2]),
    /// A point.
    Point(String, [f64; 2]),
}

/// A row of the table that sets paper and model side by side.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// What is compared, with its unit.
    pub quantity: String,
    /// Decimals that are worth showing.
    pub decimals: usize,
    /// What the paper states.
    pub paper: Value,
    /// What the paper's model gives, its formulas taken as printed.
    pub printed: Value,
    /// What the exact model gives.
    pub exact: Value,
    /// What this means, in a sentence.
    pub remark: String,
}

/// What stands in a cell of the comparison.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Nothing: it is not stated or does not exist.
    Absent,
    /// A number.
    Number(f64),
    /// Smallest and largest.
    Range(f64, f64),
    /// A finding that is no number.
    Words(String),
}

impl Study {
    /// The values of a column.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        self.columns.iter().find(|column| column.name == name).map(|column| column.values.as_slice())
    }
}

impl Column {
    /// A column of the given name.
    #[must_use]
    pub fn new(name: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), values }
    }
}

impl Curve {
    /// A curve of the given label, column, colour and stroke.
    #[must_use]
    pub fn new(label: impl Into<String>, column: impl Into<String>, colour: usize, stroke: Stroke) -> Self {
        Self { label: label.into(), column: column.into(), colour, stroke }
    }
}

impl Comparison {
    /// Relative difference of the exact model from the paper; none unless both are numbers.
    ///
    /// ```
    /// use mcm::studies::{Comparison, Value};
    /// let row = Comparison {
    ///     quantity: "force (N)".into(),
    ///     decimals: 2,
    ///     paper: Value::Number(1.0),
    ///     printed: Value::Absent,
    ///     exact: Value::Number(1.5),
    ///     remark: String::new(),
    /// };
    /// assert_eq!(row.difference(), Some(0.5));
    /// ```
    #[must_use]
    pub fn difference(&self) -> Option<f64> {
        match (&self.paper, &self.exact) {
            (Value::Number(paper), Value::Number(exact)) => Some(exact / paper - 1.0),
            _ => None,
        }
    }
}
