/* What the C library does with arguments that cannot be used. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <sys/resource.h>

#include "expect.h"
#include "shapes.h"

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

/* The last: it leaves the process with little memory. 12 million triangles want 430 MB for their indices alone. */
static void running_out_of_memory_is_a_status(void) {
#ifdef __SANITIZE_ADDRESS__
  return; /* which ends the process where memory runs out */
#endif
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

int main(int argc, char** argv) {
  static const named_test tests[] = {TEST(structs_have_the_layout_of_abi_version_1),
                                     TEST(every_status_has_a_text_of_its_own),
                                     TEST(a_struct_of_another_size_is_refused),
                                     TEST(null_arguments_are_refused_and_never_followed),
                                     TEST(a_mesh_that_cannot_be_used_is_refused_with_the_place),
                                     TEST(a_job_that_cannot_be_used_is_refused_with_the_place),
                                     TEST(running_out_of_memory_is_a_status)};
  return run_tests(argc, argv, tests, sizeof tests / sizeof *tests);
}
