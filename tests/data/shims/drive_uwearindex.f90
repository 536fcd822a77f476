! Calls uwearindex as its solver does: each node in contact in each increment, some increments a second time after a
! cut-back. Prints the bits of the rates of the last tries, and of the wear that they add up to.
!
!   drive_uwearindex INCREMENTS NODES RETRIES(0 or 1) EVEN(1: lengths of increments are powers of two) PARAMS..
program drive_uwearindex
  use, intrinsic :: iso_fortran_env, only: int64
  implicit none
  integer, parameter :: dp = kind(1d0)
  integer :: increments, nodes, retries, even, inc, i, tries, attempt
  real(dp) :: time, step, wrnd, coord(3), normal(3), pressure, velocity, temperature, param(8)
  real(dp), allocatable :: worn(:)
  increments = int(argument(1))
  nodes = int(argument(2))
  retries = int(argument(3))
  even = int(argument(4))
  param = 0
  do i = 5, command_argument_count()
    param(i - 4) = argument(i)
  end do
  allocate (worn(nodes), source=0d0)
  time = 0
  do inc = 1, increments
    tries = 1
    if (retries == 1 .and. mod(inc, 3) == 0) tries = 3
    do attempt = 1, tries
      step = 0.01_dp * (1 + mod(inc, 7)) / 3
      if (even == 1) step = 2d0**(-5 - mod(inc, 4))
      ! A failed try was longer, and with another pressure.
      if (attempt < tries) step = step * 2
      do i = 1, nodes
        pressure = 1e6_dp * (1 + 0.3_dp * sin(0.1_dp * i * inc)) * (1 + 0.5_dp * (tries - attempt))
        if (mod(i + inc, 11) == 0) pressure = 0
        velocity = 0.05_dp * (1 + 0.2_dp * cos(0.01_dp * i))
        temperature = 293 + 0.5_dp * i
        coord = [1e-3_dp * i, 0d0, 0d0]
        normal = [0d0, 0d0, 1d0]
        wrnd = -1
        call uwearindex(wrnd, i, 1000 + 7 * i, inc, time, step, coord, 3, normal, 1e-6_dp * pressure, &
                        1e-7_dp * pressure, pressure, 0.1_dp * pressure, param, temperature, velocity, 1, 1, 2, 0.1_dp)
        if (attempt == tries) then
          worn(i) = worn(i) + wrnd * step
          if (inc == increments) print '(i0, 1x, z16.16, 1x, z16.16, 1x, es24.16)', i, transfer(wrnd, 0_int64), &
            transfer(worn(i), 0_int64), worn(i)
        end if
      end do
    end do
    time = time + step
  end do
contains
  real(dp) function argument(at) result(value)
    integer, intent(in) :: at
    character(len=64) :: word
    call get_command_argument(at, word)
    read (word, *) value
  end function argument
end program drive_uwearindex

subroutine quit(code)
  integer, intent(in) :: code
  print '(a, i0)', 'quit ', code
  stop 7
end subroutine quit
