!> The form of a deck: what is taken, and every fault of form with its place.
program test_form
   use check, only : suite_type
   use deck_trial, only : says
   implicit none
   type(suite_type) :: suite
   character(len=*), parameter :: cr = achar(13), tab = achar(9), bom = char(239)//char(187)//char(191)

   call taken()
   call groups()
   call entries()
   call values()
   call strings()
   call bytes()
   call suite%finish()

contains

   subroutine taken()
      call says(suite, "no line end at the end", "&run title = 'a' /", "")
      call says(suite, "CRLF, byte order mark, tabs, comments", bom//"! a comment"//cr//"~&run"//tab//"title ='a'! b" &
         & //cr//"~"//tab//"t_end_ms=30,"//cr//"~/"//cr//"~", "")
      call says(suite, "names in any case", "&RUN Title = 'a', MODEL = 'Squeeze', traces = .TRUE. /", "")
      call says(suite, "no blanks", "&run title='a',t_end_ms=30/&film gap_mm=0.1/", "")
      call says(suite, "both quotes, one inside the other", "&run title = ""it's"" / &film acts = 'both' /", "")
      call says(suite, "words of a logical", "&run traces = T /", "")
      call says(suite, "repeat counts", "&sweep key = 'pressure.inlet_kpa', values = 1*10.0, 20 30 /", "")
      call says(suite, "forms of a real", "&film gap_mm = 5.d-2 k_s = +.0075E+0 /", "")
      call says(suite, "a / in quotes", "&run title = 'a/b' /", "")
      call says(suite, "a comment with quotes and a /", "&run ! it's & = /~ title = 'a' /", "")
   end subroutine taken

   subroutine groups()
      call says(suite, "empty file", "", "@: the file is empty; `reedvalve template` prints a deck to start from")
      call says(suite, "only a comment", "! nothing", &
         & "@:1:1: there is no group in this deck; `reedvalve template` prints a deck to start from")
      call says(suite, "empty group", "&run /", "@:1:1: warning: &run is empty")
      call says(suite, "unknown group", "&preasure inlet_kpa = 3 /", &
         & "@:1:1: &preasure: there is no such group; did you mean 'pressure'?")
      call says(suite, "unknown group, nothing near", "&xyzzy a = 3 /", "@:1:1: &xyzzy: there is no such group")
      call says(suite, "group twice", "&film gap_mm = 0.1 /~~ &film k_s = 0.1 /", &
         & "@:3:2: &film a second time; the first is in line 1: put all its keys there")
      call says(suite, "unclosed at the end", "&film gap_mm = 0.1", &
         & "@:1:1: &film is not closed: no '/' before the end of the file")
      call says(suite, "unclosed before a group", "&film gap_mm = 0.1~&run title = 'a' /", &
         & "@:1:1: &film is not closed: no '/' before '&run' in line 2")
      call says(suite, "old form of a group", "$film gap_mm = 0.1 $end", &
         & "@:1:1: old form of a group; write '&film ... /'~@:1:20: old form of a group's end; write '/'")
      call says(suite, "old end", "&film gap_mm = 0.1 &END", "@:1:20: old form of a group's end; write '/'")
      call says(suite, "end outside", "&film gap_mm = 0.1 /~&end", &
         & "@:2:1: '&end' closes no group; a group ends with '/'")
      call says(suite, "no name", "& film gap_mm = 0.1 /", &
         & "@:1:1: a group's name must follow '&' directly, as in '&run'")
      call says(suite, "text before", "hello ~&run title = 'a' /", &
         & "@:1:1: text outside all groups: 'hello '; a group starts with its name, as in '&run'")
      call says(suite, "text behind, told once", "&run title = 'a' /~ k_s = 1~ gap_mm = 2 /~&film k_s = 1 /", &
         & "@:2:2: text outside all groups: 'k_s = 1'; did a '/' close the group above it too early?")
      call says(suite, "# comment outside", "# a~&run title = 'a' /", &
         & "@:1:1: text outside all groups: '# a'; comments start with '!', not '#'")
   end subroutine groups

   subroutine entries()
      call says(suite, "unknown key", "&film gap_m = 0.1 /", &
         & "@:1:7: film.gap_m: there is no such key; did you mean 'gap_mm'?")
      call says(suite, "key without its unit", "&film gap = 0.1 /", &
         & "@:1:7: film.gap: there is no such key; did you mean 'gap_mm'?")
      call says(suite, "key with another unit", "&pressure inlet_bar = 0.1 /", &
         & "@:1:11: pressure.inlet_bar: there is no such key; did you mean 'inlet_kpa'?")
      call says(suite, "key of another group", "&film ~inlet_kpa = 0.1 /", &
         & "@:2:1: film.inlet_kpa: there is no such key; it belongs to &pressure")
      call says(suite, "unknown key, nothing near", "&film frobnication = 0.1 /", &
         & "@:1:7: film.frobnication: there is no such key")
      call says(suite, "key twice", "&film gap_mm = 0.1, k_s = 1,~ GAP_MM = 0.2 /", &
         & "@:2:2: film.gap_mm a second time; the first is in line 1")
      call says(suite, "no = ", "&film gap_mm 0.1 /", "@:1:7: 'key = value' is due: no '=' after 'gap_mm'")
      call says(suite, "two = ", "&film gap_mm == 0.1 /", "@:1:15: film.gap_mm: this '=' has no place here")
      call says(suite, "no key", "&film = 0.1 /", "@:1:7: the name of a key is due here, not =")
      call says(suite, "comma for a key", "&film , gap_mm = 0.1 /", "@:1:7: the name of a key is due here, not ,")
      call says(suite, "array index", "&sweep key = 'film.gap_mm', values(1) = 0.1, values (2) = 0.2 /", &
         & "@:1:29: 'values(1)': array indices are not taken; list the values: values = value, value~" &
         & //"@:1:46: 'values (2)': array indices are not taken; list the values: values = value, value")
      call says(suite, "component", "&film film%gap = 0.1 /", &
         & "@:1:7: 'film%gap': array indices are not taken; list the values: film = value, value")
      call says(suite, "no name of a key", "&film gap-mm = 0.1 /", &
         & "@:1:7: 'gap-mm' is not the name of a key: letters, digits and _")
      call says(suite, "# comment inside", "&film # a = 3~gap_mm = 0.1 # b = 4~ k_s = 1 /", &
         & "@:1:7: comments start with '!', not '#'~@:2:14: comments start with '!', not '#'")
   end subroutine entries

   subroutine values()
      call says(suite, "no value", "&film gap_mm = k_s = 1 /", "@:1:7: film.gap_mm: no value after '='")
      call says(suite, "no value at the end", "&film gap_mm = /", "@:1:7: film.gap_mm: no value after '='")
      call says(suite, "null value", "&sweep key = 'film.gap_mm', values = 0.1, , 0.2 /", &
         & "@:1:43: sweep.values: a value is missing before this comma")
      call says(suite, "null value first", "&sweep key = 'film.gap_mm', values = , 0.2 /", &
         & "@:1:38: sweep.values: a value is missing before this comma")
      call says(suite, "repeated null", "&sweep key = 'film.gap_mm', values = 3* /", &
         & "@:1:38: sweep.values = 3*: a value must follow '*' directly")
      call says(suite, "no repeats", "&sweep key = 'film.gap_mm', values = 0*1.0, 99999999999999999999*0.1 /", &
         & "@:1:38: sweep.values: a repeat count must be from 1 to 1000000~" &
         & //"@:1:45: sweep.values: a repeat count must be from 1 to 1000000")
      call says(suite, "too many values", "&sweep key = 'film.gap_mm', values = 600000*0.1, 600000*0.2 /", &
         & "@:1:50: sweep.values: more than 1000000 values in one deck")
      call says(suite, "unquoted / in a value", "&pressure file = data/p.csv /", &
         & "@:1:18: pressure.file = data/p.csv: " &
         & //"a '/' ends the group unless it stands in quotes; put a text in quotes~" &
         & //"@:1:18: warning: pressure.file has no effect with pressure.kind = 'square'")
      call says(suite, "unquoted / first", "&run title = /tmp/a, traces = F /", &
         & "@:1:14: run.title = /tmp/a: a '/' ends the group unless it stands in quotes; put a text in quotes")
      call says(suite, "unquoted / and the group's", "&run title = a/b/", &
         & "@:1:14: run.title = a/b: a '/' ends the group unless it stands in quotes; put a text in quotes")
      call says(suite, "a fraction", "&film k_s = 1/2 /", &
         & "@:1:13: film.k_s = 1/2: a '/' ends the group unless it stands in quotes; put a text in quotes")
   end subroutine values

   subroutine strings()
      call says(suite, "text not closed", "&run title = 'abc /~&film k_s = 1 /", &
         & "@:1:14: run.title: the text is not closed: no ' before the end of the line")
      call says(suite, "text not closed at the end", "&run title = ""abc /", &
         & "@:1:14: run.title: the text is not closed: no "" before the end of the line")
      call says(suite, "text in place of a key", "&run 'title' = 'a' /", &
         & "@:1:6: the name of a key is due here, not '")
      call says(suite, "columns count characters", "&run title = '"//char(206)//char(188)//"m' modell = 'a' /", &
         & "@:1:19: run.modell: there is no such key; did you mean 'model'?")
   end subroutine strings

   subroutine bytes()
      call says(suite, "binary", "&run"//achar(0)//" /", &
         & "@:1:5: byte 00 (hexadecimal) does not belong into a text; is this a binary file?")
      call says(suite, "not UTF-8", "! ok~! 5 "//char(181)//"m~&run /", &
         & "@:2:5: byte B5 (hexadecimal) is not UTF-8; save the file as UTF-8")
      call says(suite, "UTF-16", char(255)//char(254)//"&"//achar(0), "@:1:1: this file is UTF-16; save it as UTF-8")
      call says(suite, "cut off UTF-8", "! "//char(206), &
         & "@:1:3: byte CE (hexadecimal) is not UTF-8; save the file as UTF-8")
   end subroutine bytes

end program test_form
