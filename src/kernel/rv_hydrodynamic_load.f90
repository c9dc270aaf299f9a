!> Added mass and damping of the reed's one degree of freedom, Eqs. (21) to (23).
!>
!> The paper leaves the Reynolds number, the frequency and the length on which the load
!> acts open; each choice here states its own:
!>
!> | choice    | frequency        | Re                       | weight             | Gamma     |
!> |-----------|------------------|--------------------------|--------------------|-----------|
!> | published | dry, sqrt(k/m_e) | rho_f omega h B/mu       | integral of phi    | Eq. (23)  |
!> | maali     | wet, fixed point | rho_f omega B^2/(4 mu)   | integral of phi^2  | Eq. (23)  |
!> | sader     | wet, fixed point | rho_f omega B^2/(4 mu)   | integral of phi^2  | Sader     |
!> | none      | dry              | -                        | 0                  | 0         |
module rv_hydrodynamic_load
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use rv_kinds, only : wp, pi
   use rv_error, only : error_type, fail, rv_bad_input, rv_not_converged
   use rv_text, only : to_text
   use rv_hydrodynamic_function, only : maali_function, sader_function, maali_range, sader_range
   use rv_reed, only : reed_type
   implicit none
   private
   public :: hydrodynamic_load, new_hydrodynamic_load, fluid_type
   public :: load_published, load_maali, load_sader, load_none

   integer, parameter :: load_published = 1
   integer, parameter :: load_maali = 2
   integer, parameter :: load_sader = 3
   integer, parameter :: load_none = 4

   !> The liquid around the reed.
   type :: fluid_type
      real(wp) :: density = 0.0_wp    !! rho_f [kg m-3]
      real(wp) :: viscosity = 0.0_wp  !! mu, dynamic [Pa s]
   end type fluid_type

   !> What the liquid adds to the equation of motion.
   type :: hydrodynamic_load
      real(wp) :: added_mass = 0.0_wp        !! m_a [kg]
      real(wp) :: added_damping = 0.0_wp     !! c_a [N s m-1]
      real(wp) :: angular_frequency = 0.0_wp !! omega at which Gamma was taken [rad/s]
      real(wp) :: reynolds = 0.0_wp          !! Re at which Gamma was taken [-]; NaN without load
      logical :: in_range = .true.           !! Re lies where Gamma's formula holds
   end type hydrodynamic_load

contains

   !> Added mass and damping for one of the load_ choices. On failure `self` is a default load.
   !>
   !> Wet frequency: omega = sqrt(k/(m_e + m_a(omega))). m_a depends on omega weaker than omega**(-1/2)
   !> in Eq. (23), so the iteration contracts by at least 4 (Sader's Gamma at low Re: by 2) each time.
   subroutine new_hydrodynamic_load(self, choice, reed, fluid, error)
      type(hydrodynamic_load), intent(out) :: self
      integer, intent(in) :: choice          !! one of load_
      type(reed_type), intent(in) :: reed
      type(fluid_type), intent(in) :: fluid
      type(error_type), allocatable, intent(out) :: error
      real(wp), parameter :: tolerance = 1.0e-14_wp   !! of omega; the rounding of Sader's Gamma is some 1e-15
      real(wp) :: omega, wet
      integer :: iteration

      if (.not. (fluid%density > 0.0_wp .and. fluid%viscosity > 0.0_wp .and. reed%mass > 0.0_wp)) then
         call fail(error, rv_bad_input, "the hydrodynamic load needs density, viscosity and the reed's mass > 0")
         return
      end if
      omega = sqrt(reed%stiffness/reed%mass)
      select case (choice)
      case (load_published)
         self = load_at(choice, reed, fluid, omega)
      case (load_maali, load_sader)
         do iteration = 1, 200
            self = load_at(choice, reed, fluid, omega)
            wet = sqrt(reed%stiffness/(reed%mass + self%added_mass))
            if (abs(wet - omega) <= tolerance*omega) return
            omega = wet
         end do
         self = hydrodynamic_load()
         call fail(error, rv_not_converged, "no wet frequency found for the hydrodynamic load near " &
            & //to_text(omega, 6)//" rad/s")
      case (load_none)
         self%angular_frequency = omega
         self%reynolds = ieee_value(1.0_wp, ieee_quiet_nan)
      case default
         call fail(error, rv_bad_input, "unknown hydrodynamic load")
      end select
   end subroutine new_hydrodynamic_load

   pure function load_at(choice, reed, fluid, omega) result(load)
      integer, intent(in) :: choice
      type(reed_type), intent(in) :: reed
      type(fluid_type), intent(in) :: fluid
      real(wp), intent(in) :: omega      !! [rad/s]
      type(hydrodynamic_load) :: load
      complex(wp) :: gamma
      real(wp) :: per_length, weight, range(2)

      if (choice == load_published) then
         load%reynolds = fluid%density*omega*reed%thickness*reed%width/fluid%viscosity
         weight = reed%shape_integral
      else
         load%reynolds = 0.25_wp*fluid%density*omega*reed%width**2/fluid%viscosity
         weight = reed%shape2_integral
      end if
      if (choice == load_sader) then
         gamma = sader_function(load%reynolds)
         range = sader_range
      else
         gamma = maali_function(load%reynolds)
         range = maali_range
      end if
      per_length = 0.25_wp*pi*fluid%density*reed%width**2
      load%added_mass = per_length*real(gamma)*weight
      load%added_damping = per_length*omega*aimag(gamma)*weight
      load%angular_frequency = omega
      load%in_range = load%reynolds >= range(1) .and. load%reynolds <= range(2)
   end function load_at

end module rv_hydrodynamic_load
