//! Files that a luminaire's file names, which lie beside it.

use std::fs::{File, metadata};
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
        let path = path.with_file_name(name);
        // A pipe would be waited for as soon as it is opened.
        let file = metadata(&path).and_then(|found| match found.is_file() {
            true => Ok(File::open(&path)?.take(found.len().min(LONGEST + 1))),
            false => Err(Error::other("not a file")),
        });
        file.and_then(|mut file| file.read_to_end(&mut bytes)).map_err(|error| error.to_string())?;
        if bytes.len() as u64 > LONGEST { Err(format!("more than {LONGEST} bytes")) } else { Ok(bytes) }
    }
}

/// Of what is read from memory.
pub(crate) fn nothing_beside(_: &str) -> Result<Vec<u8>, String> {
    Err("it is not known where the luminaire's file lies".to_owned())
}
