!> From a deck to what its results say of it: the manifest, and the columns that tell its cases apart.
module rv_inputs
   use rv_kinds, only : wp, i8
   use rv_text, only : text_type
   use rv_number, only : tidy
   use rv_keys, only : choice_count, choice_key, choice_name, csv_always, csv_auto, from_si, full_name, key_run_compress, &
      & key_run_csv, key_run_model, keys, n_keys, text_key
   use rv_deck, only : deck_type
   use rv_block, only : block_count, trace_count, trace_times
   use rv_field_mesh, only : deck_field_mesh
   use rv_manifest, only : input_type, kind_choice, kind_number, kind_text, manifest_type
   use rv_version, only : code_version
   implicit none
   private
   public :: new_manifest, input_values, most_csv_cases

   integer(i8), parameter :: most_csv_cases = 2000000   !! beyond them a summary is written only if it is asked for

contains

   !> The manifest of a run of this deck.
   subroutine new_manifest(deck, manifest)
      type(deck_type), intent(in) :: deck
      type(manifest_type), intent(out) :: manifest
      integer, allocatable :: swept(:)
      integer :: i

      manifest%code_version = code_version
      manifest%deck_name = deck%name
      manifest%deck = deck%text
      manifest%title = deck%title
      manifest%effective = deck%effective_text()
      manifest%cases = deck%case_count()
      manifest%blocks = block_count(deck)
      manifest%time = tidy(trace_times(deck)*1.0e3_wp)
      manifest%traces = trace_count(deck)
      manifest%compress = nint(deck%value(key_run_compress))
      select case (nint(deck%value(key_run_csv)))
      case (csv_auto)
         manifest%has_csv = manifest%cases <= most_csv_cases
      case default
         manifest%has_csv = nint(deck%value(key_run_csv)) == csv_always
      end select
      call deck_field_mesh(deck, manifest%fields)
      allocate(swept, source=deck%swept_keys())
      allocate(manifest%input(size(swept) + 1))
      call describe(deck, key_run_model, manifest%input(1))
      manifest%input(1)%name = "model"
      manifest%input(1)%long_name = "valve model"
      do i = 1, size(swept)
         call describe(deck, swept(i), manifest%input(i + 1))
      end do
   end subroutine new_manifest

   !> The columns of the manifest for some consecutive cases, in the deck's units.
   subroutine input_values(deck, first, last, input)
      type(deck_type), intent(in) :: deck
      integer(i8), intent(in) :: first, last      !! 1 <= first <= last <= case_count
      real(wp), allocatable, intent(out) :: input(:, :)
      integer, allocatable :: column(:)
      real(wp) :: value(n_keys)
      integer :: i

      allocate(column, source=[key_run_model, deck%swept_keys()])
      allocate(input(size(column), last - first + 1))
      do i = 1, size(input, 2)
         call deck%case_values(first + i - 1, value)
         input(:, i) = from_si(column, value(column))
      end do
   end subroutine input_values

   subroutine describe(deck, key, input)
      type(deck_type), intent(in) :: deck
      integer, intent(in) :: key
      type(input_type), intent(out) :: input
      integer :: i

      input%name = full_name(key)
      input%unit = trim(keys(key)%unit)
      input%long_name = trim(keys(key)%help)
      select case (keys(key)%kind)
      case (choice_key)
         input%kind = kind_choice
         allocate(input%word(choice_count(key)))
         do i = 1, size(input%word)
            input%word(i)%s = choice_name(key, i)
         end do
      case (text_key)
         input%kind = kind_text
         allocate(input%word(size(deck%trace_name)))
         do i = 1, size(input%word)
            input%word(i)%s = deck%trace_name(i)%s
         end do
      case default
         input%kind = kind_number
         allocate(input%word(0))
      end select
   end subroutine describe

end module rv_inputs
