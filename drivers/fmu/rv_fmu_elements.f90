!> How FMI 2.0 and 3.0 write the same in a model description.
module rv_fmu_elements
   use rv_keys, only : choice_count, choice_key, choice_name, full_name, integer_key
   use rv_text, only : to_text
   use rv_text_builder, only : text_builder
   implicit none
   private
   public :: attribute, variable_element, choices_element, unknowns_elements

contains

   !> ' name="value"'
   function attribute(name, value) result(text)
      character(len=*), intent(in) :: name, value
      character(len=:), allocatable :: text

      text = " "//name//'="'//escaped(value)//'"'
   end function attribute

   !> A variable: in FMI 2.0 its type is an element inside, in 3.0 its name.
   function variable_element(fmi, kind, general, special) result(text)
      integer, intent(in) :: fmi
      integer, intent(in) :: kind               !! of key: real_key, integer_key or choice_key
      character(len=*), intent(in) :: general   !! attributes of any variable
      character(len=*), intent(in) :: special   !! attributes of its type
      character(len=:), allocatable :: text, type

      select case (kind)
      case (choice_key)
         type = "Enumeration"
      case (integer_key)
         type = trim(merge("Integer", "Int32  ", fmi == 2))
      case default
         type = trim(merge("Real   ", "Float64", fmi == 2))
      end select
      if (fmi == 2) then
         text = "<ScalarVariable"//general//"><"//type//special//"/></ScalarVariable>"
      else
         text = "<"//type//general//special//"/>"
      end if
   end function variable_element

   !> The type of a choice, called as its key.
   function choices_element(fmi, key) result(text)
      integer, intent(in) :: fmi, key
      character(len=:), allocatable :: text
      type(text_builder) :: items
      integer :: i

      do i = 1, choice_count(key)
         call items%add("<Item"//attribute("name", choice_name(key, i))//attribute("value", to_text(i))//"/>")
      end do
      if (fmi == 2) then
         text = "<SimpleType"//attribute("name", full_name(key))//"><Enumeration>"//items%text()//"</Enumeration></SimpleType>"
      else
         text = "<EnumerationType"//attribute("name", full_name(key))//">"//items%text()//"</EnumerationType>"
      end if
   end function choices_element

   !> Variables that are computed. FMI 2.0 asks for their places among all, from 1.
   function unknowns_elements(fmi, name, place, reference) result(text)
      integer, intent(in) :: fmi
      character(len=*), intent(in) :: name
      integer, intent(in) :: place(:)
      integer, intent(in) :: reference(:)   !! one for each place
      character(len=:), allocatable :: text
      type(text_builder) :: list
      integer :: i

      do i = 1, size(place)
         if (fmi == 2) then
            call list%add("<Unknown"//attribute("index", to_text(place(i)))//"/>")
         else
            call list%add("<"//name//attribute("valueReference", to_text(reference(i)))//"/>")
         end if
      end do
      text = list%text()
      if (fmi == 2) text = "<"//name//"s>"//text//"</"//name//"s>"
   end function unknowns_elements

   !> As XML wants it in an attribute.
   function escaped(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: escaped
      type(text_builder) :: build
      integer :: i

      do i = 1, len(text)
         select case (text(i:i))
         case ("&")
            call build%add("&amp;")
         case ("<")
            call build%add("&lt;")
         case (">")
            call build%add("&gt;")
         case ('"')
            call build%add("&quot;")
         case (achar(0):achar(31))
            call build%add(" ")   ! most are not allowed there at all
         case default
            call build%add(text(i:i))
         end select
      end do
      escaped = build%text()
   end function escaped

end module rv_fmu_elements
