/* Makes a leaning box stand and writes it as OBJ: example OUT.obj [JOB]. What the library says goes to standard error.
 */
#include <stdio.h>
#include <stdlib.h>

#include "aplomb.h"

/* 28 x 28 mm, 60 mm high, its top 30 mm further in +x: its centre of mass lies 1 mm beyond its base. */
static const float box_vertices[] = {-14, -14, 0,  14, -14, 0,  14, 14, 0,  -14, 14, 0,
                                     16,  -14, 60, 44, -14, 60, 44, 14, 60, 16,  14, 60};
static const uint32_t box_triangles[] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                         1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

static int32_t show(void* user, double fraction, const char* stage) {
  (void)user;
  fprintf(stderr, "\r%3.0f %% %-20s", 100 * fraction, stage);
  return 1; /* go on */
}

static int write_obj(const char* path, const aplomb_mesh* mesh) {
  uint64_t i;
  FILE* file = fopen(path, "w");
  if (!file) return 0;
  for (i = 0; i < mesh->vertex_count; ++i) {
    const double* v = mesh->double_vertices + 3 * i;
    fprintf(file, "v %.9g %.9g %.9g\n", v[0], v[1], v[2]);
  }
  for (i = 0; i < mesh->triangle_count; ++i) {
    const uint32_t* t = mesh->triangles + 3 * i;
    fprintf(file, "f %lu %lu %lu\n", t[0] + 1UL, t[1] + 1UL, t[2] + 1UL);
  }
  return fclose(file) == 0;
}

int main(int argc, char** argv) {
  aplomb_mesh box = {0}, made = {0};
  aplomb_listener listener = {0};
  aplomb_result* result = NULL;
  aplomb_status status;

  if (argc < 2 || aplomb_abi_version() != APLOMB_ABI_VERSION) return EXIT_FAILURE;
  box.struct_size = sizeof box;
  box.float_vertices = box_vertices;
  box.vertex_count = sizeof box_vertices / sizeof *box_vertices / 3;
  box.triangles = box_triangles;
  box.triangle_count = sizeof box_triangles / sizeof *box_triangles / 3;
  listener.struct_size = sizeof listener;
  listener.progress = show;

  status = aplomb_stand(&box, argc > 2 ? argv[2] : NULL, &listener, &result);
  fprintf(stderr, "\r%s: %s\n", aplomb_status_text(status), aplomb_result_message(result));
  made.struct_size = sizeof made;
  aplomb_result_mesh(result, &made);
  if (made.triangle_count > 0 && !write_obj(argv[1], &made)) status = APLOMB_UNUSABLE_INPUT;
  aplomb_result_free(result);
  return (int)status;
}
