/* The functions of rv_posix.c; rv_posix.f90 and rv_file.f90 bind to them. */
#ifndef RV_POSIX_H
#define RV_POSIX_H

#include <stddef.h>
#include <stdint.h>

int rv_posix_catch_signals(const char *notice);
int rv_posix_signal_seen(void);
void rv_posix_reason(int number, char *buffer, size_t size);
int rv_posix_make_folder(const char *path);
int rv_posix_remove_folder(const char *path);
int rv_posix_remove_file(const char *path);
int rv_posix_rename(const char *from, const char *to);
int rv_posix_link(const char *from, const char *to, int *taken);
int rv_posix_kind(const char *path, int *kind, int64_t *size);
int rv_posix_free_bytes(const char *path, int64_t *bytes);
int rv_posix_reserve(const char *path, int64_t bytes);
int rv_posix_sync_folder(const char *path);
int rv_posix_open(const char *path, int mode, int *fd);
int rv_posix_write(int fd, const void *data, size_t size);
int rv_posix_read(int fd, void *data, size_t size, size_t *got);
int rv_posix_sync(int fd);
void rv_posix_start_sync(int fd);
int rv_posix_close(int fd);
int rv_posix_lock(const char *path, const char *holder, int shared, int *fd, int *state);
void rv_posix_unlock(const char *path, int fd);
int rv_posix_list_open(const char *path, void **list);
int rv_posix_list_next(void *list, char *name, size_t size);
void rv_posix_list_close(void *list);
void rv_posix_keep_standard_files(void);
int rv_posix_is_terminal(int fd);
int rv_posix_terminal_width(int fd);
double rv_posix_seconds(void);
void rv_posix_nap(double seconds);
void rv_posix_date(char *buffer, size_t size);
void rv_posix_host(char *buffer, size_t size);
int rv_posix_process(void);
int64_t rv_posix_process_mark(void);
int rv_posix_is_neighbour(int64_t mark);
int rv_posix_is_gone(int64_t mark);

#endif
