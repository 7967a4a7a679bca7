#include "aplomb/job/job_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "aplomb/core/printable.h"
#include "aplomb/job/detail/degrees.h"
#include "aplomb/job/detail/job_table.h"

namespace aplomb {
namespace {

using Json = nlohmann::ordered_json;  // as it is written; it searches all keys for each
using ReadJson = nlohmann::json;
using detail::degree;
using detail::degrees_of;
namespace fs = std::filesystem;

constexpr std::array<const char*, 6> up_names{"x", "y", "z", "-x", "-y", "-z"};  // in UpAxis' order

template <class Names>
std::size_t index_of(const Names& names, const std::string& name) {
  std::size_t i = 0;
  while (i + 1 < names.size() && name != names[i]) ++i;
  return i;
}

Vec3 axis(std::size_t up_name) {
  Vec3 v;
  v[static_cast<int>(up_name % 3)] = up_name < 3 ? 1 : -1;
  return v;
}

Vec3 vec_of(const ReadJson& json) { return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()}; }
Json json_of(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

/// Puts what the JSON has into the fields it is shown. \pre The JSON has passed the schema.
class Reader {
 public:
  Reader(const ReadJson& json, const fs::path& folder) : json_(json), folder_(folder) {}

  template <class T>
  void value(const char* key, T& field) const {
    if (const auto at = json_.find(key); at != json_.end()) field = at->template get<T>();
  }
  template <class T>
  void value(const char* key, std::optional<T>& field) const {
    if (const auto at = json_.find(key); at != json_.end()) field = at->template get<T>();
  }
  void path(const char* key, fs::path& field) const {
    if (const auto at = json_.find(key); at != json_.end()) field = at->get<std::string>();
    if (!field.empty() && field != "-" && field.is_relative() && json_.contains(key)) field = folder_ / field;
  }
  void angle(const char* key, double& field_rad) const {
    if (const auto at = json_.find(key); at != json_.end()) field_rad = at->get<double>() * degree;
  }
  template <class Ratio>
  void percent(const char* key, Ratio& field_ratio) const {
    if (const auto at = json_.find(key); at != json_.end()) field_ratio = at->get<double>() / 100;
  }
  void turns(const char* key, std::vector<AxisTurn>& field) const {
    if (const auto at = json_.find(key); at != json_.end()) field = turns_about_xyz(degree * vec_of(*at));
  }
  void direction(const char* key, Vec3& field) const {
    const auto at = json_.find(key);
    if (at == json_.end()) return;
    field = at->is_string() ? axis(index_of(up_names, at->get<std::string>())) : vec_of(*at);
    if (const double length = norm(field); length > 0 && std::abs(length - 1) > 1e-12) field = field / length;
  }
  void up(const char* key, std::optional<UpAxis>& field) const {
    if (const auto at = json_.find(key); at != json_.end()) field = up_axis_named(at->get<std::string>());
  }
  template <class Enum, class Names>
  void name(const char* key, const Names& names, Enum& field) const {
    if (const auto at = json_.find(key); at != json_.end())
      field = static_cast<Enum>(index_of(names, at->get<std::string>()));
  }
  template <class Enum, class Names>
  void name(const char* key, const Names& names, std::optional<Enum>& field) const {
    if (json_.contains(key)) name(key, names, field.emplace());
  }
  void memory(const char* key, std::size_t& field_bytes) const {
    if (const auto at = json_.find(key); at != json_.end())
      field_bytes = static_cast<std::size_t>(std::llround(at->get<double>() * 1e6));
  }
  void preset(const char* key, double& field, std::optional<double> (*named)(std::string_view)) const {
    if (const auto at = json_.find(key); at != json_.end()) field = named(at->get<std::string>()).value_or(field);
  }
  template <class Point>
  void point(const char* key, Point& field) const {
    if (const auto at = json_.find(key); at != json_.end()) field = vec_of(*at);
  }
  void points(const char* key, std::vector<Vec3>& field) const {
    if (const auto at = json_.find(key); at != json_.end())
      for (const ReadJson& point : *at) field.push_back(vec_of(point));
  }
  template <class Item, class Visit>
  void list(const char* key, std::vector<Item>& field, const Visit& visit) const {
    if (const auto at = json_.find(key); at != json_.end())
      for (const ReadJson& item : *at) visit(Reader(item, folder_), field.emplace_back());
  }
  template <class Visit>
  void group(const char* key, const Visit& visit) const {
    if (const auto at = json_.find(key); at != json_.end()) visit(Reader(*at, folder_));
  }
  template <class VisitPose>
  void poses(const char* key, std::vector<JobPose>& field, const VisitPose& visit) const {
    const auto at = json_.find(key);
    if (at == json_.end()) return;
    field.clear();
    for (const ReadJson& pose : *at) {
      field.emplace_back();
      if (pose.contains("hang")) field.back().pose.way = HangingPose{};
      visit(Reader(pose, folder_), field.back());
    }
  }

 private:
  const ReadJson& json_;
  const fs::path& folder_;
};

/// Puts the fields it is shown into JSON; what is not set has no key.
class Writer {
 public:
  Writer(Json& json, const fs::path& folder) : json_(json), folder_(folder) {}

  template <class T>
  void value(const char* key, const T& field) const {
    json_[key] = field;
  }
  void value(const char* key, const std::string& field) const {
    if (!field.empty()) json_[key] = field;
  }
  template <class T>
  void value(const char* key, const std::optional<T>& field) const {
    if (field) json_[key] = *field;
  }
  void path(const char* key, const fs::path& field) const {
    if (field.empty()) return;
    json_[key] = field == "-" ? "-" : fs::proximate(fs::absolute(field), fs::absolute(folder_)).generic_string();
  }
  void angle(const char* key, double field_rad) const { json_[key] = degrees_of(field_rad); }
  void percent(const char* key, double field_ratio) const { json_[key] = 100 * field_ratio; }
  void percent(const char* key, const std::optional<double>& field_ratio) const {
    if (field_ratio) percent(key, *field_ratio);
  }
  void turns(const char* key, const std::vector<AxisTurn>& field) const {
    if (field.size() != 3) return;
    json_[key] = Json::array();
    for (const AxisTurn& turn : field) json_[key].push_back(degrees_of(turn.angle_rad));
  }
  void direction(const char* key, Vec3 field) const {
    for (std::size_t i = 0; i < up_names.size(); ++i)
      if (field == axis(i)) return void(json_[key] = up_names[i]);
    json_[key] = json_of(field);
  }
  void up(const char* key, std::optional<UpAxis> field) const {
    if (field) json_[key] = up_names[static_cast<std::size_t>(*field)];
  }
  template <class Enum, class Names>
  void name(const char* key, const Names& names, Enum field) const {
    json_[key] = names[static_cast<std::size_t>(field)];
  }
  template <class Enum, class Names>
  void name(const char* key, const Names& names, const std::optional<Enum>& field) const {
    if (field) name(key, names, *field);
  }
  void memory(const char* key, std::size_t field_bytes) const { json_[key] = static_cast<double>(field_bytes) / 1e6; }
  void preset(const char*, double, std::optional<double> (*)(std::string_view)) const {}  // its number is written
  void point(const char* key, Vec3 field) const { json_[key] = json_of(field); }
  void point(const char* key, const std::optional<Vec3>& field) const {
    if (field) json_[key] = json_of(*field);
  }
  void points(const char* key, const std::vector<Vec3>& field) const {
    json_[key] = Json::array();
    for (const Vec3& point : field) json_[key].push_back(json_of(point));
  }
  template <class Item, class Visit>
  void list(const char* key, std::vector<Item>& field, const Visit& visit) const {
    if (field.empty()) return;
    json_[key] = Json::array();
    for (Item& item : field) {
      Json inner = Json::object();
      visit(Writer(inner, folder_), item);
      json_[key].push_back(std::move(inner));
    }
  }
  template <class Visit>
  void group(const char* key, const Visit& visit) const {
    Json inner = Json::object();
    visit(Writer(inner, folder_));
    if (!inner.empty()) json_[key] = std::move(inner);
  }
  template <class VisitPose>
  void poses(const char* key, std::vector<JobPose>& field, const VisitPose& visit) const {
    json_[key] = Json::array();
    for (JobPose& pose : field) {
      Json inner = Json::object();
      visit(Writer(inner, folder_), pose);
      json_[key].push_back(std::move(inner));
    }
  }

 private:
  Json& json_;
  const fs::path& folder_;
};

/// JSON's own functions call themselves as deep as it nests; a job nests six deep.
bool nests_too_deep(std::string_view text) {
  constexpr int most_levels = 100;
  int level = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') in_string = !in_string;
    else if (in_string) i += text[i] == '\\' ? 1 : 0;
    else if (text[i] == '[' || text[i] == '{') ++level;
    else if (text[i] == ']' || text[i] == '}') --level;
    if (level > most_levels) return true;
  }
  return false;
}

}  // namespace

Result<JobFile> parse_job(std::string_view text, const fs::path& folder) {
  if (nests_too_deep(text))
    return fail(ErrorCode::invalid_option,
                "the job nests deeper than 100 levels, which no job needs; save it anew (--save-job)");
  ReadJson json;
  try {
    json = ReadJson::parse(text);
  } catch (const ReadJson::exception& error) {  // "[json.exception.parse_error.101] parse error at line 1, ..."
    const std::string what = error.what();
    return fail(ErrorCode::invalid_option, "the job is no JSON:" + printable(what.substr(what.find(']') + 1), 300) +
                                               "; mend it there, or save it anew (--save-job)");
  }
  if (std::string problem = find_schema_problem(text); !problem.empty())
    return fail(ErrorCode::invalid_option, std::move(problem));
  JobFile job;
  detail::visit_job(Reader(json, folder), job);
  job.input.read.memory_bytes = job.options.memory_bytes;
  for (std::size_t i = 0; i < job.poses.size(); ++i)
    if (std::string problem = find_problem(std::span(&job.poses[i].pose, 1)); !problem.empty())
      return fail(ErrorCode::invalid_option,
                  fmt::format("poses[{}].{}: {}", i, job.poses[i].pose.hanging() ? "hang" : "stand", problem));
  if (std::string problem = find_problem(job); !problem.empty())
    return fail(ErrorCode::invalid_option, std::move(problem));
  const StandingPose* first = job.poses.front().pose.standing();
  job.input.hint_at_resting = first && first->up == Vec3{0, 0, 1};
  return job;
}

std::string to_json(const JobFile& job, const fs::path& folder) {
  Json json{{"aplomb_job", 1}};
  JobFile shown = job;  // one table of fields for both ways
  detail::visit_job(Writer(json, folder), shown);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace aplomb
