#ifndef APLOMB_H
#define APLOMB_H

#include <stdint.h>

/* Aplomb for programs in any language: triangles in, triangles that stand out.
 *
 * Threads: any thread may call, and results may be read and freed on any. The calls that work (aplomb_stand,
 * aplomb_check, aplomb_validate) run one after another in a process; one that waits for its turn still asks its
 * listener and can be cancelled. Each uses as many threads as its job's "threads" allows, all of which are idle when it
 * returns.
 *
 * Memory: what the library returns belongs to the library and lives until its result is freed. What is passed in is
 * only read, and not after the call. No C++ exception leaves the library, and none may leave a listener.
 *
 * The process: repairing a broken mesh may fork, for work that must not take the host down; the child is waited for by
 * its number. No signal handler, locale, standard stream or working folder is touched, and no file is written. */

#if defined(_WIN32)
#define APLOMB_API
#else
#define APLOMB_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Of this header. It grows by one when a program built against the old header would no longer run right; it is also the
 * number in the library's name (libaplomb.so.1). */
#define APLOMB_ABI_VERSION 1

/* Of the library that is loaded. */
APLOMB_API uint32_t aplomb_abi_version(void);

/* Of Aplomb: "1.2.3". */
APLOMB_API const char* aplomb_version(void);

/* What every call returns: the exit codes of the program. */
typedef int32_t aplomb_status;
enum {
  APLOMB_STANDS = 0,         /* it stands, or prints: all is well */
  APLOMB_USAGE = 1,          /* an argument, the job or one of its values */
  APLOMB_UNUSABLE_INPUT = 2, /* of the mesh no solid can be made */
  APLOMB_CANNOT_STAND = 3,   /* the report says by how much; there is a mesh only if the job asks for best_effort */
  APLOMB_CANCELLED = 4,      /* by the listener */
  APLOMB_OVER_BUDGET = 5,    /* the memory that the job allows, or that there is, would not do */
  APLOMB_NOT_PRINTABLE = 6,  /* the report says why; there is a mesh only if the job asks for best_effort */
  APLOMB_INTERNAL = 7        /* a fault of Aplomb's */
};

/* A few words for each of them, in English; never null. */
APLOMB_API const char* aplomb_status_text(aplomb_status status);

/* Triangles in millimetres, z up, counter-clockwise seen from outside. Exactly one of the two kinds of vertices is
 * given; they are taken as float32, which is what slicers read. Set all bytes to 0 and then struct_size first. */
typedef struct aplomb_mesh {
  uint64_t struct_size;          /* sizeof(aplomb_mesh) */
  const float* float_vertices;   /* x, y, z of each vertex; or null */
  const double* double_vertices; /* the same; or null */
  uint64_t vertex_count;
  const uint32_t* triangles; /* three vertices of each triangle, counted from 0 */
  uint64_t triangle_count;
} aplomb_mesh;

/* Told how far a call is, at least every 100 ms, on the thread of the call; the share done is in [0, 1] and never null
 * is the stage ("carve"), which lives for the time of the call to the listener. Returns 0 to cancel: the call then ends
 * within 100 ms. It may not call the library's working calls (they return APLOMB_USAGE). */
typedef int32_t (*aplomb_progress)(void* user, double fraction, const char* stage);

typedef struct aplomb_listener {
  uint64_t struct_size; /* sizeof(aplomb_listener) */
  aplomb_progress progress;
  void* user; /* passed on as it is */
} aplomb_listener;

/* What came of a call. */
typedef struct aplomb_result aplomb_result;

/* The calls that work. All take a mesh, a job, a listener or null, and where to put the result.
 *
 * The job is JSON, UTF-8, as lib/aplomb/job/job.schema.json has it, but for the keys that name files ("model",
 * "output", "report", "dump", "html", "picture", "plugs", "profile", "modifier") and "time_s", which are refused:
 * {"aplomb_job": 1, "wall_mm": 2}. Null or "" stands for {"aplomb_job": 1}: make it stand as it lies, with a tip angle
 * of 10 degrees.
 *
 * *result is set to a result that says more, to be freed, also when the call fails; it is null only where memory ran
 * out. `result` itself may be null if only the status is wanted. */

/* Makes it hold every pose of the job by a void inside and, if asked for, by bending the outside. */
APLOMB_API aplomb_status aplomb_stand(const aplomb_mesh* mesh, const char* job, const aplomb_listener* listener,
                                      aplomb_result** result);

/* Whether it holds the poses of the job, and by how many degrees. */
APLOMB_API aplomb_status aplomb_check(const aplomb_mesh* mesh, const char* job, const aplomb_listener* listener,
                                      aplomb_result** result);

/* Whether it prints, as it is. */
APLOMB_API aplomb_status aplomb_validate(const aplomb_mesh* mesh, const char* job, const aplomb_listener* listener,
                                         aplomb_result** result);

/* One sentence for people: the verdict, or what went wrong and what helps (where it names a flag of the program, the
 * job's key of that name is meant). Never null. */
APLOMB_API const char* aplomb_result_message(const aplomb_result* result);

/* The report as JSON, the same that the program's --report writes; "" where there is none. Never null. */
APLOMB_API const char* aplomb_result_report(const aplomb_result* result);

/* Shows the mesh to print: outer surface and voids as one, voids wound inwards, its coordinates float32 values in
 * double_vertices. The caller sets mesh->struct_size first; no other field is read. Without a mesh (there is one only
 * after aplomb_stand) counts are 0 and pointers null. A model that stood already comes back as it was.
 * Returns APLOMB_USAGE for a null argument or an unknown struct_size. */
APLOMB_API aplomb_status aplomb_result_mesh(const aplomb_result* result, aplomb_mesh* mesh);

/* Null is allowed. */
APLOMB_API void aplomb_result_free(aplomb_result* result);

#ifdef __cplusplus
}
#endif

#endif
