! Wear in proportion to the dissipated friction work, as used for fretting. README.md has the source.
module dissipated_work
  use wearlaw
  implicit none
  private
  type(wl_about), parameter :: about = wl_about('dissipated-work', '1.0.0', 'wear proportional to the friction work', &
    source='S. Fouvry, P. Kapsa, L. Vincent, Wear 200 (1996) 186-205', reads=WL_FIELD_FRICTION_WORK, &
    claims=WL_CLAIM_DETERMINISTIC + WL_CLAIM_NON_NEGATIVE + WL_CLAIM_LINEAR_IN_DT + WL_CLAIM_FRAME_INDIFFERENT)
  type(wl_declared), parameter :: quantities(*) = [ &
    wl_declared(WL_KIND_CONSTANT, 'alpha', wl_per_pascal, 0, wl_infinity, wl_required, 'wear volume per friction work')]
contains
  integer(c_int32_t) function point(in, c, s, out) result(status)
    type(wl_in), intent(in) :: in
    real(c_double), intent(in) :: c(*)
    real(c_double), intent(inout) :: s(*)
    type(wl_out), intent(inout) :: out
    out%increment = c(1) * merge(0.0_c_double, in%friction_work, in%friction_work < 0)
    status = merge(WL_OK, WL_OUT_OF_DOMAIN, abs(out%increment) <= huge(out%increment))
    if (out%speak) write (out%text, '(a, g0)') 'no finite wear at friction work ', in%friction_work
  end function point
  include 'wearlaw_point.inc'
end module dissipated_work
