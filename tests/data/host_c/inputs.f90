! Bad input, from Fortran: what each call says of it, and that nothing was changed by it.
program inputs
  use, intrinsic :: iso_c_binding
  use wearlaw
  use wearlaw_host
  implicit none
  integer(c_int64_t), parameter :: one = 1, three = 3
  character(kind=c_char, len=*), parameter :: right = 'embedded:archard' // c_null_char, wrong = 'archad' // c_null_char
  character(kind=c_char, len=len(right)), target :: right_name = right
  character(kind=c_char, len=len(wrong)), target :: wrong_name = wrong
  character(kind=c_char) :: text(400)
  integer(c_int64_t), parameter :: length = size(text)
  real(c_double), target :: pressure(3) = 1e6_c_double, velocity(3) = 0.1_c_double, increment(3) = -7, few(2) = 1e6_c_double
  real(c_double), target :: values(4) = [1e-4_c_double, 2e9_c_double, 1.0_c_double, 1.0_c_double]
  type(wlh_source) :: source
  type(wlh_solver) :: solver
  type(wlh_constants) :: constants
  type(wlh_step) :: step
  type(wlh_outputs) :: outputs
  type(c_ptr) :: law, surface
  integer :: checks = 0

  source%struct_size = c_sizeof(source)
  solver%struct_size = c_sizeof(solver)
  solver%dimension = 3
  solver%provides = WL_FIELD_PRESSURE + WL_FIELD_VELOCITY
  source%name = c_loc(wrong_name)
  call expect(WLH_NOT_LOADED, 'did you mean `archard`?', wlh_open_1(source, solver, law, text, length))
  call true(.not. c_associated(law))
  source%name = c_loc(right_name)
  source%struct_size = 0
  call expect(WLH_BAD_INPUT, '`wlh_source.struct_size` is 0', wlh_open_1(source, solver, law, text, length))
  source%struct_size = c_sizeof(source)
  solver%provides = WL_FIELD_PRESSURE
  call expect(WLH_BAD_INPUT, 'law `archard` needs `velocity`', wlh_open_1(source, solver, law, text, length))
  solver%provides = WL_FIELD_PRESSURE + WL_FIELD_VELOCITY
  call expect(WL_OK, '', wlh_open_1(source, solver, law, text, length))
  call expect(WLH_BAD_INPUT, '', wlh_open_surface(law, -one, surface, text, length))
  call expect(WL_OK, '', wlh_open_surface(law, three, surface, text, length))

  outputs%struct_size = c_sizeof(outputs)
  outputs%increment = c_loc(increment)
  outputs%increment_length = three
  step%struct_size = c_sizeof(step)
  step%dt = 1
  call expect(WLH_BAD_INPUT, '', wlh_evaluate(surface, step, outputs, text, length))
  constants%struct_size = c_sizeof(constants)
  constants%count = 4
  constants%values = c_loc(values)
  constants%value_count = 3
  call expect(WLH_BAD_INPUT, 'value_count', wlh_set_constants(surface, constants, text, length))
  constants%value_count = 4
  values(2) = -1
  call expect(WLH_BAD_INPUT, '`H`', wlh_set_constants(surface, constants, text, length))
  values(2) = 2e9_c_double
  call expect(WL_OK, '', wlh_set_constants(surface, constants, text, length))
  call expect(WLH_BAD_INPUT, 'pressure', &
              wlh_set_field(surface, WL_FIELD_PRESSURE, c_loc(few), size(few, kind=c_int64_t), one, text, length))
  call expect(WLH_BAD_INPUT, '', wlh_set_field(surface, WL_FIELD_SLIP, c_loc(velocity), three, one, text, length))
  call expect(WL_OK, '', wlh_set_field(surface, WL_FIELD_PRESSURE, c_loc(pressure), three, one, text, length))
  call expect(WL_OK, '', wlh_set_field(surface, WL_FIELD_VELOCITY, c_loc(velocity), three, one, text, length))
  outputs%increment_length = 2
  call expect(WLH_BAD_INPUT, 'increment', wlh_evaluate(surface, step, outputs, text, length))
  outputs%increment_length = three
  outputs%increment = c_loc(pressure)
  call expect(WLH_BAD_INPUT, 'pressure', wlh_evaluate(surface, step, outputs, text, length))
  outputs%increment = c_loc(increment)
  step%dt = -1
  call expect(WLH_BAD_INPUT, 'dt', wlh_evaluate(surface, step, outputs, text, length))
  call true(all(increment == -7) .and. all(pressure == 1e6_c_double))
  step%dt = 1
  call expect(WL_OK, '', wlh_evaluate(surface, step, outputs, text, length))
  call true(all(abs(increment - 5e-9_c_double) < 1e-20_c_double))
  call expect(WL_OK, '', wlh_close_surface(surface, text, length))
  call expect(WLH_BAD_HANDLE, '', wlh_evaluate(surface, step, outputs, text, length))
  call expect(WL_OK, '', wlh_close_law(law, text, length))
  call expect(WLH_BAD_HANDLE, '', wlh_close_law(law, text, length))
  print '(i0, a)', checks, ' checks'

contains

  ! The status has to be this one, and the text has to hold these words.
  subroutine expect(wanted, words, status)
    integer(c_int32_t), intent(in) :: wanted, status
    character(len=*), intent(in) :: words
    character(len=size(text)) :: said
    integer :: k
    said = ''
    do k = 1, size(text)
      if (text(k) == c_null_char) exit
      said(k:k) = text(k)
    end do
    checks = checks + 1
    if (status == wanted .and. index(said, words) > 0) return
    print '(a, i0, a, i0, 4a)', 'status ', status, ', expected ', wanted, ': ', trim(said), ', expected in it: ', words
    error stop 1
  end subroutine expect

  subroutine true(answer)
    logical, intent(in) :: answer
    checks = checks + 1
    if (.not. answer) error stop 'not so'
  end subroutine true
end program inputs
