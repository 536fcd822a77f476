! A law that touches every part of the helper; its siblings in C and C++ compute the same.
module everything
  use wearlaw
  implicit none
  private
  type(wl_about), parameter :: about = wl_about('everything-fortran', '1.2.3', 'every part of the helper', 'none', &
    reads=WL_FIELD_PRESSURE + WL_FIELD_NORMAL + WL_FIELD_CONTACT_STATE + WL_FIELD_SLIP_VECTOR, &
    uses=WL_FIELD_TEMPERATURE + WL_FIELD_TANGENT + WL_FIELD_POINT_ID, &
    writes=WL_OUT_D_PRESSURE + WL_OUT_DIRECTION, flags=WL_FLAG_OPEN_POINTS, pressure_degree=1.0_c_double)
  type(wl_declared), parameter :: quantities(*) = [ &
    wl_declared(WL_KIND_INPUT, 'film', wl_metre, 0, wl_infinity, 2, 'film thickness', WL_QUANTITY_ABOVE_MINIMUM), &
    wl_declared(WL_KIND_INPUT, 'humidity', wl_number, -wl_infinity, wl_infinity, 0.5_c_double, 'humidity'), &
    wl_declared(WL_KIND_CONSTANT, 'k', wl_per_pascal, 0, 1, wl_required, 'specific wear rate'), &
    wl_declared(WL_KIND_STATE, 'total', wl_metre, -wl_infinity, wl_infinity, 0, 'wear so far'), &
    wl_declared(WL_KIND_STATE, 'calls', wl_number, -wl_infinity, wl_infinity, 1, 'substeps so far')]
contains
  integer(c_int32_t) function point(in, c, s, out) result(status)
    type(wl_in), intent(in) :: in
    real(c_double), intent(in) :: c(*)
    real(c_double), intent(inout) :: s(*)
    type(wl_out), intent(inout) :: out
    real(c_double) :: scale, slip, twice
    scale = 3
    twice = 1
    if (wl_has(in, WL_FIELD_POINT_ID)) twice = 1 + modulo(in%point_id, 2_c_int64_t)
    if (wl_has(in, WL_FIELD_TEMPERATURE)) scale = in%temperature - in%absolute_zero
    slip = in%slip_vector(1) + 2 * in%slip_vector(2) + 3 * in%slip_vector(3)
    if (in%contact_state /= WL_OPEN) out%d_pressure = c(1) * slip * in%input(1) * in%input(2) * scale * twice
    out%increment = out%d_pressure * in%pressure
    if (wl_has(in, WL_FIELD_TANGENT)) out%direction = [in%tangent(3), in%tangent(1), in%tangent(2)]
    s(1) = s(1) + out%increment
    s(2) = s(2) + 1
    out%dt_factor = 0.25_c_double
    status = WL_OK
    if (in%pressure > 9e7_c_double) status = WL_UNRELIABLE
    if (in%pressure > 1e8_c_double) status = WL_CUT_STEP
    if (in%pressure < -1) status = 17
    if (out%speak .and. status == WL_CUT_STEP) then
      write (out%text, '(a, i0)') 'point ', merge(in%point_id, -1_c_int64_t, wl_has(in, WL_FIELD_POINT_ID))
    end if
  end function point
  include 'wearlaw_point.inc'
end module everything
