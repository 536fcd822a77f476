! wearlaw_host.f90: wear laws in a solver written in Fortran 2008: the interface of wearlaw_host.h, name by name.
!
! Compile it behind wearlaw.f90 and link with -lwearlaw_host. wearlaw_host.h says what everything means. Set struct_size
! of every struct to c_sizeof of it; texts that go in end with c_null_char.
!
! SPDX-License-Identifier: MIT OR Apache-2.0

module wearlaw_host
  use, intrinsic :: iso_c_binding
  implicit none
  public

  integer(c_int32_t), parameter :: WLH_ABI_MINOR = 0_c_int32_t
  integer(c_int32_t), parameter :: WLH_BAD_INPUT = 16_c_int32_t
  integer(c_int32_t), parameter :: WLH_NOT_LOADED = 17_c_int32_t
  integer(c_int32_t), parameter :: WLH_BAD_HANDLE = 18_c_int32_t
  integer(c_int32_t), parameter :: WLH_BUSY = 19_c_int32_t
  integer(c_int32_t), parameter :: WLH_INTERNAL = 20_c_int32_t

  type, bind(c) :: wlh_source
    integer(c_int64_t) :: struct_size = 0
    type(c_ptr) :: name = c_null_ptr
    type(c_ptr) :: sha256 = c_null_ptr
    type(c_ptr) :: options = c_null_ptr
    type(c_ptr) :: worker = c_null_ptr
    real(c_double) :: deadline = 0
  end type wlh_source

  type, bind(c) :: wlh_solver
    integer(c_int64_t) :: struct_size = 0
    integer(c_int64_t) :: provides = 0
    integer(c_int64_t) :: dimension = 0
    real(c_double) :: unit_metre = 0
    real(c_double) :: unit_kilogram = 0
    real(c_double) :: unit_second = 0
    real(c_double) :: unit_kelvin = 0
    real(c_double) :: absolute_zero = 0
    real(c_double) :: reference_temperature = 0
  end type wlh_solver

  type, bind(c) :: wlh_description
    integer(c_int64_t) :: struct_size = 0
    integer(c_int64_t) :: reads = 0
    integer(c_int64_t) :: uses = 0
    integer(c_int64_t) :: writes = 0
    integer(c_int64_t) :: claims = 0
    integer(c_int64_t) :: flags = 0
    integer(c_int64_t) :: constant_count = 0
    integer(c_int64_t) :: state_count = 0
    integer(c_int64_t) :: input_count = 0
    character(kind=c_char) :: name(64) = c_null_char
    character(kind=c_char) :: version(32) = c_null_char
  end type wlh_description

  type, bind(c) :: wlh_constants
    integer(c_int64_t) :: struct_size = 0
    integer(c_int64_t) :: count = 0
    type(c_ptr) :: names = c_null_ptr
    type(c_ptr) :: values = c_null_ptr
    integer(c_int64_t) :: value_count = 0
    type(c_ptr) :: times = c_null_ptr
    integer(c_int64_t) :: time_count = 0
    type(c_ptr) :: temperatures = c_null_ptr
    integer(c_int64_t) :: temperature_count = 0
  end type wlh_constants

  type, bind(c) :: wlh_step
    integer(c_int64_t) :: struct_size = 0
    real(c_double) :: time = 0
    real(c_double) :: dt = 0
    real(c_double) :: step_time = 0
    integer(c_int64_t) :: load_step = 0
    integer(c_int64_t) :: substep = 0
    integer(c_int64_t) :: cycle = 0
    integer(c_int64_t) :: material = 0
    integer(c_int64_t) :: pair = 0
    integer(c_int64_t) :: body = 0
    integer(c_int64_t) :: counter_body = 0
  end type wlh_step

  type, bind(c) :: wlh_outputs
    integer(c_int64_t) :: struct_size = 0
    type(c_ptr) :: increment = c_null_ptr
    integer(c_int64_t) :: increment_length = 0
    type(c_ptr) :: direction = c_null_ptr
    integer(c_int64_t) :: direction_length = 0
    type(c_ptr) :: d_pressure = c_null_ptr
    integer(c_int64_t) :: d_pressure_length = 0
    type(c_ptr) :: status = c_null_ptr
    integer(c_int64_t) :: status_length = 0
    real(c_double) :: dt_factor = 0
    integer(c_int64_t) :: first_bad = 0
  end type wlh_outputs

  ! `law` and `surface` are handles, of type(c_ptr); `text` is an array or a variable of characters.
  interface
    function wlh_minor() bind(c) result(answer)
      import :: c_int32_t
      integer(c_int32_t) :: answer
    end function wlh_minor

    function wlh_open_1(source, solver, law, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char, wlh_source, wlh_solver
      integer(c_int32_t) :: answer
      type(wlh_source), intent(in) :: source
      type(wlh_solver), intent(in) :: solver
      type(c_ptr), intent(out) :: law
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: text_size
    end function wlh_open_1

    function wlh_describe(law, description, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char, wlh_description
      integer(c_int32_t) :: answer
      type(c_ptr), value :: law
      type(wlh_description), intent(inout) :: description
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: text_size
    end function wlh_describe

    function wlh_quantity(law, kind, index, quantity, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char
      integer(c_int32_t) :: answer
      type(c_ptr), value :: law
      integer(c_int32_t), value :: kind
      integer(c_int64_t), value :: index
      type(c_ptr), value :: quantity ! of a wl_quantity of wearlaw.f90
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: text_size
    end function wlh_quantity

    function wlh_open_surface(law, points, surface, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char
      integer(c_int32_t) :: answer
      type(c_ptr), value :: law
      integer(c_int64_t), value :: points
      type(c_ptr), intent(out) :: surface
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: text_size
    end function wlh_open_surface

    function wlh_set_constants(surface, constants, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char, wlh_constants
      integer(c_int32_t) :: answer
      type(c_ptr), value :: surface
      type(wlh_constants), intent(in) :: constants
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: text_size
    end function wlh_set_constants

    function wlh_evaluate(surface, step, outputs, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char, wlh_step, wlh_outputs
      integer(c_int32_t) :: answer
      type(c_ptr), value :: surface
      type(wlh_step), intent(in) :: step
      type(wlh_outputs), intent(inout) :: outputs
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: text_size
    end function wlh_evaluate

    ! values is c_loc of an array that is a target and stays where it is.
    function wlh_set_field(surface, field, values, length, step, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char
      integer(c_int32_t) :: answer
      type(c_ptr), value :: surface, values
      integer(c_int64_t), value :: field, length, step, text_size
      character(kind=c_char), intent(inout) :: text(*)
    end function wlh_set_field

    function wlh_set_index_field(surface, field, values, length, step, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char
      integer(c_int32_t) :: answer
      type(c_ptr), value :: surface, values
      integer(c_int64_t), value :: field, length, step, text_size
      character(kind=c_char), intent(inout) :: text(*)
    end function wlh_set_index_field

    function wlh_set_input(surface, name, values, length, step, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char
      integer(c_int32_t) :: answer
      type(c_ptr), value :: surface, values
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: length, step, text_size
      character(kind=c_char), intent(inout) :: text(*)
    end function wlh_set_input

    function wlh_set_state(surface, values, length, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char, c_double
      integer(c_int32_t) :: answer
      type(c_ptr), value :: surface
      real(c_double), intent(in) :: values(*)
      integer(c_int64_t), value :: length, text_size
      character(kind=c_char), intent(inout) :: text(*)
    end function wlh_set_state

    function wlh_get_state(surface, values, length, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char, c_double
      integer(c_int32_t) :: answer
      type(c_ptr), value :: surface
      real(c_double), intent(inout) :: values(*)
      integer(c_int64_t), value :: length, text_size
      character(kind=c_char), intent(inout) :: text(*)
    end function wlh_get_state

    function wlh_scaling_factor(change, safety, maximum, factor, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_char, c_double
      integer(c_int32_t) :: answer
      real(c_double), value :: change, safety, maximum
      real(c_double), intent(out) :: factor
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: text_size
    end function wlh_scaling_factor

    function wlh_warnings(law, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char
      integer(c_int32_t) :: answer
      type(c_ptr), value :: law
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: text_size
    end function wlh_warnings

    function wlh_commit(surface, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char
      integer(c_int32_t) :: answer
      type(c_ptr), value :: surface
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: text_size
    end function wlh_commit

    function wlh_roll_back(surface, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char
      integer(c_int32_t) :: answer
      type(c_ptr), value :: surface
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: text_size
    end function wlh_roll_back

    function wlh_close_surface(surface, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char
      integer(c_int32_t) :: answer
      type(c_ptr), value :: surface
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: text_size
    end function wlh_close_surface

    function wlh_close_law(law, text, text_size) bind(c) result(answer)
      import :: c_int32_t, c_int64_t, c_ptr, c_char
      integer(c_int32_t) :: answer
      type(c_ptr), value :: law
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: text_size
    end function wlh_close_law
  end interface
end module wearlaw_host
