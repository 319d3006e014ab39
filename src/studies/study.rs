//! Data of a study: columns of numbers, marks beside them, and their comparison with the paper.

/// A computed figure of the paper, or a further study.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// The numbers, all columns of equal length.
    pub columns: Vec<Column>,
    /// Points and levels besides the columns.
    pub marks: Vec<Mark>,
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

/// A point or level besides the columns: a value of the paper, or an event such as a snap, a fold or the end of a branch.
///
/// A band is two marks whose names end in `from` and `to`.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// What it is.
    pub name: String,
    /// Its abscissa; `None` for a level, which has no place.
    pub x: Option<f64>,
    /// Its ordinate.
    pub y: Option<f64>,
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

impl Mark {
    /// A level of the ordinate.
    #[must_use]
    pub fn level(name: impl Into<String>, y: f64) -> Self {
        Self { name: name.into(), x: None, y: Some(y) }
    }

    /// A point.
    #[must_use]
    pub fn point(name: impl Into<String>, [x, y]: [f64; 2]) -> Self {
        Self { name: name.into(), x: Some(x), y: Some(y) }
    }

    /// A band of the ordinate.
    #[must_use]
    pub fn band(name: &str, [from, to]: [f64; 2]) -> [Self; 2] {
        [Self::level(format!("{name} from"), from), Self::level(format!("{name} to"), to)]
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
