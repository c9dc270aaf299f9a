/* What rv_row_text is held against. */
#include <stdio.h>

void test_printf_number(double x, int digits, char *text, size_t size);

void test_printf_number(double x, int digits, char *text, size_t size)
{
   snprintf(text, size, "%.*g", digits, x);
}
