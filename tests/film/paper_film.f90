!> The paper's valve (Table II) as film model, for the film suites.
module paper_film
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_film_lanes, only : film_lanes, new_film_lanes
   use rv_film_mesh, only : film_mesh
   use rv_film_reed, only : film_reed, new_film_reed
   use rv_film_table, only : film_table, new_film_table
   use rv_film_valve, only : film_valve, new_film_valve
   use rv_hydrodynamic_load, only : fluid_type, load_maali
   use rv_lanes, only : lane_outcome, lane_settings, run_lanes
   use rv_planform, only : planform_type, new_planform
   use rv_pressure, only : pressure_history
   use rv_reynolds, only : film_type, new_film
   use rv_table_lanes, only : table_lanes, new_table_lanes
   use rv_valve_lanes, only : valve_lanes
   use paper_valve, only : mm, wave_40ms
   implicit none
   private
   public :: paper_form, paper_reed, build_paper_table, paper_case, rigid_film, run_film, run_table, scatter

   type(fluid_type), parameter, public :: oil = fluid_type(density=875.0_wp, viscosity=0.0484_wp)
   real(wp), parameter, public :: nu = 0.3_wp                  !! Poisson's ratio [-]
   real(wp), parameter, public :: rigidity = 110.0e9_wp*(0.15_wp*mm)**3/(12.0_wp*(1.0_wp - nu**2))  !! D_p [N m]
   real(wp), parameter, public :: areal_mass = 8950.0_wp*0.15_wp*mm                                 !! [kg m-2]
   real(wp), parameter, public :: no_times(0) = [real(wp) ::]

contains

   function paper_form() result(form)
      type(planform_type) :: form
      type(error_type), allocatable :: error

      call new_planform(form, 2.5_wp*mm, 4.0_wp*mm, 1.0_wp*mm, 6.0_wp*mm, error)
      if (allocated(error)) error stop "the paper's planform is refused"
   end function paper_form

   !> The planform's plate and film; `finer` multiplies the mesh's numbers of elements.
   function paper_reed(modes, elongation, finer) result(reed)
      integer, intent(in) :: modes
      real(wp), intent(in), optional :: elongation
      integer, intent(in), optional :: finer
      type(film_reed) :: reed
      type(error_type), allocatable :: error
      real(wp) :: beta
      integer :: n

      beta = 0.0_wp
      if (present(elongation)) beta = elongation
      n = 1
      if (present(finer)) n = finer
      call new_film_reed(reed, 2.5_wp*mm, 4.0_wp*mm, 1.0_wp*mm, 6.0_wp*mm, nu, modes, beta, error, n*[6, 4, 2], n*3)
      if (allocated(error)) error stop "the paper's reed is refused"
   end function paper_reed

   !> The planform with one shape, and its film's table for a gap [m].
   subroutine build_paper_table(reed, table, gap, elongation)
      type(film_reed), intent(out) :: reed
      type(film_table), intent(out) :: table
      real(wp), intent(in) :: gap, elongation
      type(error_type), allocatable :: error

      reed = paper_reed(1, elongation)
      call new_film_table(table, reed, gap, error)
      if (allocated(error)) error stop "the paper's film table is refused"
   end subroutine build_paper_table

   !> One case on it: gap [m], inlet pressure [Pa].
   function paper_case(reed, gap, inlet, load) result(valve)
      type(film_reed), intent(in) :: reed
      real(wp), intent(in) :: gap, inlet
      integer, intent(in), optional :: load
      type(film_valve) :: valve
      type(error_type), allocatable :: error
      integer :: choice

      choice = load_maali
      if (present(load)) choice = load
      call new_film_valve(valve, reed, 0.15_wp*mm, 8950.0_wp, 110.0e9_wp, nu, choice, oil, gap, error)
      if (allocated(error)) error stop "the paper's case is refused"
      valve%inlet = inlet
   end function paper_case

   !> A film on any mesh under a plate that moves as a whole: one shape, 1 everywhere.
   function rigid_film(mesh, elongation) result(film)
      type(film_mesh), intent(in) :: mesh
      real(wp), intent(in) :: elongation
      type(film_type) :: film

      call new_film(film, mesh, ones(size(mesh%px)), ones(mesh%nodes), ones(3*size(mesh%edge_on_hole)), elongation)
   end function rigid_film

   pure function ones(n) result(one)
      integer, intent(in) :: n
      real(wp) :: one(n, 1)

      one = 1.0_wp
   end function ones

   !> Run one case of the film model under the paper's wave or another history.
   subroutine run_film(reed, valve, settings, trace_time, outcome, history)
      type(film_reed), intent(in) :: reed
      type(film_valve), intent(in) :: valve
      type(lane_settings), intent(in) :: settings
      real(wp), intent(in) :: trace_time(:)
      type(lane_outcome), intent(out) :: outcome
      class(pressure_history), intent(in), optional :: history
      type(film_lanes), allocatable :: film
      class(valve_lanes), allocatable :: lanes

      allocate(film)
      call new_film_lanes(film, reed, valve)
      call move_alloc(film, lanes)
      if (present(history)) then
         call run_lanes(lanes, history, settings, trace_time, outcome)
      else
         call run_lanes(lanes, wave_40ms(), settings, trace_time, outcome)
      end if
   end subroutine run_film

   !> Run cases of the table model side by side.
   subroutine run_table(reed, valve, settings, trace_time, outcome)
      type(film_reed), intent(in) :: reed
      type(film_valve), intent(in) :: valve(:)
      type(lane_settings), intent(in) :: settings
      real(wp), intent(in) :: trace_time(:)
      type(lane_outcome), intent(out) :: outcome
      type(film_table) :: table
      type(table_lanes), allocatable :: tabled
      class(valve_lanes), allocatable :: lanes
      type(error_type), allocatable :: error

      call new_film_table(table, reed, valve(1)%gap, error)
      if (allocated(error)) error stop "the paper's film table is refused"
      allocate(tabled)
      call new_table_lanes(tabled, reed, table, valve)
      call move_alloc(tabled, lanes)
      call run_lanes(lanes, wave_40ms(), settings, trace_time, outcome)
   end subroutine run_table

   !> n numbers in -1..1 that follow no pattern; another `seed`, other numbers.
   pure function scatter(n, seed) result(x)
      integer, intent(in) :: n, seed
      real(wp) :: x(n)
      integer :: i

      do i = 1, n
         x(i) = 43758.5453123_wp*sin(12.9898_wp*real(i, wp) + 78.233_wp*real(seed, wp))
         x(i) = 2.0_wp*(x(i) - floor(x(i))) - 1.0_wp
      end do
   end function scatter

end module paper_film
