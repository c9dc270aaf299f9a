!> What a misspelt word was meant to be.
module rv_suggest
   use rv_text, only : text_type, lower
   implicit none
   private
   public :: closest, edit_distance

contains

   !> The word of a list that is meant, empty if none is near: same up to a wrong unit or ending, or few edits away.
   pure function closest(word, list) result(best)
      character(len=*), intent(in) :: word
      type(text_type), intent(in) :: list(:)
      character(len=:), allocatable :: best
      character(len=:), allocatable :: low
      integer :: i, distance, least

      best = ""
      if (len(word) == 0 .or. len(word) > 64) return
      low = lower(word)
      least = max(1, len(low)/3) + 1
      do i = 1, size(list)
         distance = edit_distance(low, list(i)%s)
         if (stem(low) == stem(list(i)%s) .or. index(list(i)%s, low//"_") == 1) distance = min(distance, least - 1)
         if (distance >= least) cycle
         least = distance
         best = list(i)%s
      end do
   end function closest

   !> Fewest insertions, deletions, replacements and swaps of neighbours that make `b` of `a`.
   !>
   !> Optimal string alignment, O(len(a) len(b)).
   pure integer function edit_distance(a, b) result(distance)
      character(len=*), intent(in) :: a, b
      integer :: d(-1:len(a), -1:len(b))
      integer :: i, j, cost

      d = 0
      d(0:, 0) = [(i, i = 0, len(a))]
      d(0, 0:) = [(j, j = 0, len(b))]
      do j = 1, len(b)
         do i = 1, len(a)
            cost = merge(0, 1, a(i:i) == b(j:j))
            d(i, j) = min(d(i - 1, j) + 1, d(i, j - 1) + 1, d(i - 1, j - 1) + cost)
            if (i < 2 .or. j < 2) cycle
            if (a(i:i) == b(j - 1:j - 1) .and. a(i - 1:i - 1) == b(j:j)) d(i, j) = min(d(i, j), d(i - 2, j - 2) + 1)
         end do
      end do
      distance = d(len(a), len(b))
   end function edit_distance

   !> A word up to its last underscore, where keys have their unit; the whole word if it has none.
   pure function stem(word)
      character(len=*), intent(in) :: word
      character(len=:), allocatable :: stem

      stem = word
      if (index(word, "_") > 1) stem = word(:index(word, "_", back=.true.) - 1)
   end function stem

end module rv_suggest
