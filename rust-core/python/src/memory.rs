//! Memory: large blocks come straight from the kernel and go back to it.
//!
//! Renders come and go inside hosts that run for days, each on threads of its own; the system's allocator would keep what these threads freed.

use std::{
    alloc::{GlobalAlloc, Layout, System},
    ptr::null_mut,
};

/// Blocks from this many bytes on are the kernel's business.
const LARGE: usize = 1 << 17;

/// Blocks from this many bytes on want large pages: a picture's first touch is a fault for each page.
#[cfg(target_os = "linux")]
const HUGE: usize = 1 << 22;

/// No page of a kernel is smaller, so every block is aligned to it.
const PAGE: usize = 4096;

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

fn is_large(layout: Layout) -> bool {
    layout.size() >= LARGE && layout.align() <= PAGE
}

fn map(size: usize) -> *mut u8 {
    let (protection, flags) = (libc::PROT_READ | libc::PROT_WRITE, libc::MAP_PRIVATE | libc::MAP_ANONYMOUS);
    // SAFETY: a new private mapping at an address of the kernel's choice touches no memory that is in use.
    let block = unsafe { libc::mmap(null_mut(), size, protection, flags, -1, 0) };
    if block == libc::MAP_FAILED {
        return null_mut();
    }
    #[cfg(target_os = "linux")]
    if size >= HUGE {
        // SAFETY: advice about a mapping of our own; a kernel that does not take it does nothing.
        unsafe { libc::madvise(block, size, libc::MADV_HUGEPAGE) };
    }
    block.cast()
}

// SAFETY: blocks are the system's or whole mappings of their own, page-aligned and zeroed; which of the two follows from the layout alone, that
// callers repeat when they free. Nothing here panics or allocates.
unsafe impl GlobalAlloc for Memory {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promises are passed on.
        if is_large(layout) { map(layout.size()) } else { unsafe { System.alloc(layout) } }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promises are passed on; fresh mappings are zero.
        if is_large(layout) { map(layout.size()) } else { unsafe { System.alloc_zeroed(layout) } }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        if is_large(layout) {
            // SAFETY: the block is a mapping of this size, which nothing uses any more.
            unsafe { libc::munmap(block.cast(), layout.size()) };
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
            #[cfg(target_os = "linux")]
            (true, true) => {
                // SAFETY: the block is a mapping of the old size; the kernel moves its pages.
                let moved = unsafe { libc::mremap(block.cast(), layout.size(), size, libc::MREMAP_MAYMOVE) };
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
