!> Progress on standard error: a bar on a terminal, a line now and then in a log, nothing when quiet.
module rv_cli_progress
   use, intrinsic :: iso_fortran_env, only : error_unit
   use rv_cli_output, only : complain
   use rv_kinds, only : wp, i8
   use rv_monitor, only : monitor_type, phase_cases, progress_type
   use rv_posix, only : is_terminal, seconds, signal_seen, terminal_width
   use rv_text, only : to_text
   implicit none
   private
   public :: progress_bar, duration_text, rate_text

   integer, parameter :: error_fd = 2
   real(wp), parameter :: bar_interval = 0.1_wp    !! [s]
   real(wp), parameter :: line_interval = 10.0_wp  !! [s]
   character(len=*), parameter :: erase = achar(13)//achar(27)//"[K"   !! to the line's start, clear it

   type, extends(monitor_type) :: progress_bar
      logical :: quiet = .false.
      logical, private :: shown = .false.        !! a bar stands on the terminal
      real(wp), private :: last = -huge(1.0_wp)  !! when something was last shown [s]
   contains
      procedure :: report
      procedure :: stop_asked
      procedure :: clear
   end type progress_bar

contains

   subroutine report(self, progress)
      class(progress_bar), intent(inout) :: self
      type(progress_type), intent(in) :: progress
      real(wp) :: now
      logical :: terminal

      if (self%quiet) return
      now = seconds()
      terminal = is_terminal(error_fd)
      if (.not. terminal .and. self%last < 0.0_wp) self%last = now   ! a log begins with the first interval
      if (now - self%last < merge(bar_interval, line_interval, terminal)) return
      self%last = now
      if (terminal) then
         self%shown = .true.
         write(error_unit, '(a)', advance="no") erase//bar(progress, terminal_width(error_fd))
         flush(error_unit)
      else
         call complain(state(progress))
      end if
   end subroutine report

   function stop_asked(self) result(yes)
      class(progress_bar), intent(inout) :: self
      logical :: yes

      yes = signal_seen()
      if (yes) call self%clear()
   end function stop_asked

   !> Take the bar off the terminal before other lines come.
   subroutine clear(self)
      class(progress_bar), intent(inout) :: self

      if (.not. self%shown) return
      self%shown = .false.
      write(error_unit, '(a)', advance="no") erase
      flush(error_unit)
   end subroutine clear

   !> "[########--------] 1720 of 4096 cases, 42 %, 1240 cases/s, 2 s left", as wide as the terminal allows.
   function bar(progress, columns) result(line)
      type(progress_type), intent(in) :: progress
      integer, intent(in) :: columns              !! 0: not known
      character(len=:), allocatable :: line
      integer :: room, filled

      line = state(progress)
      room = merge(columns, 80, columns > 0) - len(line) - 4
      if (room < 8) then
         line = line(:min(len(line), max(1, len(line) + room + 3)))
         return
      end if
      room = min(room, 40)
      filled = int(real(room, wp)*fraction_done(progress))
      line = "["//repeat("#", filled)//repeat("-", room - filled)//"] "//line
   end function bar

   function state(progress) result(line)
      type(progress_type), intent(in) :: progress
      character(len=:), allocatable :: line
      real(wp) :: rate

      line = to_text(progress%done)//" of "//to_text(progress%cases)
      if (progress%phase == phase_cases) then
         line = line//" cases, "
      else
         line = "writing results: "//line//" cases, "
      end if
      line = line//to_text(int(100.0_wp*fraction_done(progress)))//" %"
      if (progress%failed > 0) line = line//", "//to_text(progress%failed)//" failed"
      if (progress%done == progress%earlier .or. progress%seconds <= 0.0_wp) return
      rate = real(progress%done - progress%earlier, wp)/progress%seconds
      line = line//", "//rate_text(rate)//", "//duration_text(real(progress%cases - progress%done, wp)/rate)//" left"
   end function state

   pure real(wp) function fraction_done(progress) result(part)
      type(progress_type), intent(in) :: progress

      part = real(progress%done, wp)/real(max(1_i8, progress%cases), wp)
   end function fraction_done

   !> "1240 cases/s"
   pure function rate_text(rate) result(text)
      real(wp), intent(in) :: rate                !! [1/s]
      character(len=:), allocatable :: text

      text = to_text(rate, 3)//" cases/s"
      if (rate >= 1000.0_wp) text = to_text(nint(rate, i8))//" cases/s"
   end function rate_text

   !> "0.21 s", "42 s", "3 min 20 s", "2 h 5 min", "3 d 4 h"
   pure function duration_text(duration) result(text)
      real(wp), intent(in) :: duration            !! [s]
      character(len=:), allocatable :: text
      integer(i8) :: whole

      whole = nint(min(duration, 1.0e15_wp), i8)
      if (duration < 9.95_wp) then
         text = to_text(duration, 2)//" s"
      else if (whole < 60) then
         text = to_text(whole)//" s"
      else if (whole < 3600) then
         text = to_text(whole/60)//" min "//to_text(mod(whole, 60_i8))//" s"
      else if (whole < 86400) then
         text = to_text(whole/3600)//" h "//to_text(mod(whole, 3600_i8)/60)//" min"
      else
         text = to_text(whole/86400)//" d "//to_text(mod(whole, 86400_i8)/3600)//" h"
      end if
   end function duration_text

end module rv_cli_progress
