//! Tables of multipoles of coils with iron cores: CSV with the columns `degree` and `t_m_per_a`, the coefficients of
//! [`crate::magnetics::MultipoleTable`] in T m^(degree + 2) / A.

use super::SceneFile;
use crate::error::Error;

impl SceneFile {
    /// Takes the multipoles from the tables that coils name, whose text `text_of` gives.
    pub(super) fn find_multipoles(
        &mut self,
        text_of: impl Fn(&str) -> Result<String, Error>,
    ) -> Result<(), Error> {
        for (number, coil) in (1..).zip(&mut self.coil) {
            let Some(name) = coil.multipoles_csv.as_deref().filter(|_| coil.multipoles.is_none()) else {
                continue;
            };
            let refused =
                |reason: String| Error::Syntax { what: format!("coil[{number}].multipoles_csv"), reason };
            let text = text_of(name).map_err(|error| refused(error.to_string()))?;
            let read = read(&text).map_err(|reason| refused(format!("{name}: {reason}")))?;
            (coil.multipoles, coil.multipoles_csv) = (Some(read), None);
        }
        Ok(())
    }
}

/// The coefficients by degree, 0 where a degree is missing.
#[cfg(feature = "csv")]
fn read(text: &str) -> Result<Vec<f64>, String> {
    use crate::magnetics::MultipoleTable;

    /// A row of a table.
    #[derive(Debug, serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Row {
        degree: usize,
        t_m_per_a: f64,
    }

    let mut coefficients: Vec<Option<f64>> = Vec::new();
    for row in csv::Reader::from_reader(text.as_bytes()).into_deserialize() {
        let Row { degree, t_m_per_a } = row.map_err(|error| error.to_string())?;
        let most = MultipoleTable::MOST_DEGREES;
        if degree == 0 || degree > most {
            return Err(format!("degree {degree}: from 1 (the dipole) to {most}"));
        }
        coefficients.resize(coefficients.len().max(degree), None);
        if coefficients[degree - 1].replace(t_m_per_a).is_some() {
            return Err(format!("degree {degree} stands there twice"));
        }
    }
    if coefficients.is_empty() {
        return Err("it has no rows".into());
    }
    Ok(coefficients.into_iter().map(Option::unwrap_or_default).collect())
}

#[cfg(not(feature = "csv"))]
fn read(_: &str) -> Result<Vec<f64>, String> {
    Err("not read: this build of mcm has no reader for CSV files, the feature `csv`".into())
}
