/* tests/tools/log_reads.c
 * Preloaded before a tool (LD_PRELOAD): appends the name of every file that it opens to the file
 * LOG_READS. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Only opened files; the log itself is written without the functions below. */
static void note(const char* path, int opened) {
  int (*real)(const char*, int, ...) = (int (*)(const char*, int, ...))dlsym(RTLD_NEXT, "open");
  const char* log = getenv("LOG_READS");
  if (!opened || !log) return;
  const int to = real(log, O_WRONLY | O_APPEND | O_CREAT, 0644);
  if (to < 0) return;
  if (write(to, path, strlen(path)) < 0 || write(to, "\n", 1) < 0) abort();
  close(to);
}

#define OPEN(name)                                                                        \
  int name(const char* path, int flags, ...) {                                            \
    va_list more;                                                                         \
    va_start(more, flags);                                                                \
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;  \
    va_end(more);                                                                         \
    const int file = ((int (*)(const char*, int, ...))dlsym(RTLD_NEXT, #name))(path, flags, mode); \
    note(path, file >= 0);                                                                \
    return file;                                                                          \
  }
OPEN(open)
OPEN(open64)

#define FOPEN(name)                                                                                 \
  FILE* name(const char* path, const char* mode) {                                                  \
    FILE* file = ((FILE * (*)(const char*, const char*)) dlsym(RTLD_NEXT, #name))(path, mode);      \
    note(path, file != NULL);                                                                       \
    return file;                                                                                    \
  }
FOPEN(fopen)
FOPEN(fopen64)
