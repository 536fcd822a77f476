//! Looks whether a law has left the floating-point environment as it found it, and puts it back if not.
//!
//! To read the control registers once holds a processor up for 5 to 40 ns, as much as a small call takes. So it is read
//! once, behind the call: before it, this thread's environment is what it was behind the call before. Where that is not
//! found again, the law or the program itself has changed it, which a second call tells apart, because a law is pure.

use std::cell::Cell;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicU64, Ordering};

use super::super::evaluation::Evaluator;
use super::super::float_env::{FloatEnv, FloatEnvChange};
use super::LawInstance;

thread_local! {
    /// Of the instance that this thread called last the number, which is never 0.
    static LAST: Cell<u64> = const { Cell::new(0) };
    /// The environment before and after that call.
    static ENV: Cell<Option<FloatEnv>> = const { Cell::new(None) };
}

/// A number that no other instance has.
pub(super) fn next_number() -> u64 {
    static NUMBERS: AtomicU64 = AtomicU64::new(1);
    NUMBERS.fetch_add(1, Ordering::Relaxed)
}

/// The environment before a call.
#[derive(Clone, Copy)]
pub(super) struct Before {
    env: FloatEnv,
    /// Whether it is that behind the call before, not one that was read.
    pub(super) is_assumed: bool,
}

/// How a call of a law is looked after.
#[derive(Clone, Copy)]
pub(super) enum Guard<'a> {
    /// Whoever made the guard looks when all pieces have been called.
    Around,
    /// Each piece is looked after, and it is noted whether one of them changed something.
    Each(&'a Cell<bool>),
}

impl Guard<'_> {
    /// Calls a law for one piece.
    #[inline]
    pub(super) fn around<T>(self, law: &LawInstance, call: impl FnOnce() -> T) -> T {
        let Guard::Each(changed) = self else { return call() };
        let before = FloatEnv::capture();
        let answer = call();
        if let Some(change) = before.changed_since() {
            before.restore();
            changed.set(true);
            law.warn_of_floats(change);
        }
        answer
    }
}

impl LawInstance {
    /// Evaluates by `pieces`, with the floating-point environment at the end what it was before.
    ///
    /// If the law is found to change it, `pieces` is run again with each call put back by itself, so that what one call
    /// of the law does never reaches the next.
    #[inline]
    pub(super) fn guarded<T>(&self, mut pieces: impl FnMut(Guard<'_>) -> T) -> T {
        if self.changes_floats.load(Ordering::Relaxed) {
            return pieces(Guard::Each(&Cell::new(false)));
        }
        let before = self.floats_before();
        let answer = pieces(Guard::Around);
        match self.floats_after(before) {
            None => answer,
            Some(change) => {
                drop(answer);
                self.again(change, before.is_assumed, pieces)
            }
        }
    }

    /// The environment before a call of the law.
    #[inline]
    pub(super) fn floats_before(&self) -> Before {
        match ENV.get() {
            Some(env) if LAST.get() == self.number => Before { env, is_assumed: true },
            _ => Before { env: FloatEnv::capture(), is_assumed: false },
        }
    }

    /// What the environment is now, if it is not what it was before a call of the law.
    #[inline]
    pub(super) fn floats_after(&self, before: Before) -> Option<FloatEnvChange> {
        let change = before.env.changed_since();
        if change.is_none() && !before.is_assumed {
            self.remember(before.env);
        }
        change
    }

    fn remember(&self, env: FloatEnv) {
        LAST.set(self.number);
        ENV.set(Some(env));
    }

    /// Finds out who changed the environment, and evaluates with it put back.
    #[cold]
    pub(super) fn again<T>(
        &self,
        change: FloatEnvChange,
        is_assumed: bool,
        mut pieces: impl FnMut(Guard<'_>) -> T,
    ) -> T {
        change.before.restore();
        let changed = Cell::new(false);
        let answer = pieces(Guard::Each(&changed));
        if is_assumed && !changed.get() {
            // The law leaves it alone; so the program had set it anew since the call before, and it is to stay so.
            drop(answer);
            change.after.restore();
            self.remember(change.after);
            return pieces(Guard::Each(&changed));
        }
        // A law may do so in its first call only.
        self.warn_of_floats(change);
        self.remember(change.before);
        answer
    }

    #[cold]
    fn warn_of_floats(&self, change: FloatEnvChange) {
        if !self.changes_floats.swap(true, Ordering::Relaxed) {
            let library = self.created.law.library();
            let law = &self.descriptor().name;
            self.warnings.lock().unwrap_or_else(PoisonError::into_inner).push(format!(
                "law `{law}` of `{library}` changed the floating-point environment while it was evaluated ({change}); \
                 it is put back after every call"
            ));
        }
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests;
