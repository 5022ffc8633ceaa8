/* tests/endurance/kill_when_placed.c
 * Preloaded before a tool (LD_PRELOAD): kills it right after it has renamed a file to the name
 * KILL_WHEN_PLACED (without folder). */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

int rename(const char* from, const char* to) {
  int (*real)(const char*, const char*) = (int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename");
  const int result = real(from, to);
  const char* name = getenv("KILL_WHEN_PLACED");
  const char* slash = strrchr(to, '/');
  if (result == 0 && name && strcmp(slash ? slash + 1 : to, name) == 0) raise(SIGKILL);
  return result;
}
