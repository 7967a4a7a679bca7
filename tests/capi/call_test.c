/* What the C library's calls answer, and that they can be watched, cancelled and made from several threads. */
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <time.h>

#include "expect.h"
#include "shapes.h"

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
  clock_gettime(CLOCK_MONOTONIC, &w->cancelled_at);
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
    clock_gettime(CLOCK_MONOTONIC, &ended);
    EXPECT(w.reports == at[i] + 1); /* and not asked again */
    /* 100 ms are promised; ten times that on a machine that does much else */
    EXPECT((double)(ended.tv_sec - w.cancelled_at.tv_sec) + 1e-9 * (double)(ended.tv_nsec - w.cancelled_at.tv_nsec) <
           1);
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

static int32_t cancel_what_waits(void* user, double fraction, const char* stage) {
  (void)fraction;
  EXPECT(strcmp(stage, "wait") == 0);
  ++((witness*)user)->reports;
  return 0;
}

static void* call_and_cancel(void* user) {
  leaning_box box;
  aplomb_listener listener = {sizeof listener, cancel_what_waits, NULL};
  listener.user = user;
  make_box(&box, 0);
  ((witness*)user)->inner = aplomb_check(&box.mesh, NULL, &listener, NULL);
  return NULL;
}

/* In the middle of a call: another thread makes one, which must wait, and cancels it. */
static int32_t let_another_call(void* user, double fraction, const char* stage) {
  pthread_t thread;
  (void)fraction, (void)stage;
  if (((witness*)user)->reports > 0) return 1;
  EXPECT(pthread_create(&thread, NULL, call_and_cancel, user) == 0 && pthread_join(thread, NULL) == 0);
  return 1;
}

static void a_call_that_waits_for_its_turn_can_be_cancelled(void) {
  leaning_box box;
  witness w = {0};
  aplomb_listener listener = {sizeof listener, let_another_call, NULL};
  listener.user = &w;
  make_box(&box, 0);
  EXPECT(aplomb_check(&box.mesh, NULL, &listener, NULL) == APLOMB_STANDS);
  EXPECT(w.inner == APLOMB_CANCELLED && w.reports == 1);
}

int main(int argc, char** argv) {
  static const named_test tests[] = {TEST(a_box_tips_at_the_angle_that_its_shape_gives),
                                     TEST(doubles_and_floats_give_the_same_bytes),
                                     TEST(what_stands_comes_back_as_it_was),
                                     TEST(what_cannot_stand_has_a_report_and_no_mesh_unless_asked_for),
                                     TEST(loose_triangles_are_joined_as_those_of_an_stl),
                                     TEST(a_call_can_be_cancelled_at_any_report),
                                     TEST(a_listener_may_not_call_back),
                                     TEST(threads_wait_for_each_other),
                                     TEST(a_call_that_waits_for_its_turn_can_be_cancelled)};
  return run_tests(argc, argv, tests, sizeof tests / sizeof *tests);
}
