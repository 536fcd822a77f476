! Rule broken: one instance may be evaluated from several threads at once.
! A local array is too large for the stack, so the compiler makes one of it for all threads;
! a pause at one pressure in 64 makes sure that a busy machine shows it.
module large_local_array_law
  use wearlaw
  implicit none
  private
  type(wl_about), parameter :: about = wl_about('large-local-array', '1.0.0', 'wear proportional to pressure and slip', &
    reads=WL_FIELD_PRESSURE + WL_FIELD_SLIP + WL_FIELD_NORMAL, writes=WL_OUT_D_PRESSURE + WL_OUT_DIRECTION, &
    claims=WL_CLAIMS_KNOWN, pressure_degree=1.0_c_double)
  include 'sound_quantities.inc'
  interface
    integer(c_int) function usleep(microseconds) bind(C, name='usleep')
      import :: c_int
      integer(c_int), value :: microseconds
    end function usleep
  end interface
contains
  integer(c_int32_t) function point(in, c, s, out) result(status)
    type(wl_in), intent(in) :: in
    real(c_double), intent(in) :: c(*)
    real(c_double), intent(inout) :: s(*)
    type(wl_out), intent(inout) :: out
    real(c_double) :: parts(20000)
    status = sound_point(in, c, s, out)
    parts(1:256) = out%increment
    if (iand(transfer(in%pressure, 0_c_int64_t), 63_c_int64_t) == 7) then
      if (usleep(30) /= 0) status = WL_FAILED
    end if
    if (status == WL_OK) out%increment = maxval(parts(1:256))
  end function point
  include 'sound_point.inc'
  include 'wearlaw_point.inc'
end module large_local_array_law
