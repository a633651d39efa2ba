//! Hints to memory.

/// Has the cache fetch an item that is about to be read; past the end nothing happens.
#[inline(always)]
pub fn prefetch<T>(items: &[T], index: usize) {
    if let Some(item) = items.get(index) {
        prefetch_at(core::ptr::from_ref(item).addr(), size_of::<T>());
    }
}

/// Has the cache fetch what is at an address, whatever it is: all lines of 64 bytes that begin within `size` bytes.
#[inline(always)]
pub fn prefetch_at(address: usize, size: usize) {
    #[cfg(target_arch = "x86_64")]
    for line in (0..size).step_by(64) {
        let place = core::ptr::without_provenance::<i8>(address.wrapping_add(line));
        // SAFETY: a hint reads nothing, and no address is wrong.
        unsafe { core::arch::x86_64::_mm_prefetch::<{ core::arch::x86_64::_MM_HINT_T0 }>(place) };
    }
    #[cfg(target_arch = "aarch64")]
    for line in (0..size).step_by(64) {
        let place = address.wrapping_add(line);
        // SAFETY: a hint reads nothing, and no address is wrong.
        unsafe { core::arch::asm!("prfm pldl1keep, [{place}]", place = in(reg) place, options(nostack, preserves_flags, readonly)) };
    }
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    let _ = (address, size);
}
