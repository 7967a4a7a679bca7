// The answers of Routes that are streams: what takes its time, and one solver.

#include <fmt/format.h>
#include <httplib.h>

#include <array>
#include <nlohmann/json.hpp>

#include "aplomb/job/job_file.h"
#include "server/replies.h"
#include "server/routes.h"
#include "wire/messages.h"

namespace aplomb::studio {

using httplib::ContentReader;
using httplib::Request;
using httplib::Response;
namespace fs = std::filesystem;

void Routes::add_streams(httplib::Server& server) {
  constexpr std::array<std::pair<const char*, Errand>, 5> errands{{{"/api/place", Errand::place},
                                                                   {"/api/check", Errand::check},
                                                                   {"/api/preview", Errand::preview},
                                                                   {"/api/validate", Errand::validate},
                                                                   {"/api/stand", Errand::stand}}};
  for (const auto& [path, errand] : errands)
    server.Post(path, [this, errand = errand](const Request&, Response& response, const ContentReader& reader) {
      if (const auto ask = read_ask(response, reader)) stream(response, *ask, errand);
    });
}

void Routes::stream(Response& response, const Ask& ask, Errand errand) {
  const auto work = work_of(ask, response);
  if (!work) return;
  const auto turn = turns_.ask(errand);
  response.set_chunked_content_provider(
      "application/octet-stream",
      [this, ask, work = *work, errand, turn](std::size_t, httplib::DataSink& sink) {
        Stream stream(sink, *turn);
        while (!stream.is_over() && !turns_.is_up(*turn, 50)) stream.stay_alive();
        try {
          if (stream.is_over()) stream.json(cancelled_message());
          else answer(ask, work, errand, stream);
        } catch (const std::exception& error) {  // a bug, or no memory; the library would let it end the server
          stream.json(error_message(static_cast<int>(Ending::internal), error.what()));
        }
        stream.end();
        sink.done();
        return true;
      },
      [this, turn](bool) { turns_.leave(*turn); });
}

void Routes::answer(const Ask& ask, const Work& work, Errand errand, Stream& stream) {
  const std::string job = job_text(work, JobReader::solver);
  if (errand == Errand::stand)  // the others are told by the solver
    if (const auto parsed = parse_job(job, ""); !parsed) return stream.json(error_message(parsed.error()));
  SolverRequest request{.what = "place", .folder = work.model.folder.string(), .job = job, .wish = ask.wish};
  switch (errand) {
    case Errand::stand:
      return stand(ask, work, stream);
    case Errand::validate:
      if (ask.of == "result") return validate_result(ask, work, stream);
      request.what = "validate";
      break;
    case Errand::check:
      request.what = "check";
      break;
    case Errand::preview:
      request.what = "preview";
      break;
    case Errand::place:
      break;
  }
  resident_.answer(request, stream);
}

void Routes::stand(const Ask& ask, const Work& work, Stream& stream) {
  const fs::path folder = places_.models / fmt::format("run-{}", ++runs_);  // one at a time: see Turns
  const RunOrder order{places_.aplomb, work, {folder, work.model.stem()}};
  std::error_code ignored;
  bool is_kept = false;
  const auto keep = [&] {
    is_kept = true;
    const std::lock_guard lock(made_mutex_);
    if (made_) fs::remove_all(made_->folder, ignored);
    made_ = order.made;
    made_of_ = ask;
  };
  const bool has_ended = run_whole(order, stream, resident_, keep);
  if (is_kept) return;  // what was written stays, even where its page was not drawn to the end
  if (has_ended) keep();
  else fs::remove_all(folder, ignored);
}

/// The file that was written, as it is: it was placed when it was made.
void Routes::validate_result(const Ask& ask, const Work& work, Stream& stream) {
  const auto made = [&] {
    const std::lock_guard lock(made_mutex_);
    return made_of(ask);
  }();
  if (!made || !fs::exists(made->mesh()))
    return stream.json(
        error_message(static_cast<int>(Ending::usage), "make it stand first: there is no result of this job"));
  auto job = nlohmann::ordered_json::parse(job_text(work, JobReader::solver));
  job["model"] = made->mesh().filename().string();
  for (const char* key : {"place", "profile", "ballast"}) job.erase(key);
  resident_.answer({.what = "validate", .folder = made->folder.string(), .job = job.dump()}, stream);
}

}  // namespace aplomb::studio
