//! Hints to memory.

/// Has the cache fetch an item that is about to be read; past the end nothing happens.
#[inline(always)]
pub fn prefetch<T>(items: &[T], index: usize) {
    #[cfg(target_arch = "x86_64")]
    if let Some(item) = items.get(index) {
        for line in (0..size_of::<T>()).step_by(64) {
            let place = core::ptr::from_ref(item).cast::<i8>().wrapping_add(line);
            // SAFETY: a hint reads nothing, and `place` is within the item.
            unsafe { core::arch::x86_64::_mm_prefetch::<{ core::arch::x86_64::_MM_HINT_T0 }>(place) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (items, index);
}
