/* The inside of the FMU's library: one instance, its life, and what its variables are. FMI itself is in fmi2*.h and
 * fmi3*.h. */
#ifndef RV_FMU_H
#define RV_FMU_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define RV_FMU_TOKEN 64 /* bytes of an instantiation token, its NUL among them */

uint64_t rv_fmu_hash(const void *data, size_t size);
void rv_fmu_token(const void *deck, size_t size, char token[RV_FMU_TOKEN]);

#ifdef RV_FMU_LIBRARY
#include <fmi2FunctionTypes.h>
#include <fmi3Functions.h>
#include <reedvalve.h>

enum { n_inputs = 4, n_outputs = 10, n_pressures = 2 }; /* the first inputs are pressures, their slopes follow */
enum { first_input = 1, first_output = 10, first_parameter = 100 }; /* value references; 0 is time */

/* States of FMI; a set of them says where a function is allowed. */
enum { instantiated = 1, initializing = 2, stepping = 4, terminated = 8, anywhere = 15 };

/* Where inputs may be set, and parameters. */
enum { before_end = instantiated | initializing | stepping, before_steps = instantiated | initializing };

/* What fmi3GetFMUState gives: `size` bytes, which are also the serialised form. */
typedef struct fmu_state {
  struct fmu_state *next;
  size_t size;
  unsigned char bytes[];
} fmu_state;

typedef struct instance {
  struct instance *next;
  char *name;
  fmi3InstanceEnvironment environment;
  fmi3LogMessageCallback log;
  fmi2CallbackLogger log2; /* of an importer of FMI 2.0, in place of log */
  const char *called;      /* the function of FMI 2.0 that messages name; NULL: this is FMI 3.0 */
  bool tells_warnings;
  char *deck; /* its file */
  uint64_t settings; /* hash of its bytes */
  rv_valve *valve;
  int model, kind; /* of valve and pressure, see rv_keys */
  int mode;
  double start, time, stop; /* [s]; stop is infinite where none is given */
  double input[n_inputs];   /* [Pa], [Pa/s] */
  double output[n_outputs]; /* at `time`, see rv_out; while initializing only if is_ready */
  bool is_ready;            /* the valve has begun with the parameters and inputs as they are */
  fmu_state *states;
} instance;

/* A new instance with the name and the importer's side of `given`. NULL: it has been told why there is none. */
instance *rv_fmu_new(const instance *given, const char *function, const char *token, const char *resources);

/* The instance behind a pointer if `function` is allowed now. NULL: there is none, or it has been told that it is not. */
instance *rv_fmu_enter(fmi3Instance pointer, const char *function, int allowed);

/* The same if arrays for n variables are there, too. */
instance *rv_fmu_enter_values(fmi3Instance pointer, const char *function, int allowed, const fmi3ValueReference *reference,
                              size_t n, const void *value, size_t n_values);

/* The instance that a function of FMI 2.0 was called with, which messages name from here on; NULL: there is none. */
instance *rv_fmu_called_as(fmi2Component component, const char *function);

/* Tell an error, after which only going back to a state, reset and the end are left. */
fmi3Status rv_fmu_fail(instance *self, const char *function, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same with the valve's own message. */
fmi3Status rv_fmu_fail_valve(instance *self, const char *function);

/* Tell something of less weight to those who ask for it. The status comes back. */
fmi3Status rv_fmu_warn(instance *self, fmi3Status status, const char *function, const char *message);

/* Tell what the valve's last call warned of, if it did. */
fmi3Status rv_fmu_warn_valve(instance *self, const char *function);

/* Open the valve, with the settings of the deck, in place of the one there was. False: it has been told why not. */
bool rv_fmu_open_valve(instance *self, const char *function);

/* Take what the importer says of the run. */
fmi3Status rv_fmu_set_up(instance *self, const char *function, bool has_tolerance, double tolerance, double start,
                         bool has_stop, double stop);

/* Put the valve to its start under the inputs as they are, and compute outputs. */
fmi3Status rv_fmu_begin(instance *self, const char *function);

/* Take outputs from the valve. */
void rv_fmu_read_outputs(instance *self);

/* Errors for what this FMU does not do, and for types of variable that it does not have, unless n is 0. */
fmi3Status rv_fmu_refuse(fmi3Instance pointer, const char *function);
fmi3Status rv_fmu_no_variables(fmi3Instance pointer, const char *function, size_t n);

/* The worse of two. */
fmi3Status rv_fmu_worse(fmi3Status a, fmi3Status b);

/* The key of a parameter, "film.gap_mm", with its kind and number. False: this FMU has no such parameter. */
enum { longest_name = 40, longest_word = 400 };
typedef struct {
  int key; /* from 0 */
  int kind;
  char name[longest_name];
} parameter;
bool rv_fmu_parameter(const instance *self, fmi3ValueReference reference, parameter *out);

/* The number of a key's choice, from 1; 0: it is none. */
int rv_fmu_choice_number(int key, const char *word);

/* From rv_fmu_variables.f90. */
int rv_fmu_is_output(int model, int which);
int rv_fmu_is_parameter(int key, int model, int kind);
void rv_fmu_choice(int key, int number, char *buffer, size_t size);
#endif

#endif
