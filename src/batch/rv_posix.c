/* The few things of the operating system that Fortran 2008 cannot say: folders, renames, fsync, locks,
 * signals, clocks. Every function that can fail returns 0 or an errno; nothing exits, and nothing
 * prints but the notice of a signal, in the words of the program that asked for it. */
#define _GNU_SOURCE

#include "rv_posix.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <time.h>
#include <unistd.h>

/* A large write is cut so that no single call passes what Linux takes at once. */
#define LARGEST_CALL ((size_t)1 << 30)

static volatile sig_atomic_t signals_seen = 0;
static char signal_notice[256];

static void note_signal(int number)
{
   int kept = errno;

   (void)number;
   if (!signals_seen) (void)!write(STDERR_FILENO, signal_notice, strlen(signal_notice));
   signals_seen = 1;
   errno = kept;
}

/* SIGINT, SIGTERM, SIGUSR1 and SIGHUP are noted once; a second one has its usual effect, so nobody is locked in.
 * Schedulers announce the end of a job's time with SIGUSR1, and mpirun passes that one on where it makes an end of the
 * others. SIGHUP comes when a connection is lost; under nohup it is ignored, and stays so. A file that may grow no more
 * (ulimit -f) is an error of the write, as a full disk is, and no reason to die.
 * `notice` is what the program wants to be told at once on standard error; it may be empty. */
int rv_posix_catch_signals(const char *notice)
{
   static const int stopping[] = {SIGINT, SIGTERM, SIGUSR1, SIGHUP};
   struct sigaction action, before;

   snprintf(signal_notice, sizeof signal_notice, "%s", notice);
   memset(&action, 0, sizeof action);
   action.sa_handler = note_signal;
   action.sa_flags = (int)(SA_RESTART | SA_RESETHAND);
   sigemptyset(&action.sa_mask);
   for (size_t i = 0; i < sizeof stopping / sizeof *stopping; i++) {
      if (stopping[i] == SIGHUP) {
         if (sigaction(SIGHUP, NULL, &before) != 0) return errno;
         if (before.sa_handler == SIG_IGN) continue;
      }
      if (sigaction(stopping[i], &action, NULL) != 0) return errno;
   }
   action.sa_handler = SIG_IGN;
   action.sa_flags = 0;
   return sigaction(SIGXFSZ, &action, NULL) == 0 ? 0 : errno;
}

int rv_posix_signal_seen(void)
{
   return signals_seen != 0;
}

void rv_posix_reason(int number, char *buffer, size_t size)
{
   char room[256];

   /* the GNU kind, which may point to its own text */
   snprintf(buffer, size, "%s", strerror_r(number, room, sizeof room));
}

int rv_posix_make_folder(const char *path)
{
   return mkdir(path, 0777) == 0 ? 0 : errno;
}

int rv_posix_remove_folder(const char *path)
{
   return rmdir(path) == 0 ? 0 : errno;
}

int rv_posix_remove_file(const char *path)
{
   return unlink(path) == 0 ? 0 : errno;
}

int rv_posix_rename(const char *from, const char *to)
{
   return rename(from, to) == 0 ? 0 : errno;
}

/* Gives a file a second name unless something has that name: then `taken` is 1. */
int rv_posix_link(const char *from, const char *to, int *taken)
{
   *taken = 0;
   if (link(from, to) == 0) return 0;
   *taken = errno == EEXIST;
   return *taken ? 0 : errno;
}

/* kind: 0 nothing there, 1 file, 2 folder, 3 something else */
int rv_posix_kind(const char *path, int *kind, int64_t *size)
{
   struct stat facts;

   *kind = 0;
   *size = 0;
   if (stat(path, &facts) != 0) return errno == ENOENT || errno == ENOTDIR ? 0 : errno;
   *kind = S_ISREG(facts.st_mode) ? 1 : S_ISDIR(facts.st_mode) ? 2 : 3;
   *size = (int64_t)facts.st_size;
   return 0;
}

int rv_posix_free_bytes(const char *path, int64_t *bytes)
{
   struct statvfs facts;

   *bytes = 0;
   if (statvfs(path, &facts) != 0) return errno;
   *bytes = (int64_t)facts.f_bavail * (int64_t)facts.f_frsize;
   return 0;
}

/* Is there room for a file of so many bytes? Says so by taking and giving back the room: that asks quotas too. */
int rv_posix_reserve(const char *path, int64_t bytes)
{
   int failure = 0;
   int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);

   if (fd < 0) return errno;
   if (fallocate(fd, 0, 0, (off_t)bytes) != 0) failure = errno;
   close(fd);
   unlink(path);
   /* other failures: this file system cannot say beforehand */
   return failure == ENOSPC || failure == EDQUOT || failure == EFBIG ? failure : 0;
}

/* A rename is safe on disk only when the folder that holds the name is. */
int rv_posix_sync_folder(const char *path)
{
   int failure = 0;
   int fd = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);

   if (fd < 0) return errno;
   /* EINVAL: a file system without fsync of folders, where nothing more can be done */
   if (fsync(fd) != 0 && errno != EINVAL) failure = errno;
   close(fd);
   return failure;
}

/* mode: 0 read, 1 create or empty, 2 append */
int rv_posix_open(const char *path, int mode, int *fd)
{
   static const int flags[] = {O_RDONLY, O_WRONLY | O_CREAT | O_TRUNC, O_WRONLY | O_CREAT | O_APPEND};

   *fd = open(path, flags[mode] | O_CLOEXEC, 0666);
   return *fd < 0 ? errno : 0;
}

int rv_posix_write(int fd, const void *data, size_t size)
{
   const char *next = data;

   while (size > 0) {
      ssize_t done = write(fd, next, size < LARGEST_CALL ? size : LARGEST_CALL);
      if (done < 0) {
         if (errno == EINTR) continue;
         return errno;
      }
      next += done;
      size -= (size_t)done;
   }
   return 0;
}

/* got < size only at the end of the file */
int rv_posix_read(int fd, void *data, size_t size, size_t *got)
{
   char *next = data;

   *got = 0;
   while (*got < size) {
      size_t left = size - *got;
      ssize_t done = read(fd, next + *got, left < LARGEST_CALL ? left : LARGEST_CALL);
      if (done < 0) {
         if (errno == EINTR) continue;
         return errno;
      }
      if (done == 0) return 0;
      *got += (size_t)done;
   }
   return 0;
}

int rv_posix_sync(int fd)
{
   /* EINVAL, ENOTSUP: pipes and devices, which have nothing to bring to a disk */
   if (fsync(fd) == 0 || errno == EINVAL || errno == ENOTSUP) return 0;
   return errno;
}

/* Have what is written on its way to the disk, and do not wait: a later sync finds little left to do. */
void rv_posix_start_sync(int fd)
{
#ifdef SYNC_FILE_RANGE_WRITE
   (void)sync_file_range(fd, 0, 0, SYNC_FILE_RANGE_WRITE);
#else
   (void)fd;
#endif
}

int rv_posix_close(int fd)
{
   return close(fd) == 0 ? 0 : errno;
}

/* 0 when we have the lock, else an errno. A lock that many may hold is asked for a little longer: whoever ends takes it
 * alone for a moment, to see whether others are left (rv_posix_unlock). */
static int take_lock(int fd, int shared)
{
   int tries = shared ? 50 : 1;

   while (flock(fd, (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) != 0) {
      if (errno == EINTR) continue;
      if (errno != EWOULDBLOCK || --tries == 0) return errno;
      rv_posix_nap(0.01);
   }
   return 0;
}

/* Is `path` still the name of this open file? */
static int is_named(int fd, const char *path)
{
   struct stat held, named;

   return fstat(fd, &held) == 0 && stat(path, &named) == 0 && held.st_ino == named.st_ino &&
          held.st_dev == named.st_dev;
}

/* state: 0 ours, 1 another process holds it, 2 this file system has no locks.
 * A shared lock is ours together with others that asked for a shared one.
 * The last holder removes the file when it ends: a lock on a file that is no longer there is taken anew.
 * `holder` goes into the file, for the message of whoever is refused. */
int rv_posix_lock(const char *path, const char *holder, int shared, int *fd, int *state)
{
   for (;;) {
      int failure;

      *state = 0;
      *fd = open(path, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
      if (*fd < 0) return errno;
      failure = take_lock(*fd, shared);
      if (failure == EWOULDBLOCK) {
         *state = 1;
         close(*fd);
         return 0;
      }
      if (failure == ENOLCK || failure == ENOSYS || failure == EOPNOTSUPP) {
         *state = 2;
         return 0;
      }
      if (failure != 0) {
         close(*fd);
         return failure;
      }
      if (is_named(*fd, path)) {
         /* without a name in it the lock is as good: a full disk is no reason to fail here */
         if (shared || ftruncate(*fd, 0) == 0) (void)!write(*fd, holder, strlen(holder));
         return 0;
      }
      close(*fd);
   }
}

/* Ends a lock; its file goes with the last holder. */
void rv_posix_unlock(const char *path, int fd)
{
   if ((flock(fd, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) && is_named(fd, path)) unlink(path);
   close(fd);
}

int rv_posix_list_open(const char *path, void **list)
{
   *list = opendir(path);
   return *list == NULL ? errno : 0;
}

/* 1 and a name, or 0 at the end; "." and ".." are left out */
int rv_posix_list_next(void *list, char *name, size_t size)
{
   struct dirent *entry;

   while ((entry = readdir(list)) != NULL) {
      if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
      snprintf(name, size, "%s", entry->d_name);
      return 1;
   }
   return 0;
}

void rv_posix_list_close(void *list)
{
   closedir(list);
}

/* A program started with one of 0, 1, 2 closed would get that number for its next file, and then print into it. */
void rv_posix_keep_standard_files(void)
{
   int fd;

   do fd = open("/dev/null", O_RDWR);
   while (fd >= 0 && fd <= STDERR_FILENO);
   if (fd >= 0) close(fd);
}

int rv_posix_is_terminal(int fd)
{
   return isatty(fd) == 1;
}

/* columns of the terminal, 0 when it has none */
int rv_posix_terminal_width(int fd)
{
   struct winsize window;

   return ioctl(fd, TIOCGWINSZ, &window) == 0 ? window.ws_col : 0;
}

double rv_posix_seconds(void)
{
   struct timespec now;

   clock_gettime(CLOCK_MONOTONIC, &now);
   return (double)now.tv_sec + 1.0e-9 * (double)now.tv_nsec;
}

void rv_posix_nap(double seconds)
{
   struct timespec rest = {(time_t)seconds, (long)(1.0e9 * (seconds - (double)(time_t)seconds))};

   nanosleep(&rest, NULL);
}

/* ISO 8601 in UTC */
void rv_posix_date(char *buffer, size_t size)
{
   struct tm parts;
   time_t now = time(NULL);

   if (gmtime_r(&now, &parts) == NULL || strftime(buffer, size, "%Y-%m-%dT%H:%M:%SZ", &parts) == 0)
      snprintf(buffer, size, "unknown");
}

void rv_posix_host(char *buffer, size_t size)
{
   if (gethostname(buffer, size) != 0) snprintf(buffer, size, "unknown");
   buffer[size - 1] = '\0';
}

int rv_posix_process(void)
{
   return (int)getpid();
}

/* Tells this process from those of other hosts, too: the process number behind a hash (FNV-1a) of the host's name. */
int64_t rv_posix_process_mark(void)
{
   char host[256];
   uint32_t hash = 2166136261u;

   rv_posix_host(host, sizeof host);
   for (const char *next = host; *next != '\0'; next++) hash = (hash ^ (unsigned char)*next) * 16777619u;
   return (int64_t)(((uint64_t)hash << 32) | (uint32_t)getpid());
}

/* Process or host of the mark of a process. */
static uint32_t half_of(int64_t mark, int upper)
{
   return (uint32_t)((uint64_t)mark >> (upper ? 32 : 0));
}

int rv_posix_is_neighbour(int64_t mark)
{
   return half_of(mark, 1) == half_of(rv_posix_process_mark(), 1);
}

/* Has this process of this host ended? It may not have been waited for, which only Linux tells. */
int rv_posix_is_gone(int64_t mark)
{
   char path[40], text[512], *state;
   FILE *file;
   size_t got;
   pid_t process = (pid_t)half_of(mark, 0);

   if (kill(process, 0) != 0) return errno == ESRCH;
   snprintf(path, sizeof path, "/proc/%ld/stat", (long)process);
   file = fopen(path, "r");
   if (file == NULL) return 0;
   got = fread(text, 1, sizeof text - 1, file);
   fclose(file);
   text[got] = '\0';
   state = strrchr(text, ')');   /* behind the program's name */
   return state != NULL && (strncmp(state, ") Z", 3) == 0 || strncmp(state, ") X", 3) == 0);
}
