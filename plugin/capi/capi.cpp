#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <type_traits>
#include <utility>

#include "aplomb.h"
#include "aplomb/core/threads.h"
#include "memory_mesh.h"
#include "runs.h"

struct aplomb_result {
  std::string message;
  std::string report;
  aplomb::TriangleMesh mesh;
};

namespace aplomb::capi {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double) && std::is_standard_layout_v<Vec3>, "vertices are shown as doubles");
static_assert(sizeof(Triangle) == 3 * sizeof(std::uint32_t));
static_assert(sizeof(aplomb_mesh) == 48 && sizeof(aplomb_listener) == 24,
              "of ABI version 1, where pointers have 64 bits");

constexpr const char* no_result = "there is no result: memory ran out, or none was asked for";
constexpr std::chrono::milliseconds patience{50};  // between two questions to a listener that waits

// ThreadLimit is the process's, and what runs in a forked child wants no neighbours.
std::mutex turn_mutex;
std::condition_variable turn_ended;
bool is_turn_taken = false;
thread_local bool is_working = false;

/// One run of this thread; waits until no other thread has one.
class Turn {
 public:
  /// \return cancelled; invalid_option when this thread has one, which then is a listener's.
  static Result<std::unique_ptr<Turn>> take(const Job& job) {
    if (is_working)
      return fail(ErrorCode::invalid_option, "a listener called a working call of the library: it may not");
    std::unique_lock lock(turn_mutex);
    while (!turn_ended.wait_for(lock, patience, [] { return !is_turn_taken; })) {
      lock.unlock();  // a listener may take its time
      if (!job.report(0, "wait")) return cancelled();
      lock.lock();
    }
    return std::unique_ptr<Turn>(new Turn());
  }
  ~Turn() {
    is_working = false;
    {
      const std::lock_guard lock(turn_mutex);
      is_turn_taken = false;
    }
    turn_ended.notify_one();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  Turn() { is_working = is_turn_taken = true; }
};

Result<Job> job_of(const aplomb_listener* listener) {
  if (!listener) return Job();
  if (listener->struct_size != sizeof(aplomb_listener))
    return fail(ErrorCode::invalid_option, "listener->struct_size is " + std::to_string(listener->struct_size) +
                                               "; this version of the library knows " +
                                               std::to_string(sizeof(aplomb_listener)));
  if (!listener->progress) return fail(ErrorCode::invalid_option, "listener->progress is null");
  return Job([progress = listener->progress, user = listener->user](double fraction, std::string_view stage) {
    return progress(user, fraction, std::string(stage).c_str()) != 0;
  });
}

Result<Finished> run(Run& work, const aplomb_mesh* mesh, const char* job_text, const aplomb_listener* listener) {
  const auto job = job_of(listener);
  if (!job) return tl::unexpected(job.error());
  const auto asked = job_without_files(job_text ? job_text : "");
  if (!asked) return tl::unexpected(asked.error());
  const auto turn_taken = Turn::take(*job);
  if (!turn_taken) return tl::unexpected(turn_taken.error());
  const auto file = read_memory(mesh, asked->input.read);
  if (!file) return tl::unexpected(file.error());
  const ThreadLimit limit(asked->threads);
  return work(*file, *asked, *job);
}

Finished ended(const Error& error) { return {ending_of(error), error.message, {}, {}}; }

/// Runs it; nothing is thrown from here.
Finished run_safely(Run& work, const aplomb_mesh* mesh, const char* job, const aplomb_listener* listener) noexcept {
  try {
    try {
      auto finished = run(work, mesh, job, listener);
      return finished ? std::move(*finished) : ended(finished.error());
    } catch (const std::bad_alloc&) {
      return {Ending::over_budget, "memory ran out", {}, {}};
    } catch (const std::exception& error) {
      return {Ending::internal, std::string("internal error: ") + error.what(), {}, {}};
    } catch (...) {
      return {Ending::internal, "internal error", {}, {}};
    }
  } catch (...) {  // not even for a message
    return {Ending::over_budget, {}, {}, {}};
  }
}

aplomb_status call(Run& work, const aplomb_mesh* mesh, const char* job, const aplomb_listener* listener,
                   aplomb_result** result) noexcept {
  if (result) *result = nullptr;
  Finished finished = run_safely(work, mesh, job, listener);
  if (result)
    *result = new (std::nothrow)
        aplomb_result{std::move(finished.message), std::move(finished.report), std::move(finished.mesh)};
  return static_cast<aplomb_status>(finished.ending);
}

}  // namespace
}  // namespace aplomb::capi

using namespace aplomb::capi;

uint32_t aplomb_abi_version(void) { return APLOMB_ABI_VERSION; }

const char* aplomb_version(void) { return APLOMB_VERSION; }

const char* aplomb_status_text(aplomb_status status) {
  switch (status) {
    case APLOMB_STANDS:
      return "stands, or prints";
    case APLOMB_USAGE:
      return "wrong use";
    case APLOMB_UNUSABLE_INPUT:
      return "unusable input";
    case APLOMB_CANNOT_STAND:
      return "cannot stand";
    case APLOMB_CANCELLED:
      return "cancelled";
    case APLOMB_OVER_BUDGET:
      return "over budget";
    case APLOMB_NOT_PRINTABLE:
      return "does not print";
    case APLOMB_INTERNAL:
      return "internal error";
    default:
      return "no status of this version";
  }
}

aplomb_status aplomb_stand(const aplomb_mesh* mesh, const char* job, const aplomb_listener* listener,
                           aplomb_result** result) {
  return call(run_stand, mesh, job, listener, result);
}

aplomb_status aplomb_check(const aplomb_mesh* mesh, const char* job, const aplomb_listener* listener,
                           aplomb_result** result) {
  return call(run_check, mesh, job, listener, result);
}

aplomb_status aplomb_validate(const aplomb_mesh* mesh, const char* job, const aplomb_listener* listener,
                              aplomb_result** result) {
  return call(run_validate, mesh, job, listener, result);
}

const char* aplomb_result_message(const aplomb_result* result) { return result ? result->message.c_str() : no_result; }

const char* aplomb_result_report(const aplomb_result* result) { return result ? result->report.c_str() : ""; }

aplomb_status aplomb_result_mesh(const aplomb_result* result, aplomb_mesh* mesh) {
  if (!result || !mesh || mesh->struct_size != sizeof(aplomb_mesh)) return APLOMB_USAGE;
  const aplomb::TriangleMesh& made = result->mesh;
  *mesh = {sizeof(aplomb_mesh), nullptr, nullptr, made.vertices.size(), nullptr, made.triangles.size()};
  if (made.triangles.empty()) return APLOMB_STANDS;
  mesh->double_vertices = &made.vertices.front().x;
  mesh->triangles = made.triangles.front().data();
  return APLOMB_STANDS;
}

void aplomb_result_free(aplomb_result* result) { delete result; }
