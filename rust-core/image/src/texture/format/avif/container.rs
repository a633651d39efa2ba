//! The boxes of an AVIF file that lead to its picture (ISO/IEC 14496-12 and 23008-12, AVIF 1.1).

/// The type of a box, an item or a reference.
pub(super) type Name = [u8; 4];

/// Where the bytes of an item are: in the file or in the box `idat`.
struct Place {
    in_idat: bool,
    extents: Vec<(u64, u64)>,
}

/// What the box `meta` says of the items of a file.
#[derive(Default)]
pub(super) struct Meta<'a> {
    /// The item that is the picture.
    pub(super) primary: u32,
    idat: &'a [u8],
    kinds: Vec<(u32, Name)>,
    places: Vec<(u32, Place)>,
    properties: Vec<(Name, &'a [u8])>,
    owned: Vec<(u32, Vec<usize>)>,
    references: Vec<(Name, u32, Vec<u32>)>,
}

impl<'a> Meta<'a> {
    /// Reads the boxes of a file; nothing where one is missing or cut short.
    pub(super) fn read(file: &'a [u8]) -> Option<Self> {
        let mut meta = Self::default();
        let (_, contents) = boxes(file).find(|(name, _)| name == b"meta")?;
        for (name, data) in boxes(contents.get(4..)?) {
            match &name {
                b"pitm" => meta.primary = read_primary(data)?,
                b"idat" => meta.idat = data,
                b"iinf" => meta.kinds = read_kinds(data)?,
                b"iloc" => meta.places = read_places(data)?,
                b"iprp" => meta.read_properties(data)?,
                b"iref" => meta.references = read_references(data)?,
                _ => {}
            }
        }
        Some(meta)
    }

    fn read_properties(&mut self, data: &'a [u8]) -> Option<()> {
        for (name, data) in boxes(data) {
            match &name {
                b"ipco" => self.properties = boxes(data).collect(),
                b"ipma" => self.owned.extend(read_owners(data)?),
                _ => {}
            }
        }
        Some(())
    }

    /// The type of an item.
    pub(super) fn kind(&self, item: u32) -> Option<Name> {
        self.kinds.iter().find(|(id, _)| *id == item).map(|(_, kind)| *kind)
    }

    /// The contents of an item's properties of a type.
    pub(super) fn properties(&self, item: u32, name: Name) -> impl Iterator<Item = &'a [u8]> {
        let owned = self.owned.iter().filter(move |(id, _)| *id == item).flat_map(|(_, indices)| indices);
        owned.filter_map(move |index| self.properties.get(*index).filter(|(found, _)| *found == name).map(|(_, data)| *data))
    }

    /// The items that refer to `item` by references of a type.
    pub(super) fn referrers(&self, name: Name, item: u32) -> impl Iterator<Item = u32> {
        self.references.iter().filter(move |(found, _, to)| *found == name && to.contains(&item)).map(|(_, from, _)| *from)
    }

    /// Whether an item has a reference of a type.
    pub(super) fn refers(&self, name: Name, item: u32) -> bool {
        self.references.iter().any(|(found, from, _)| (*found, *from) == (name, item))
    }

    /// The bytes of an item; nothing where its extents leave the file.
    pub(super) fn data(&self, file: &[u8], item: u32) -> Option<Vec<u8>> {
        let (_, place) = self.places.iter().find(|(id, _)| *id == item)?;
        let source = if place.in_idat { self.idat } else { file };
        let mut data = Vec::new();
        for &(start, length) in &place.extents {
            let rest = source.get(usize::try_from(start).ok()?..)?;
            // A length of zero means all that follows.
            let length = if length == 0 { rest.len() } else { usize::try_from(length).ok()? };
            // An item is no larger than its file, whatever its extents are.
            if data.len() + length.min(rest.len()) > source.len() {
                return None;
            }
            data.extend_from_slice(rest.get(..length)?);
        }
        Some(data)
    }
}

/// Numbers in network order from the front of a slice.
struct Numbers<'a>(&'a [u8]);

impl Numbers<'_> {
    /// The next `bytes` bytes, at most eight, as a number.
    fn next(&mut self, bytes: usize) -> Option<u64> {
        let (number, rest) = self.0.split_at_checked(bytes)?;
        self.0 = rest;
        Some(number.iter().fold(0, |sum, byte| (sum << 8) | u64::from(*byte)))
    }

    /// The next number of an item: 16 bits, or 32.
    fn item(&mut self, is_wide: bool) -> Option<u32> {
        self.next(if is_wide { 4 } else { 2 }).map(|id| id as u32)
    }
}

/// The boxes in `data`: types and contents; up to the first that is cut short.
fn boxes(data: &[u8]) -> impl Iterator<Item = (Name, &[u8])> {
    let mut rest = data;
    std::iter::from_fn(move || {
        let (size, body) = rest.split_first_chunk::<4>()?;
        let (name, body) = body.split_first_chunk::<4>()?;
        let (head, length) = match u32::from_be_bytes(*size) {
            0 => (8, rest.len() as u64),
            1 => (16, u64::from_be_bytes(*body.first_chunk()?)),
            length => (8, u64::from(length)),
        };
        let length = usize::try_from(length).ok()?;
        let contents = rest.get(head..length)?;
        rest = &rest[length..];
        Some((*name, contents))
    })
}

/// The version of a box, its flags, and what follows.
fn versioned(data: &[u8]) -> Option<(u8, u32, Numbers<'_>)> {
    let (head, rest) = data.split_first_chunk::<4>()?;
    Some((head[0], u32::from_be_bytes(*head) & 0xff_ffff, Numbers(rest)))
}

fn read_primary(data: &[u8]) -> Option<u32> {
    let (version, _, mut numbers) = versioned(data)?;
    numbers.item(version > 0)
}

fn read_kinds(data: &[u8]) -> Option<Vec<(u32, Name)>> {
    let (version, _, mut numbers) = versioned(data)?;
    numbers.item(version > 0)?;
    let mut kinds = Vec::new();
    for (name, data) in boxes(numbers.0) {
        let (version, _, mut numbers) = versioned(data)?;
        if name == *b"infe" && version >= 2 {
            let item = numbers.item(version > 2)?;
            numbers.next(2)?;
            kinds.push((item, *numbers.0.first_chunk()?));
        }
    }
    Some(kinds)
}

fn read_places(data: &[u8]) -> Option<Vec<(u32, Place)>> {
    let (version, _, mut numbers) = versioned(data)?;
    let sizes = numbers.next(2)?;
    let size = |shift: u32| (sizes >> shift) as usize & 15;
    let (offset, length, base, index) = (size(12), size(8), size(4), if version > 0 { size(0) } else { 0 });
    if [offset, length, base, index].iter().any(|size| *size > 8) {
        return None;
    }
    let mut places = Vec::new();
    for _ in 0..numbers.item(version > 1)? {
        let item = numbers.item(version > 1)?;
        let method = if version > 0 { numbers.next(2)? & 15 } else { 0 };
        numbers.next(2)?;
        let start = numbers.next(base)?;
        let mut extents = Vec::new();
        for _ in 0..numbers.next(2)? {
            numbers.next(index)?;
            let offset = numbers.next(offset)?;
            extents.push((start.checked_add(offset)?, numbers.next(length)?));
            // Extents without a size of their own would be endless.
            if numbers.0.is_empty() && offset == 0 && length == 0 {
                break;
            }
        }
        if method > 1 {
            return None;
        }
        places.push((item, Place { in_idat: method == 1, extents }));
    }
    Some(places)
}

/// For each item the indices of its properties, from zero.
fn read_owners(data: &[u8]) -> Option<Vec<(u32, Vec<usize>)>> {
    let (version, flags, mut numbers) = versioned(data)?;
    let is_wide = flags & 1 == 1;
    let mut owners = Vec::new();
    for _ in 0..numbers.next(4)? {
        let item = numbers.item(version > 0)?;
        let mut indices = Vec::new();
        for _ in 0..numbers.next(1)? {
            let index = numbers.next(if is_wide { 2 } else { 1 })? & if is_wide { 0x7fff } else { 0x7f };
            // Zero stands for no property.
            indices.extend((index as usize).checked_sub(1));
        }
        owners.push((item, indices));
    }
    Some(owners)
}

fn read_references(data: &[u8]) -> Option<Vec<(Name, u32, Vec<u32>)>> {
    let (version, _, numbers) = versioned(data)?;
    let mut references = Vec::new();
    for (name, data) in boxes(numbers.0) {
        let mut numbers = Numbers(data);
        let from = numbers.item(version > 0)?;
        let count = numbers.next(2)?;
        references.push((name, from, (0..count).map_while(|_| numbers.item(version > 0)).collect()));
    }
    Some(references)
}
