/* tests/endurance/failing_write.c
 * Preloaded before a tool (LD_PRELOAD): lets FAIL_AFTER writes to regular files pass, then fails the
 * next FAIL_COUNT ones (0: all that follow) with FAIL_ERRNO. Counts write, pwrite, writev and fwrite,
 * whatever library calls them; the number of calls goes to the file FAIL_REPORT when the tool ends. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

static long n_writes;

static long number(const char* name, long otherwise) {
  const char* text = getenv(name);
  return text ? atol(text) : otherwise;
}

static int fails(int file) {
  struct stat about;
  const long after = number("FAIL_AFTER", -1), count = number("FAIL_COUNT", 1);
  if (fstat(file, &about) != 0 || !S_ISREG(about.st_mode)) return 0;
  const long now = __sync_fetch_and_add(&n_writes, 1);
  if (after < 0 || now < after || (count > 0 && now >= after + count)) return 0;
  errno = (int)number("FAIL_ERRNO", EIO);
  return 1;
}

#define REAL(type, name, ...)                       \
  static type (*real)(__VA_ARGS__);                 \
  if (!real) real = (type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, name)

ssize_t write(int file, const void* bytes, size_t size) {
  REAL(ssize_t, "write", int, const void*, size_t);
  return fails(file) ? -1 : real(file, bytes, size);
}

ssize_t writev(int file, const struct iovec* parts, int n) {
  REAL(ssize_t, "writev", int, const struct iovec*, int);
  return fails(file) ? -1 : real(file, parts, n);
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  REAL(ssize_t, "pwrite", int, const void*, size_t, off_t);
  return fails(file) ? -1 : real(file, bytes, size, at);
}

ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t at) {
  REAL(ssize_t, "pwrite64", int, const void*, size_t, off64_t);
  return fails(file) ? -1 : real(file, bytes, size, at);
}

size_t fwrite(const void* items, size_t size, size_t n, FILE* file) {
  REAL(size_t, "fwrite", const void*, size_t, size_t, FILE*);
  return fails(fileno(file)) ? 0 : real(items, size, n, file);
}

__attribute__((destructor)) static void report(void) {
  const char* path = getenv("FAIL_REPORT");
  FILE* file = path ? fopen(path, "w") : NULL;
  if (!file) return;
  fprintf(file, "%ld\n", n_writes);
  fclose(file);
}
