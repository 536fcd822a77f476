! The law that the faulty laws in Fortran are made from, with no fault.
module sound_fortran_law
  use wearlaw
  implicit none
  private
  type(wl_about), parameter :: about = wl_about('sound-fortran', '1.0.0', 'wear proportional to pressure and slip', &
    reads=WL_FIELD_PRESSURE + WL_FIELD_SLIP + WL_FIELD_NORMAL, writes=WL_OUT_D_PRESSURE + WL_OUT_DIRECTION, &
    claims=WL_CLAIMS_KNOWN, pressure_degree=1.0_c_double)
  include 'sound_quantities.inc'
contains
  integer(c_int32_t) function point(in, c, s, out) result(status)
    type(wl_in), intent(in) :: in
    real(c_double), intent(in) :: c(*)
    real(c_double), intent(inout) :: s(*)
    type(wl_out), intent(inout) :: out
    status = sound_point(in, c, s, out)
  end function point
  include 'sound_point.inc'
  include 'wearlaw_point.inc'
end module sound_fortran_law
