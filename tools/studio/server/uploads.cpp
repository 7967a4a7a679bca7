#include "server/uploads.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

namespace aplomb::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_name_bytes = 100, most_extension_bytes = 8, uploads_kept = 8;

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

std::uintmax_t size_of(const Upload& upload) {
  std::error_code failed;
  const std::uintmax_t bytes = fs::file_size(upload.file(), failed);
  return failed ? 0 : bytes;
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

Result<Upload> Uploads::begin(std::string_view name) {
  Upload upload;
  {
    const std::lock_guard lock(mutex_);
    upload.id = ++last_id_;
  }
  upload.name = safe_name(name);
  upload.folder = folder_ / fmt::format("{}-{}", kind_, upload.id);
  std::error_code failed;
  fs::create_directory(upload.folder, failed);
  if (failed)
    return fail(ErrorCode::file_system, fmt::format("there is no place for the {}: {}", kind_, failed.message()));
  return upload;
}

void Uploads::drop(const Upload& upload) {
  std::error_code ignored;
  fs::remove_all(upload.folder, ignored);
}

void Uploads::add(const Upload& upload) {
  const std::lock_guard lock(mutex_);
  kept_.push_back(upload);
  std::uintmax_t bytes = 0;
  std::size_t kept = 0;  // from the newest on
  for (auto at = kept_.rbegin(); at != kept_.rend() && kept < uploads_kept; ++at, ++kept) {
    bytes += size_of(*at);
    if (kept > 0 && bytes > most_bytes_) break;
  }
  for (; kept_.size() > kept; kept_.pop_front()) drop(kept_.front());
}

std::optional<Upload> Uploads::find(int id) {
  const std::lock_guard lock(mutex_);
  const auto at = std::ranges::find(kept_, id, &Upload::id);
  if (at == kept_.end()) return std::nullopt;
  std::rotate(at, at + 1, kept_.end());
  return kept_.back();
}

}  // namespace aplomb::studio
