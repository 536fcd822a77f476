//! Handles: what a solver holds of a law or a surface, told apart from anything else and from closed ones.
#![allow(unsafe_code)] // reason: goes back from the solver's pointer to the handle.

use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};

use crate::error::HostError;

/// What a handle leads to.
pub(crate) trait Kind {
    /// Begins every handle of this kind and of no other.
    const MAGIC: u64;
    /// What messages call it.
    const NAME: &'static str;
}

/// A handle stays where it is when it is closed, empty, so that a use after that is an error.
#[repr(C)]
pub(crate) struct Handle<T> {
    magic: u64,
    slot: Mutex<Option<Box<T>>>,
}

impl<T: Kind> Handle<T> {
    /// A pointer that C holds, for ever.
    pub(crate) fn give(content: T) -> *mut Self {
        Box::into_raw(Box::new(Self { magic: T::MAGIC, slot: Mutex::new(Some(Box::new(content))) }))
    }

    /// The handle behind a pointer.
    ///
    /// # Safety
    /// The pointer is NULL, or eight bytes at it can be read; if they are the magic number it came from [`Handle::give`].
    pub(crate) unsafe fn find<'a>(pointer: *const Self) -> Result<&'a Self, HostError> {
        if pointer.is_null() {
            return Err(HostError::Handle { found: "NULL", expected: T::NAME });
        }
        // SAFETY: the caller vouches for eight bytes, and the address is looked at first.
        if !pointer.is_aligned() || unsafe { *pointer.cast::<u64>() } != T::MAGIC {
            return Err(HostError::Handle { found: "none of this kind", expected: T::NAME });
        }
        // SAFETY: the magic number says that it came from `give`, which lets nobody free it.
        Ok(unsafe { &*pointer })
    }

    /// The content; another thread that has it is waited for.
    pub(crate) fn wait(&self) -> Result<Held<'_, T>, HostError> {
        Held::new(self.slot.lock().map_err(|_| broken())?)
    }

    /// The content, unless another thread has it.
    pub(crate) fn take_turn(&self) -> Result<Held<'_, T>, HostError> {
        match self.slot.try_lock() {
            Ok(guard) => Held::new(guard),
            Err(TryLockError::WouldBlock) => Err(HostError::Busy),
            Err(TryLockError::Poisoned(_)) => Err(broken()),
        }
    }

    /// Empties the handle, also after an internal error; another thread that has the content is waited for.
    pub(crate) fn close(&self) -> Result<(), HostError> {
        let content = self.slot.lock().unwrap_or_else(PoisonError::into_inner).take();
        content.map(drop).ok_or_else(closed::<T>)
    }
}

fn broken() -> HostError {
    HostError::Internal("an earlier call of this handle failed".to_owned())
}

fn closed<T: Kind>() -> HostError {
    HostError::Handle { found: "closed", expected: T::NAME }
}

/// The content of an open handle, for one call.
pub(crate) struct Held<'a, T>(MutexGuard<'a, Option<Box<T>>>);

impl<'a, T: Kind> Held<'a, T> {
    fn new(guard: MutexGuard<'a, Option<Box<T>>>) -> Result<Self, HostError> {
        if guard.is_some() { Ok(Self(guard)) } else { Err(closed::<T>()) }
    }

    /// The content.
    pub(crate) fn get(&mut self) -> Result<&mut T, HostError> {
        self.0.as_deref_mut().ok_or_else(closed::<T>)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Thing;

    impl Kind for Thing {
        const MAGIC: u64 = 7;
        const NAME: &'static str = "thing";
    }

    #[test]
    fn a_handle_is_told_from_anything_else_and_from_a_closed_one() {
        let given = Handle::give(Thing);
        // SAFETY: it has just been given.
        let handle = unsafe { Handle::find(given) }.unwrap();
        let first = handle.take_turn().unwrap();
        assert!(matches!(handle.take_turn(), Err(HostError::Busy)));
        drop(first);
        handle.close().unwrap();
        assert!(matches!(handle.take_turn(), Err(HostError::Handle { found: "closed", .. })));
        assert!(matches!(handle.close(), Err(HostError::Handle { found: "closed", .. })));
        let other = [8_u64, 0];
        for wrong in [std::ptr::null(), other.as_ptr().cast(), other.as_ptr().cast::<u8>().wrapping_add(1).cast()] {
            // SAFETY: NULL, or memory that can be read and is no handle.
            assert!(unsafe { Handle::<Thing>::find(wrong) }.is_err());
        }
        // The page of the book says so.
        assert_eq!(size_of::<Handle<Thing>>(), 24);
        // SAFETY: nobody else has it.
        drop(unsafe { Box::from_raw(given) });
    }

    #[test]
    fn a_handle_whose_call_has_failed_can_only_be_closed() {
        let given = Handle::give(Thing);
        // SAFETY: it has just been given.
        let handle = unsafe { Handle::find(given) }.unwrap();
        let failed = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            let _held = handle.take_turn();
            panic!("for the test");
        }));
        assert!(failed.is_err());
        assert!(matches!(handle.take_turn(), Err(HostError::Internal(_))));
        handle.close().unwrap();
        // SAFETY: nobody else has it.
        drop(unsafe { Box::from_raw(given) });
    }
}
