//! Memory: large blocks come straight from the kernel and go back to it.
//!
//! Renders come and go inside hosts that run for days, each on threads of its own; the system's allocator would keep what these threads freed.

use std::{
    alloc::{GlobalAlloc, Layout, System},
    ptr::null_mut,
    sync::{
        Mutex, MutexGuard,
        atomic::{AtomicUsize, Ordering},
    },
};

/// Blocks from this many bytes on are the kernel's business.
const LARGE: usize = 1 << 17;

/// A large page.
const HUGE: usize = 1 << 21;

/// No page of a kernel is smaller, so every block is aligned to it.
const PAGE: usize = 4096;

/// How many freed mappings wait for their like, and how many bytes they have at most: a first touch of a page takes as long as filling ten.
const WAITING: usize = 64;
const MOST_WAITING: usize = 1 << 26;

/// The same in hosts that hold a scene of their own: what building the trees of small meshes takes on a few threads.
const MOST_WAITING_IN_HOST: usize = 1 << 24;

/// How many have freed mappings wait; where none does, none wait.
static KEEPERS: AtomicUsize = AtomicUsize::new(0);

/// How many bytes of freed mappings wait at most.
static MOST: AtomicUsize = AtomicUsize::new(MOST_WAITING_IN_HOST);

/// The system's allocator but for large blocks.
struct Memory;

#[global_allocator]
static MEMORY: Memory = Memory;

/// Has the system's allocator give back what is free in it: hosts freed there what they read a scene from, where large blocks of ours find no room.
pub(crate) fn give_back() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    // SAFETY: takes no memory of anybody's, and any thread may ask at any time.
    unsafe {
        libc::malloc_trim(0);
    }
}

/// Lets freed mappings wait for their like from now on: for a process that reads a scene, renders it and ends.
pub(crate) fn keep() {
    MOST.store(MOST_WAITING, Ordering::Relaxed);
    std::mem::forget(Keeper::new());
}

/// Lets freed mappings wait for their like until it is dropped: while trees of many meshes are built, one after the other.
#[derive(Debug)]
pub(crate) struct Keeper(());

impl Keeper {
    pub(crate) fn new() -> Self {
        KEEPERS.fetch_add(1, Ordering::Relaxed);
        Self(())
    }
}

impl Drop for Keeper {
    fn drop(&mut self) {
        if KEEPERS.fetch_sub(1, Ordering::Relaxed) > 1 {
            return;
        }
        // Whoever has them locked frees a block that may stay; the next one who keeps finds it.
        let Ok(mut waiting) = FREED.try_lock() else { return };
        (0..WAITING).for_each(|place| waiting.replace(place, (0, 0)));
    }
}

fn is_large(layout: Layout) -> bool {
    layout.size() >= LARGE && layout.align() <= PAGE
}

/// Bytes of the mapping for a large block: an eighth more at most, so that freed ones fit others.
fn mapped(size: usize) -> usize {
    size.next_multiple_of((size.next_power_of_two() / 16).max(PAGE))
}

/// Freed mappings that wait to be used again.
struct Waiting {
    /// Address and bytes; free places have none.
    blocks: [(usize, usize); WAITING],
    bytes: usize,
    /// Whose place the next one takes.
    next: usize,
}

static FREED: Mutex<Waiting> = Mutex::new(Waiting { blocks: [(0, 0); WAITING], bytes: 0, next: 0 });

impl Waiting {
    fn take(&mut self, size: usize) -> Option<usize> {
        let found = self.blocks.iter_mut().find(|(_, bytes)| *bytes == size)?;
        self.bytes -= size;
        Some(std::mem::take(found).0)
    }

    /// Keeps a mapping; those that wait the longest make room for it.
    fn keep(&mut self, block: (usize, usize)) {
        let most = MOST.load(Ordering::Relaxed);
        if block.1 > most {
            return unmap(block);
        }
        let place = self.next;
        self.next = (place + 1) % WAITING;
        self.replace(place, block);
        for later in 1..WAITING {
            if self.bytes <= most {
                break;
            }
            self.replace((place + later) % WAITING, (0, 0));
        }
    }

    fn replace(&mut self, place: usize, block: (usize, usize)) {
        let old = std::mem::replace(&mut self.blocks[place], block);
        self.bytes = self.bytes + block.1 - old.1;
        unmap(old);
    }
}

/// The mappings that wait, where any do. Whoever finds them locked goes to the kernel: allocating never waits, not even in a process that was
/// split off meanwhile.
fn freed() -> Option<MutexGuard<'static, Waiting>> {
    if KEEPERS.load(Ordering::Relaxed) > 0 { FREED.try_lock().ok() } else { None }
}

/// Gives a mapping back to the kernel.
fn unmap((block, size): (usize, usize)) {
    if size > 0 {
        // SAFETY: the block is a whole mapping of this size, which nothing uses any more.
        unsafe { libc::munmap(block as *mut libc::c_void, size) };
    }
}

/// A mapping for a large block, zeroed if asked.
fn map(size: usize, zeroed: bool) -> *mut u8 {
    let whole = mapped(size);
    if let Some(block) = freed().and_then(|mut waiting| waiting.take(whole)) {
        let block = block as *mut u8;
        if zeroed {
            // SAFETY: the mapping has at least so many bytes, and nobody else knows of it.
            unsafe { block.write_bytes(0, size) };
        }
        return block;
    }
    fresh(whole)
}

/// A new mapping. One that holds large pages starts at one, which the kernel sees to where it is a whole number of them.
fn fresh(size: usize) -> *mut u8 {
    let aligned = if size >= HUGE { size.next_multiple_of(HUGE) } else { size };
    let (protection, flags) = (libc::PROT_READ | libc::PROT_WRITE, libc::MAP_PRIVATE | libc::MAP_ANONYMOUS);
    // SAFETY: a new private mapping at an address of the kernel's choice touches no memory that is in use.
    let block = unsafe { libc::mmap(null_mut(), aligned, protection, flags, -1, 0) };
    if block == libc::MAP_FAILED {
        return null_mut();
    }
    unmap((block as usize + size, aligned - size));
    #[cfg(target_os = "linux")]
    if size >= HUGE {
        // SAFETY: advice about a mapping of our own; a kernel that does not take it does nothing.
        unsafe { libc::madvise(block, size, libc::MADV_HUGEPAGE) };
    }
    block.cast()
}

/// Frees a large block.
fn free(block: *mut u8, size: usize) {
    let block = (block as usize, mapped(size));
    match freed() {
        Some(mut waiting) => waiting.keep(block),
        None => unmap(block),
    }
}

// SAFETY: blocks are the system's or whole mappings of their own, page-aligned, zeroed where asked; which of the two follows from the layout alone,
// that callers repeat when they free. Nothing here panics or allocates.
unsafe impl GlobalAlloc for Memory {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promises are passed on.
        if is_large(layout) { map(layout.size(), false) } else { unsafe { System.alloc(layout) } }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promises are passed on.
        if is_large(layout) { map(layout.size(), true) } else { unsafe { System.alloc_zeroed(layout) } }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        if is_large(layout) {
            free(block, layout.size());
        } else {
            // SAFETY: the block came from the system's allocator with this layout.
            unsafe { System.dealloc(block, layout) }
        }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the caller promises a size that makes a layout with this alignment.
        let wanted = unsafe { Layout::from_size_align_unchecked(size, layout.align()) };
        match (is_large(layout), is_large(wanted)) {
            // SAFETY: the block came from the system's allocator with this layout.
            (false, false) => unsafe { System.realloc(block, layout, size) },
            (true, true) if mapped(layout.size()) == mapped(size) => block,
            #[cfg(target_os = "linux")]
            (true, true) => {
                // SAFETY: the block is a mapping of the old size; the kernel moves its pages.
                let moved = unsafe { libc::mremap(block.cast(), mapped(layout.size()), mapped(size), libc::MREMAP_MAYMOVE) };
                if moved == libc::MAP_FAILED { null_mut() } else { moved.cast() }
            }
            // SAFETY: both blocks are at least as long as what is copied, and distinct.
            _ => unsafe {
                let moved = self.alloc(wanted);
                if !moved.is_null() {
                    block.copy_to_nonoverlapping(moved, layout.size().min(size));
                    self.dealloc(block, layout);
                }
                moved
            },
        }
    }
}
