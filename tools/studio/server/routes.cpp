#include "server/routes.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "aplomb/fdm/print_profile.h"
#include "aplomb/job/job_file.h"
#include "server/replies.h"

namespace aplomb::studio {
namespace {

using Json = nlohmann::ordered_json;
using httplib::ContentReader;
using httplib::Request;
using httplib::Response;
namespace fs = std::filesystem;

constexpr std::size_t most_ask_bytes = 1'000'000;
constexpr std::size_t most_triangles = 5'000'000;

void answer_json(Response& response, const Json& json) {
  response.set_content(json.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json");
}

Json json_of(const Upload& upload) {
  std::error_code ignored;
  return {{"id", upload.id}, {"name", upload.name}, {"bytes", fs::file_size(upload.file(), ignored)}};
}

Json json_of(const std::optional<Upload>& upload) { return upload ? json_of(*upload) : Json(); }

std::vector<std::string> fixture_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".stl") && !name.starts_with("broken_") && !name.starts_with("odd_")) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

std::string bytes_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// Reads a body into `take` while it is short enough. \return whether it was.
bool read_body(const ContentReader& reader, std::size_t most_bytes, const std::function<bool(std::string_view)>& take) {
  std::size_t bytes = 0;
  return reader([&](const char* data, std::size_t count) {
    bytes += count;
    return bytes <= most_bytes && take({data, count});
  });
}

/// Why a body of the length that it says has no place on the disk, or nothing.
std::string no_room(const Request& request, const fs::path& folder) {
  constexpr std::uintmax_t left_free_bytes = 64 << 20;  // for what a run writes
  const auto bytes = request.get_header_value<std::uint64_t>("Content-Length");
  std::error_code unknown;
  const auto space = fs::space(folder, unknown);
  if (unknown || bytes + left_free_bytes <= space.available) return {};
  return fmt::format("there is no place for {} MB in {}: {} MB are free", bytes >> 20, folder.parent_path().string(),
                     space.available >> 20);
}

}  // namespace

Routes::Routes(Places places, Guard guard, std::function<void()> quit)
    : places_(std::move(places)),
      guard_(std::move(guard)),
      quit_(std::move(quit)),
      models_(places_.models, "model", 2 * guard_.most_body_bytes()),
      profiles_(places_.models, "profile", guard_.most_body_bytes()),
      resident_(places_.program) {}

std::optional<Ask> Routes::read_ask(Response& response, const ContentReader& reader) {
  std::string body;
  if (!read_body(reader, most_ask_bytes, [&](std::string_view part) { return !!&body.append(part); })) {
    refuse(response, too_large, Ending::usage, "the request has more than 1 MB");
    return std::nullopt;
  }
  auto ask = parse_ask(body);
  if (ask) return std::move(*ask);
  refuse(response, bad_request, Ending::usage, ask.error().message);
  return std::nullopt;
}

void Routes::add_to(httplib::Server& server) {
  const auto refused = [this](const Request& request, Response& response) {
    const int status = guard_.refusal(request);
    if (status != 0) response.status = status;
    if (status == too_large)
      refuse(response, too_large, Ending::over_budget,
             fmt::format("a file may have up to {} MB here", guard_.most_body_bytes() >> 20));
    return status != 0;
  };
  server.set_pre_routing_handler([refused](const Request& request, Response& response) {
    // What says that it takes compressed answers gets them from the library, which takes 1.7 s for the page's script,
    // and it crosses no network. The request itself is not const.
    const_cast<Request&>(request).headers.erase("Accept-Encoding");
    return refused(request, response) ? httplib::Server::HandlerResponse::Handled
                                      : httplib::Server::HandlerResponse::Unhandled;
  });
  server.set_expect_100_continue_handler([refused](const Request& request, Response& response) {
    return refused(request, response) ? response.status : 100;
  });
  server.set_post_routing_handler([](const Request&, Response& response) { harden(response); });
  server.set_exception_handler([](const Request&, Response& response, const std::exception_ptr&) {
    refuse(response, broken, Ending::internal, "the server made a mistake");
  });
  server.Post("/api/token", [this](const Request&, Response& response, const ContentReader& reader) {
    if (const auto ask = read_ask(response, reader)) give_token(response, *ask);
  });
  server.Get("/api/start", [this](const Request&, Response& response) { start(response); });
  server.Post("/api/model", [this](const Request& request, Response& response, const ContentReader& reader) {
    take_model(request, response, reader);
  });
  server.Post("/api/profile", [this](const Request& request, Response& response, const ContentReader& reader) {
    take_profile(request, response, reader);
  });
  server.Post("/api/fixture", [this](const Request&, Response& response, const ContentReader& reader) {
    if (const auto ask = read_ask(response, reader)) take_fixture(response, *ask);
  });
  server.Post("/api/take", [this](const Request&, Response& response, const ContentReader& reader) {
    if (const auto ask = read_ask(response, reader)) take_away(response, *ask);
  });
  server.Post("/api/cancel", [this](const Request&, Response& response) {
    turns_.cancel_all(false);
    response.status = no_content;
  });
  server.Post("/api/quit", [this](const Request&, Response& response) {
    response.status = no_content;
    quit_();
  });
  add_streams(server);
  server.set_file_extension_and_mimetype_mapping("js", "text/javascript");
  server.set_file_extension_and_mimetype_mapping("woff2", "font/woff2");
  server.set_mount_point("/", places_.page.string());
}

Result<Upload> Routes::copy_of(Uploads& uploads, const fs::path& file) {
  auto copy = uploads.begin(file.filename().string());
  if (!copy) return copy;
  std::error_code failed;
  fs::copy_file(file, copy->file(), failed);
  if (failed) {
    Uploads::drop(*copy);
    return fail(ErrorCode::file_system, fmt::format("{} cannot be read: {}", file.string(), failed.message()));
  }
  uploads.add(*copy);
  return copy;
}

Result<void> Routes::begin_with(const fs::path& file) {
  const bool is_job = file.extension() == ".json";
  fs::path model_file = file, profile;
  if (is_job) {
    const auto job = read_job(file);
    if (!job) return tl::unexpected(job.error());
    model_file = job->model;
    profile = job->profile;
    begun_job_ = without_files(bytes_of(file));
  }
  auto model = copy_of(models_, model_file);
  if (!model) return tl::unexpected(model.error());
  begun_ = std::move(*model);
  if (profile.empty()) return {};
  auto copied = copy_of(profiles_, profile);
  if (!copied) return tl::unexpected(copied.error());
  begun_profile_ = std::move(*copied);
  return {};
}

void Routes::give_token(Response& response, const Ask& ask) {
  if (ticket_.take(ask.name)) return answer_json(response, {{"token", guard_.token()}});
  refuse(response, unauthorized, Ending::usage, "that address was used before, or is too old");
}

void Routes::start(Response& response) {
  Json fixtures = Json::array(), materials = Json::array(), processes = Json::array();
  for (const std::string& name : fixture_names(places_.fixtures)) fixtures.push_back({{"name", name}});
  for (const char* name : {"pla", "petg", "abs", "asa", "tpu", "resin", "pa12"}) materials.push_back(name);
  for (const char* name : {"fdm", "sla", "powder", "binder"})
    processes.push_back({{"name", name}, {"wall_mm", wall_of_process(name).value_or(0)}});
  answer_json(response, {{"version", APLOMB_VERSION},
                         {"model", json_of(begun_)},
                         {"profile", json_of(begun_profile_)},
                         {"job", begun_job_.empty() ? Json() : Json::parse(begun_job_)},
                         {"fixtures", std::move(fixtures)},
                         {"limits", {{"upload_bytes", guard_.most_body_bytes()}, {"max_triangles", most_triangles}}},
                         {"materials", std::move(materials)},
                         {"processes", std::move(processes)}});
}

std::optional<Upload> Routes::receive(Uploads& uploads, const Request& request, Response& response,
                                      const ContentReader& reader) {
  if (const std::string why = no_room(request, places_.models); !why.empty()) {
    refuse(response, broken, Ending::unusable_input, why);
    return std::nullopt;
  }
  const auto begun = uploads.begin(request.get_param_value("name"));
  if (!begun) {
    refuse(response, broken, Ending::unusable_input, begun.error().message);
    return std::nullopt;
  }
  std::ofstream file(begun->file(), std::ios::binary);
  bool is_written = true;
  const bool is_whole = read_body(reader, guard_.most_body_bytes(), [&](std::string_view part) {
    return is_written = static_cast<bool>(file.write(part.data(), static_cast<std::streamsize>(part.size())));
  });
  file.close();
  if (is_whole && is_written && file) return *begun;
  Uploads::drop(*begun);
  if (!is_written || !file) refuse(response, broken, Ending::unusable_input, "there is no place for the file");
  else
    refuse(response, too_large, Ending::over_budget,
           fmt::format("a file may have up to {} MB here, and is to come whole", guard_.most_body_bytes() >> 20));
  return std::nullopt;
}

void Routes::take_model(const Request& request, Response& response, const ContentReader& reader) {
  const auto model = receive(models_, request, response, reader);
  if (!model) return;
  models_.add(*model);
  answer_json(response, json_of(*model));
}

/// One that makes no sense is refused before anything is asked of it.
void Routes::take_profile(const Request& request, Response& response, const ContentReader& reader) {
  const auto profile = receive(profiles_, request, response, reader);
  if (!profile) return;
  const std::string path = profile->file().string();
  if (const auto read = read_profile(path); !read) {
    Uploads::drop(*profile);
    const bool names_it = read.error().message.starts_with(path);
    return refuse(response, bad_request, ending_of(read.error()),
                  names_it ? profile->name + read.error().message.substr(path.size()) : read.error().message);
  }
  profiles_.add(*profile);
  answer_json(response, json_of(*profile));
}

void Routes::take_fixture(Response& response, const Ask& ask) {
  const auto names = fixture_names(places_.fixtures);
  if (std::ranges::find(names, ask.name) == names.end())
    return refuse(response, not_found, Ending::usage, "there is no fixture of that name");
  const auto model = copy_of(models_, places_.fixtures / ask.name);
  if (!model) return refuse(response, broken, Ending::unusable_input, model.error().message);
  answer_json(response, json_of(*model));
}

std::optional<Made> Routes::made_of(const Ask& ask) { return made_ && same_work(made_of_, ask) ? made_ : std::nullopt; }

std::optional<Work> Routes::work_of(const Ask& ask, Response& response) {
  const auto model = models_.find(ask.model);
  const auto profile = ask.profile == 0 ? std::nullopt : profiles_.find(ask.profile);
  if (model && (profile || ask.profile == 0)) return Work{*model, profile, ask.job};
  refuse(response, conflict, Ending::usage, model ? "that profile is no longer here" : "that model is no longer here");
  return std::nullopt;
}

void Routes::take_away(Response& response, const Ask& ask) {
  const auto work = work_of(ask, response);
  if (!work) return;
  if (ask.what == "job")
    return answer_file(response, job_text(*work, JobReader::person), work->model.stem() + "-job.json",
                       "application/json");
  const std::lock_guard lock(made_mutex_);  // a newer run removes the files of this one
  const auto made = made_of(ask);
  if (!made) return refuse(response, conflict, Ending::usage, "make it stand first: there is no result of this job");
  if (ask.what == "stl" && fs::exists(made->dense()))
    return refuse(response, conflict, Ending::usage, "an STL cannot hold ballast: take the 3MF");
  const fs::path file = ask.what == "3mf" ? made->mesh() : ask.what == "stl" ? made->stl() : made->page();
  if (ask.what != "3mf" && ask.what != "stl" && ask.what != "html")
    return refuse(response, bad_request, Ending::usage, "what there is to take: 3mf, stl, job or html");
  if (!fs::exists(file) && !fs::exists(made->mesh()))
    return refuse(response, conflict, Ending::cannot_stand, "nothing was written, for it does not stand");
  if (!fs::exists(file)) return refuse(response, conflict, Ending::usage, "its page is not drawn: make it stand again");
  const char* type = ask.what == "3mf" ? "model/3mf" : ask.what == "stl" ? "model/stl" : "text/html";
  if (!answer_file(response, file, type)) refuse(response, broken, Ending::internal, "what was written is gone");
}

}  // namespace aplomb::studio
