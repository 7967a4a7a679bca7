/* Meshes whose balance is known, for the tests in C. */
#ifndef APLOMB_TESTS_CAPI_SHAPES_H
#define APLOMB_TESTS_CAPI_SHAPES_H

#include <stdint.h>
#include <string.h>

#include "aplomb.h"

static const uint32_t box_triangles[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                           1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

/* A box of 28 x 28 x 60 mm; its top is displaced, so that the centre of mass lies lean / 2 off the base's middle. */
typedef struct leaning_box {
  float vertices[24];
  double double_vertices[24];
  aplomb_mesh mesh;
} leaning_box;

static void make_box(leaning_box* box, float lean_mm) {
  int i;
  for (i = 0; i < 8; ++i) {
    float* v = box->vertices + 3 * i;
    v[0] = (i % 4 == 1 || i % 4 == 2 ? 14.0F : -14.0F) + (i >= 4 ? lean_mm : 0.0F);
    v[1] = i % 4 >= 2 ? 14.0F : -14.0F;
    v[2] = i >= 4 ? 60.0F : 0.0F;
  }
  for (i = 0; i < 24; ++i) box->double_vertices[i] = box->vertices[i];
  memset(&box->mesh, 0, sizeof box->mesh);
  box->mesh.struct_size = sizeof box->mesh;
  box->mesh.float_vertices = box->vertices;
  box->mesh.vertex_count = 8;
  box->mesh.triangles = box_triangles;
  box->mesh.triangle_count = 12;
}

#endif
