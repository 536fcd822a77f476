! Calls umeshmotion as its solver does: each node in each sweep of the mesh of each increment, some increments a second
! time after a cut-back, with the routines that the subroutine asks for pressure and slip. Prints the displacement of each node.
!
!   drive_umeshmotion INCREMENTS NODES RETRIES(0 or 1)
module contact_of_the_driver
  implicit none
  integer, parameter :: dp = kind(1d0)
  real(dp) :: moment = 0, stronger = 1
contains
  pure real(dp) function pressure_of(node)
    integer, intent(in) :: node
    pressure_of = stronger * 1e6_dp * (1 + 0.1_dp * node)
    if (mod(node, 5) == 0) pressure_of = 0
  end function pressure_of

  ! Slip from the beginning, to and fro.
  pure function slip_of(node) result(slip)
    integer, intent(in) :: node
    real(dp) :: slip(2)
    slip = [1e-3_dp * sin(3 * moment) * (1 + 0.01_dp * node), 2e-4_dp * moment]
  end function slip_of
end module contact_of_the_driver

program drive_umeshmotion
  use contact_of_the_driver
  implicit none
  integer :: increments, nodes, retries, inc, node, sweep, attempt, tries, lsmooth, jmatyp(1), jgvblock(1)
  real(dp) :: time, step, ulocal(3), alocal(3, 3), times(2), pnewdt, expected, before(2), first
  real(dp), allocatable :: moved(:), wanted(:)
  increments = argument(1)
  nodes = argument(2)
  retries = argument(3)
  allocate (moved(nodes), wanted(nodes))
  moved = 0
  wanted = 0
  alocal = reshape([1d0, 0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0], [3, 3])
  jmatyp = 0
  jgvblock = 0
  time = 0
  first = 0
  do inc = 1, increments
    tries = 1
    if (retries == 1 .and. mod(inc, 2) == 0) tries = 2
    do attempt = 1, tries
      step = 0.01_dp * (1 + mod(inc, 3))
      if (attempt < tries) step = step * 4
      stronger = 1 + tries - attempt
      do sweep = 1, 3
        do node = 1, nodes
          moment = time
          before = slip_of(node)
          moment = time + step
          times = moment
          ulocal = [0d0, 0d0, 0.5d0]
          pnewdt = 1
          lsmooth = 0
          call umeshmotion(0d0, ulocal, node, 3, 1, alocal, 3, times, step, pnewdt, 1, inc, sweep, jmatyp, jgvblock, lsmooth)
          if (attempt == tries .and. sweep == 1) then
            first = ulocal(3)
            moved(node) = moved(node) + (ulocal(3) - 0.5d0) * step
            wanted(node) = wanted(node) - 1e-4_dp / 2e9_dp * pressure_of(node) * norm2(slip_of(node) - before)
          end if
        end do
      end do
    end do
    time = time + step
  end do
  do node = 1, nodes
    print '(i0, 3(1x, es24.16))', node, moved(node), wanted(node), first
  end do
contains
  integer function argument(at) result(value)
    integer, intent(in) :: at
    character(len=64) :: word
    call get_command_argument(at, word)
    read (word, *) value
  end function argument
end program drive_umeshmotion

subroutine getnodetoelemconn(node, count, elements, types, answer, jgvblock)
  implicit none
  integer :: node, count, elements(*), types(*), answer, jgvblock(*)
  if (count < 2) error stop 'no room for two elements'
  count = 2
  elements(:2) = [node, node + 1]
  types(:2) = 1
  answer = 0
end subroutine getnodetoelemconn

subroutine getvrmavgatnode(node, variable, array, answer, elements, count, jmatyp, jgvblock)
  use contact_of_the_driver
  implicit none
  integer :: node, answer, elements(*), count, jmatyp(*), jgvblock(*)
  character(len=*) :: variable
  real(dp) :: array(15)
  answer = 0
  select case (variable)
  case ('CSTRESS')
    array(:3) = [pressure_of(node), 0.1_dp * pressure_of(node), 0d0]
    if (pressure_of(node) <= 0) answer = 1
  case ('CDISP')
    array(1) = 0
    array(2:3) = slip_of(node)
  case ('CNAREA')
    array(1) = 1e-6_dp
  case default
    answer = 1
  end select
end subroutine getvrmavgatnode

subroutine getvrn(node, variable, array, answer, jgvblock, transform)
  use contact_of_the_driver
  implicit none
  integer :: node, answer, jgvblock(*), transform
  character(len=*) :: variable
  real(dp) :: array(15)
  answer = 0
  array(:3) = [1e-3_dp * node, 0d0, 0d0]
  if (variable == 'NT') array(1) = 293 + node
end subroutine getvrn

subroutine xit()
  print '(a)', 'xit'
  stop 7
end subroutine xit
