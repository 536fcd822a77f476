! {{name}}: Archard's law with a pressure that levels off.
!
!     wear increment = k * q * slip,    q = p / (1 + p / p_half)
!
! At low contact pressure p this is Archard's law with the specific wear rate k; at p = p_half it gives half of it, and
! beyond that more pressure hardly wears more. Put your own equation in its place.

module law
  use wearlaw
  implicit none
  private

  ! What the law is, what it must be given and what it promises; leave out what your equation does not keep.
  ! The derivative branches at p = 0.
  type(wl_about), parameter :: about = wl_about(name='{{name}}', version='0.1.0', &
    summary='Archard wear that levels off at high pressure', reads=ior(WL_FIELD_PRESSURE, WL_FIELD_SLIP), &
    claims=WL_CLAIM_DETERMINISTIC + WL_CLAIM_NON_NEGATIVE + WL_CLAIM_LINEAR_IN_DT + WL_CLAIM_ZERO_WITHOUT_PRESSURE + &
      WL_CLAIM_ZERO_WITHOUT_SLIP + WL_CLAIM_FRAME_INDIFFERENT, flags=WL_FLAG_KINKS)
  ! Every constant: kind, name, unit, minimum, maximum, default; then by keyword what it is and its flags.
  type(wl_declared), parameter :: quantities(2) = [ &
    wl_declared(WL_KIND_CONSTANT, 'k', wl_per_pascal, 0.0d0, wl_infinity, wl_required, summary='specific wear rate'), &
    wl_declared(WL_KIND_CONSTANT, 'p_half', wl_pascal, 0.0d0, wl_infinity, 1.0d9, &
      flags=WL_QUANTITY_ABOVE_MINIMUM, summary='pressure at which the wear is half of Archard''s')]

contains

  ! What the law does at one point: in (fields), c (constants), s (state), out (answer).
  function point(in, c, s, out) result(status)
    type(wl_in), intent(in) :: in
    real(c_double), intent(in) :: c(*)
    real(c_double), intent(inout) :: s(*)
    type(wl_out), intent(inout) :: out
    integer(c_int32_t) :: status
    real(c_double) :: q
    if (.not. in%pressure <= 0) then ! a pressure that is no number comes in here, too
      q = in%pressure / (1 + in%pressure / c(2))
      out%increment = c(1) * q * in%slip
    end if ! else: no pressure, no wear; the increment is preset to 0
    ! What has no answer gets a status, never a silent NaN or infinity.
    status = merge(WL_OK, WL_OUT_OF_DOMAIN, abs(out%increment) <= huge(out%increment))
  end function point

  include 'wearlaw_point.inc' ! makes the loop over the points, the description and the entry

end module law
