/* Tests in C: each is a function named by the property that it shows; a program takes the name of one, or runs all. */
#ifndef APLOMB_TESTS_CAPI_EXPECT_H
#define APLOMB_TESTS_CAPI_EXPECT_H

#include <stdio.h>
#include <string.h>

#include "aplomb.h"

static int failures;

#define EXPECT(condition) \
  ((condition) ? (void)0 : (void)(++failures, fprintf(stderr, "%s:%d: %s\n", __func__, __LINE__, #condition)))

/* A call's status, checked against what is expected of it, with what it says where that is another. */
static inline aplomb_status run(aplomb_status (*call)(const aplomb_mesh*, const char*, const aplomb_listener*,
                                                      aplomb_result**),
                                const aplomb_mesh* mesh, const char* job, const char* said) {
  aplomb_result* result = NULL;
  const aplomb_status status = call(mesh, job, NULL, &result);
  EXPECT(result != NULL);
  if (said && !strstr(aplomb_result_message(result), said)) {
    ++failures;
    fprintf(stderr, "expected '%s', was told '%s'\n", said, aplomb_result_message(result));
  }
  aplomb_result_free(result);
  return status;
}

#define TEST(name) \
  { #name, name }

typedef struct named_test {
  const char* name;
  void (*run)(void);
} named_test;

static int run_tests(int argc, char** argv, const named_test* tests, size_t count) {
  size_t i, ran = 0;
  for (i = 0; i < count; ++i)
    if (argc < 2 || strcmp(argv[1], tests[i].name) == 0) {
      const int before = failures;
      tests[i].run();
      ++ran;
      printf("%s %s\n", failures == before ? "ok  " : "FAIL", tests[i].name);
    }
  return failures > 0 || ran == 0;
}

#endif
