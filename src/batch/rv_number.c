/* A word as a real number, by strtod: a tenth of the time of Fortran's own read, and the same double.
 *
 * strtod takes more than a deck may have (blanks, infinity, hexadecimals) and less (no d for an exponent), so the form is
 * checked here first; and it goes by the locale, so it is told one with a decimal point. */
#define _GNU_SOURCE
#include <locale.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* as in rv_number.f90 */
enum { FINE, NO_NUMBER, TOO_LARGE, TOO_SMALL };

void rv_number_real(char *word, int64_t length, double *value, int *verdict);

static char *past_sign(char *next)
{
   return *next == '+' || *next == '-' ? next + 1 : next;
}

static char *past_digits(char *next)
{
   while (*next >= '0' && *next <= '9') next++;
   return next;
}

/* Where the digits and the point end that `word` begins with; NULL if there is no digit. */
static char *past_mantissa(char *word)
{
   char *first = past_sign(word);
   char *end = past_digits(first);
   int has_digit = end > first;

   if (*end == '.') {
      first = end + 1;
      end = past_digits(first);
      has_digit = has_digit || end > first;
   }
   return has_digit ? end : NULL;
}

/* Is `letter` the end of the word or an exponent up to there? A d becomes an e. */
static int ends_well(char *letter, const char *end)
{
   char *first;

   if (letter == end) return 1;
   if (*letter == '\0' || strchr("eEdD", *letter) == NULL) return 0;
   *letter = 'e';
   first = past_sign(letter + 1);
   return past_digits(first) == end && first < end;
}

/* [sign] digits [. digits] [e|d [sign] digits], with a digit before or after the point. There is room for a NUL behind
 * the `length` bytes of the word. */
void rv_number_real(char *word, int64_t length, double *value, int *verdict)
{
   locale_t plain;
   char *letter;

   *value = 0.0;
   *verdict = NO_NUMBER;
   word[length] = '\0';
   letter = past_mantissa(word);
   if (letter == NULL || !ends_well(letter, word + length)) return;
   plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);   /* one that is always there, at no cost */
   *value = strtod_l(word, NULL, plain);
   freelocale(plain);
   *verdict = FINE;
   if (!isfinite(*value)) {
      *verdict = TOO_LARGE;
   } else if (!(fabs(*value) > 0.0) && strcspn(word, "123456789") < (size_t)(letter - word)) {
      *verdict = TOO_SMALL;
   }
   if (*verdict != FINE) *value = 0.0;
}
