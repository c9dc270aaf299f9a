!> A crew of MPI ranks.
!>
!> The counters lie in the memory of rank 0, which works like all others: a rank adds to one with a one-sided
!> fetch-and-add, without rank 0 taking part. (Where the network cannot do that by itself, a rank waits until rank 0
!> calls MPI the next time, which it does with every block.) All that passes between ranks besides is an error.
!>
!> MPI does not tell that a rank has died (kill -9, out of memory): a wait for it has no end. Where all ranks are on one
!> host, who waits looks whether the others' processes are still there. If not, the crew is broken: no more MPI, the
!> program ends. Each rank has written its blocks by then, and rank 0, which closes the folder, ends last.
module rv_rank_crew
   use, intrinsic :: iso_c_binding, only : c_f_pointer, c_ptr
   use mpi_f08, only : MPI_ADDRESS_KIND, MPI_Allgather, MPI_Barrier, MPI_Bcast, MPI_CHARACTER, MPI_COMM_WORLD, &
      & MPI_Comm_rank, MPI_Comm_size, MPI_Fetch_and_op, MPI_Finalize, MPI_Iallreduce, MPI_INFO_NULL, MPI_Init_thread, &
      & MPI_INTEGER, MPI_INTEGER8, MPI_MIN, MPI_Request, MPI_STATUS_IGNORE, MPI_SUM, MPI_Test, MPI_THREAD_SERIALIZED, &
      & MPI_Win, MPI_Win_allocate, MPI_Win_flush, MPI_Win_free, MPI_Win_lock_all, MPI_Win_sync, MPI_Win_unlock_all
   use omp_lib, only : omp_get_max_threads
   use rv_cli_output, only : complain
   use rv_crew, only : crew_type, n_counters
   use rv_error, only : error_type, fail, rv_io
   use rv_kinds, only : wp, i8
   use rv_posix, only : host_name, is_gone, is_neighbour, nap, process_mark, seconds
   use rv_text, only : to_text
   implicit none
   private
   public :: rank_crew

   integer, parameter :: root = 0
   integer, parameter :: counter_bytes = storage_size(1_i8)/8
   real(wp), parameter :: shortest_nap = 1.0e-4_wp   !! [s]
   real(wp), parameter :: longest_nap = 1.0e-2_wp    !! [s]
   real(wp), parameter :: look_interval = 1.0_wp     !! [s], between looks after the others

   !> Start, then finish on every path; between them all ranks are in step at each share.
   type, extends(crew_type) :: rank_crew
      private
      type(MPI_Win) :: window
      integer :: rank = root
      integer(i8), allocatable :: mark(:)   !! of the processes of ranks 0, 1, ...; empty where they cannot be watched
      logical, public :: is_broken = .false.
   contains
      procedure :: start
      procedure :: finish
      procedure :: add
      procedure :: share
      procedure, private :: make_counters
      procedure, private :: watch_others
      procedure, private :: wait_for
      procedure, private :: look_around
   end type rank_crew

contains

   !> Start MPI and make the counters.
   subroutine start(self, error)
      class(rank_crew), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      integer :: provided, status

      call MPI_Init_thread(MPI_THREAD_SERIALIZED, provided)
      call MPI_Comm_rank(MPI_COMM_WORLD, self%rank)
      call MPI_Comm_size(MPI_COMM_WORLD, self%processes)
      self%leads = self%rank == root
      call self%make_counters()
      call self%watch_others()
      ! processors are shared out among ranks; their threads come on top, only when asked for
      self%usual_threads = 1
      call get_environment_variable("OMP_NUM_THREADS", status=status)
      if (status == 0) self%usual_threads = omp_get_max_threads()
      if (provided < MPI_THREAD_SERIALIZED) call fail(error, rv_io, "this MPI library cannot be used by threads")
   end subroutine start

   !> Wait for all and end MPI; a broken crew cannot.
   subroutine finish(self)
      class(rank_crew), intent(inout) :: self

      if (self%is_broken) return
      call MPI_Win_unlock_all(self%window)
      call MPI_Win_free(self%window)
      call MPI_Finalize()
   end subroutine finish

   subroutine make_counters(self)
      class(rank_crew), intent(inout) :: self
      integer(MPI_ADDRESS_KIND) :: bytes
      type(c_ptr) :: base
      integer(i8), pointer :: counter(:)

      bytes = 0
      if (self%leads) bytes = n_counters*counter_bytes
      call MPI_Win_allocate(bytes, counter_bytes, MPI_INFO_NULL, MPI_COMM_WORLD, base, self%window)
      call MPI_Win_lock_all(0, self%window)
      if (self%leads) then
         call c_f_pointer(base, counter, [n_counters])
         counter = 0
         call MPI_Win_sync(self%window)
      end if
      call MPI_Barrier(MPI_COMM_WORLD)
   end subroutine make_counters

   !> Learn who the others are. All are there now: who seems not to be cannot be seen from here.
   subroutine watch_others(self)
      class(rank_crew), intent(inout) :: self
      logical, allocatable :: is_seen(:)
      integer :: i

      allocate(self%mark(self%processes))
      call MPI_Allgather(process_mark(), 1, MPI_INTEGER8, self%mark, 1, MPI_INTEGER8, MPI_COMM_WORLD)
      is_seen = [(is_neighbour(self%mark(i)), i=1, self%processes)]
      if (all(is_seen)) is_seen = [(.not. is_gone(self%mark(i)), i=1, self%processes)]
      if (.not. all(is_seen)) self%mark = [integer(i8) ::]
      call MPI_Barrier(MPI_COMM_WORLD)
   end subroutine watch_others

   subroutine add(self, counter, amount, before)
      class(rank_crew), intent(inout) :: self
      integer, intent(in) :: counter
      integer(i8), intent(in) :: amount
      integer(i8), intent(out) :: before
      integer(i8), asynchronous :: given, taken

      before = 0
      if (self%is_broken .and. .not. self%leads) return   ! what is rank 0's may be gone
      given = amount
      call MPI_Fetch_and_op(given, taken, MPI_INTEGER8, root, int(counter - 1, MPI_ADDRESS_KIND), MPI_SUM, self%window)
      call MPI_Win_flush(root, self%window)
      before = taken
   end subroutine add

   !> Agree on the error of the lowest rank that has one; that a rank has died is one, too. Who waits sleeps: others may
   !> need the processor.
   subroutine share(self, error)
      class(rank_crew), intent(inout) :: self
      type(error_type), allocatable, intent(inout) :: error
      integer, asynchronous :: own, first
      type(MPI_Request) :: request

      if (self%is_broken) return
      own = self%processes
      if (allocated(error)) own = self%rank
      call MPI_Iallreduce(own, first, 1, MPI_INTEGER, MPI_MIN, MPI_COMM_WORLD, request)
      call self%wait_for(request, error)
      if (self%is_broken) return
      if (first < self%processes) call tell_error(self, first, error)
   end subroutine share

   !> All get the error of rank `from`.
   subroutine tell_error(self, from, error)
      class(rank_crew), intent(in) :: self
      integer, intent(in) :: from
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: message
      integer :: facts(2)                         !! code, and length of the message

      facts = 0
      if (from == self%rank) then
         message = error%message
         if (self%rank /= root) message = "rank "//to_text(self%rank)//" on "//host_name()//": "//message
         facts = [error%code, len(message)]
      end if
      call MPI_Bcast(facts, 2, MPI_INTEGER, from, MPI_COMM_WORLD)
      if (from /= self%rank) allocate(character(len=facts(2)) :: message)
      call MPI_Bcast(message, facts(2), MPI_CHARACTER, from, MPI_COMM_WORLD)
      if (allocated(error)) deallocate(error)
      call fail(error, facts(1), message)
   end subroutine tell_error

   subroutine wait_for(self, request, error)
      class(rank_crew), intent(inout) :: self
      type(MPI_Request), intent(inout) :: request
      type(error_type), allocatable, intent(inout) :: error
      logical :: done
      real(wp) :: rest, next_look

      rest = shortest_nap
      next_look = seconds() + look_interval
      do
         call MPI_Test(request, done, MPI_STATUS_IGNORE)
         if (done) return
         if (seconds() > next_look) then
            call self%look_around(error)
            if (self%is_broken) return
            next_look = seconds() + look_interval
         end if
         call nap(rest)
         rest = min(2.0_wp*rest, longest_nap)
      end do
   end subroutine wait_for

   !> See whether any has died. Rank 0 waits until all others are gone: those that live finish their blocks, come to the
   !> same finding and leave.
   subroutine look_around(self, error)
      class(rank_crew), intent(inout) :: self
      type(error_type), allocatable, intent(inout) :: error
      logical, allocatable :: gone(:)
      character(len=:), allocatable :: message
      integer :: i

      gone = [(is_gone(self%mark(i)), i=1, size(self%mark))]
      if (.not. any(gone)) return
      self%is_broken = .not. self%leads .or. count(gone) == self%processes - 1
      if (.not. self%is_broken) return
      message = "one of the "//to_text(self%processes)//" ranks has died; only what it was at is lost"
      ! nobody else speaks for a dead leader
      if (self%rank > root .and. all(gone(:self%rank))) call complain(message//"; go on with the same words and --resume")
      if (.not. allocated(error)) call fail(error, rv_io, message)
   end subroutine look_around

end module rv_rank_crew
