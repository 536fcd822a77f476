! Archard's law with exponents, in the order of operations that every language here writes.
module archard
  use wearlaw
  implicit none
  private
  type(wl_about), parameter :: about = wl_about('archard-fortran', '1.0.0', 'K / H * p^m * v^n * dt', pressure_degree_constant=3, &
    reads=WL_FIELD_PRESSURE + WL_FIELD_VELOCITY, writes=WL_OUT_D_PRESSURE, claims=WL_CLAIM_NON_NEGATIVE + WL_CLAIM_LINEAR_IN_DT)
  type(wl_declared), parameter :: quantities(*) = [ &
    wl_declared(WL_KIND_CONSTANT, 'K', wl_number, 0, wl_infinity, wl_required, 'coefficient', WL_QUANTITY_CLOSES_UNITS), &
    wl_declared(WL_KIND_CONSTANT, 'H', wl_pascal, 0, wl_infinity, wl_required, 'hardness', WL_QUANTITY_ABOVE_MINIMUM), &
    wl_declared(WL_KIND_CONSTANT, 'm', wl_number, 0, wl_infinity, 1, 'pressure exponent'), &
    wl_declared(WL_KIND_CONSTANT, 'n', wl_number, 0, wl_infinity, 1, 'velocity exponent')]
contains
  integer(c_int32_t) function point(in, c, s, out) result(status)
    type(wl_in), intent(in) :: in
    real(c_double), intent(in) :: c(*)
    real(c_double), intent(inout) :: s(*)
    type(wl_out), intent(inout) :: out
    status = WL_OK
    if (in%pressure <= 0) return
    out%increment = c(1) / c(2) * in%pressure**c(3) * in%velocity**c(4) * in%dt
    out%d_pressure = c(3) * out%increment / in%pressure
    if (.not. abs(out%increment) <= huge(in%dt)) status = WL_OUT_OF_DOMAIN
  end function point
  include 'wearlaw_point.inc'
end module archard
