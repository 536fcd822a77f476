#![allow(unsafe_code)] // the boundary itself: raw columns become bounded, typed ones here and nowhere else
//! The inputs of a call, with bounds.

use core::marker::PhantomData;
use core::mem::{MaybeUninit, size_of};

use crate::abi::{self, View};

/// The inputs of one call.
pub struct Batch<'a> {
    view: &'a View,
}

/// One real input over the points of a batch.
#[derive(Clone, Copy)]
pub struct Column<'a> {
    ptr: *const f64,
    step: i64,
    points: usize,
    life: PhantomData<&'a f64>,
}

/// One integer input over the points of a batch.
#[derive(Clone, Copy)]
pub struct Indices<'a> {
    ptr: *const i64,
    step: i64,
    points: usize,
    life: PhantomData<&'a i64>,
}

impl<'a> Column<'a> {
    /// Value at point `i`, or the first component there.
    ///
    /// # Panics
    /// If `i` is not a point of the batch.
    #[inline]
    pub fn get(&self, i: usize) -> f64 {
        assert!(i < self.points, "point {i} of a batch of {}", self.points);
        // SAFETY: `i` is a point of the batch, and the host promises a value for each of them.
        unsafe { *self.ptr.offset(i as isize * self.step as isize) }
    }
    /// The three components of a vector at point `i`.
    ///
    /// # Panics
    /// If `i` is not a point of the batch.
    #[inline]
    pub fn vector(&self, i: usize) -> [f64; 3] {
        assert!(i < self.points, "point {i} of a batch of {}", self.points);
        // SAFETY: `i` is a point of the batch, and the host promises three adjacent components for each of them.
        unsafe {
            let at = self.ptr.offset(i as isize * self.step as isize);
            [*at, *at.add(1), *at.add(2)]
        }
    }
    /// Value `k` of the `count` adjacent values at point `i` (state variables).
    #[inline]
    pub(crate) fn adjacent(&self, i: usize, k: usize) -> f64 {
        assert!(i < self.points, "point {i} of a batch of {}", self.points);
        // SAFETY: callers keep `k` below the declared number of state variables, which the host promises to give.
        unsafe { *self.ptr.offset(i as isize * self.step as isize + k as isize) }
    }
    /// The one value that all points share, if there is one.
    #[inline]
    pub fn uniform(&self) -> Option<f64> {
        (self.step == 0 && self.points > 0).then(|| self.get(0))
    }
    /// All values as a slice, if they lie side by side.
    #[inline]
    pub fn slice(&self) -> Option<&'a [f64]> {
        // SAFETY: with a step of one the host's promise of a value per point is a promise of a contiguous array.
        (self.step == 1).then(|| unsafe { core::slice::from_raw_parts(self.ptr, self.points) })
    }
    /// The array behind the column and the number of doubles from point to point (0: one value for all).
    #[inline]
    pub fn strided(&self) -> (&'a [f64], usize) {
        let step = usize::try_from(self.step).unwrap_or(0);
        let len = if self.points == 0 { 0 } else { (self.points - 1) * step + 1 };
        // SAFETY: the last value that the host promises is that of the last point, `(points - 1) * step` doubles in.
        (unsafe { core::slice::from_raw_parts(self.ptr, len) }, step)
    }
    /// Values of the points `start ..` side by side: the host's own array, or a copy in `room`.
    #[inline]
    pub fn gather<'b>(&self, start: usize, room: &'b mut [f64]) -> &'b [f64]
    where
        'a: 'b,
    {
        if let Some(all) = self.slice() {
            return &all[start..start + room.len()];
        }
        for (k, value) in room.iter_mut().enumerate() {
            *value = self.get(start + k);
        }
        room
    }
}

impl Indices<'_> {
    /// Value at point `i`.
    ///
    /// # Panics
    /// If `i` is not a point of the batch.
    #[inline]
    pub fn get(&self, i: usize) -> i64 {
        assert!(i < self.points, "point {i} of a batch of {}", self.points);
        // SAFETY: `i` is a point of the batch, and the host promises a value for each of them.
        unsafe { *self.ptr.offset(i as isize * self.step as isize) }
    }
}

impl<'a> Batch<'a> {
    /// Takes over the view of a call in place; none if it is shorter than this side's, or makes no sense.
    ///
    /// # Safety
    /// As for [`Batch::new`].
    #[inline(always)]
    pub(crate) unsafe fn in_place(view: *const View) -> Option<Batch<'a>> {
        if view.is_null() {
            return None;
        }
        // SAFETY: the caller promises `struct_size` bytes, which begin with that number; a whole view is read in place.
        let view = unsafe {
            let given = usize::try_from((*view).struct_size).unwrap_or(0);
            (given >= size_of::<View>()).then(|| &*view)?
        };
        Self::of(view)
    }

    #[inline(always)]
    fn of(view: &'a View) -> Option<Batch<'a>> {
        (view.points >= 0).then_some(Batch { view })
    }

    /// Takes over the view of a call; one that is shorter than this side's goes to `room` first.
    ///
    /// # Safety
    /// `view` is NULL or points to at least `struct_size` bytes of a view that nobody writes for `'a` and whose columns
    /// stay valid for `'a`.
    #[inline]
    pub(crate) unsafe fn new(view: *const View, room: &'a mut MaybeUninit<View>) -> Option<Batch<'a>> {
        if view.is_null() {
            return None;
        }
        // SAFETY: the caller promises `struct_size` bytes; of a shorter view that is what is copied.
        unsafe {
            let given = usize::try_from((*view).struct_size).unwrap_or(0);
            Self::of(if given >= size_of::<View>() { &*view } else { Self::widened(view, given, room) })
        }
    }

    /// A copy of a short view, in which everything that it does not have is absent.
    ///
    /// # Safety
    /// `view` points to at least `given` bytes, fewer than a `View` has.
    #[cold]
    unsafe fn widened(view: *const View, given: usize, room: &'a mut MaybeUninit<View>) -> &'a View {
        *room = MaybeUninit::zeroed();
        // SAFETY: the caller promises `given` bytes, and the room has more; all-zero bytes are a valid `View` (absent
        // columns), and so is any prefix of one.
        unsafe {
            core::ptr::copy_nonoverlapping(view.cast::<u8>(), room.as_mut_ptr().cast::<u8>(), given);
            room.assume_init_ref()
        }
    }

    /// Number of points.
    #[inline]
    pub fn points(&self) -> usize {
        self.view.points as usize
    }
    /// The scalars of the call (times, numbers, units); its columns are better read through the methods here.
    #[inline]
    pub fn view(&self) -> &'a View {
        self.view
    }
    /// Duration of the substep; time.
    #[inline]
    pub fn dt(&self) -> f64 {
        self.view.dt
    }

    #[inline]
    fn column(&self, column: abi::Column) -> Option<Column<'a>> {
        (!column.ptr.is_null()).then_some(Column {
            ptr: column.ptr,
            step: column.step,
            points: self.points(),
            life: PhantomData,
        })
    }
    #[inline]
    fn indices(&self, column: abi::IndexColumn) -> Option<Indices<'a>> {
        (!column.ptr.is_null()).then_some(Indices {
            ptr: column.ptr,
            step: column.step,
            points: self.points(),
            life: PhantomData,
        })
    }
    /// Constant `index`, in the declared order.
    #[inline]
    pub fn constant(&self, index: usize) -> Option<Column<'a>> {
        self.listed(self.view.constants, self.view.constant_count, index)
    }
    /// The first `N` constants, if there are as many and each is one value for all points.
    #[inline]
    pub fn uniform_constants<const N: usize>(&self) -> Option<[f64; N]> {
        if self.view.constants.is_null() || self.view.constant_count < N as i64 || self.view.points == 0 {
            return None;
        }
        let mut all = [0.0; N];
        for (index, value) in all.iter_mut().enumerate() {
            // SAFETY: the host promises `constant_count` columns behind a list that is not NULL.
            let column = unsafe { *self.view.constants.add(index) };
            if column.ptr.is_null() || column.step != 0 {
                return None;
            }
            // SAFETY: the host promises the value of a column that is not absent.
            *value = unsafe { *column.ptr };
        }
        Some(all)
    }
    /// Further input `index`, in the declared order.
    #[inline]
    pub fn input(&self, index: usize) -> Option<Column<'a>> {
        self.listed(self.view.inputs, self.view.input_count, index)
    }
    #[inline]
    fn listed(&self, list: *const abi::Column, count: i64, index: usize) -> Option<Column<'a>> {
        if list.is_null() || index as i64 >= count {
            return None;
        }
        // SAFETY: the host promises `count` columns behind a list that is not NULL, and `index` is below it.
        self.column(unsafe { *list.add(index) })
    }
    /// State variables at the start of the substep, those of a point adjacent.
    #[inline]
    pub(crate) fn state(&self) -> Option<Column<'a>> {
        self.column(self.view.state)
    }
    /// State variable `k` of point `i` at the start of the substep.
    ///
    /// # Panics
    /// If `i` or `k` is out of range or the call gives no state.
    pub fn state_at(&self, i: usize, k: usize) -> f64 {
        assert!((k as i64) < self.view.state_count, "state variable {k} of {}", self.view.state_count);
        self.state().expect("the host gives the state of a law that declares one").adjacent(i, k)
    }
}

macro_rules! columns {
    ($($name:ident: $bit:ident, $text:literal;)*) => {
        impl<'a> Batch<'a> {
            $(#[doc = $text] #[inline] pub fn $name(&self) -> Option<Column<'a>> { self.column(self.view.$name) })*

            /// Field bits of `wanted` that this call does not give.
            #[inline]
            pub fn missing(&self, wanted: i64) -> i64 {
                let mut missing = wanted & !abi::WL_FIELDS_KNOWN;
                $(if wanted & abi::$bit != 0 && self.view.$name.ptr.is_null() { missing |= abi::$bit; })*
                for (bit, column) in [
                    (abi::WL_FIELD_CONTACT_STATE, &self.view.contact_state),
                    (abi::WL_FIELD_POINT_ID, &self.view.point_id),
                    (abi::WL_FIELD_ELEMENT_ID, &self.view.element_id),
                ] {
                    if wanted & bit != 0 && column.ptr.is_null() {
                        missing |= bit;
                    }
                }
                missing
            }
        }
    };
}

columns! {
    pressure: WL_FIELD_PRESSURE, "Contact pressure; pressure.";
    slip: WL_FIELD_SLIP, "Slip increment: path length over the substep; length.";
    velocity: WL_FIELD_VELOCITY, "Sliding velocity; length per time.";
    slip_vector: WL_FIELD_SLIP_VECTOR, "Net slip displacement, a vector; length.";
    normal: WL_FIELD_NORMAL, "Outward unit normal of the worn body, a vector.";
    coordinates: WL_FIELD_COORDINATES, "Position, a vector; length.";
    tangent: WL_FIELD_TANGENT, "First unit tangent, a vector.";
    temperature: WL_FIELD_TEMPERATURE, "Temperature of the worn surface.";
    counter_temperature: WL_FIELD_COUNTER_TEMPERATURE, "Temperature of the counter surface.";
    friction_stress: WL_FIELD_FRICTION_STRESS, "Friction stress on the worn body, a vector; pressure.";
    friction_coefficient: WL_FIELD_FRICTION_COEFFICIENT, "Friction coefficient.";
    friction_work: WL_FIELD_FRICTION_WORK, "Friction work per area over the substep; pressure times length.";
    accumulated_wear: WL_FIELD_ACCUMULATED_WEAR, "Wear depth at the start of the substep; length.";
    accumulated_slip: WL_FIELD_ACCUMULATED_SLIP, "Sliding distance at the start of the substep; length.";
    nodal_traction: WL_FIELD_NODAL_TRACTION, "Normal traction from nodal stresses; pressure.";
    gap: WL_FIELD_GAP, "Gap between the surfaces; length.";
    area: WL_FIELD_AREA, "Area that belongs to the point.";
}

impl<'a> Batch<'a> {
    /// Contact state: `WL_OPEN`, `WL_STICK` or `WL_SLIDING`.
    pub fn contact_state(&self) -> Option<Indices<'a>> {
        self.indices(self.view.contact_state)
    }
    /// Number of the point in the host's numbering.
    pub fn point_id(&self) -> Option<Indices<'a>> {
        self.indices(self.view.point_id)
    }
    /// Number of the contact element.
    pub fn element_id(&self) -> Option<Indices<'a>> {
        self.indices(self.view.element_id)
    }
}
