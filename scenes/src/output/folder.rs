//! A folder with the files of a run, in which nothing of anybody else's is touched.
//!
//! Files are written as the run goes on, so that whatever ends it leaves a shorter run. Each is entered in a
//! list in the folder before it is created: what is not in the list is somebody else's. A folder that holds
//! an earlier run gets another folder inside it for the new one, which takes the place of the earlier run at
//! the end, if it is complete; otherwise it stays where it is.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;

use super::whole::{new_folder, sync_folder};
use super::{Names, PARTIAL, RESERVE, is_frame, is_result, rank};

mod exchange;
mod listing;
#[cfg(test)]
mod tests;

use exchange::Moves;
use listing::{LISTING, Listing};

/// Beginning of the name of a folder for a new run beside an earlier one.
const UNFINISHED: &str = "unfinished-";
/// Beginning of the name of a folder for the files of an earlier run while they are being replaced.
const REPLACED: &str = "replaced-";
/// Room that is kept for the closing files of a run that has filled the disk, in bytes.
const ROOM: usize = 64 * 1024;

/// A folder that is being filled with the files of a run.
#[derive(Debug)]
pub struct Folder {
    target: PathBuf,
    /// The folder that files are written to: the target, or a folder in it.
    work: PathBuf,
    listing: Listing,
    /// An earlier run in the target.
    earlier: Option<Earlier>,
    /// Folders that did not exist before, innermost first.
    created: Vec<PathBuf>,
    leftovers: Vec<PathBuf>,
}

/// Files in the target that a complete run takes the place of.
#[derive(Debug)]
struct Earlier {
    listing: Listing,
    /// Files that piola has not written, and that may be replaced nevertheless.
    given_up: BTreeSet<String>,
}

impl Folder {
    /// Prepares a folder for the files of a run, creating it if it does not exist.
    ///
    /// `names` are those of the files to come. Files with such names that no run has written are replaced at
    /// the end if `force` says so.
    ///
    /// # Errors
    /// [`Error::ForeignFiles`] if the folder holds frames or results that no run has written and that may not
    /// be replaced, [`Error::InTheWay`] if a file to come has the name of something that is no file,
    /// [`Error::Busy`] if another run writes there, and [`Error::Folder`] if files cannot be written there.
    /// The folder is then as it was.
    pub fn prepare(target: &Path, names: Names, force: bool) -> Result<Self, Error> {
        let existed = |path: &&Path| !path.as_os_str().is_empty() && !path.exists();
        let created: Vec<_> = target.ancestors().take_while(existed).map(PathBuf::from).collect();
        let prepared = Self::prepare_created(target, names, force, created.clone());
        if prepared.is_err() {
            remove_folders(&created);
        }
        prepared
    }

    fn prepare_created(
        target: &Path,
        names: Names,
        force: bool,
        created: Vec<PathBuf>,
    ) -> Result<Self, Error> {
        let failed = |source| Error::Folder { path: target.into(), source };
        fs::create_dir_all(target).map_err(failed)?;
        let listing = Listing::open(target)?;
        let content = Content::of(target, listing.as_ref(), names)?;
        if !force && !content.foreign.is_empty() {
            return Err(Error::ForeignFiles { folder: target.into(), names: content.foreign });
        }
        let given_up: BTreeSet<_> = content.foreign.into_iter().filter(|name| names.contain(name)).collect();
        let is_free = content.frames == 0 && given_up.is_empty();
        let (work, listing, earlier) = match listing {
            // A list without files is what is left of a run that wrote none.
            Some(listing) if is_free => (target.to_owned(), listing, None),
            None if is_free => (target.to_owned(), Listing::create(target)?, None),
            listing => {
                let listing = listing.map_or_else(|| Listing::create(target), Ok)?;
                let earlier = Earlier { listing, given_up };
                match beside(target) {
                    Ok((work, listing)) => (work, listing, Some(earlier)),
                    Err(error) => {
                        earlier.leave(target);
                        return Err(error);
                    }
                }
            }
        };
        Ok(Self { target: target.into(), work, listing, earlier, created, leftovers: content.leftovers })
    }

    /// Opens the folder of a run, to go on with it.
    ///
    /// # Errors
    /// Like [`Folder::prepare`], and [`Error::NothingToResume`] if the folder holds no run.
    pub fn reopen(target: &Path, names: Names) -> Result<Self, Error> {
        let nothing = || Error::NothingToResume { folder: target.into() };
        if !target.is_dir() {
            return Err(nothing());
        }
        let listing = Listing::open(target)?.ok_or_else(nothing)?;
        let content = Content::of(target, Some(&listing), names)?;
        if !content.foreign.is_empty() {
            return Err(Error::ForeignFiles { folder: target.into(), names: content.foreign });
        }
        let (target, leftovers) = (target.to_owned(), content.leftovers);
        Ok(Self { work: target.clone(), target, listing, earlier: None, created: Vec::new(), leftovers })
    }

    /// The folder that files are written to.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.work
    }

    /// Folders in this one that hold runs which were cut off.
    #[must_use]
    pub fn leftovers(&self) -> &[PathBuf] {
        &self.leftovers
    }

    /// Whether the run has written a file of this name.
    #[must_use]
    pub fn contains(&self, name: &str) -> bool {
        self.listing.contains(name) && self.work.join(name).is_file()
    }

    /// Writes one file, which `content` fills. It appears when it is complete, in place of one that the run
    /// has written before.
    ///
    /// # Errors
    /// [`Error::Write`] if the disk is full, `content` fails, or somebody else has written a file of that
    /// name meanwhile. The folder is then as it was.
    pub fn write(
        &mut self,
        name: &str,
        content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), Error> {
        self.listing.add(PARTIAL)?;
        let [partial, path] = [PARTIAL, name].map(|name| self.work.join(name));
        let is_own = self.listing.contains(name);
        self.listing.add(name)?;
        let written = File::create(&partial).and_then(|file| {
            let mut file = BufWriter::new(file);
            content(&mut file)?;
            file.flush()?;
            nothing_in_the_way(&path, is_own)?;
            fs::rename(&partial, &path)
        });
        written.map_err(|source| {
            let _ = fs::remove_file(&partial);
            if !is_own {
                self.listing.withdraw(name);
            }
            Error::Write { path, source }
        })
    }

    /// Writes one file, which is on the disk before it replaces one that the run has written before.
    ///
    /// # Errors
    /// Like [`Folder::write`].
    pub fn replace(
        &mut self,
        name: &str,
        content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), Error> {
        self.write(name, |file| {
            content(file)?;
            file.flush()?;
            file.get_ref().sync_all()
        })
    }

    /// Ends a run, and returns the folder that holds its files.
    ///
    /// A complete run takes the place of an earlier one; one that is not complete leaves the earlier one as
    /// it is.
    ///
    /// # Errors
    /// [`Error::Exchange`] if the files of the earlier run cannot be replaced. Both runs are then whole, and
    /// the error says where.
    pub fn finish(mut self, is_complete: bool) -> Result<PathBuf, Error> {
        self.release();
        self.listing.tidy();
        match self.earlier.take() {
            Some(earlier) if is_complete => self.take_place(earlier),
            Some(earlier) => {
                earlier.leave(&self.target);
                Ok(self.work)
            }
            None => Ok(self.work),
        }
    }

    /// Keeps room for the closing files of a run that fills the disk, until [`release`](Self::release).
    ///
    /// # Errors
    /// Like [`Folder::write`].
    pub fn reserve(&mut self) -> Result<(), Error> {
        self.write(RESERVE, |file| file.write_all(&[0; ROOM]))
    }

    /// Gives the room back that was kept.
    pub fn release(&mut self) {
        let _ = fs::remove_file(self.work.join(RESERVE));
    }

    /// Removes all files of the run, and its folder if that did not exist before.
    pub fn abandon(self) {
        for name in self.listing.names() {
            let _ = fs::remove_file(self.work.join(name));
        }
        let _ = fs::remove_file(self.work.join(LISTING));
        if self.work != self.target {
            let _ = fs::remove_dir(&self.work);
        }
        if let Some(earlier) = self.earlier {
            earlier.leave(&self.target);
        }
        remove_folders(&self.created);
    }

    /// Moves the files of the earlier run away, the last first, and those of this one into their places, the
    /// first first: at any moment, the target holds the beginning of one of them.
    fn take_place(self, mut earlier: Earlier) -> Result<PathBuf, Error> {
        let Self { target, work, listing, .. } = self;
        let kept = |source| Error::Exchange { folder: target.clone(), kept: work.clone(), source };
        let old = earlier.files(&target);
        let new = sorted(listing.names());
        let set_up = sync_all(&work, &new).and_then(|()| {
            for name in &new {
                nothing_in_the_way(&target.join(name), earlier.covers(name))?;
            }
            new_folder(&target, REPLACED)
        });
        let aside = match set_up {
            Ok(aside) => aside,
            Err(source) => {
                earlier.leave(&target);
                return Err(kept(source));
            }
        };
        let mut moves = Moves::default();
        let exchanged = earlier.exchange([&old, &new], [&target, &work, &aside], &listing, &mut moves);
        if exchanged.is_ok() {
            sync_folder(&target);
            for name in &old {
                let _ = fs::remove_file(aside.join(name));
            }
            let _ = fs::remove_dir(&work);
        } else {
            moves.undo();
            earlier.leave(&target);
        }
        let _ = fs::remove_file(aside.join(LISTING));
        let _ = fs::remove_dir(&aside);
        exchanged.map(|()| target.clone()).map_err(kept)
    }
}

impl Earlier {
    /// Moves the old files from the target to a folder aside, and the new ones from their folder to the
    /// target.
    fn exchange(
        &mut self,
        [old, new]: [&[String]; 2],
        [target, work, aside]: [&Path; 3],
        listing: &Listing,
        moves: &mut Moves,
    ) -> io::Result<()> {
        // Wherever this is cut off, each file is in the list of its folder.
        let mut replaced = Listing::create(aside).map_err(io::Error::other)?;
        for name in new.iter().chain(old) {
            self.listing.add(name).and_then(|()| replaced.add(name)).map_err(io::Error::other)?;
        }
        for name in old.iter().rev() {
            if listing.contains(name) {
                let permissions = fs::metadata(target.join(name))?.permissions();
                fs::set_permissions(work.join(name), permissions)?;
            }
            moves.rename(target.join(name), aside.join(name))?;
        }
        for name in new {
            moves.rename(work.join(name), target.join(name))?;
        }
        fs::rename(work.join(LISTING), target.join(LISTING))
    }

    /// Leaves the files as they are; a list that was made for files of somebody else goes.
    fn leave(mut self, target: &Path) {
        for name in &self.given_up {
            self.listing.withdraw(name);
        }
        self.listing.tidy();
        if self.listing.names().next().is_none() {
            let _ = fs::remove_file(target.join(LISTING));
        }
    }

    /// Whether a complete run may take the place of a file of this name.
    fn covers(&self, name: &str) -> bool {
        self.listing.contains(name) || self.given_up.contains(name)
    }

    /// The files that exist, in the order in which a run writes them.
    fn files(&self, target: &Path) -> Vec<String> {
        let given_up = self.given_up.iter().map(String::as_str);
        let names = self.listing.names().chain(given_up);
        sorted(names.filter(|name| target.join(name).is_file()))
    }
}

/// A folder in the target for a new run beside an earlier one.
fn beside(target: &Path) -> Result<(PathBuf, Listing), Error> {
    let failed = |source| Error::Folder { path: target.into(), source };
    let work = new_folder(target, UNFINISHED).map_err(failed)?;
    match Listing::create(&work) {
        Ok(listing) => Ok((work, listing)),
        Err(error) => {
            let _ = fs::remove_dir(work);
            Err(error)
        }
    }
}

/// Content of a folder, as far as it concerns a run.
struct Content {
    /// Number of frames of an earlier run.
    frames: usize,
    /// Files with names that a run gives, and that no run has written.
    foreign: Vec<String>,
    /// Folders that hold runs which were cut off.
    leftovers: Vec<PathBuf>,
}

impl Content {
    fn of(folder: &Path, listing: Option<&Listing>, names: Names) -> Result<Self, Error> {
        let failed = |source| Error::Folder { path: folder.into(), source };
        let mut content = Self { frames: 0, foreign: Vec::new(), leftovers: Vec::new() };
        for entry in fs::read_dir(folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            // Names that are not in UTF-8 are nobody's but the user's.
            let Ok(name) = entry.file_name().into_string() else { continue };
            let kind = entry.file_type().map_err(failed)?;
            let is_own = listing.is_some_and(|listing| listing.contains(&name));
            if is_result(&name) {
                match (kind.is_file(), is_own) {
                    (true, true) => content.frames += usize::from(is_frame(&name)),
                    (true, false) => content.foreign.push(name),
                    (false, is_own) if is_own || names.contain(&name) => {
                        return Err(Error::InTheWay { path: entry.path() });
                    }
                    (false, _) => {}
                }
            } else if kind.is_dir() && [UNFINISHED, REPLACED].iter().any(|prefix| name.starts_with(prefix)) {
                content.leftovers.extend(Some(entry.path()).filter(|path| path.join(LISTING).is_file()));
            }
        }
        content.foreign.sort_unstable();
        content.leftovers.sort_unstable();
        Ok(content)
    }
}

/// Names in the order in which a run writes the files.
fn sorted<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut names: Vec<_> = names.map(String::from).collect();
    names.sort_unstable_by(|one, other| rank(one).cmp(&rank(other)).then_with(|| one.cmp(other)));
    names
}

fn sync_all(folder: &Path, names: &[String]) -> io::Result<()> {
    names.iter().try_for_each(|name| File::open(folder.join(name))?.sync_all())
}

/// An error if there is a file that is not to be replaced.
fn nothing_in_the_way(path: &Path, is_replaced: bool) -> io::Result<()> {
    match is_replaced || fs::symlink_metadata(path).is_err() {
        true => Ok(()),
        false => Err(io::Error::other(format!("{} has appeared meanwhile", path.display()))),
    }
}

/// Removes folders that are empty.
fn remove_folders(innermost_first: &[PathBuf]) {
    for folder in innermost_first {
        let _ = fs::remove_dir(folder);
    }
}
