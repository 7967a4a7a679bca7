#include "aplomb/inserts/insert.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace aplomb {
namespace {

constexpr double steel_g_per_cm3 = 7.85;
constexpr double densest_g_per_cm3 = 22.6;  // osmium
constexpr int most_of_a_kind = 100;

struct Coin {
  std::string_view name;
  double diameter_mm, thickness_mm, mass_g;
};
constexpr std::array<Coin, 4> coins{Coin{"penny", 19.05, 1.52, 2.5},
                                    {"nickel", 21.21, 1.95, 5.0},
                                    {"dime", 17.91, 1.35, 2.268},
                                    {"quarter", 24.26, 1.75, 5.67}};

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(at, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

/// A number that the unit follows, or may follow.
std::optional<double> number(std::string_view text, std::string_view unit, bool needs_unit) {
  double value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  const std::string_view after(rest, static_cast<std::size_t>(text.data() + text.size() - rest));
  return after == unit || (after.empty() && !needs_unit) ? std::optional(value) : std::nullopt;
}

std::optional<int> count(std::string_view text) {
  int value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && rest == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::optional<Insert> coin_named(std::string_view name) {
  for (const Coin& coin : coins)
    if (coin.name == name)
      return Insert{std::string(name), Insert::Shape::disc, coin.diameter_mm, coin.thickness_mm, coin.mass_g};
  return std::nullopt;
}

/// "10mm" or "19.05x1.52mm", of steel.
std::optional<Insert> insert_of(std::string_view kind, std::string_view size) {
  Insert insert;
  if (kind == "ball") {
    const auto diameter = number(size, "mm", false);
    if (!diameter) return std::nullopt;
    insert = {fmt::format("ball {:g} mm", *diameter), Insert::Shape::ball, *diameter, *diameter, 0};
  } else {
    const std::size_t cross = size.find('x');
    if (kind != "coin" || cross == std::string_view::npos) return std::nullopt;
    const auto diameter = number(size.substr(0, cross), "mm", false),
               thickness = number(size.substr(cross + 1), "mm", false);
    if (!diameter || !thickness) return std::nullopt;
    insert = {fmt::format("coin {:g} x {:g} mm", *diameter, *thickness), Insert::Shape::disc, *diameter, *thickness, 0};
  }
  insert.mass_g = steel_g_per_cm3 * 1e-3 * volume_mm3(insert);
  return insert;
}

}  // namespace

double volume_mm3(const Insert& insert) {
  const double disc = std::numbers::pi / 4 * insert.diameter_mm * insert.diameter_mm * insert.height_mm;
  return insert.shape == Insert::Shape::ball ? disc * 2 / 3 : disc;
}

double density_g_per_cm3(const Insert& insert) { return 1e3 * insert.mass_g / volume_mm3(insert); }

std::string find_problem(const InsertStock& stock) {
  const Insert& insert = stock.insert;
  for (const auto& [what, size] : {std::pair{"diameter", insert.diameter_mm}, {"height", insert.height_mm}})
    if (!(size >= 0.5 && size <= 500))
      return fmt::format("the insert's {} is {:g} mm; it must lie in [0.5, 500]", what, size);
  const double density = density_g_per_cm3(insert);
  if (!(insert.mass_g > 0 && density <= densest_g_per_cm3))
    return fmt::format("the insert weighs {:g} g, which is {:.3g} g/cm3; that must lie in (0, {:g}]", insert.mass_g,
                       density, densest_g_per_cm3);
  if (stock.most < 1 || stock.most > most_of_a_kind)
    return fmt::format("there are {} inserts of a kind; it must be 1 to {}", stock.most, most_of_a_kind);
  return {};
}

Result<InsertStock> parse_insert(std::string_view text) {
  const auto refuse = [&](const std::string& why) {
    return fail(ErrorCode::invalid_option, fmt::format("insert '{}': {}", text, why));
  };
  constexpr const char* forms =
      "it is none of penny:4 (or nickel, dime, quarter), ball:10mm:6 and coin:19.05x1.52mm:2.5g:4";
  const auto parts = split(text, ':');
  std::size_t next = 1;
  auto insert = coin_named(parts.front());
  if (!insert && parts.size() > 1) {
    insert = insert_of(parts[0], parts[1]);
    next = 2;
    if (const auto mass = insert && parts.size() > 2 ? number(parts[2], "g", true) : std::nullopt)
      insert->mass_g = *mass, next = 3;
  }
  if (!insert || parts.size() > next + 1) return refuse(forms);
  InsertStock stock{*insert, 1};
  if (next < parts.size()) {
    const auto most = count(parts[next]);
    if (!most) return refuse(forms);
    stock.most = *most;
  }
  if (const std::string problem = find_problem(stock); !problem.empty()) return refuse(problem);
  return stock;
}

}  // namespace aplomb
