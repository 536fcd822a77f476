! Rule broken: inputs are constant.
! A negative pressure is set to zero where it stands, through the view.
module clamps_through_pointer_law
  use wearlaw
  implicit none
  private
  type(wl_about), parameter :: about = wl_about('clamps-through-pointer', '1.0.0', 'wear proportional to pressure and slip', &
    reads=WL_FIELD_PRESSURE + WL_FIELD_SLIP + WL_FIELD_NORMAL, writes=WL_OUT_D_PRESSURE + WL_OUT_DIRECTION, &
    claims=WL_CLAIMS_KNOWN, pressure_degree=1.0_c_double)
  include 'sound_quantities.inc'
contains
  integer(c_int32_t) function point(in, c, s, out) result(status)
    type(wl_in), intent(in) :: in
    real(c_double), intent(in) :: c(*)
    real(c_double), intent(inout) :: s(*)
    type(wl_out), intent(inout) :: out
    type(wl_view), pointer :: v
    real(c_double), pointer :: pressure(:)
    status = sound_point(in, c, s, out)
    if (in%pressure < 0) then
      call c_f_pointer(in%view, v)
      call c_f_pointer(v%pressure%ptr, pressure, [(v%points - 1) * v%pressure%step + 1])
      where (pressure < 0) pressure = 0
    end if
  end function point
  include 'sound_point.inc'
  include 'wearlaw_point.inc'
end module clamps_through_pointer_law
