/* What packing an FMU needs of the system: where the FMU library lies, the run-time libraries of the compiler, and a ZIP
 * archive. Texts that do not fit are cut; names so long do not open. */
#define _GNU_SOURCE
#include <link.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zip.h>

int rv_fmu_folder(char *path, size_t size);
void rv_fmu_platform(char *name, size_t size);
int rv_fmu_loaded_library(const char *prefix, char *path, size_t size);
int rv_fmu_archive(int n, const char *const *name, const void *const *data, const size_t *size, void **bytes,
                   size_t *length);
void rv_fmu_release(void *bytes);

/* Folder of what goes into every FMU, with a / at its end: below the program in a build tree, or beside that of MPI,
 * else where the installation has it. 0: it is there. */
int rv_fmu_folder(char *path, size_t size) {
  static const char *const place[] = {"fmu/", "../reedvalve/fmu/", RV_FMU_PLACE};
  char program[4096];
  ssize_t n = readlink("/proc/self/exe", program, sizeof program - 1);
  path[0] = '\0';
  if (n <= 0) return -1;
  program[n] = '\0';
  strrchr(program, '/')[1] = '\0';
  for (size_t i = 0; i < sizeof place / sizeof *place; i++) {
    snprintf(path, size, "%s%s", program, place[i]);
    if (access(path, F_OK) == 0) return 0;
  }
  return -1;
}

/* As FMI 3.0 names it. */
void rv_fmu_platform(char *name, size_t size) {
  snprintf(name, size, "%s", RV_FMU_PLATFORM);
}

typedef struct {
  const char *prefix;
  char *path;
  size_t size;
} search;

static int look_at(struct dl_phdr_info *info, size_t size, void *data) {
  search *self = data;
  const char *name = strrchr(info->dlpi_name, '/');
  (void)size;
  if (name == NULL || strncmp(name + 1, self->prefix, strlen(self->prefix)) != 0) return 0;
  snprintf(self->path, self->size, "%s", info->dlpi_name);
  return 1;
}

/* Path of the library of this program whose file name begins so; empty if there is none. */
int rv_fmu_loaded_library(const char *prefix, char *path, size_t size) {
  search self = {prefix, path, size};
  path[0] = '\0';
  return dl_iterate_phdr(look_at, &self);
}

enum { effort = 6 }; /* of 9, in a third of the time, for a hundredth of the size */

static const zip_uint32_t mode = 0100644u << 16; /* a file that all may read and its owner may write; unset, it is 0666 */

/* One date for all entries makes equal archives of equal contents. */
static int add(zip_t *archive, const char *name, const void *data, size_t size) {
  zip_source_t *source = zip_source_buffer(archive, data, size, 0);
  zip_int64_t place;
  if (source == NULL) return -1;
  place = zip_file_add(archive, name, source, ZIP_FL_ENC_UTF_8);
  if (place < 0) {
    zip_source_free(source);
    return -1;
  }
  if (zip_set_file_compression(archive, (zip_uint64_t)place, ZIP_CM_DEFLATE, effort) != 0) return -1;
  if (zip_file_set_external_attributes(archive, (zip_uint64_t)place, 0, ZIP_OPSYS_UNIX, mode) != 0) return -1;
  return zip_file_set_dostime(archive, (zip_uint64_t)place, 0, (1 << 5) | 1, 0); /* 1 January 1980 */
}

static int take_bytes(zip_source_t *source, void **bytes, size_t *length) {
  zip_stat_t about;
  int done = -1;
  if (zip_source_open(source) != 0) return -1;
  if (zip_source_stat(source, &about) == 0 && (about.valid & ZIP_STAT_SIZE)) {
    *length = about.size;
    *bytes = malloc(about.size);
    if (*bytes != NULL && zip_source_read(source, *bytes, about.size) == (zip_int64_t)about.size) done = 0;
  }
  zip_source_close(source);
  return done;
}

/* A ZIP archive of n entries, in this order, in memory that rv_fmu_release gives back. 0: done. */
int rv_fmu_archive(int n, const char *const *name, const void *const *data, const size_t *size, void **bytes,
                   size_t *length) {
  zip_source_t *source = zip_source_buffer_create(NULL, 0, 0, NULL);
  zip_t *archive = source == NULL ? NULL : zip_open_from_source(source, ZIP_TRUNCATE, NULL);
  int failed = archive == NULL;
  *bytes = NULL;
  *length = 0;
  if (archive != NULL) {
    zip_source_keep(source); /* closing the archive would take it along */
    for (int i = 0; i < n && !failed; i++) failed = add(archive, name[i], data[i], size[i]);
    if (failed || zip_close(archive) != 0) {
      zip_discard(archive);
      failed = 1;
    }
  }
  if (!failed) failed = take_bytes(source, bytes, length);
  if (source != NULL) zip_source_free(source);
  return failed;
}

void rv_fmu_release(void *bytes) {
  free(bytes);
}
