!> The paper's valve (Table II) for the physics suites, with everything a suite may want to vary.
module paper_valve
   use rv_kinds, only : wp
   use rv_error, only : error_type
   use rv_hydrodynamic_load, only : fluid_type, hydrodynamic_load, new_hydrodynamic_load, load_published
   use rv_lanes, only : lane_outcome, lane_settings, run_lanes
   use rv_lumped, only : lumped_lanes, lumped_valve, new_lumped_lanes, squeeze_coefficient
   use rv_pressure, only : pressure_history, square_wave, new_square_wave
   use rv_reed, only : reed_type, new_reed
   use rv_valve_lanes, only : valve_lanes
   implicit none
   private
   public :: valve_at, wave_40ms, run_lumped

   real(wp), parameter, public :: kpa = 1.0e3_wp, mm = 1.0e-3_wp, ms = 1.0e-3_wp

contains

   !> One case: inlet pressure [Pa], gap [m], k_s [-] (0: traditional), viscosity [Pa s] (the paper's unless given).
   function valve_at(inlet, gap, k_s, viscosity) result(valve)
      real(wp), intent(in) :: inlet, gap, k_s
      real(wp), intent(in), optional :: viscosity
      type(lumped_valve) :: valve
      type(reed_type) :: reed
      type(hydrodynamic_load) :: load
      type(fluid_type) :: oil
      type(error_type), allocatable :: error

      oil = fluid_type(density=875.0_wp, viscosity=0.0484_wp)
      if (present(viscosity)) oil%viscosity = viscosity
      call new_reed(reed, 2.5_wp*mm, 4.0_wp*mm, 1.0_wp*mm, 6.0_wp*mm, 0.15_wp*mm, 8950.0_wp, 110.0e9_wp, 0.91_wp, error)
      if (allocated(error)) error stop "the paper's reed is refused"
      call new_hydrodynamic_load(load, load_published, reed, oil, error)
      if (allocated(error)) error stop "the paper's load is refused"
      valve = lumped_valve(mass=reed%mass + load%added_mass, damping=load%added_damping, stiffness=reed%stiffness, &
         & area=12.56_wp*mm**2, squeeze=squeeze_coefficient(k_s, oil%viscosity, reed%length, reed%width), &
         & gap=gap, inlet=inlet)
   end function valve_at

   !> The paper's square wave: period 40 ms, ramps of 1 ms.
   function wave_40ms() result(wave)
      type(square_wave) :: wave
      type(error_type), allocatable :: error

      call new_square_wave(wave, 40.0_wp*ms, 1.0_wp*ms, error)
      if (allocated(error)) error stop "the paper's wave is refused"
   end function wave_40ms

   !> Run cases of the lumped models as one group of lanes.
   subroutine run_lumped(valve, history, settings, trace_time, outcome)
      type(lumped_valve), intent(in) :: valve(:)
      class(pressure_history), intent(in) :: history
      type(lane_settings), intent(in) :: settings
      real(wp), intent(in) :: trace_time(:)
      type(lane_outcome), intent(out) :: outcome
      type(lumped_lanes) :: lumped
      class(valve_lanes), allocatable :: lanes

      call new_lumped_lanes(lumped, valve)
      allocate(lanes, source=lumped)
      call run_lanes(lanes, history, settings, trace_time, outcome)
   end subroutine run_lumped

end module paper_valve
