#include <fmt/format.h>

#include <string_view>

#include "flags.h"
#include "quantity_flags.h"

namespace aplomb::cli {
namespace {

constexpr const char* form = "X,Y,Z[,R]:lock or X,Y,Z[,R] with any of :to=X,Y,Z :turn=X,Y,Z :scale=S";

BallRegion ball_of(const std::string& flag, const std::string& text, std::size_t least, const char* form_of_ball) {
  const auto n = numbers_of(flag, text, least, 4, form_of_ball);
  return {{n[0], n[1], n[2]}, n.size() == 4 ? n[3] : 0};
}

Vec3 vec_of(const std::string& text, const char* what) {
  const auto n = numbers_of("--handle", text, 3, 3, what);
  return {n[0], n[1], n[2]};
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == ':') parts.emplace_back();
    else parts.back() += c;
  return parts;
}

void take_change(Handle& handle, const std::string& change) {
  const std::size_t equals = change.find('=');
  const std::string name = change.substr(0, equals);
  const std::string value = equals == std::string::npos ? "" : change.substr(equals + 1);
  if (name == "to") handle.to_mm = vec_of(value, "to=X,Y,Z in mm");
  else if (name == "turn")
    handle.turns = turns_about_xyz(angles.front().factor * vec_of(value, "turn=X,Y,Z in degrees"));
  else if (name == "scale") handle.scale_ratio = numbers_of("--handle", value, 1, 1, "scale=S")[0];
  else throw CLI::ValidationError("--handle", fmt::format("'{}' is no change; it is {}", change, form));
}

void take_handle(Regions& regions, const std::string& text) {
  const std::vector<std::string> parts = split(text);
  const BallRegion at = ball_of("--handle", parts[0], 3, "X,Y,Z[,R] in mm");
  if (parts.size() == 2 && parts[1] == "lock") return regions.locked.push_back(at);
  if (parts.size() == 1) throw CLI::ValidationError("--handle", fmt::format("'{}' is not {}", text, form));
  Handle& handle = regions.handles.emplace_back();
  handle.at = at;
  for (std::size_t i = 1; i < parts.size(); ++i) take_change(handle, parts[i]);
}

}  // namespace

void add_region_flags(CLI::App* app, Regions& regions) {
  app->add_option_function<std::vector<std::string>>(
      "--keep",
      [&regions](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) regions.kept.push_back(ball_of("--keep", text, 4, "X,Y,Z,R in mm"));
      },
      "a ball X,Y,Z,R in mm that a bend leaves in shape, such as a face");
  app->add_option_function<std::vector<std::string>>(
      "--handle",
      [&regions](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) take_handle(regions, text);
      },
      fmt::format("a ball (or point) that a bend moves, turns in degrees, scales, or does not touch: {}", form));
}

}  // namespace aplomb::cli
