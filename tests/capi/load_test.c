/* Many models in one process: what it takes of memory, and that no call sees anything of another. */
#include <malloc.h>
#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

#include "expect.h"
#include "shapes.h"

typedef aplomb_status (*working_call)(const aplomb_mesh*, const char*, const aplomb_listener*, aplomb_result**);

/* One model and what is asked of it; coarse, so that it is quick. */
typedef struct errand {
  working_call call;
  float lean_mm;
  uint64_t triangles; /* of the box's 12 */
  const char* job;
  aplomb_status status;
} errand;

#define COARSE "\"aplomb_job\": 1, \"wall_mm\": 5, \"voxel_mm\": 2.5"
static const errand errands[] = {
    {aplomb_stand, 20, 12, "{" COARSE ", \"poses\": [{\"stand\": {\"tip_deg\": 8}}]}", APLOMB_STANDS},
    {aplomb_check, 10, 12, NULL, APLOMB_STANDS},
    {aplomb_stand, 20, 12, "{" COARSE ", \"aim\": \"stable\", \"best_effort\": true}", APLOMB_CANNOT_STAND},
    {aplomb_validate, 5, 12, NULL, APLOMB_STANDS},
    {aplomb_stand, 20, 6, NULL, APLOMB_UNUSABLE_INPUT},
    {aplomb_stand, 20, 12, "{" COARSE ", \"process\": \"binder\", \"poses\": [{\"stand\": {\"tip_deg\": 8.2}}]}",
     APLOMB_STANDS}, /* with escape holes */
    {aplomb_stand, 90, 12, "{" COARSE "}", APLOMB_CANNOT_STAND},
    {aplomb_check, 8, 11, NULL, APLOMB_STANDS}, /* through repair */
    {aplomb_check, 30, 12, "{\"aplomb_job\": 1, \"wall_mm\": -1}", APLOMB_USAGE},
    {aplomb_stand, 26, 12,
     "{" COARSE ", \"best_effort\": true, \"poses\": [{\"hang\": {\"from_mm\": [[26, 0, 60]], \"tilt_deg\": 5}}]}",
     APLOMB_CANNOT_STAND},
};
enum { kinds = sizeof errands / sizeof *errands };

static aplomb_result* run_errand(const errand* e) {
  leaning_box box;
  aplomb_result* result = NULL;
  aplomb_status status;
  make_box(&box, e->lean_mm);
  box.mesh.triangle_count = e->triangles;
  status = e->call(&box.mesh, e->job, NULL, &result);
  if (status != e->status) {
    ++failures;
    fprintf(stderr, "errand %d: %d, %s\n", (int)(e - errands), (int)status, aplomb_result_message(result));
  }
  return result;
}

/* Times and memory differ from run to run, and come after all else that a report says of a model. */
static size_t told_length(const char* report) {
  const char* times = strstr(report, "\"seconds\"");
  return times ? (size_t)(times - report) : strlen(report);
}

static int are_same(const aplomb_result* a, const aplomb_result* b) {
  const char *of_a = aplomb_result_report(a), *of_b = aplomb_result_report(b);
  aplomb_mesh m = {0}, n = {0};
  m.struct_size = n.struct_size = sizeof m;
  if (aplomb_result_mesh(a, &m) != APLOMB_STANDS || aplomb_result_mesh(b, &n) != APLOMB_STANDS) return 0;
  if (m.vertex_count != n.vertex_count || m.triangle_count != n.triangle_count) return 0;
  if (told_length(of_a) != told_length(of_b) || memcmp(of_a, of_b, told_length(of_a)) != 0) return 0;
  if (strcmp(aplomb_result_message(a), aplomb_result_message(b)) != 0) return 0;
  return m.triangle_count == 0 || (memcmp(m.double_vertices, n.double_vertices, 24 * m.vertex_count) == 0 &&
                                   memcmp(m.triangles, n.triangles, 12 * m.triangle_count) == 0);
}

/* In use, by malloc's own count, and what the system holds for this process, in bytes. */
typedef struct memory {
  long allocated;
  long resident;
} memory;

static memory memory_now(void) {
  memory now = {0, 0};
  struct mallinfo2 info;
  FILE* file = fopen("/proc/self/statm", "r");
  long pages = 0;
  malloc_trim(0);
  info = mallinfo2();
  now.allocated = (long)(info.uordblks + info.hblkhd);
  EXPECT(file && fscanf(file, "%*d %ld", &pages) == 1);
  if (file) fclose(file);
  now.resident = pages * sysconf(_SC_PAGESIZE);
  return now;
}

static void a_thousand_models_in_a_row_hold_no_more_memory_than_fifty(void) {
  enum { models = 1000, settled = 50 };
  aplomb_result* first[kinds];
  memory before = {0, 0}, after;
  int i;
  for (i = 0; i < kinds; ++i) first[i] = run_errand(&errands[i]);
  for (i = kinds; i < models; ++i) {
    aplomb_result* again = run_errand(&errands[i % kinds]);
    EXPECT(are_same(again, first[i % kinds]));
    aplomb_result_free(again);
    if (i + 1 == settled) before = memory_now();
  }
  after = memory_now();
  printf("allocated %ld and %ld bytes, resident %ld and %ld\n", before.allocated, after.allocated, before.resident,
         after.resident);
  EXPECT(after.allocated - before.allocated < 200 * 1000);    /* 200 bytes a model */
  EXPECT(after.resident - before.resident < 4 * 1000 * 1000); /* pages come and go */
  for (i = 0; i < kinds; ++i) aplomb_result_free(first[i]);
}

typedef struct worker {
  pthread_t thread;
  aplomb_result** alone;
  int first;
  int differ; /* results that are not those of the same errand alone */
} worker;

static void* run_some(void* at) {
  worker* w = at;
  int i;
  for (i = 0; i < kinds; ++i) {
    const int n = (w->first + i) % kinds;
    aplomb_result* result = run_errand(&errands[n]);
    w->differ += !are_same(result, w->alone[n]);
    aplomb_result_free(result);
  }
  return NULL;
}

static void sixteen_at_once_give_what_each_gives_alone(void) {
  enum { workers = 16 };
  worker at_once[workers];
  aplomb_result* alone[kinds];
  int i;
  for (i = 0; i < kinds; ++i) alone[i] = run_errand(&errands[i]);
  for (i = 1; i < kinds; ++i) EXPECT(!are_same(alone[i], alone[0])); /* or nothing would be shown */
  for (i = 0; i < workers; ++i) {
    at_once[i].alone = alone;
    at_once[i].first = i;
    at_once[i].differ = 0;
    EXPECT(pthread_create(&at_once[i].thread, NULL, run_some, &at_once[i]) == 0);
  }
  for (i = 0; i < workers; ++i) EXPECT(pthread_join(at_once[i].thread, NULL) == 0 && at_once[i].differ == 0);
  for (i = 0; i < kinds; ++i) aplomb_result_free(alone[i]);
}

int main(int argc, char** argv) {
  static const named_test tests[] = {TEST(a_thousand_models_in_a_row_hold_no_more_memory_than_fifty),
                                     TEST(sixteen_at_once_give_what_each_gives_alone)};
  return run_tests(argc, argv, tests, sizeof tests / sizeof *tests);
}
