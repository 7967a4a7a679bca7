/* The C library as a program in C sees it. Each test is a function named by the property that it shows; the program takes
 * the name of one, or runs all. */
#include <math.h>
#include <pthread.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>

#include "shapes.h"

static int failures;

#define EXPECT(condition) \
  ((condition) ? (void)0 : (void)(++failures, fprintf(stderr, "%s:%d: %s\n", __func__, __LINE__, #condition)))

/* A call's status, checked against what is expected of it, with what it says where that is another. */
static aplomb_status run(aplomb_status (*call)(const aplomb_mesh*, const char*, const aplomb_listener*, aplomb_result**),
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

static void structs_have_the_layout_of_abi_version_1(void) {
  EXPECT(aplomb_abi_version() == 1 && APLOMB_ABI_VERSION == 1);
  EXPECT(sizeof(aplomb_mesh) == 48);
  EXPECT(offsetof(aplomb_mesh, struct_size) == 0);
  EXPECT(offsetof(aplomb_mesh, float_vertices) == 8);
  EXPECT(offsetof(aplomb_mesh, double_vertices) == 16);
  EXPECT(offsetof(aplomb_mesh, vertex_count) == 24);
  EXPECT(offsetof(aplomb_mesh, triangles) == 32);
  EXPECT(offsetof(aplomb_mesh, triangle_count) == 40);
  EXPECT(sizeof(aplomb_listener) == 24);
  EXPECT(offsetof(aplomb_listener, progress) == 8 && offsetof(aplomb_listener, user) == 16);
  EXPECT(sizeof(aplomb_status) == 4);
}

static void every_status_has_a_text_of_its_own(void) {
  int a, b;
  for (a = -1; a <= APLOMB_INTERNAL; ++a)
    for (b = a + 1; b <= APLOMB_INTERNAL; ++b) EXPECT(strcmp(aplomb_status_text(a), aplomb_status_text(b)) != 0);
  EXPECT(strlen(aplomb_version()) >= 5);
}

static void a_struct_of_another_size_is_refused(void) {
  leaning_box box;
  aplomb_listener listener = {0};
  aplomb_mesh out = {0};
  aplomb_result* result = NULL;
  make_box(&box, 0);
  box.mesh.struct_size = sizeof box.mesh - 8;
  EXPECT(run(aplomb_check, &box.mesh, NULL, "struct_size is 40") == APLOMB_USAGE);
  box.mesh.struct_size = sizeof box.mesh;
  EXPECT(aplomb_check(&box.mesh, NULL, &listener, NULL) == APLOMB_USAGE);
  listener.struct_size = sizeof listener; /* but without a function */
  EXPECT(aplomb_check(&box.mesh, NULL, &listener, NULL) == APLOMB_USAGE);
  EXPECT(aplomb_check(&box.mesh, NULL, NULL, &result) == APLOMB_STANDS);
  EXPECT(aplomb_result_mesh(result, &out) == APLOMB_USAGE);
  aplomb_result_free(result);
}

static void null_arguments_are_refused_and_never_followed(void) {
  leaning_box box;
  aplomb_mesh out = {0};
  out.struct_size = sizeof out;
  make_box(&box, 0);
  EXPECT(run(aplomb_stand, NULL, NULL, "mesh is null") == APLOMB_USAGE);
  EXPECT(aplomb_stand(NULL, NULL, NULL, NULL) == APLOMB_USAGE);
  EXPECT(aplomb_result_mesh(NULL, &out) == APLOMB_USAGE);
  EXPECT(strlen(aplomb_result_message(NULL)) > 0 && strcmp(aplomb_result_report(NULL), "") == 0);
  aplomb_result_free(NULL);
  box.mesh.float_vertices = NULL;
  EXPECT(run(aplomb_check, &box.mesh, NULL, "exactly one") == APLOMB_USAGE);
  box.mesh.float_vertices = box.vertices;
  box.mesh.double_vertices = box.double_vertices;
  EXPECT(run(aplomb_check, &box.mesh, NULL, "exactly one") == APLOMB_USAGE);
  make_box(&box, 0);
  box.mesh.triangles = NULL;
  EXPECT(run(aplomb_check, &box.mesh, NULL, "triangles is null") == APLOMB_USAGE);
}

static void a_mesh_that_cannot_be_used_is_refused_with_the_place(void) {
  leaning_box box;
  uint32_t wild[36], flat[36];
  int i;
  make_box(&box, 0);
  memcpy(wild, box_triangles, sizeof wild);
  wild[10] = 8;
  box.mesh.triangles = wild;
  EXPECT(run(aplomb_check, &box.mesh, NULL, "triangle 3 (from 0) has the vertex 8") == APLOMB_UNUSABLE_INPUT);
  make_box(&box, 0);
  box.vertices[5] = NAN;
  EXPECT(run(aplomb_check, &box.mesh, NULL, "vertex 1 (from 0)") == APLOMB_UNUSABLE_INPUT);
  make_box(&box, 0);
  for (i = 0; i < 36; ++i) flat[i] = 1;
  box.mesh.triangles = flat;
  EXPECT(run(aplomb_stand, &box.mesh, NULL, NULL) == APLOMB_UNUSABLE_INPUT);
  make_box(&box, 0);
  box.mesh.triangle_count = 0;
  EXPECT(run(aplomb_stand, &box.mesh, NULL, "no triangles") == APLOMB_UNUSABLE_INPUT);
  make_box(&box, 0);
  box.mesh.triangle_count = UINT64_MAX / 16; /* read no further than the count */
  EXPECT(run(aplomb_stand, &box.mesh, NULL, "are the most") == APLOMB_OVER_BUDGET);
}

static void a_job_that_cannot_be_used_is_refused_with_the_place(void) {
  leaning_box box;
  char* deep = malloc(900001);
  make_box(&box, 0);
  EXPECT(run(aplomb_check, &box.mesh, "{\"aplomb_job\": 1", "no JSON") == APLOMB_USAGE);
  EXPECT(run(aplomb_check, &box.mesh, "\xff\xfe garbage", "no JSON") == APLOMB_USAGE);
  EXPECT(run(aplomb_check, &box.mesh, "[1]", NULL) == APLOMB_USAGE);
  EXPECT(run(aplomb_check, &box.mesh, "{}", "aplomb_job") == APLOMB_USAGE);
  EXPECT(run(aplomb_check, &box.mesh, "{\"aplomb_job\": 2}", "aplomb_job") == APLOMB_USAGE);
  EXPECT(run(aplomb_check, &box.mesh, "{\"aplomb_job\": 1, \"wall_mm\": -1}", "wall_mm") == APLOMB_USAGE);
  EXPECT(run(aplomb_check, &box.mesh, "{\"aplomb_job\": 1, \"output\": \"a.stl\"}", "\"output\"") == APLOMB_USAGE);
  if (!deep) return;
  memset(deep, '[', 900000);
  deep[900000] = 0;
  EXPECT(run(aplomb_check, &box.mesh, deep, NULL) == APLOMB_USAGE);
  free(deep);
}

static void a_box_tips_at_the_angle_that_its_shape_gives(void) {
  leaning_box box;
  aplomb_result* result = NULL;
  const char* tip;
  make_box(&box, 0);
  EXPECT(aplomb_check(&box.mesh, "{\"aplomb_job\": 1, \"poses\": [{\"stand\": {\"contact_height_mm\": 0.001}}]}", NULL,
                      &result) == APLOMB_STANDS);
  tip = strstr(aplomb_result_report(result), "\"tip_deg\": ");
  EXPECT(tip && fabs(atof(tip + 11) - atan(14.0 / 30.0) * 180 / acos(-1)) < 1e-3);
  aplomb_result_free(result);
  make_box(&box, 30);
  EXPECT(run(aplomb_check, &box.mesh, NULL, "Falls") == APLOMB_CANNOT_STAND);
}

static void doubles_and_floats_give_the_same_bytes(void) {
  leaning_box box;
  aplomb_result *of_floats = NULL, *of_doubles = NULL;
  aplomb_mesh a = {0}, b = {0};
  a.struct_size = b.struct_size = sizeof a;
  make_box(&box, 30);
  EXPECT(aplomb_stand(&box.mesh, NULL, NULL, &of_floats) == APLOMB_STANDS);
  box.mesh.float_vertices = NULL;
  box.mesh.double_vertices = box.double_vertices;
  EXPECT(aplomb_stand(&box.mesh, NULL, NULL, &of_doubles) == APLOMB_STANDS);
  EXPECT(aplomb_result_mesh(of_floats, &a) == APLOMB_STANDS && aplomb_result_mesh(of_doubles, &b) == APLOMB_STANDS);
  EXPECT(a.vertex_count > 8 && a.vertex_count == b.vertex_count && a.triangle_count == b.triangle_count);
  EXPECT(a.float_vertices == NULL && memcmp(a.double_vertices, b.double_vertices, 24 * a.vertex_count) == 0);
  EXPECT(memcmp(a.triangles, b.triangles, 12 * a.triangle_count) == 0);
  EXPECT(memcmp(a.triangles, box_triangles, sizeof box_triangles) == 0); /* the outside left as it came */
  aplomb_result_free(of_floats);
  aplomb_result_free(of_doubles);
}

static void what_stands_comes_back_as_it_was(void) {
  leaning_box box;
  aplomb_result* result = NULL;
  aplomb_mesh made = {0};
  made.struct_size = sizeof made;
  make_box(&box, 0);
  EXPECT(aplomb_stand(&box.mesh, "", NULL, &result) == APLOMB_STANDS);
  EXPECT(aplomb_result_mesh(result, &made) == APLOMB_STANDS);
  EXPECT(made.vertex_count == 8 && made.triangle_count == 12);
  EXPECT(memcmp(made.double_vertices, box.double_vertices, sizeof box.double_vertices) == 0);
  aplomb_result_free(result);
}

static void what_cannot_stand_has_a_report_and_no_mesh_unless_asked_for(void) {
  leaning_box box;
  aplomb_result* result = NULL;
  aplomb_mesh made = {0};
  made.struct_size = sizeof made;
  make_box(&box, 90);
  EXPECT(aplomb_stand(&box.mesh, NULL, NULL, &result) == APLOMB_CANNOT_STAND);
  EXPECT(strstr(aplomb_result_report(result), "\"best_effort\"") != NULL);
  EXPECT(aplomb_result_mesh(result, &made) == APLOMB_STANDS && made.triangle_count == 0 && made.triangles == NULL);
  aplomb_result_free(result);
  EXPECT(aplomb_stand(&box.mesh, "{\"aplomb_job\": 1, \"best_effort\": true}", NULL, &result) == APLOMB_CANNOT_STAND);
  EXPECT(aplomb_result_mesh(result, &made) == APLOMB_STANDS && made.triangle_count > 12);
  aplomb_result_free(result);
}

static void loose_triangles_are_joined_as_those_of_an_stl(void) {
  leaning_box box;
  float soup[108];
  uint32_t triangles[36];
  int i;
  make_box(&box, 0);
  for (i = 0; i < 36; ++i) {
    memcpy(soup + 3 * i, box.vertices + 3 * box_triangles[i], 3 * sizeof *soup);
    triangles[i] = (uint32_t)i;
  }
  EXPECT(run(aplomb_validate, &box.mesh, NULL, NULL) == APLOMB_STANDS);
  box.mesh.float_vertices = soup;
  box.mesh.vertex_count = 36;
  box.mesh.triangles = triangles;
  EXPECT(run(aplomb_validate, &box.mesh, NULL, NULL) == APLOMB_STANDS);
  box.mesh.triangle_count = 11;
  EXPECT(run(aplomb_validate, &box.mesh, NULL, NULL) == APLOMB_NOT_PRINTABLE);
}

typedef struct witness {
  int reports;
  int cancel_at;         /* the report that is answered by 0; below 0: none */
  double least_fraction; /* that the next report may have */
  struct timespec cancelled_at;
  aplomb_status inner; /* what a call from within the listener returned */
} witness;

static int32_t watch(void* user, double fraction, const char* stage) {
  witness* w = user;
  EXPECT(fraction >= 0 && fraction <= 1 && stage && *stage);
  w->least_fraction = fraction > w->least_fraction ? fraction : w->least_fraction;
  if (w->reports++ != w->cancel_at) return 1;
  timespec_get(&w->cancelled_at, TIME_UTC);
  return 0;
}

static void a_call_can_be_cancelled_at_any_report(void) {
  static const int at[] = {0, 1, 5, 20, 60};
  size_t i;
  leaning_box box;
  make_box(&box, 30);
  for (i = 0; i < sizeof at / sizeof *at; ++i) {
    witness w = {0};
    aplomb_listener listener = {0};
    aplomb_result* result = NULL;
    struct timespec ended;
    aplomb_mesh made = {0};
    made.struct_size = sizeof made;
    w.cancel_at = at[i];
    listener.struct_size = sizeof listener;
    listener.progress = watch;
    listener.user = &w;
    EXPECT(aplomb_stand(&box.mesh, NULL, &listener, &result) == APLOMB_CANCELLED);
    timespec_get(&ended, TIME_UTC);
    EXPECT(w.reports == at[i] + 1); /* and not asked again */
    /* 100 ms are promised; ten times that on a machine that does much else */
    EXPECT((double)(ended.tv_sec - w.cancelled_at.tv_sec) + 1e-9 * (double)(ended.tv_nsec - w.cancelled_at.tv_nsec) < 1);
    EXPECT(aplomb_result_mesh(result, &made) == APLOMB_STANDS && made.triangle_count == 0);
    aplomb_result_free(result);
  }
}

static int32_t call_again(void* user, double fraction, const char* stage) {
  leaning_box box;
  (void)fraction, (void)stage;
  make_box(&box, 0);
  ((witness*)user)->inner = aplomb_check(&box.mesh, NULL, NULL, NULL);
  return 1;
}

static void a_listener_may_not_call_back(void) {
  leaning_box box;
  witness w = {0};
  aplomb_listener listener = {sizeof listener, call_again, NULL};
  listener.user = &w;
  make_box(&box, 0);
  EXPECT(aplomb_check(&box.mesh, NULL, &listener, NULL) == APLOMB_STANDS);
  EXPECT(w.inner == APLOMB_USAGE);
}

static void* check_in_a_thread(void* status) {
  leaning_box box;
  make_box(&box, 30);
  *(aplomb_status*)status = aplomb_stand(&box.mesh, NULL, NULL, NULL);
  return NULL;
}

static void threads_wait_for_each_other(void) {
  pthread_t threads[3];
  aplomb_status statuses[3] = {-1, -1, -1};
  int i;
  for (i = 0; i < 3; ++i) EXPECT(pthread_create(&threads[i], NULL, check_in_a_thread, &statuses[i]) == 0);
  for (i = 0; i < 3; ++i) EXPECT(pthread_join(threads[i], NULL) == 0 && statuses[i] == APLOMB_STANDS);
}

/* The last: it leaves the process with little memory. 12 million triangles want 430 MB for their indices alone. */
static void running_out_of_memory_is_a_status(void) {
  leaning_box box;
  const size_t count = 12000000;
  uint32_t* triangles = calloc(3 * count, sizeof *triangles);
  struct rlimit limit;
  FILE* statm = fopen("/proc/self/statm", "r");
  unsigned long pages = 0;
  EXPECT(triangles && statm && fscanf(statm, "%lu", &pages) == 1);
  if (!triangles || !statm) return;
  fclose(statm);
  make_box(&box, 0);
  box.mesh.triangles = triangles;
  box.mesh.triangle_count = count;
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = pages * 4096 + (64UL << 20);
  EXPECT(setrlimit(RLIMIT_AS, &limit) == 0);
  EXPECT(aplomb_check(&box.mesh, NULL, NULL, NULL) == APLOMB_OVER_BUDGET);
  limit.rlim_cur = limit.rlim_max;
  EXPECT(setrlimit(RLIMIT_AS, &limit) == 0);
  make_box(&box, 0);
  EXPECT(aplomb_check(&box.mesh, NULL, NULL, NULL) == APLOMB_STANDS); /* and it goes on */
  free(triangles);
}

#define TEST(name) {#name, name}
static const struct {
  const char* name;
  void (*run)(void);
} tests[] = {TEST(structs_have_the_layout_of_abi_version_1),
             TEST(every_status_has_a_text_of_its_own),
             TEST(a_struct_of_another_size_is_refused),
             TEST(null_arguments_are_refused_and_never_followed),
             TEST(a_mesh_that_cannot_be_used_is_refused_with_the_place),
             TEST(a_job_that_cannot_be_used_is_refused_with_the_place),
             TEST(a_box_tips_at_the_angle_that_its_shape_gives),
             TEST(doubles_and_floats_give_the_same_bytes),
             TEST(what_stands_comes_back_as_it_was),
             TEST(what_cannot_stand_has_a_report_and_no_mesh_unless_asked_for),
             TEST(loose_triangles_are_joined_as_those_of_an_stl),
             TEST(a_call_can_be_cancelled_at_any_report),
             TEST(a_listener_may_not_call_back),
             TEST(threads_wait_for_each_other),
             TEST(running_out_of_memory_is_a_status)};

int main(int argc, char** argv) {
  size_t i, ran = 0;
  for (i = 0; i < sizeof tests / sizeof *tests; ++i)
    if (argc < 2 || strcmp(argv[1], tests[i].name) == 0) {
      const int before = failures;
      tests[i].run();
      ++ran;
      printf("%s %s\n", failures == before ? "ok  " : "FAIL", tests[i].name);
    }
  return failures > 0 || ran == 0;
}
