!> The manifest: read as written, and what it says of two runs that do not belong together.
program test_manifest
   use check, only : suite_type
   use rv_error, only : error_type, rv_bad_input, rv_io
   use rv_kinds, only : wp, i8
   use rv_manifest, only : input_type, kind_choice, kind_number, kind_text, manifest_type
   use rv_text, only : to_text
   implicit none
   type(suite_type) :: suite

   call test_round_trip()
   call test_damage()
   call test_difference()
   call suite%finish()

contains

   subroutine test_round_trip()
      type(manifest_type) :: manifest, back
      type(error_type), allocatable :: error

      call make(manifest)
      call back%from_text(manifest%to_text(), error)
      call suite%no_error("read", error)
      call suite%true("the same text", back%to_text() == manifest%to_text())
      call suite%text("deck", back%deck, manifest%deck)
      call suite%true("cases", back%cases == manifest%cases)
      call suite%equal("inputs", size(back%input), 3)
      call suite%text("a file's name", back%input(3)%word(2)%s, "two"//new_line("a")//" 17 lines")
      call suite%true("times to the bit", all(abs(back%time - manifest%time) <= 0.0_wp))
      call suite%true("field mesh to the bit", all(abs(back%fields%x - manifest%fields%x) <= 0.0_wp) &
         & .and. all(abs(back%fields%y - manifest%fields%y) <= 0.0_wp) &
         & .and. all(abs(back%fields%time - manifest%fields%time) <= 0.0_wp))
      call suite%equal("nodes along a ray", back%fields%rings, 3)
      call suite%equal("values in a trace sample", back%traces, 10)
      call suite%equal("compression", back%compress, 7)
      call suite%true("no summary", .not. back%has_csv)
      call suite%equal("faces of two rays of three nodes", size(back%fields%faces(), 2), 2)
      call suite%text("no difference", manifest%difference(back), "")
      call suite%true("one identity", back%identity() == manifest%identity())
      deallocate(manifest%time)
      allocate(manifest%time(0))
      call back%from_text(manifest%to_text(), error)
      call suite%equal("no traces", size(back%time), 0)
   end subroutine test_round_trip

   !> A text cut anywhere is refused, or is at least not the same run.
   subroutine test_damage()
      type(manifest_type) :: manifest, back
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      integer :: cut, taken

      call make(manifest)
      text = manifest%to_text()
      taken = 0
      do cut = 0, len(text) - 2
         call back%from_text(text(:cut), error)
         if (allocated(error)) cycle
         if (back%identity() == manifest%identity()) taken = taken + 1
      end do
      call suite%equal("cut texts that are taken for the whole", taken, 0)
      call back%from_text("something else", error)
      call suite%fails("another file", error, "it is damaged")
      call back%from_text("", error)
      call suite%fails("no bytes", error, "it is empty")
      call suite%equal("which is trouble with a file", error%code, rv_io)
      call back%from_text(text(:index(text, new_line("a")))//"1"//text(index(text, new_line("a")) + 2:), error)
      call suite%fails("another format", error, "it was written by another version of reedvalve")
      call suite%equal("which is sound", error%code, rv_bad_input)
   end subroutine test_damage

   subroutine test_difference()
      type(manifest_type) :: mine, other

      call make(mine)
      call make(other)
      other%effective = "x"
      call suite%text("files", mine%difference(other), "a file that the deck names was changed since")
      other%code_version = "9.9.9"
      call suite%text("versions", mine%difference(other), "it was made by reedvalve 9.9.9 and this is 0.0.1")
      other%deck = "x"
      call suite%text("decks", mine%difference(other), "the deck was edited since")
      other%deck_name = "x"
      call suite%text("names", mine%difference(other), "it was made by another deck, 'x'")
      call make(other)
      other%blocks = 3
      call suite%true("other blocks are another identity", other%identity() /= mine%identity())
   end subroutine test_difference

   subroutine make(manifest)
      type(manifest_type), intent(out) :: manifest
      integer :: i

      manifest%code_version = "0.0.1"
      manifest%deck_name = "name with blanks"
      manifest%deck = "&run /"//new_line("a")//"cases 3"//new_line("a")//"400"//new_line("a")
      manifest%effective = ""
      manifest%title = "Luft, Öl"
      manifest%cases = 5000000000_i8
      manifest%blocks = 2
      allocate(manifest%time(7), manifest%input(3))
      manifest%traces = 10
      manifest%compress = 7
      manifest%has_csv = .false.
      manifest%fields%time = [19.5_wp, 20.0_wp]
      manifest%fields%x = [(1.0_wp/i, i=1, 6)]
      manifest%fields%y = [(0.1_wp*i, i=1, 6)]
      manifest%fields%rings = 3
      manifest%time = [(0.1_wp*i, i=1, 7)]
      call name_input(manifest%input(1), "model", "", kind_choice, 2)
      call name_input(manifest%input(2), "film.gap_mm", "mm", kind_number, 0)
      call name_input(manifest%input(3), "pressure.file", "", kind_text, 2)
      if (size(manifest%input(3)%word) > 1) manifest%input(3)%word(2)%s = "two"//new_line("a")//" 17 lines"
   end subroutine make

   subroutine name_input(input, name, unit, kind, words)
      type(input_type), intent(out) :: input
      character(len=*), intent(in) :: name, unit
      integer, intent(in) :: kind, words
      integer :: i

      input%name = name
      input%unit = unit
      input%long_name = "what "//name//" means"
      input%kind = kind
      allocate(input%word(words))
      do i = 1, words
         input%word(i)%s = "word_"//to_text(i)
      end do
   end subroutine name_input

end program test_manifest
