/* Numbers as text, many millions of them: the bytes of printf's "%.*g" at a tenth of its cost.
 *
 * x = n 10^(e - digits + 1) with n a whole number of `digits` digits. Powers of ten up to 10^22 are doubles, so
 * x 10^k (or x / 10^-k) is one rounded operation, whose rounding error a fused multiply-add gives exactly
 * (Dekker 1971, doi:10.1007/BF01397083, with the sum and the remainder as one operation). The product is below 2^53,
 * where a half is a double: it and the sign of the error tell on which side of a tie the true value lies. So n is what
 * printf finds with long arithmetic, in all cases; what is too small or large for k goes to printf itself.
 * Needs rounding to nearest. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* where a column's field stands in the row before, and its number; nowhere yet while its length is 0 */
typedef struct {
   double x;
   int64_t at;
   int64_t length;
} field_type;

void rv_decimal_number(double x, int digits, char *text, int *length);
void rv_decimal_fields(const double *x, int n, int digits, field_type *above, char *text, int64_t *used);
void rv_decimal_whole(int64_t i, char *text, int *length);

enum { FEWEST = 1, MOST = 15, LONGEST = 16, ROOM = 40 };

static const double power[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                               1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

static const uint64_t whole_power[] = {1u,         10u,         100u,         1000u,         10000u,         100000u,
                                       1000000u,   10000000u,   100000000u,   1000000000u,   10000000000u,   100000000000u,
                                       1000000000000u, 10000000000000u, 100000000000000u, 1000000000000000u};

static const char pair[100][2] = {
   {'0', '0'}, {'0', '1'}, {'0', '2'}, {'0', '3'}, {'0', '4'}, {'0', '5'}, {'0', '6'}, {'0', '7'}, {'0', '8'}, {'0', '9'},
   {'1', '0'}, {'1', '1'}, {'1', '2'}, {'1', '3'}, {'1', '4'}, {'1', '5'}, {'1', '6'}, {'1', '7'}, {'1', '8'}, {'1', '9'},
   {'2', '0'}, {'2', '1'}, {'2', '2'}, {'2', '3'}, {'2', '4'}, {'2', '5'}, {'2', '6'}, {'2', '7'}, {'2', '8'}, {'2', '9'},
   {'3', '0'}, {'3', '1'}, {'3', '2'}, {'3', '3'}, {'3', '4'}, {'3', '5'}, {'3', '6'}, {'3', '7'}, {'3', '8'}, {'3', '9'},
   {'4', '0'}, {'4', '1'}, {'4', '2'}, {'4', '3'}, {'4', '4'}, {'4', '5'}, {'4', '6'}, {'4', '7'}, {'4', '8'}, {'4', '9'},
   {'5', '0'}, {'5', '1'}, {'5', '2'}, {'5', '3'}, {'5', '4'}, {'5', '5'}, {'5', '6'}, {'5', '7'}, {'5', '8'}, {'5', '9'},
   {'6', '0'}, {'6', '1'}, {'6', '2'}, {'6', '3'}, {'6', '4'}, {'6', '5'}, {'6', '6'}, {'6', '7'}, {'6', '8'}, {'6', '9'},
   {'7', '0'}, {'7', '1'}, {'7', '2'}, {'7', '3'}, {'7', '4'}, {'7', '5'}, {'7', '6'}, {'7', '7'}, {'7', '8'}, {'7', '9'},
   {'8', '0'}, {'8', '1'}, {'8', '2'}, {'8', '3'}, {'8', '4'}, {'8', '5'}, {'8', '6'}, {'8', '7'}, {'8', '8'}, {'8', '9'},
   {'9', '0'}, {'9', '1'}, {'9', '2'}, {'9', '3'}, {'9', '4'}, {'9', '5'}, {'9', '6'}, {'9', '7'}, {'9', '8'}, {'9', '9'}};

/* |x| for which every k is a place in `power`, even when the exponent is first taken one too low */
static const double least = 1e-7, most = 1e20;

/* x times 10^k, rounded to a whole number as the exact value would be, ties to even; 0 < x, result below 2^53 */
static uint64_t scaled(double x, int k)
{
   double product = k >= 0 ? x * power[k] : x / power[-k];
   uint64_t whole = (uint64_t)(int64_t)product;
   double rest = product - (double)(int64_t)whole, error;

   if (rest < 0.5) return whole;
   if (rest > 0.5) return whole + 1;
   error = k >= 0 ? fma(x, power[k], -product) : fma(-product, power[-k], x);
   if (error > 0.0) return whole + 1;
   return error < 0.0 ? whole : whole + (whole & 1);
}

/* eight digits, with leading zeros */
static void put_half(uint32_t n, char *text)
{
   uint32_t high = n / 10000, low = n % 10000;

   memcpy(text, pair[high / 100], 2);
   memcpy(text + 2, pair[high % 100], 2);
   memcpy(text + 4, pair[low / 100], 2);
   memcpy(text + 6, pair[low % 100], 2);
}

/* LONGEST digits of n, with leading zeros; in halves, so that divisions do not wait for each other */
static void put_digits(uint64_t n, char *text)
{
   put_half((uint32_t)(n / 100000000u), text);
   put_half((uint32_t)(n % 100000000u), text + LONGEST / 2);
}

/* the decimal exponent of x, or one less: from the binary one, of a positive number that is not subnormal */
static int lowest_exponent(double x)
{
   uint64_t bits;
   int binary;

   memcpy(&bits, &x, sizeof bits);
   binary = (int)(bits >> 52) - 1023;
   return (binary * 1233 + (64 << 12)) / 4096 - 64;   /* 1233/4096 is log10(2) less 5e-6; the sum is > 0 */
}

/* a host program's locale may have a decimal comma, a CSV file may not */
static int by_printf(double x, int digits, char *text)
{
   int length = snprintf(text, ROOM, "%.*g", digits, x);
   char *comma = strchr(text, ',');

   if (comma != NULL) *comma = '.';
   return length;
}

/* `used` digits with a point after `whole` of them, filled up with zeros before it; returns where they end.
 * Copies of fixed length, beyond the end too, are quicker than loops. */
static char *put_fraction(const char *digit, int whole, int used, char *text)
{
   memcpy(text, digit, MOST);
   if (used <= whole) return text + whole;
   text[whole] = '.';
   memcpy(text + whole + 1, digit + whole, MOST);
   return text + used + 1;
}

/* Writes x with so many significant digits, zeros at the end dropped. `text` has ROOM bytes, `length` are used. */
void rv_decimal_number(double x, int digits, char *text, int *length)
{
   char room[LONGEST + MOST], *next = text;
   const char *digit = room + LONGEST - digits;
   double size = fabs(x);
   uint64_t n;
   int exponent, used = digits;

   if (digits < FEWEST || digits > MOST || !(size >= least && size < most)) {
      *length = by_printf(x, digits, text);
      return;
   }
   exponent = lowest_exponent(size);
   n = scaled(size, digits - 1 - exponent);
   if (n >= whole_power[digits]) n = scaled(size, digits - 1 - ++exponent);
   if (n >= whole_power[digits]) n = scaled(size, digits - 1 - ++exponent);   /* 9.99... became 10 */
   memset(room + LONGEST, '0', MOST);
   put_digits(n, room);
   while (used > 1 && digit[used - 1] == '0') used--;

   if (signbit(x)) *next++ = '-';
   if (exponent < -4 || exponent >= digits) {
      next = put_fraction(digit, 1, used, next);
      *next++ = 'e';
      *next++ = exponent < 0 ? '-' : '+';
      memcpy(next, pair[exponent < 0 ? -exponent : exponent], 2);
      next += 2;
   } else if (exponent >= 0) {
      next = put_fraction(digit, exponent + 1, used, next);
   } else {
      memcpy(next, "0.000", 5);
      memcpy(next + 1 - exponent, digit, MOST);
      next += used + 1 - exponent;
   }
   *length = (int)(next - text);
}

static int is_same(double x, double y)
{
   return memcmp(&x, &y, sizeof x) == 0;
}

/* Writes a comma and a number for each of n columns behind `used` bytes of text, no number for a NaN; what a column
 * repeats is copied from the row before. There is room for n (ROOM + 1) bytes. */
void rv_decimal_fields(const double *x, int n, int digits, field_type *above, char *text, int64_t *used)
{
   int i, length;

   for (i = 0; i < n; i++) {
      char *next = text + *used;

      if (above[i].length > 0 && is_same(x[i], above[i].x)) {
         memmove(next, text + above[i].at, ROOM);   /* of fixed length, which is quicker */
      } else {
         length = 0;
         *next = ',';
         if (!isnan(x[i])) rv_decimal_number(x[i], digits, next + 1, &length);
         above[i].x = x[i];
         above[i].length = length + 1;
      }
      above[i].at = *used;
      *used += above[i].length;
   }
}

/* Writes a whole number, i >= 0. `text` has ROOM bytes, `length` are used. */
void rv_decimal_whole(int64_t i, char *text, int *length)
{
   char room[LONGEST];
   int64_t rest;

   *length = 1;
   for (rest = i; rest >= 10; rest /= 10) ++*length;
   if (*length > LONGEST) {
      *length = snprintf(text, ROOM, "%" PRId64, i);
      return;
   }
   put_digits((uint64_t)i, room);
   memcpy(text, room + LONGEST - *length, (size_t)*length);
}
