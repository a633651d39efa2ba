//! Files that a luminaire's file names, which lie beside it.

use std::fs::File;
use std::io::{Error, Read};
use std::path::Path;

/// Bytes of the longest of them: tilt factors take a few hundred.
const LONGEST: u64 = 1 << 20;

/// Gives the bytes of the file with a name, without folders, that lies beside the one being read, or says why it has none.
pub type Beside<'a> = dyn FnMut(&str) -> Result<Vec<u8>, String> + 'a;

/// Reads files in the folder of `path`, which itself need not exist.
pub fn beside(path: &Path) -> impl FnMut(&str) -> Result<Vec<u8>, String> + '_ {
    |name| {
        let mut bytes = Vec::new();
        let file = File::open(path.with_file_name(name)).and_then(|file| match file.metadata()?.is_file() {
            true => Ok(file),
            false => Err(Error::other("not a file")),
        });
        file.and_then(|file| file.take(LONGEST + 1).read_to_end(&mut bytes)).map_err(|error| error.to_string())?;
        if bytes.len() as u64 > LONGEST { Err(format!("more than {LONGEST} bytes")) } else { Ok(bytes) }
    }
}

/// Of what is read from memory.
pub(crate) fn nothing_beside(_: &str) -> Result<Vec<u8>, String> {
    Err("it is not known where the luminaire's file lies".to_owned())
}
