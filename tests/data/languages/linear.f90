! The linear law of point_bench.c.
module linear_law
  use wearlaw
  implicit none
  private
  type(wl_about), parameter :: about = wl_about('linear-fortran', '1.0.0', 'wear proportional to pressure and sliding distance', &
    reads=ior(WL_FIELD_PRESSURE, WL_FIELD_SLIP), writes=WL_OUT_D_PRESSURE)
  type(wl_declared), parameter :: quantities(*) = [ &
    wl_declared(WL_KIND_CONSTANT, 'K', wl_number, 0, wl_infinity, wl_required, 'wear coefficient'), &
    wl_declared(WL_KIND_CONSTANT, 'H', wl_pascal, 0, wl_infinity, wl_required, 'hardness', WL_QUANTITY_ABOVE_MINIMUM)]
contains
  integer(c_int32_t) function point(in, c, s, out) result(status)
    type(wl_in), intent(in) :: in
    real(c_double), intent(in) :: c(*)
    real(c_double), intent(inout) :: s(*)
    type(wl_out), intent(inout) :: out
    out%d_pressure = c(1) / c(2) * in%slip
    out%increment = out%d_pressure * merge(in%pressure, 0.0_c_double, in%pressure > 0)
    status = WL_OK
  end function point
  include 'wearlaw_point.inc'
end module linear_law
