/* The number of threads of a BLAS that has its own: OpenBLAS. Other libraries need nothing of this kind. */

/* there if OpenBLAS is what the program runs with */
extern int openblas_get_num_threads(void) __attribute__((weak));
extern void openblas_set_num_threads(int threads) __attribute__((weak));

int rv_blas_threads_set(int threads);

/* Returns how many there were; 0: that is not known, and nothing was set. */
int rv_blas_threads_set(int threads)
{
   int before;

   if (!openblas_get_num_threads || !openblas_set_num_threads) return 0;
   before = openblas_get_num_threads();
   if (before != threads) openblas_set_num_threads(threads);
   return before;
}
