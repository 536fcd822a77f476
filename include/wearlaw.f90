! wearlaw.f90: the C ABI of wear laws, major version 1, for Fortran 2008 (iso_c_binding), and what wearlaw_point.inc needs.
!
! A law is a module that uses this one, declares `about` and `quantities`, contains a function `point` and includes
! wearlaw_point.inc; README.md shows it. The types are those of wearlaw.h, field by field.
!
! SPDX-License-Identifier: MIT OR Apache-2.0

module wearlaw
  use, intrinsic :: iso_c_binding
  implicit none
  public

  integer(c_int32_t), parameter :: WL_ABI_MAJOR = 1_c_int32_t
  integer(c_int32_t), parameter :: WL_ABI_MINOR = 0_c_int32_t
  integer(c_int), parameter :: WL_NAME_SIZE = 64
  integer(c_int), parameter :: WL_VERSION_SIZE = 32
  integer(c_int), parameter :: WL_SUMMARY_SIZE = 256
  integer(c_int32_t), parameter :: WL_OK = 0_c_int32_t
  integer(c_int32_t), parameter :: WL_UNRELIABLE = 1_c_int32_t
  integer(c_int32_t), parameter :: WL_CUT_STEP = 2_c_int32_t
  integer(c_int32_t), parameter :: WL_OUT_OF_DOMAIN = 3_c_int32_t
  integer(c_int32_t), parameter :: WL_MISSING_INPUT = 4_c_int32_t
  integer(c_int32_t), parameter :: WL_FAILED = 5_c_int32_t
  integer(c_int32_t), parameter :: WL_NO_MORE = -1_c_int32_t
  integer(c_int64_t), parameter :: WL_FIELD_PRESSURE = 1_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_SLIP = 2_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_VELOCITY = 4_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_SLIP_VECTOR = 8_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_NORMAL = 16_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_COORDINATES = 32_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_TANGENT = 64_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_TEMPERATURE = 128_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_COUNTER_TEMPERATURE = 256_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_FRICTION_STRESS = 512_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_FRICTION_COEFFICIENT = 1024_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_FRICTION_WORK = 2048_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_ACCUMULATED_WEAR = 4096_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_ACCUMULATED_SLIP = 8192_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_NODAL_TRACTION = 16384_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_GAP = 32768_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_AREA = 65536_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_CONTACT_STATE = 131072_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_POINT_ID = 262144_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELD_ELEMENT_ID = 524288_c_int64_t
  integer(c_int64_t), parameter :: WL_FIELDS_KNOWN = 1048575_c_int64_t
  integer(c_int64_t), parameter :: WL_OUT_DIRECTION = 1_c_int64_t
  integer(c_int64_t), parameter :: WL_OUT_STATE = 2_c_int64_t
  integer(c_int64_t), parameter :: WL_OUT_D_PRESSURE = 4_c_int64_t
  integer(c_int64_t), parameter :: WL_OUT_STATUS = 8_c_int64_t
  integer(c_int64_t), parameter :: WL_OUTS_KNOWN = 15_c_int64_t
  integer(c_int64_t), parameter :: WL_CLAIM_DETERMINISTIC = 1_c_int64_t
  integer(c_int64_t), parameter :: WL_CLAIM_NON_NEGATIVE = 2_c_int64_t
  integer(c_int64_t), parameter :: WL_CLAIM_LINEAR_IN_DT = 4_c_int64_t
  integer(c_int64_t), parameter :: WL_CLAIM_ZERO_WITHOUT_PRESSURE = 8_c_int64_t
  integer(c_int64_t), parameter :: WL_CLAIM_ZERO_WITHOUT_SLIP = 16_c_int64_t
  integer(c_int64_t), parameter :: WL_CLAIM_FRAME_INDIFFERENT = 32_c_int64_t
  integer(c_int64_t), parameter :: WL_CLAIMS_KNOWN = 63_c_int64_t
  integer(c_int64_t), parameter :: WL_FLAG_SERIAL = 1_c_int64_t
  integer(c_int64_t), parameter :: WL_FLAG_OPEN_POINTS = 2_c_int64_t
  integer(c_int64_t), parameter :: WL_FLAG_KINKS = 4_c_int64_t
  integer(c_int64_t), parameter :: WL_FLAGS_KNOWN = 7_c_int64_t
  integer(c_int64_t), parameter :: WL_QUANTITY_CLOSES_UNITS = 1_c_int64_t
  integer(c_int64_t), parameter :: WL_QUANTITY_ABOVE_MINIMUM = 2_c_int64_t
  integer(c_int64_t), parameter :: WL_QUANTITY_BELOW_MAXIMUM = 4_c_int64_t
  integer(c_int32_t), parameter :: WL_KIND_CONSTANT = 0_c_int32_t
  integer(c_int32_t), parameter :: WL_KIND_STATE = 1_c_int32_t
  integer(c_int32_t), parameter :: WL_KIND_INPUT = 2_c_int32_t
  integer(c_int32_t), parameter :: WL_KIND_FIELD = 3_c_int32_t
  integer(c_int64_t), parameter :: WL_OPEN = 0_c_int64_t
  integer(c_int64_t), parameter :: WL_STICK = 1_c_int64_t
  integer(c_int64_t), parameter :: WL_SLIDING = 2_c_int64_t

  ! Bytes of the structs that the host allocates, as this module knows them.
  integer(c_int64_t), parameter :: WL_VIEW_BYTES = 536_c_int64_t
  integer(c_int64_t), parameter :: WL_OUTPUT_BYTES = 88_c_int64_t

  ! A value that must be given, and no bound.
  real(c_double), parameter :: wl_required = transfer(9221120237041090560_c_int64_t, 1.0_c_double)
  real(c_double), parameter :: wl_infinity = transfer(9218868437227405312_c_int64_t, 1.0_c_double)

  type, bind(C) :: wl_host
    integer(c_int64_t) :: struct_size, abi_minor, provides, accepts
    character(kind=c_char) :: name(WL_NAME_SIZE), version(WL_VERSION_SIZE)
  end type wl_host

  type, bind(C) :: wl_quantity
    integer(c_int64_t) :: struct_size
    character(kind=c_char) :: name(WL_NAME_SIZE), summary(WL_SUMMARY_SIZE)
    real(c_double) :: metre, kilogram, second, kelvin, minimum, maximum, default_value
    integer(c_int64_t) :: flags
  end type wl_quantity

  type, bind(C) :: wl_column
    type(c_ptr) :: ptr
    integer(c_int64_t) :: step
  end type wl_column

  type, bind(C) :: wl_index_column
    type(c_ptr) :: ptr
    integer(c_int64_t) :: step
  end type wl_index_column

  type, bind(C) :: wl_view
    integer(c_int64_t) :: struct_size, points, dimension, request
    real(c_double) :: time, dt, step_time
    integer(c_int64_t) :: load_step, substep, cycle, material, pair, body, counter_body
    real(c_double) :: reference_temperature, absolute_zero, unit_metre, unit_kilogram, unit_second, unit_kelvin
    integer(c_int64_t) :: constant_count
    type(c_ptr) :: constants
    integer(c_int64_t) :: input_count
    type(c_ptr) :: inputs
    integer(c_int64_t) :: state_count
    type(wl_column) :: state, pressure, slip, velocity, slip_vector, normal, coordinates, tangent, temperature
    type(wl_column) :: counter_temperature, friction_stress, friction_coefficient, friction_work, accumulated_wear
    type(wl_column) :: accumulated_slip, nodal_traction, gap, area
    type(wl_index_column) :: contact_state, point_id, element_id
  end type wl_view

  type, bind(C) :: wl_output
    integer(c_int64_t) :: struct_size
    type(c_ptr) :: increment, direction, state, status
    integer(c_int64_t) :: first_bad
    real(c_double) :: dt_factor
    integer(c_int64_t) :: missing
    type(c_ptr) :: text
    integer(c_int64_t) :: text_size
    type(c_ptr) :: d_pressure
  end type wl_output

  type, bind(C) :: wl_law
    integer(c_int64_t) :: struct_size, abi_minor
    character(kind=c_char) :: name(WL_NAME_SIZE), version(WL_VERSION_SIZE), summary(WL_SUMMARY_SIZE), source(WL_SUMMARY_SIZE)
    integer(c_int64_t) :: reads, uses, writes, claims, flags, constant_count, state_count, input_count
    real(c_double) :: pressure_degree
    integer(c_int64_t) :: pressure_degree_constant
    type(c_funptr) :: describe, create, evaluate, destroy, extension
  end type wl_law

  ! Units: exponents of metre, kilogram, second, kelvin.
  type :: wl_unit
    real(c_double) :: metre = 0, kilogram = 0, second = 0, kelvin = 0
  end type wl_unit
  type(wl_unit), parameter :: wl_number = wl_unit()
  type(wl_unit), parameter :: wl_metre = wl_unit(metre=1)
  type(wl_unit), parameter :: wl_per_metre = wl_unit(metre=-1)
  type(wl_unit), parameter :: wl_square_metre = wl_unit(metre=2)
  type(wl_unit), parameter :: wl_kilogram = wl_unit(kilogram=1)
  type(wl_unit), parameter :: wl_second = wl_unit(second=1)
  type(wl_unit), parameter :: wl_per_second = wl_unit(second=-1)
  type(wl_unit), parameter :: wl_kelvin = wl_unit(kelvin=1)
  type(wl_unit), parameter :: wl_per_kelvin = wl_unit(kelvin=-1)
  type(wl_unit), parameter :: wl_metre_per_second = wl_unit(1, 0, -1, 0)
  type(wl_unit), parameter :: wl_newton = wl_unit(1, 1, -2, 0)
  type(wl_unit), parameter :: wl_joule = wl_unit(2, 1, -2, 0)
  type(wl_unit), parameter :: wl_pascal = wl_unit(-1, 1, -2, 0)
  type(wl_unit), parameter :: wl_per_pascal = wl_unit(1, -1, 2, 0)
  type(wl_unit), parameter :: wl_pascal_per_kelvin = wl_unit(-1, 1, -2, -1)
  type(wl_unit), parameter :: wl_joule_per_square_metre = wl_unit(0, 1, -2, 0)
  type(wl_unit), parameter :: wl_watt_per_square_metre = wl_unit(0, 1, -3, 0)
  type(wl_unit), parameter :: wl_kilogram_per_cubic_metre = wl_unit(-3, 1, 0, 0)

  ! A constant (WL_KIND_CONSTANT), state variable (WL_KIND_STATE) or further input (WL_KIND_INPUT) of a law; bounds in SI.
  type :: wl_declared
    integer(c_int32_t) :: kind
    character(len=63) :: name
    type(wl_unit) :: unit
    real(c_double) :: minimum, maximum, preset
    character(len=255) :: summary = ' '
    integer(c_int64_t) :: flags = 0
  end type wl_declared

  ! What a law says of itself.
  type :: wl_about
    character(len=63) :: name
    character(len=31) :: version
    character(len=255) :: summary
    character(len=255) :: source = ' '
    integer(c_int64_t) :: reads = 0 ! field bits the law must have
    integer(c_int64_t) :: uses = 0 ! field bits used if present: wl_has(in, WL_FIELD_..)
    integer(c_int64_t) :: writes = 0 ! WL_OUT_D_PRESSURE, WL_OUT_DIRECTION; the state is understood
    integer(c_int64_t) :: claims = 0
    integer(c_int64_t) :: flags = 0
    real(c_double) :: pressure_degree = wl_required ! not a number: not claimed
    integer(c_int64_t) :: pressure_degree_constant = 0 ! from 1; 0: none
  end type wl_about

  ! What `point` sees: only the fields that the law reads or uses are loaded, the others are not a number (indices: -1).
  integer, parameter :: WL_MOST_INPUTS = 16
  type :: wl_call
    real(c_double) :: dt, time, absolute_zero
    integer(c_int64_t) :: given ! bits of the fields in `uses` that are there
    type(c_ptr) :: view, instance ! the wl_view, for what is one value for the call: load_step, cycle, material ..
  end type wl_call
  type, extends(wl_call) :: wl_in
    real(c_double) :: pressure = wl_required
    real(c_double) :: slip = wl_required
    real(c_double) :: velocity = wl_required
    real(c_double) :: temperature = wl_required
    real(c_double) :: counter_temperature = wl_required
    real(c_double) :: friction_coefficient = wl_required
    real(c_double) :: friction_work = wl_required
    real(c_double) :: accumulated_wear = wl_required
    real(c_double) :: accumulated_slip = wl_required
    real(c_double) :: nodal_traction = wl_required
    real(c_double) :: gap = wl_required
    real(c_double) :: area = wl_required
    real(c_double) :: slip_vector(3) = wl_required
    real(c_double) :: normal(3) = wl_required
    real(c_double) :: coordinates(3) = wl_required
    real(c_double) :: tangent(3) = wl_required
    real(c_double) :: friction_stress(3) = wl_required
    integer(c_int64_t) :: contact_state = -1
    integer(c_int64_t) :: point_id = -1
    integer(c_int64_t) :: element_id = -1
    real(c_double) :: input(WL_MOST_INPUTS) = wl_required ! further inputs in the order of their declaration
  end type wl_in

  ! What `point` sets; d_pressure and direction count only if the law writes them.
  type :: wl_out
    real(c_double) :: increment = 0, d_pressure = 0
    real(c_double) :: direction(3) = 0 ! preset minus the normal, which a law that writes directions reads
    real(c_double) :: dt_factor = 0.5_c_double ! with WL_CUT_STEP
    logical :: speak = .false. ! a text is wanted: if (out%speak) out%text = 'why'
    character(len=160) :: text
  end type wl_out

contains

  pure logical function wl_has(in, field)
    type(wl_in), intent(in) :: in
    integer(c_int64_t), intent(in) :: field
    wl_has = iand(in%given, field) /= 0
  end function wl_has

  ! Copies a text into a C character array, cut to its length and closed by a NUL.
  pure subroutine wl_text(text, chars)
    character(len=*), intent(in) :: text
    character(kind=c_char), intent(out) :: chars(:)
    integer :: i, n
    n = min(len_trim(text), size(chars) - 1)
    do i = 1, n
      chars(i) = text(i:i)
    end do
    chars(n + 1:) = c_null_char
  end subroutine wl_text

  ! The same for a buffer of the host, which may be absent.
  subroutine wl_text_to(text, buffer, bytes)
    character(len=*), intent(in) :: text
    type(c_ptr), intent(in) :: buffer
    integer(c_int64_t), intent(in) :: bytes
    character(kind=c_char), pointer :: chars(:)
    if (.not. c_associated(buffer) .or. bytes < 1) return
    call c_f_pointer(buffer, chars, [bytes])
    call wl_text(text, chars)
  end subroutine wl_text_to

  ! Copies the first `bytes` bytes.
  subroutine wl_copy(from, to, bytes)
    type(c_ptr), intent(in) :: from, to
    integer(c_int64_t), intent(in) :: bytes
    integer(c_int8_t), pointer :: a(:), b(:)
    call c_f_pointer(from, a, [bytes])
    call c_f_pointer(to, b, [bytes])
    b = a
  end subroutine wl_copy

  ! Name of a field from the number of its bit; blank if this version does not know it.
  pure function wl_field_name(bit) result(name)
    integer(c_int64_t), intent(in) :: bit
    character(len=63) :: name
    character(len=20), parameter :: names(0:19) = [character(len=20) :: &
      'pressure', 'slip', 'velocity', 'slip_vector', &
      'normal', 'coordinates', 'tangent', 'temperature', &
      'counter_temperature', 'friction_stress', 'friction_coefficient', 'friction_work', &
      'accumulated_wear', 'accumulated_slip', 'nodal_traction', 'gap', &
      'area', 'contact_state', 'point_id', 'element_id']
    name = ' '
    if (bit >= 0 .and. bit <= 19) name = names(bit)
  end function wl_field_name

  ! One declared quantity, or a field's name, for the host; `bytes` is what the host has allocated.
  subroutine wl_give_quantity(row, quantity)
    type(wl_declared), intent(in) :: row
    type(c_ptr), intent(in) :: quantity
    type(wl_quantity), target :: full
    integer(c_int64_t), pointer :: bytes
    call c_f_pointer(quantity, bytes)
    full%struct_size = bytes
    call wl_text(row%name, full%name)
    call wl_text(row%summary, full%summary)
    full%metre = row%unit%metre
    full%kilogram = row%unit%kilogram
    full%second = row%unit%second
    full%kelvin = row%unit%kelvin
    full%minimum = row%minimum
    full%maximum = row%maximum
    full%default_value = row%preset
    full%flags = row%flags
    call wl_copy(c_loc(full), quantity, min(bytes, c_sizeof(full)))
  end subroutine wl_give_quantity

  ! The quantity `index` (from 0) of a kind out of a law's table.
  subroutine wl_give_declared(table, kind, index, quantity, status)
    type(wl_declared), intent(in) :: table(:)
    integer(c_int32_t), intent(in) :: kind
    integer(c_int64_t), intent(in) :: index
    type(c_ptr), intent(in) :: quantity
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: seen
    integer :: j
    status = WL_NO_MORE
    seen = 0
    do j = 1, size(table)
      if (table(j)%kind /= kind) cycle
      if (seen == index) then
        call wl_give_quantity(table(j), quantity)
        status = WL_OK
        return
      end if
      seen = seen + 1
    end do
  end subroutine wl_give_declared

end module wearlaw
