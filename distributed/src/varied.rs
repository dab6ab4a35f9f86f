//! Individual parameters of elements, from a table.

use std::collections::{HashMap, HashSet};
use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

use piola::batch::TileMaterial;
use piola::material::PerPoint;
use piola_scenes::material::MaterialSpec;
use piola_scenes::options::{parameter, with_values};

use crate::error::Error;

/// Title of the column with the numbers of elements.
const ELEMENT: &str = "element";

/// Rows of a table for the elements of a rank.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    path: PathBuf,
    parameters: Vec<String>,
    /// Line of the table, and cells in the order of the parameters, of each element, by its tag.
    rows: HashMap<u64, (u64, Vec<String>)>,
    checksum: u32,
}

impl Varied {
    /// Reads the rows of these elements from a table with a title line, values separated by commas.
    ///
    /// # Errors
    /// [`Error::Options`], with the line and the problem.
    pub fn read(path: &Path, tags: &HashSet<u64>) -> Result<Self, Error> {
        let wrong = |reason: String| Error::Options(format!("--vary {}: {reason}", path.display()));
        let file = File::open(path).map_err(|error| wrong(error.to_string()))?;
        let mut bytes = Summed { file: BufReader::new(file), sum: crc32fast::Hasher::new() };
        let mut table =
            csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(&mut bytes);
        let titles = table.headers().map_err(|error| wrong(error.to_string()))?.clone();
        let column = titles.iter().position(|title| title == ELEMENT);
        let column = column.filter(|_| titles.len() > 1).ok_or_else(|| {
            wrong(format!("the first line needs a title `{ELEMENT}`, and one for each parameter that varies"))
        })?;
        let others = |(place, cell): (usize, &str)| (place != column).then(|| cell.to_owned());
        let parameters: Vec<String> = titles.iter().enumerate().filter_map(others).collect();
        if let Some(twice) =
            titles.iter().find(|&title| titles.iter().filter(|&other| other == title).count() > 1)
        {
            return Err(wrong(format!("two columns have the title `{twice}`")));
        }
        let mut rows = HashMap::with_capacity(tags.len());
        for row in table.records() {
            let row = row.map_err(|error| wrong(error.to_string()))?;
            let line = row.position().map_or(0, csv::Position::line);
            let tag = row.get(column).unwrap_or_default();
            let tag: u64 = tag
                .parse()
                .map_err(|_| wrong(format!("line {line}: `{tag}` is not the number of an element")))?;
            if tags.contains(&tag) {
                let cells = row.iter().enumerate().filter_map(others).collect();
                if let Some((before, _)) = rows.insert(tag, (line, cells)) {
                    return Err(wrong(format!("element {tag} has two rows, in lines {before} and {line}")));
                }
            }
        }
        drop(table);
        Ok(Self { path: path.to_owned(), parameters, rows, checksum: bytes.sum.finalize() })
    }

    /// Checksum of the table.
    #[must_use]
    pub fn checksum(&self) -> u32 {
        self.checksum
    }

    /// Material with the parameters of the table for the elements with these tags, in the order of the tags.
    ///
    /// # Errors
    /// [`Error::Options`] for an element without a row, and for a value that the material refuses.
    pub fn elements(
        &self,
        material: &MaterialSpec,
        tags: impl Iterator<Item = u64>,
    ) -> Result<Box<dyn TileMaterial<f64>>, Error> {
        let wrong = |reason: String| Error::Options(format!("--vary {}: {reason}", self.path.display()));
        let material = material.explicit()?;
        let of_element = |tag: u64| {
            let (line, cells) =
                self.rows.get(&tag).ok_or_else(|| wrong(format!("there is no row of element {tag}")))?;
            let in_line = |reason: String| wrong(format!("line {line}: {reason}"));
            let given = self.parameters.iter().zip(cells);
            let given = given.map(|(name, cell)| {
                parameter(&format!("{name}={cell}")).map_err(|reason| in_line(format!("{name}: {reason}")))
            });
            let given: Vec<_> = given.collect::<Result<_, _>>()?;
            let material = with_values(material.clone(), given).and_then(|material| material.interpreted());
            material.map_err(|error| in_line(error.to_string()))
        };
        let materials: Vec<_> = tags.map(of_element).collect::<Result<_, _>>()?;
        Ok(Box::new(PerPoint::new(materials).map_err(|error| wrong(error.to_string()))?))
    }
}

/// File with a checksum that is computed during reading.
struct Summed {
    file: BufReader<File>,
    sum: crc32fast::Hasher,
}

impl Read for Summed {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(buffer)?;
        self.sum.update(&buffer[..count]);
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Varied, Error> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("soft.csv");
        std::fs::write(&path, text).expect("a file");
        Varied::read(&path, &HashSet::from([3, 5]))
    }

    fn elements(text: &str) -> Result<(), Error> {
        let material = MaterialSpec::typical("neo-Hookean")?;
        read(text)?.elements(&material, [5, 3].into_iter()).map(|_| ())
    }

    #[test]
    fn rows_of_other_elements_may_be_there_in_any_order() -> Result<(), Error> {
        elements("mu, element\n1e5, 5\n# half as stiff\n50 kPa, 3\nnothing, 9\n")?;
        let [one, other] =
            [1, 2].map(|mu| read(&format!("element,mu\n3,{mu}\n")).map(|table| table.checksum()));
        assert_ne!(one?, other?);
        Ok(())
    }

    #[test]
    fn errors_have_the_line() {
        for (text, expected) in [
            ("mu\n1e5\n", "a title `element`"),
            ("element\n3\n", "one for each parameter"),
            ("element,mu\n3,1e5\n", "no row of element 5"),
            ("element,mu\n3,1e5\nfive,1e5\n", "line 3: `five` is not the number of an element"),
            ("element,mu\n3,1e5\n3,1e5\n", "element 3 has two rows, in lines 2 and 3"),
            ("element,mu\n3,1e5\n5,soft\n", "line 3: mu: "),
            ("element,mu,mu\n3,1e5,1e5\n5,1e5,2e5\n", "two columns have the title `mu`"),
            ("element,mu\n3,1e5\n5,-1\n", "line 3: "),
            ("element,stiffness\n3,1e5\n5,1\n", "stiffness"),
            ("element,mu\n3,1e5\n5\n", "found record with 1 fields"),
        ] {
            let error = elements(text).expect_err(text).to_string();
            assert!(error.starts_with("--vary ") && error.contains(expected), "{text:?}: {error}");
        }
    }
}
