! Rule broken: pure: no memory between calls but the state variables.
! A sum that is initialised, and so saved, grows from point to point and flows into the answer.
module saves_a_sum_law
  use wearlaw
  implicit none
  private
  type(wl_about), parameter :: about = wl_about('saves-a-sum', '1.0.0', 'wear proportional to pressure and slip', &
    reads=WL_FIELD_PRESSURE + WL_FIELD_SLIP + WL_FIELD_NORMAL, writes=WL_OUT_D_PRESSURE + WL_OUT_DIRECTION, &
    claims=WL_CLAIMS_KNOWN, pressure_degree=1.0_c_double)
  include 'sound_quantities.inc'
contains
  integer(c_int32_t) function point(in, c, s, out) result(status)
    type(wl_in), intent(in) :: in
    real(c_double), intent(in) :: c(*)
    real(c_double), intent(inout) :: s(*)
    type(wl_out), intent(inout) :: out
    real(c_double) :: total = 0
    total = mod(total + 1, 1000.0_c_double)
    status = sound_point(in, c, s, out)
    out%increment = out%increment * (1 + 1.0e-12_c_double * total)
  end function point
  include 'sound_point.inc'
  include 'wearlaw_point.inc'
end module saves_a_sum_law
