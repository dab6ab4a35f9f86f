//! A ranking as a table, and its stability in words.

use std::fmt;

use super::{Place, Ranking};
use crate::curve::Mode;
use crate::data::short;
use crate::stability::criteria::Criterion;

impl fmt::Display for Ranking {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let modes: Vec<Mode> = self
            .places
            .first()
            .map_or_else(Vec::new, |place| place.fit.agreement.modes.iter().map(|(mode, _)| *mode).collect());
        if !self.places.is_empty() {
            write!(f, "{:24} {:>2} {:>9}", "energy", "n", "R²")?;
            for mode in modes {
                write!(f, " {mode:>12}")?;
            }
            writeln!(f, " {:>9}  stability", "R²/n")?;
        }
        for place in &self.places {
            let agreement = &place.fit.agreement;
            write!(f, "{:24} {:>2} {:>9}", place.name, place.parameters(), shown(agreement.total))?;
            for (_, determination) in &agreement.modes {
                write!(f, " {:>12}", shown(*determination))?;
            }
            writeln!(f, " {:>9}  {}", shown(place.share()), place.stability())?;
        }
        for (name, error) in &self.failures {
            writeln!(f, "{name:24} not fitted: {error}")?;
        }
        Ok(())
    }
}

/// R², or a dash where it is undefined.
pub(crate) fn shown(determination: Option<f64>) -> String {
    determination.map_or_else(|| "–".into(), short)
}

impl Place {
    /// Place at which each criterion is lost first, such as `Hill, SE lost at uniaxial 2.13`, or `kept`.
    #[must_use]
    pub fn stability(&self) -> String {
        let mut groups: Vec<(String, String)> = Vec::new();
        for (criterion, lost) in Criterion::ALL.into_iter().zip(self.lost) {
            let Some(loss) = lost else { continue };
            let (name, at) = (initials(criterion), format!("{} {:.2}", loss.mode, loss.control));
            match groups.iter_mut().find(|(_, place)| *place == at) {
                Some((names, _)) => *names += &format!(", {name}"),
                None => groups.push((name.into(), at)),
            }
        }
        if groups.is_empty() {
            return "kept".into();
        }
        let groups: Vec<_> = groups.into_iter().map(|(names, at)| format!("{names} lost at {at}")).collect();
        groups.join("; ")
    }
}

/// The criterion in few letters: BE, Hill, SE.
fn initials(criterion: Criterion) -> &'static str {
    match criterion {
        Criterion::BakerEricksen => "BE",
        Criterion::Hill => "Hill",
        Criterion::StrongEllipticity => "SE",
    }
}
