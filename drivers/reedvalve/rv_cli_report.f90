!> What a person is told when a run has ended.
module rv_cli_report
   use rv_cli_arguments, only : arguments_type
   use rv_cli_output, only : complain, exit_failed, exit_fine, say, status_of
   use rv_cli_progress, only : duration_text, rate_text
   use rv_error, only : error_type
   use rv_inputs, only : most_csv_cases
   use rv_kinds, only : wp, i8
   use rv_run, only : run_outcome
   use rv_status, only : n_statuses, n_warnings, status_name, status_ok, warning_name
   use rv_tally, only : tally_type
   use rv_text, only : to_text
   implicit none
   private
   public :: report_run, counted

contains

   !> Tell how a run or a merge ended, and what to do next; the exit status.
   integer function report_run(arguments, folder, outcome, error) result(status)
      type(arguments_type), intent(in) :: arguments
      character(len=*), intent(in) :: folder
      type(run_outcome), intent(in) :: outcome
      type(error_type), allocatable, intent(in) :: error

      if (outcome%unlocked) call complain("warning: the file system of '"//folder &
         & //"' has no locks; let no other run work in there at the same time")
      if (outcome%damaged_blocks > 0) call complain("warning: "//counted(int(outcome%damaged_blocks, i8), "part file") &
         & //" in '"//folder//"' could not be used (damaged, or of another run); the blocks were run again")
      if (.not. outcome%logged) call complain("warning: could not write '"//folder//"/run.log'")
      if (allocated(error)) then
         call complain(error%message)
         call tell_kept(arguments, folder, outcome, "when this is put right, go on with")
         status = status_of(error)
      else if (outcome%stopped) then
         call complain("stopped on request")
         call tell_kept(arguments, folder, outcome, "go on with")
         status = exit_failed
      else
         call tell_failures(outcome%tally, folder, trim(merge("summary.csv", "results.nc ", outcome%has_csv)))
         if (.not. arguments%quiet) then
            if (arguments%slices > 0 .and. .not. outcome%was_complete) then
               call tell_slice(arguments, folder, outcome)
            else
               call tell_results(folder, outcome)
            end if
         end if
         status = merge(exit_failed, exit_fine, outcome%tally%failed > 0)
      end if
   end function report_run

   subroutine tell_kept(arguments, folder, outcome, go_on)
      type(arguments_type), intent(in) :: arguments
      character(len=*), intent(in) :: folder
      type(run_outcome), intent(in) :: outcome
      character(len=*), intent(in) :: go_on
      character(len=:), allocatable :: kept

      if (arguments%command == "merge" .and. outcome%blocks > 0) then
         call complain("the parts are as they were in '"//folder//"/parts'")
      else if (outcome%finished_blocks > 0) then
         kept = to_text(outcome%finished_blocks)//" of "//to_text(outcome%blocks)//" blocks are finished and kept in '" &
            & //folder//"/parts'; "//go_on//": reedvalve run "//arguments%operand
         if (arguments%folder /= "") kept = kept//" -o "//arguments%folder
         if (arguments%slices > 0) kept = kept//" --slice "//to_text(arguments%slice)//"/"//to_text(arguments%slices)
         call complain(kept//" --resume")
      else if (outcome%stopped) then
         call complain("no block was finished, so there is nothing to resume")
      end if
   end subroutine tell_kept

   !> The first failures one by one, and how many there are.
   subroutine tell_failures(tally, folder, file)
      type(tally_type), intent(in) :: tally
      character(len=*), intent(in) :: folder, file   !! which has them all
      integer :: i

      do i = 1, tally%named
         call complain(tally%failure(i)%s)
      end do
      if (tally%failed > tally%named .and. tally%named > 0) call complain("and " &
         & //to_text(tally%failed - tally%named)//" more failed; all of them are in '"//folder//"/"//file//"'")
   end subroutine tell_failures

   subroutine tell_results(folder, outcome)
      character(len=*), intent(in) :: folder
      type(run_outcome), intent(in) :: outcome
      integer :: i

      do i = 1, n_warnings
         if (outcome%tally%warned(i) > 0) call complain("warning: "//to_text(outcome%tally%warned(i)) &
            & //" of "//to_text(outcome%tally%cases)//" cases " &
            & //trim(merge("is ", "are", outcome%tally%warned(i) == 1))//" marked "//warning_name(i)//"; the first is case " &
            & //to_text(outcome%tally%first_warned(i))//after_colon(outcome%tally%warning(i)%s))
      end do
      call say(cases_text(outcome))
      if (outcome%has_csv) then
         call say("Results: "//folder//"/summary.csv and "//folder//"/results.nc")
      else
         if (outcome%tally%cases > most_csv_cases) call complain("no summary.csv of more than " &
            & //counted(most_csv_cases, "case")//"; run.csv = 'always' in the deck would write it")
         call say("Results: "//folder//"/results.nc")
      end if
      if (.not. outcome%was_complete) call say(time_text(outcome))
   end subroutine tell_results

   !> What a slice has done, and what comes next.
   subroutine tell_slice(arguments, folder, outcome)
      type(arguments_type), intent(in) :: arguments
      character(len=*), intent(in) :: folder
      type(run_outcome), intent(in) :: outcome

      call say("Slice "//to_text(arguments%slice)//"/"//to_text(arguments%slices)//": "//cases_text(outcome))
      if (outcome%finished_blocks < outcome%blocks) then
         call say(to_text(outcome%finished_blocks)//" of "//to_text(outcome%blocks)//" blocks of the run are finished. " &
            & //"When all are: reedvalve merge "//folder)
      else
         call say("All blocks of the run are finished. For the results: reedvalve merge "//folder)
      end if
      call say(time_text(outcome))
   end subroutine tell_slice

   !> "6 cases, 2 failed (2 film_closed). 4 of them were run now, the others before."
   function cases_text(outcome) result(line)
      type(run_outcome), intent(in) :: outcome
      character(len=:), allocatable :: line

      line = counted(outcome%tally%cases, "case")
      if (outcome%tally%failed == 0) line = line//", none failed."
      if (outcome%tally%failed > 0) line = line//", "//to_text(outcome%tally%failed)//" failed" &
         & //kinds(outcome%tally)//"."
      if (outcome%was_complete) line = line//" They were finished before; nothing was run."
      if (outcome%new_cases > 0 .and. outcome%kept_blocks > 0) line = line//" "//to_text(outcome%new_cases) &
         & //" of them were run now, the others before."
   end function cases_text

   !> "Time: 3 s with 2 processes of 1 thread, 1000 cases/s"
   function time_text(outcome) result(line)
      type(run_outcome), intent(in) :: outcome
      character(len=:), allocatable :: line

      line = "Time: "//duration_text(outcome%seconds)
      if (outcome%new_cases == 0) return
      line = line//" with "
      if (outcome%processes > 1) line = line//to_text(outcome%processes)//" processes of "
      line = line//counted(int(outcome%threads, i8), "thread")//", " &
         & //rate_text(real(outcome%new_cases, wp)/max(outcome%seconds, 1.0e-6_wp))
   end function time_text

   !> ": 2 film_closed, 1 bad_case"
   pure function kinds(tally) result(text)
      type(tally_type), intent(in) :: tally
      character(len=:), allocatable :: text
      integer :: i

      text = ""
      do i = 0, n_statuses - 1
         if (i == status_ok .or. tally%by_status(i) == 0) cycle
         text = text//", "//to_text(tally%by_status(i))//" "//status_name(i)
      end do
      if (text /= "") text = " ("//text(3:)//")"
   end function kinds

   !> ": Re = ..." of "warning: Re = ...", nothing where there is no message.
   pure function after_colon(message) result(text)
      character(len=:), allocatable, intent(in) :: message
      character(len=:), allocatable :: text

      text = ""
      if (allocated(message)) text = ": "//message(merge(10, 1, index(message, "warning: ") == 1):)
   end function after_colon

   !> "1 thread", "2 threads"
   pure function counted(n, noun) result(text)
      integer(i8), intent(in) :: n
      character(len=*), intent(in) :: noun
      character(len=:), allocatable :: text

      text = to_text(n)//" "//noun
      if (n /= 1) text = text//"s"
   end function counted

end module rv_cli_report
