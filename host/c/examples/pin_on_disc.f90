! A pin on a disc (host/scenes/pin_on_disc.toml) from a solver in Fortran.
!
!   gfortran -std=f2008 -c include/wearlaw.f90 include/wearlaw_host.f90
!   gfortran -std=f2008 host/c/examples/pin_on_disc.f90 -L target/release -lwearlaw_host -o pin && ./pin
program pin_on_disc
  use, intrinsic :: iso_c_binding
  use wearlaw
  use wearlaw_host
  implicit none
  integer, parameter :: points = 3, substeps = 2000
  character(kind=c_char, len=*), parameter :: name = 'embedded:archard' // c_null_char
  character(kind=c_char, len=len(name)), target :: law_name = name
  character(kind=c_char) :: text(400)
  real(c_double), target :: pressure(points) = 50, velocity = 0.2_c_double, increment(points), depth(points) = 0
  real(c_double), target :: times(2) = [0, 1]
  real(c_double), target :: values(4, 2) = reshape([1e-4_c_double, 2e3_c_double, 1.0_c_double, 1.0_c_double, &
                                                    3e-4_c_double, 1e3_c_double, 1.5_c_double, 0.8_c_double], [4, 2])
  integer(c_int64_t), parameter :: length = size(text), n = points, one = 1, zero = 0
  type(wlh_source) :: source
  type(wlh_solver) :: solver
  type(wlh_constants) :: constants
  type(wlh_step) :: step
  type(wlh_outputs) :: outputs
  type(c_ptr) :: law, surface
  integer :: i

  source%struct_size = c_sizeof(source)
  source%name = c_loc(law_name)
  solver%struct_size = c_sizeof(solver)
  solver%provides = WL_FIELD_PRESSURE + WL_FIELD_VELOCITY
  solver%dimension = 3
  call need(wlh_open_1(source, solver, law, text, length))
  call need(wlh_open_surface(law, n, surface, text, length))

  constants%struct_size = c_sizeof(constants)
  constants%count = 4 ! K, H, m and n, at each time
  constants%values = c_loc(values)
  constants%value_count = size(values)
  constants%times = c_loc(times)
  constants%time_count = size(times)
  call need(wlh_set_constants(surface, constants, text, length))
  call need(wlh_set_field(surface, WL_FIELD_PRESSURE, c_loc(pressure), n, one, text, length))
  call need(wlh_set_field(surface, WL_FIELD_VELOCITY, c_loc(velocity), one, zero, text, length))

  step%struct_size = c_sizeof(step)
  step%dt = 1.0_c_double / substeps
  outputs%struct_size = c_sizeof(outputs)
  outputs%increment = c_loc(increment)
  outputs%increment_length = n
  do i = 1, substeps
    step%time = (i - 1) * step%dt
    step%substep = i
    call need(wlh_evaluate(surface, step, outputs, text, length))
    call need(wlh_commit(surface, text, length))
    depth = depth + increment
  end do
  print '(es24.16)', depth
  call need(wlh_close_surface(surface, text, length))
  call need(wlh_close_law(law, text, length))
contains
  subroutine need(status)
    integer(c_int32_t), intent(in) :: status
    integer :: k
    if (status == WL_OK .or. status == WL_UNRELIABLE) return
    do k = 1, size(text)
      if (text(k) == c_null_char) exit
    end do
    print *, text(:k - 1)
    error stop 3
  end subroutine need
end program pin_on_disc
