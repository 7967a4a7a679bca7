/* Preloaded, it holds up whoever starts a thread for a fifth of a second: as a busy machine may, now and then. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <pthread.h>
#include <unistd.h>

typedef int creates_thread(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*), void* argument) {
  creates_thread* real = (creates_thread*)dlsym(RTLD_NEXT, "pthread_create");
  const int failed = real(thread, attributes, start, argument);
  usleep(200000);
  return failed;
}
