/* The caller's floating-point environment, put aside and given back; see rv_floats.f90. */
#include <fenv.h>

enum { room = 64 }; /* bytes that Fortran keeps it in */

_Static_assert(sizeof(fenv_t) <= room, "no room for a floating-point environment");

void rv_floats_put_aside(fenv_t *kept);
void rv_floats_give_back(const fenv_t *kept);

void rv_floats_put_aside(fenv_t *kept)
{
   feholdexcept(kept);
}

void rv_floats_give_back(const fenv_t *kept)
{
   fesetenv(kept);
}
