#include "server/models.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

namespace aplomb::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_name_bytes = 100, most_extension_bytes = 8, models_kept = 8;

/// The longest beginning of at most so many bytes that cuts no character in two.
std::string beginning(const std::string& text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0) == 0x80) --bytes;
  return text.substr(0, bytes);
}

bool is_utf8(const std::string& text) {
  try {
    return !nlohmann::json(text).dump().empty();
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

}  // namespace

std::string safe_name(std::string_view name) {
  if (const auto slash = name.find_last_of("/\\"); slash != std::string_view::npos) name.remove_prefix(slash + 1);
  std::string clean(name);
  std::erase_if(clean, [](unsigned char c) { return c < 0x20 || c == 0x7F; });
  if (!is_utf8(clean))
    std::ranges::replace_if(
        clean, [](unsigned char c) { return c >= 0x80; }, '_');
  clean.erase(0, std::min(clean.find_first_not_of(" .-"), clean.size()));
  const fs::path path(clean);
  const std::string extension = beginning(path.extension().string(), most_extension_bytes);
  const std::string stem = beginning(path.stem().string(), most_name_bytes - extension.size());
  return (stem.empty() ? "model" : stem) + extension;
}

Result<Model> Models::begin(std::string_view name) {
  Model model;
  {
    const std::lock_guard lock(mutex_);
    model.id = ++last_id_;
  }
  model.name = safe_name(name);
  model.folder = folder_ / fmt::format("model-{}", model.id);
  std::error_code failed;
  fs::create_directory(model.folder, failed);
  if (failed) return fail(ErrorCode::file_system, "there is no place for the model: " + failed.message());
  return model;
}

void Models::add(const Model& model) {
  const std::lock_guard lock(mutex_);
  kept_.push_back(model);
  if (kept_.size() <= models_kept) return;
  std::error_code ignored;
  fs::remove_all(kept_.front().folder, ignored);
  kept_.pop_front();
}

std::optional<Model> Models::find(int id) {
  const std::lock_guard lock(mutex_);
  const auto at = std::ranges::find(kept_, id, &Model::id);
  if (at == kept_.end()) return std::nullopt;
  std::rotate(at, at + 1, kept_.end());
  return kept_.back();
}

}  // namespace aplomb::studio
