/* FMI 3.0: the state of an instance, which is kept in the form in which it is serialised: a head, the parameters as
 * words, and the valve's own state. Of this kind of machine only, as that is. */
#include "rv_fmu.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
  char mark[8];
  uint64_t settings; /* of the FMU */
  uint64_t size;     /* of all [byte] */
  uint64_t checksum; /* of what follows it */
  double start, time, stop, input[n_inputs], output[n_outputs];
  int64_t mode, is_ready;
  uint64_t words;    /* bytes of parameters */
} head;

static const char mark[8] = "rvfmu 1";
static const char no_state[] = "this is no state of this instance";

static uint64_t checksum_of(const unsigned char *bytes, size_t size) {
  const size_t first = offsetof(head, start);
  return rv_fmu_hash(bytes + first, size - first);
}

/* The next parameter from reference `r` on, and its word; empty: it was not set and follows others. */
static bool next_word(instance *self, fmi3ValueReference *r, parameter *found, char *word) {
  for (; *r < first_parameter + (unsigned)rv_key_count(); ++*r) {
    if (!rv_fmu_parameter(self, *r, found)) continue;
    rv_valve_get_text(self->valve, found->name, word, longest_word);
    ++*r;
    return true;
  }
  return false;
}

/* All words with their NULs; with `to` NULL only their length. */
static size_t put_words(instance *self, unsigned char *to) {
  fmi3ValueReference r = first_parameter;
  parameter found;
  char word[longest_word];
  size_t used = 0;
  while (next_word(self, &r, &found, word)) {
    size_t n = strlen(word) + 1;
    if (to != NULL) memcpy(to + used, word, n);
    used += n;
  }
  return used;
}

static size_t count_parameters(instance *self) {
  fmi3ValueReference r = first_parameter;
  parameter found;
  char word[longest_word];
  size_t n = 0;
  while (next_word(self, &r, &found, word)) n++;
  return n;
}

/* The head goes in front when all else is there. */
static void put_head(const instance *self, head *top, fmu_state *state) {
  memcpy(top->mark, mark, sizeof mark);
  top->settings = self->settings;
  top->size = state->size;
  top->start = self->start;
  top->time = self->time;
  top->stop = self->stop;
  memcpy(top->input, self->input, sizeof top->input);
  memcpy(top->output, self->output, sizeof top->output);
  top->mode = self->mode;
  top->is_ready = self->is_ready;
  memcpy(state->bytes, top, sizeof *top);
  top->checksum = checksum_of(state->bytes, state->size);
  memcpy(state->bytes, top, sizeof *top);
}

static fmu_state *new_state(instance *self, size_t size) {
  fmu_state *state = malloc(sizeof *state + size);
  if (state == NULL) return NULL;
  state->size = size;
  state->next = self->states;
  self->states = state;
  return state;
}

static fmu_state *find(const instance *self, const void *pointer) {
  fmu_state *state = self->states;
  while (state != NULL && state != pointer) state = state->next;
  return state;
}

static void drop(instance *self, fmu_state *state) {
  fmu_state **place = &self->states;
  while (*place != NULL && *place != state) place = &(*place)->next;
  if (*place == NULL) return;
  *place = state->next;
  free(state);
}

/* An instance and a state of it. */
static instance *enter(fmi3Instance pointer, const char *function, const void *state) {
  instance *self = rv_fmu_enter(pointer, function, anywhere);
  if (self == NULL || find(self, state) != NULL) return self;
  rv_fmu_fail(self, function, "%s", no_state);
  return NULL;
}

fmi3Status fmi3GetFMUState(fmi3Instance pointer, fmi3FMUState *out) {
  instance *self = rv_fmu_enter(pointer, __func__, anywhere);
  head top = {.start = 0};
  size_t valve_size = 0;
  fmu_state *state;
  if (self == NULL) return fmi3Error;
  if (out == NULL) return rv_fmu_fail(self, __func__, "a pointer is NULL");
  if (*out != NULL && find(self, *out) == NULL) return rv_fmu_fail(self, __func__, "%s", no_state);
  if (self->is_ready && rv_valve_state_size(self->valve, &valve_size) != RV_OK) return rv_fmu_fail_valve(self, __func__);
  top.words = put_words(self, NULL);
  state = new_state(self, sizeof top + top.words + valve_size);
  if (state == NULL) return rv_fmu_fail(self, __func__, "there is no memory left");
  put_words(self, state->bytes + sizeof top);
  if (self->is_ready && rv_valve_state_save(self->valve, state->bytes + sizeof top + top.words, valve_size) != RV_OK) {
    drop(self, state);
    return rv_fmu_fail_valve(self, __func__);
  }
  put_head(self, &top, state);
  drop(self, *out);
  *out = state;
  return fmi3OK;
}

/* Parameters as they were: those that differ are set, in a valve that is opened anew, for some may have been without a
 * value. */
static bool restore_words(instance *self, const char *function, const unsigned char *words, size_t size) {
  unsigned char *now = malloc(size + 1);
  fmi3ValueReference r = first_parameter;
  parameter found;
  char word[longest_word];
  bool is_same;
  if (now == NULL) {
    rv_fmu_fail(self, function, "there is no memory left");
    return false;
  }
  is_same = put_words(self, NULL) == size && put_words(self, now) == size && memcmp(now, words, size) == 0;
  free(now);
  if (is_same) return true;
  if (!rv_fmu_open_valve(self, function)) return false;
  while (next_word(self, &r, &found, word)) {
    const char *wanted = (const char *)words;
    if (strcmp(word, wanted) != 0 && rv_valve_set_text(self->valve, found.name, wanted) != RV_OK) {
      rv_fmu_fail_valve(self, function);
      return false;
    }
    words += strlen(wanted) + 1;
  }
  return true;
}

static bool restore_valve(instance *self, const head *top, const unsigned char *bytes, size_t size) {
  if (!top->is_ready) return true;
  if (!self->is_ready && rv_valve_begin(self->valve, top->start) != RV_OK) return false;
  return rv_valve_state_restore(self->valve, bytes, size) == RV_OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance pointer, fmi3FMUState state) {
  instance *self = enter(pointer, __func__, state);
  const unsigned char *bytes;
  head top;
  if (self == NULL) return fmi3Error;
  bytes = ((fmu_state *)state)->bytes;
  memcpy(&top, bytes, sizeof top);
  bytes += sizeof top;
  if (!restore_words(self, __func__, bytes, top.words)) return fmi3Error;
  if (!restore_valve(self, &top, bytes + top.words, top.size - sizeof top - top.words)) {
    self->is_ready = false;
    return rv_fmu_fail_valve(self, __func__);
  }
  self->start = top.start;
  self->time = top.time;
  self->stop = top.stop;
  memcpy(self->input, top.input, sizeof top.input);
  memcpy(self->output, top.output, sizeof top.output);
  self->mode = (int)top.mode;
  self->is_ready = top.is_ready;
  return fmi3OK;
}

fmi3Status fmi3FreeFMUState(fmi3Instance pointer, fmi3FMUState *state) {
  instance *self = rv_fmu_enter(pointer, __func__, anywhere);
  if (self == NULL) return fmi3Error;
  if (state == NULL || *state == NULL) return fmi3OK;
  if (find(self, *state) == NULL) return rv_fmu_fail(self, __func__, "%s", no_state);
  drop(self, *state);
  *state = NULL;
  return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance pointer, fmi3FMUState state, size_t *size) {
  instance *self = enter(pointer, __func__, state);
  if (self == NULL) return fmi3Error;
  if (size == NULL) return rv_fmu_fail(self, __func__, "a pointer is NULL");
  *size = ((fmu_state *)state)->size;
  return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance pointer, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
  instance *self = enter(pointer, __func__, state);
  if (self == NULL) return fmi3Error;
  if (bytes == NULL) return rv_fmu_fail(self, __func__, "a pointer is NULL");
  if (size < ((fmu_state *)state)->size) return rv_fmu_fail(self, __func__, "%zu bytes are too few", size);
  memcpy(bytes, ((fmu_state *)state)->bytes, ((fmu_state *)state)->size);
  return fmi3OK;
}

/* Whether bytes are those of a state of this FMU, undamaged. */
static bool is_state(instance *self, const unsigned char *bytes, size_t size) {
  head top;
  size_t n = 0;
  if (size < sizeof top) return false;
  memcpy(&top, bytes, sizeof top);
  if (memcmp(top.mark, mark, sizeof mark) != 0 || top.settings != self->settings || top.size != size) return false;
  if (top.checksum != checksum_of(bytes, size) || top.words > size - sizeof top) return false;
  for (size_t i = 0; i < top.words; i++) n += bytes[sizeof top + i] == '\0';
  return n == count_parameters(self) && (top.words == 0 || bytes[sizeof top + top.words - 1] == '\0');
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance pointer, const fmi3Byte bytes[], size_t size, fmi3FMUState *out) {
  instance *self = rv_fmu_enter(pointer, __func__, anywhere);
  fmu_state *state;
  if (self == NULL) return fmi3Error;
  if (bytes == NULL || out == NULL) return rv_fmu_fail(self, __func__, "a pointer is NULL");
  if (!is_state(self, bytes, size)) return rv_fmu_fail(self, __func__, "these bytes are no state of this FMU, or are damaged");
  state = new_state(self, size);
  if (state == NULL) return rv_fmu_fail(self, __func__, "there is no memory left");
  memcpy(state->bytes, bytes, size);
  *out = state;
  return fmi3OK;
}
