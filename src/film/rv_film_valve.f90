!> One case of a film model: the planform's plate and film with thickness, material, gap, liquid and pressures.
!>
!> (M + M_a) q'' + C_a q' + K q = (p_in - p_out) (int_hole phi + int_land P_0 phi) - C(q) q', q the
!> displacements of the modes (or of the one static shape), each 1 at the tip.
module rv_film_valve
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type, fail, rv_bad_input, rv_not_converged
   use rv_film_reed, only : film_reed, fluid_matrices
   use rv_hydrodynamic_function, only : maali_range, sader_range
   use rv_hydrodynamic_load, only : fluid_type, load_maali, load_sader, load_none
   implicit none
   private
   public :: film_valve, new_film_valve

   !> Matrices and data of one case; index modes + 1 is the static shape.
   type :: film_valve
      integer :: modes = 0
      real(wp), allocatable :: mass(:, :)      !! M + M_a [kg], (modes, modes)
      real(wp), allocatable :: damping(:, :)   !! C_a [N s m-1], (modes, modes)
      real(wp), allocatable :: stiffness(:)    !! diagonal of K [N m-1], (modes)
      real(wp) :: modal_mass = 0.0_wp          !! of the first mode, dry [kg]
      real(wp) :: added_mass = 0.0_wp          !! of the first mode [kg]
      real(wp) :: added_damping = 0.0_wp       !! of the first mode [N s m-1]
      real(wp) :: static_mass = 0.0_wp         !! of the static shape, dry [kg]
      real(wp) :: static_added_mass = 0.0_wp   !! [kg]
      real(wp) :: static_damping = 0.0_wp      !! [N s m-1]
      real(wp) :: static_stiffness = 0.0_wp    !! generalised stiffness of the static shape [N m-1]
      real(wp) :: hole_stiffness = 0.0_wp      !! pressed hole: force over tip displacement [N m-1]
      real(wp) :: omega = 0.0_wp               !! wet frequency of the first mode [rad s-1]
      real(wp) :: reynolds = 0.0_wp            !! at omega and the full width [-]
      logical :: in_range = .true.             !! Re lies where Gamma's formula holds
      real(wp) :: gap = 0.0_wp                 !! g0 [m]
      real(wp) :: viscosity = 0.0_wp           !! mu [Pa s]
      real(wp) :: inlet = 0.0_wp, outlet = 0.0_wp   !! amplitudes [Pa] or [-]
   end type film_valve

contains

   !> Scale a planform's plate and load it with liquid. On failure `self` is a default valve.
   subroutine new_film_valve(self, reed, thickness, density, youngs_modulus, poisson_ratio, load, fluid, gap, error)
      type(film_valve), intent(out) :: self
      type(film_reed), intent(in) :: reed
      real(wp), intent(in) :: thickness, density, youngs_modulus   !! h [m], rho [kg m-3], E [Pa], > 0
      real(wp), intent(in) :: poisson_ratio                        !! [-], the planform's
      integer, intent(in) :: load                                  !! load_maali, load_sader or load_none
      type(fluid_type), intent(in) :: fluid
      real(wp), intent(in) :: gap                                  !! [m], >= 0
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: tolerance = 1.0e-14_wp   !! of omega; the rounding of Sader's Gamma is some 1e-15
      real(wp) :: rigidity, areal_mass, omega, slope, last(2)
      real(wp), dimension(reed%plate%modes + 1, reed%plate%modes + 1) :: added_mass, added_damping
      integer :: n, i, iteration

      if (.not. (thickness > 0.0_wp .and. density > 0.0_wp .and. youngs_modulus > 0.0_wp .and. gap >= 0.0_wp &
         & .and. fluid%density > 0.0_wp .and. fluid%viscosity > 0.0_wp)) then
         call fail(error, rv_bad_input, "the film models need thickness, densities, Young's modulus and viscosity > 0, gap >= 0")
         return
      end if
      if (all(load /= [load_maali, load_sader, load_none])) then
         call fail(error, rv_bad_input, "the film models take hydro.load = 'maali', 'sader' or 'none'")
         return
      end if
      n = reed%plate%modes
      rigidity = youngs_modulus*thickness**3/(12.0_wp*(1.0_wp - poisson_ratio**2))
      areal_mass = density*thickness
      self%modes = n
      self%gap = gap
      self%viscosity = fluid%viscosity
      self%stiffness = rigidity*reed%plate%stiffness
      self%modal_mass = areal_mass*reed%plate%mass(1)
      self%static_stiffness = rigidity*reed%plate%static_stiffness
      self%hole_stiffness = rigidity*reed%plate%hole_stiffness
      self%static_mass = areal_mass*reed%plate%static_mass
      omega = sqrt(self%stiffness(1)/self%modal_mass)
      slope = 0.0_wp
      do iteration = 1, 50   ! secants on omega -> wet, which contracts as in rv_hydrodynamic_load
         call fluid_matrices(reed, load, fluid, omega, added_mass, added_damping)
         self%omega = sqrt(self%stiffness(1)/(self%modal_mass + added_mass(1, 1)))
         if (abs(self%omega - omega) <= tolerance*omega) exit
         if (iteration > 1) slope = (self%omega - last(2))/(omega - last(1))
         last = [omega, self%omega]
         omega = omega + (self%omega - omega)/(1.0_wp - slope)
      end do
      if (iteration > 50) then
         self = film_valve()
         call fail(error, rv_not_converged, "the wet frequency of the first mode was not found")
         return
      end if
      self%added_mass = added_mass(1, 1)
      self%added_damping = added_damping(1, 1)
      self%static_added_mass = added_mass(n + 1, n + 1)
      self%static_damping = added_damping(n + 1, n + 1)
      self%damping = added_damping(:n, :n)
      self%mass = added_mass(:n, :n)
      do i = 1, n
         self%mass(i, i) = self%mass(i, i) + areal_mass*reed%plate%mass(i)
      end do
      self%reynolds = fluid%density*self%omega*reed%plate%form%radius**2/fluid%viscosity
      if (load == load_maali) self%in_range = self%reynolds >= maali_range(1) .and. self%reynolds <= maali_range(2)
      if (load == load_sader) self%in_range = self%reynolds >= sader_range(1) .and. self%reynolds <= sader_range(2)
   end subroutine new_film_valve

end module rv_film_valve
