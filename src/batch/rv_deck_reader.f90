!> The words of a deck: a reader that knows its line and column, and takes names, words and quoted texts.
module rv_deck_reader
   use rv_text_file, only : byte_order_mark
   implicit none
   private
   public :: deck_reader, new_deck_reader, place_type, word_type, end_of_text, name_characters

   !> A place in the text; columns count characters, not bytes.
   type :: place_type
      integer :: at = 1, line = 1, column = 1
   end type place_type

   !> A piece of the text, without its quotes.
   type :: word_type
      type(place_type) :: start
      integer :: first = 1, last = 0    !! bytes
      character(len=1) :: quote = " "   !! the quote around it
      logical :: is_broken = .false.    !! its fault has been told
   end type word_type

   !> Reads the text it holds from `now` on.
   type :: deck_reader
      character(len=:), allocatable :: text
      type(place_type) :: now
   contains
      procedure :: here
      procedure :: next
      procedure :: advance
      procedure :: skip_blanks
      procedure :: skip_line
      procedure :: take_any_of
      procedure :: take_word
      procedure :: take_path
      procedure :: take_quoted
      procedure :: word_text
   end type deck_reader

   character(len=1), parameter :: end_of_text = achar(0)
   character(len=1), parameter :: line_feed = achar(10)
   character(len=*), parameter :: name_characters = &
      & "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789"
   character(len=*), parameter :: line_blanks = " "//achar(9)//achar(12)//achar(13)
   character(len=*), parameter :: blanks = line_blanks//line_feed
   character(len=*), parameter :: separators = blanks//end_of_text//",/=!&$'"//'"'

contains

   !> Start at the first character of a text without NUL.
   pure function new_deck_reader(text) result(reader)
      character(len=*), intent(in) :: text
      type(deck_reader) :: reader

      reader%text = text
      if (index(text, byte_order_mark) == 1) reader%now%at = len(byte_order_mark) + 1
   end function new_deck_reader

   !> The character the reader stands on.
   pure character(len=1) function here(self)
      class(deck_reader), intent(in) :: self

      here = character_at(self, self%now%at)
   end function here

   !> The one after it.
   pure character(len=1) function next(self)
      class(deck_reader), intent(in) :: self

      next = character_at(self, self%now%at + 1)
   end function next

   pure character(len=1) function character_at(self, i) result(c)
      class(deck_reader), intent(in) :: self
      integer, intent(in) :: i

      c = end_of_text
      if (i <= len(self%text)) c = self%text(i:i)
   end function character_at

   !> One character on.
   pure subroutine advance(self)
      class(deck_reader), intent(inout) :: self
      character(len=1) :: passed

      passed = self%here()
      self%now%at = self%now%at + 1
      if (passed == line_feed) then
         self%now%line = self%now%line + 1
         self%now%column = 1
      else if (.not. is_continuation(self%here())) then
         self%now%column = self%now%column + 1
      end if
   end subroutine advance

   !> A byte of a UTF-8 character behind its first.
   pure logical function is_continuation(c)
      character(len=1), intent(in) :: c

      is_continuation = iachar(c) >= 128 .and. iachar(c) < 192
   end function is_continuation

   !> Pass blanks, line ends and comments.
   pure subroutine skip_blanks(self)
      class(deck_reader), intent(inout) :: self

      do
         if (self%here() == "!") call self%skip_line()
         if (index(blanks, self%here()) == 0) exit
         call self%advance()
      end do
   end subroutine skip_blanks

   !> Go to the end of the line.
   pure subroutine skip_line(self)
      class(deck_reader), intent(inout) :: self

      do while (self%here() /= line_feed .and. self%here() /= end_of_text)
         call self%advance()
      end do
   end subroutine skip_line

   !> Take characters as long as they are in a set; the word may be empty.
   pure subroutine take_any_of(self, set, word)
      class(deck_reader), intent(inout) :: self
      character(len=*), intent(in) :: set
      type(word_type), intent(out) :: word

      word%start = self%now
      word%first = self%now%at
      do while (index(set, self%here()) > 0)
         call self%advance()
      end do
      word%last = self%now%at - 1
   end subroutine take_any_of

   !> Take an unquoted word up to a separator; what stands in parentheses belongs to the word before it.
   pure subroutine take_word(self, word)
      class(deck_reader), intent(inout) :: self
      type(word_type), intent(out) :: word
      type(word_type) :: gap

      word%start = self%now
      word%first = self%now%at
      do
         do while (index(separators, self%here()) == 0 .and. self%here() /= "(")
            call self%advance()
         end do
         word%last = self%now%at - 1
         call self%take_any_of(line_blanks, gap)
         if (self%here() /= "(") exit
         do while (index(")"//line_feed//end_of_text, self%here()) == 0)
            call self%advance()
         end do
         if (self%here() == ")") call self%advance()
         word%last = self%now%at - 1
      end do
      self%now = gap%start
   end subroutine take_word

   !> Go on with a word that has a / in it; a / at its end stays, for it may close the group.
   pure subroutine take_path(self, word)
      class(deck_reader), intent(inout) :: self
      type(word_type), intent(inout) :: word
      type(place_type) :: before

      before = self%now
      do while (index(blanks//end_of_text//",", self%here()) == 0)
         before = self%now
         call self%advance()
      end do
      if (self%text(before%at:before%at) == "/" .and. before%at > word%first) self%now = before
      word%last = self%now%at - 1
   end subroutine take_path

   !> Take a quoted text; without its closing quote in the same line it is broken and ends with the line.
   pure subroutine take_quoted(self, word)
      class(deck_reader), intent(inout) :: self
      type(word_type), intent(out) :: word

      word%start = self%now
      word%quote = self%here()
      word%first = self%now%at + 1
      do
         call self%advance()
         if (self%here() == line_feed .or. self%here() == end_of_text) exit
         if (self%here() /= word%quote) cycle
         if (self%next() /= word%quote) exit
         call self%advance()
      end do
      word%last = self%now%at - 1
      word%is_broken = self%here() /= word%quote
      if (.not. word%is_broken) call self%advance()
   end subroutine take_quoted

   !> A word as it is meant: two quotes in a quoted text are one.
   pure function word_text(self, word) result(text)
      class(deck_reader), intent(in) :: self
      type(word_type), intent(in) :: word
      character(len=:), allocatable :: text
      integer :: i, n

      text = self%text(word%first:word%last)
      if (index(text, word%quote//word%quote) == 0 .or. word%quote == " ") return
      n = 0
      i = 1
      do while (i <= len(text))
         n = n + 1
         text(n:n) = text(i:i)
         if (text(i:i) == word%quote) i = i + 1
         i = i + 1
      end do
      text = text(:n)
   end function word_text

end module rv_deck_reader
