#include "server/routes.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

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

Json json_of(const Model& model) {
  std::error_code ignored;
  return {{"id", model.id}, {"name", model.name}, {"bytes", fs::file_size(model.file(), ignored)}};
}

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

}  // namespace

Routes::Routes(Places places, Guard guard, std::function<void()> quit)
    : places_(std::move(places)),
      guard_(std::move(guard)),
      quit_(std::move(quit)),
      models_(places_.models),
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
  server.Get("/api/start", [this](const Request&, Response& response) { start(response); });
  server.Post("/api/model", [this](const Request& request, Response& response, const ContentReader& reader) {
    take_upload(request, response, reader);
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

Result<Model> Routes::copy_of(const fs::path& file) {
  auto model = models_.begin(file.filename().string());
  if (!model) return model;
  std::error_code failed;
  fs::copy_file(file, model->file(), failed);
  if (failed)
    return fail(ErrorCode::file_system, fmt::format("{} cannot be read: {}", file.string(), failed.message()));
  return model;
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
  auto model = copy_of(model_file);
  if (!model) return tl::unexpected(model.error());
  if (!profile.empty()) {
    model->profile = safe_name(profile.filename().string());
    if (model->profile == model->name) model->profile += ".profile";
    std::error_code failed;
    fs::copy_file(profile, model->folder / model->profile, failed);
    if (failed) return fail(ErrorCode::file_system, fmt::format("{} cannot be read", profile.string()));
  }
  models_.add(*model);
  begun_ = std::move(*model);
  return {};
}

void Routes::start(Response& response) {
  Json fixtures = Json::array(), materials = Json::array(), processes = Json::array();
  for (const std::string& name : fixture_names(places_.fixtures)) fixtures.push_back({{"name", name}});
  for (const char* name : {"pla", "petg", "abs", "asa", "tpu", "resin", "pa12"}) materials.push_back(name);
  for (const char* name : {"fdm", "sla", "powder", "binder"})
    processes.push_back({{"name", name}, {"wall_mm", wall_of_process(name).value_or(0)}});
  answer_json(response, {{"version", APLOMB_VERSION},
                         {"model", begun_ ? json_of(*begun_) : Json()},
                         {"job", begun_job_.empty() ? Json() : Json::parse(begun_job_)},
                         {"fixtures", std::move(fixtures)},
                         {"limits", {{"upload_bytes", guard_.most_body_bytes()}, {"max_triangles", most_triangles}}},
                         {"materials", std::move(materials)},
                         {"processes", std::move(processes)}});
}

void Routes::take_upload(const Request& request, Response& response, const ContentReader& reader) {
  const auto model = models_.begin(request.get_param_value("name"));
  if (!model) return refuse(response, broken, Ending::unusable_input, model.error().message);
  std::ofstream file(model->file(), std::ios::binary);
  bool is_written = true;
  const bool is_whole = read_body(reader, guard_.most_body_bytes(), [&](std::string_view part) {
    return is_written = static_cast<bool>(file.write(part.data(), static_cast<std::streamsize>(part.size())));
  });
  file.close();
  if (is_whole && is_written && file) {
    models_.add(*model);
    return answer_json(response, json_of(*model));
  }
  std::error_code ignored;
  fs::remove_all(model->folder, ignored);
  if (!is_written || !file) return refuse(response, broken, Ending::unusable_input, "there is no place for the model");
  refuse(response, too_large, Ending::over_budget,
         fmt::format("a file may have up to {} MB here, and is to come whole", guard_.most_body_bytes() >> 20));
}

void Routes::take_fixture(Response& response, const Ask& ask) {
  const auto names = fixture_names(places_.fixtures);
  if (std::ranges::find(names, ask.name) == names.end())
    return refuse(response, not_found, Ending::usage, "there is no fixture of that name");
  const auto model = copy_of(places_.fixtures / ask.name);
  if (!model) return refuse(response, broken, Ending::unusable_input, model.error().message);
  models_.add(*model);
  answer_json(response, json_of(*model));
}

std::optional<Made> Routes::made_of(const Ask& ask) {
  if (!made_ || made_of_.model != ask.model || !same_json(made_of_.job, ask.job)) return std::nullopt;
  return made_;
}

void Routes::take_away(Response& response, const Ask& ask) {
  const auto model = models_.find(ask.model);
  if (!model) return refuse(response, conflict, Ending::usage, "that model is no longer here");
  if (ask.what == "job")
    return answer_file(response, job_file_text(ask.job, *model, true, false), model->stem() + "-job.json",
                       "application/json");
  const std::lock_guard lock(made_mutex_);  // a newer run removes the files of this one
  const auto made = made_of(ask);
  if (!made) return refuse(response, conflict, Ending::usage, "make it stand first: there is no result of this job");
  if (ask.what == "stl" && fs::exists(made->dense()))
    return refuse(response, conflict, Ending::usage, "an STL cannot hold ballast: take the 3MF");
  const fs::path file = ask.what == "3mf" ? made->mesh() : ask.what == "stl" ? made->stl() : made->page();
  if (ask.what != "3mf" && ask.what != "stl" && ask.what != "html")
    return refuse(response, bad_request, Ending::usage, "what there is to take: 3mf, stl, job or html");
  if (!fs::exists(file))
    return refuse(response, conflict, Ending::cannot_stand, "nothing was written, for it does not stand");
  const char* type = ask.what == "3mf" ? "model/3mf" : ask.what == "stl" ? "model/stl" : "text/html";
  answer_file(response, bytes_of(file), file.filename().string(), type);
}

}  // namespace aplomb::studio
