//! Data of a study: columns of numbers, how they are plotted, and their comparison with the paper.

/// A computed figure of the paper, or a further study.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// Title, in one line.
    pub title: &'static str,
    /// The numbers, all columns of equal length.
    pub columns: Vec<Column>,
    /// The axes on which they are plotted.
    pub panels: Vec<Panel>,
    /// Comparison with the paper.
    pub comparison: Vec<Comparison>,
}

/// One column of numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name that ends with the unit, as in `length_mm`; a dimensionless quantity has none.
    pub name: String,
    /// One value for each row; NaN where there is none.
    pub values: Vec<f64>,
}

/// One set of axes.
#[derive(Debug, Clone, PartialEq)]
pub enum Panel {
    /// Columns plotted over one column.
    Curves {
        /// Title.
        title: String,
        /// Label with unit, and column name, of the abscissa.
        x: (String, String),
        /// Label with unit of the ordinate.
        y: String,
        /// The curves.
        curves: Vec<Curve>,
        /// Additional lines, bands and points.
        marks: Vec<Mark>,
    },
    /// Points on logarithmic axes; points with values that are not positive are omitted.
    Places {
        /// Title.
        title: String,
        /// Label with unit of the abscissa.
        x: String,
        /// Label with unit of the ordinate.
        y: String,
        /// The points.
        series: Vec<Series>,
        /// Additional lines, bands and points.
        marks: Vec<Mark>,
    },
    /// Colour map of one column over the grid of two others.
    Map {
        /// Title.
        title: String,
        /// Label with unit, and column name, of the abscissa.
        x: (String, String),
        /// Label with unit, and column name, of the ordinate.
        y: (String, String),
        /// Column of the colour; a cell without a value stays empty.
        value: String,
        /// Additional points.
        marks: Vec<Mark>,
    },
    /// Grouped horizontal bars that start at zero, with labels on the left and numbers on the right.
    Bars {
        /// Title.
        title: String,
        /// Label with unit of the abscissa.
        x: String,
        /// Limits of the abscissa; longer bars are cut off there.
        range: [f64; 2],
        /// Legend label of each bar within a row.
        series: Vec<String>,
        /// The rows, from top to bottom.
        bars: Vec<Bar>,
    },
    /// Small maps in rows and columns, on common axes, whose cells are coloured by category.
    Atlas {
        /// Label with unit of the abscissa.
        x: String,
        /// Label with unit of the ordinate.
        y: String,
        /// The categories of cells.
        kinds: Vec<Kind>,
        /// Names of the columns within a group, and names of the groups.
        columns: [Vec<String>; 2],
        /// The rows of maps.
        rows: Vec<AtlasRow>,
    },
}

/// A row of bars.
#[derive(Debug, Clone, PartialEq)]
pub struct Bar {
    /// Heading of the group that begins with this row; empty if the row belongs to the group above.
    pub group: String,
    /// Label of the row.
    pub label: String,
    /// Its values as text.
    pub numbers: String,
    /// Colour index of its first bar, from 0; further bars take the following indices.
    pub colour: usize,
    /// Smallest (at most 0) and largest (at least 0) value of each series; `None` where there is no value.
    pub ends: Vec<Option<[f64; 2]>>,
}

/// A category of cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Kind {
    /// Label in the legend.
    pub label: String,
    /// Its colour.
    pub tint: Tint,
}

/// Colour of a category.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tint {
    /// The colour with this index, from 0.
    Colour(usize),
    /// Light grey.
    Light,
    /// Dark grey.
    Dark,
}

/// A row of small maps.
#[derive(Debug, Clone, PartialEq)]
pub struct AtlasRow {
    /// Heading of the group that begins with this row; empty if the row belongs to the group above.
    pub group: String,
    /// Label of the row.
    pub label: String,
    /// Cells of the map in each column: abscissa and ordinate, and index of the category.
    pub maps: Vec<Vec<([f64; 2], usize)>>,
}

/// A column plotted over the abscissa of its panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Label in the legend.
    pub label: String,
    /// Name of the column of the ordinate; the curve has gaps where the value is NaN.
    pub column: String,
    /// Colour index, from 0; related curves share one.
    pub colour: usize,
    /// Line style.
    pub stroke: Stroke,
}

/// A sequence of points.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Label in the legend.
    pub label: String,
    /// Colour index, from 0.
    pub colour: usize,
    /// Style of the line through the points.
    pub stroke: Stroke,
    /// Abscissa and ordinate of each point.
    pub places: Vec<[f64; 2]>,
}

/// Style of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// A line.
    Solid,
    /// A dashed line.
    Dashed,
    /// A dot for each value.
    Dots,
}

/// A line, band or point drawn in addition to the data, mostly a value from the paper.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A horizontal line at a height.
    Level(String, f64),
    /// A horizontal band between two heights.
    Band(String, [f64; 2]),
    /// A point.
    Point(String, [f64; 2]),
}

/// A row of the table that compares the models with the paper.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The compared quantity, with its unit.
    pub quantity: String,
    /// Number of decimals to print.
    pub decimals: usize,
    /// Value stated in the paper.
    pub paper: Value,
    /// Value of the paper's model, with its formulas as printed.
    pub printed: Value,
    /// Value of the exact model.
    pub exact: Value,
    /// Explanation, in a sentence.
    pub remark: String,
}

/// Content of a cell of the comparison.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// No value: it is not stated or does not exist.
    Absent,
    /// A number.
    Number(f64),
    /// Smallest and largest value.
    Range(f64, f64),
    /// A result in words.
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
    /// Relative difference of the exact model from the paper; `None` unless both are numbers.
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
