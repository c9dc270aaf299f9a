/* Instances: which there are, what they tell, and the valve inside. */
#define _GNU_SOURCE /* strdup */
#include "rv_fmu.h"

#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static instance *instances; /* all there are: a pointer that is not among them is not followed */

static bool is_instance(const void *pointer) {
  const instance *self;
  pthread_mutex_lock(&lock);
  for (self = instances; self != NULL && self != pointer; self = self->next) continue;
  pthread_mutex_unlock(&lock);
  return self != NULL;
}

/* FMI takes #12# for the name of variable 12, and ## for #. FMI 2.0 makes a format of it, and tells the name itself. */
static void tell(instance *self, fmi3Status status, const char *category, const char *function, const char *message) {
  const bool is_2 = self->log2 != NULL;
  char line[4096], text[2 * sizeof line];
  size_t n = 0;
  if (is_2)
    snprintf(line, sizeof line, "%s: %s", self->called, message);
  else
    snprintf(line, sizeof line, "%s: %s: %s", self->name, function, message);
  for (const char *c = line; *c != '\0' && n < sizeof text - 3; c++) {
    text[n++] = *c;
    if (*c == '#' || (is_2 && *c == '%')) text[n++] = *c;
  }
  while (n > 0 && text[n - 1] == '\n') n--;
  text[n] = '\0';
  if (is_2)
    self->log2(self->environment, self->name, (fmi2Status)status, category, text);
  else if (self->log != NULL)
    self->log(self->environment, status, category, text);
}

fmi3Status rv_fmu_fail(instance *self, const char *function, const char *format, ...) {
  char message[4096];
  va_list list;
  va_start(list, format);
  vsnprintf(message, sizeof message, format, list);
  va_end(list);
  tell(self, fmi3Error, "logStatusError", function, message);
  self->mode = terminated;
  return fmi3Error;
}

fmi3Status rv_fmu_fail_valve(instance *self, const char *function) {
  char message[2048];
  rv_valve_message(self->valve, message, sizeof message);
  return rv_fmu_fail(self, function, "%s", message);
}

fmi3Status rv_fmu_warn(instance *self, fmi3Status status, const char *function, const char *message) {
  if (self->tells_warnings) tell(self, status, "logStatusWarning", function, message);
  return status;
}

fmi3Status rv_fmu_warn_valve(instance *self, const char *function) {
  char message[2048];
  rv_valve_message(self->valve, message, sizeof message);
  return message[0] == '\0' ? fmi3OK : rv_fmu_warn(self, fmi3Warning, function, message);
}

instance *rv_fmu_enter(fmi3Instance pointer, const char *function, int allowed) {
  static const char *const word[] = {"instantiated", "in initialization mode", "in step mode", "terminated"};
  instance *self = pointer;
  int i = 0;
  if (!is_instance(pointer)) return NULL;
  if (self->mode & allowed) return self;
  while (!(self->mode & (1 << i))) i++;
  rv_fmu_fail(self, function, "it is not allowed while the instance is %s", word[i]);
  return NULL;
}

/* ---- The valve ---- */

int rv_fmu_choice_number(int key, const char *word) {
  char choice[longest_word];
  int number = 0;
  do rv_fmu_choice(key, ++number, choice, sizeof choice);
  while (choice[0] != '\0' && strcmp(choice, word) != 0);
  return choice[0] == '\0' ? 0 : number;
}

/* The number of the choice that is set. */
static int choice_of(rv_valve *valve, const char *name) {
  char word[longest_word], key[longest_name];
  int i = 0;
  while (rv_key_name(i, key, sizeof key) == RV_OK && strcmp(key, name) != 0) i++;
  rv_valve_get_text(valve, name, word, sizeof word);
  return rv_fmu_choice_number(i, word);
}

bool rv_fmu_open_valve(instance *self, const char *function) {
  char message[2048];
  rv_valve_free(&self->valve);
  self->is_ready = false;
  if (rv_valve_new_deck(self->deck, &self->valve, message, sizeof message) != RV_OK) {
    rv_fmu_fail(self, function, "%s", message);
    return false;
  }
  self->model = choice_of(self->valve, "run.model");
  self->kind = choice_of(self->valve, "pressure.kind");
  return true;
}

void rv_fmu_read_outputs(instance *self) {
  for (int i = 0; i < n_outputs; i++) rv_valve_output(self->valve, i, &self->output[i]);
}

/* Outputs at the start are those after a step so short that nothing moves: forces of a film are known only to a step.
 * The state before it is the one that the simulation goes on from. */
static int look_ahead(instance *self, const void *state, size_t size) {
  const double moment = fmax(1e-9, 1e-13 * fabs(self->start)); /* [s] */
  const double *p = self->input;
  double still[2] = {NAN, NAN};
  int code;
  for (int i = 0; i < 2; i++) rv_valve_output(self->valve, i, &still[i]);
  code = rv_valve_step(self->valve, self->start + moment, p[0], p[0], p[1], p[1]);
  if (code != RV_OK) return code;
  rv_fmu_read_outputs(self);
  for (int i = 0; i < 2; i++) /* of a valve at rest these are known */
    if (!isnan(still[i])) self->output[i] = still[i];
  return rv_valve_state_restore(self->valve, state, size);
}

fmi3Status rv_fmu_begin(instance *self, const char *function) {
  size_t size;
  void *state = NULL;
  fmi3Status status;
  int code;
  if (self->is_ready) return fmi3OK;
  if (rv_valve_begin(self->valve, self->start) != RV_OK) return rv_fmu_fail_valve(self, function);
  status = rv_fmu_warn_valve(self, function);
  code = rv_valve_state_size(self->valve, &size);
  if (code == RV_OK && (state = malloc(size)) == NULL) return rv_fmu_fail(self, function, "there is no memory left");
  if (code == RV_OK) code = rv_valve_state_save(self->valve, state, size);
  if (code == RV_OK) code = look_ahead(self, state, size);
  free(state);
  if (code != RV_OK) return rv_fmu_fail_valve(self, function);
  self->is_ready = true;
  return status;
}

bool rv_fmu_parameter(const instance *self, fmi3ValueReference reference, parameter *out) {
  if (reference < first_parameter || reference - first_parameter >= (unsigned)rv_key_count()) return false;
  out->key = (int)(reference - first_parameter);
  out->kind = rv_key_kind(out->key);
  rv_key_name(out->key, out->name, sizeof out->name);
  return rv_fmu_is_parameter(out->key, self->model, self->kind);
}

/* ---- Beginning and end ---- */

/* `folder`/valve.nml; NULL: there is no memory. */
static char *deck_in(const char *folder) {
  static const char name[] = "/valve.nml";
  size_t n = strlen(folder);
  char *path = malloc(n + sizeof name);
  if (path == NULL) return NULL;
  while (n > 0 && folder[n - 1] == '/') n--;
  memcpy(path, folder, n);
  memcpy(path + n, name, sizeof name);
  return path;
}

/* Whether the model description the caller read is the one that was packed with this deck. */
static bool is_ours(instance *self, const char *function, const char *token) {
  char own[RV_FMU_TOKEN], bytes[16384];
  size_t size;
  FILE *file = fopen(self->deck, "rb");
  if (file == NULL) {
    rv_fmu_fail(self, function, "cannot read '%s' from the FMU's resources", self->deck);
    return false;
  }
  size = fread(bytes, 1, sizeof bytes, file);
  fclose(file);
  self->settings = rv_fmu_hash(bytes, size);
  rv_fmu_token(bytes, size, own);
  if (token != NULL && strcmp(token, own) == 0) return true;
  rv_fmu_fail(self, function, "the instantiation token (guid) is %s, that of this FMU is %s", token == NULL ? "NULL" : token, own);
  return false;
}

static void discard(instance *self) {
  rv_valve_free(&self->valve);
  while (self->states != NULL) {
    fmu_state *next = self->states->next;
    free(self->states);
    self->states = next;
  }
  free(self->name);
  free(self->deck);
  free(self);
}

instance *rv_fmu_new(const instance *given, const char *function, const char *token, const char *resources) {
  instance *self = malloc(sizeof *self);
  if (self == NULL) return NULL;
  *self = *given;
  self->name = strdup(given->name);
  self->deck = resources == NULL || self->name == NULL ? NULL : deck_in(resources);
  self->stop = INFINITY;
  if (self->name == NULL || self->name[strspn(self->name, " \t\n")] == '\0')
    rv_fmu_fail(self, function, "the instance needs a name");
  else if (self->deck == NULL)
    rv_fmu_fail(self, function, "the path of the FMU's resources is missing");
  else if (is_ours(self, function, token) && rv_fmu_open_valve(self, function)) {
    rv_fmu_warn_valve(self, function);
    self->mode = instantiated;
    pthread_mutex_lock(&lock);
    self->next = instances;
    instances = self;
    pthread_mutex_unlock(&lock);
    return self;
  }
  discard(self);
  return NULL;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                         fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference required[], size_t n_required,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback update) {
  instance given = {.name = name == NULL ? (char *)"" : (char *)name, .environment = environment, .log = log,
                    .tells_warnings = logging};
  (void)visible, (void)early_return, (void)required, (void)update;
  if (event_mode)
    rv_fmu_fail(&given, __func__, "this FMU has no event mode");
  else if (n_required > 0)
    rv_fmu_fail(&given, __func__, "this FMU has no intermediate update");
  else
    return rv_fmu_new(&given, __func__, token, resources);
  return NULL;
}

void fmi3FreeInstance(fmi3Instance pointer) {
  instance **place, *self = NULL;
  pthread_mutex_lock(&lock);
  for (place = &instances; *place != NULL && *place != pointer; place = &(*place)->next) continue;
  if (*place != NULL) {
    self = *place;
    *place = self->next;
  }
  pthread_mutex_unlock(&lock);
  if (self != NULL) discard(self);
}
