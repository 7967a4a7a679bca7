#include "aplomb/io/detail/read_context.h"

#include <algorithm>
#include <limits>

#include "aplomb/core/printable.h"
#include "aplomb/io/detail/text_cursor.h"

namespace aplomb::detail {
namespace {

constexpr std::size_t kMaxIndices = std::numeric_limits<std::uint32_t>::max();

std::string megabytes(double bytes) { return std::to_string(static_cast<long long>(bytes / 1048576.0 + 1)) + " MB"; }

}  // namespace

tl::unexpected<Error> ReadContext::unusable(std::string_view place, std::string_view problem) const {
  std::string message = name_;
  if (!place.empty()) message.append(", ").append(place);
  return fail(ErrorCode::unusable_input, message.append(": ").append(problem));
}

Result<Vec3> ReadContext::read_position(TextCursor& text) const {
  Vec3 position;
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = text.number();
    if (!value)
      return unusable(text.place(), "expected a finite coordinate, found " +
                                        (text.at_line_end() ? "the end of the line" : in_quotes(text.peek_word())) +
                                        "; repair or export the model again");
    position[axis] = *value;
  }
  return position;
}

Result<void> ReadContext::admit(std::size_t vertices, std::size_t triangles, std::size_t work_bytes) const {
  if (triangles > options_.max_triangles)
    return fail(ErrorCode::over_budget, name_ + ": holds more than " + std::to_string(options_.max_triangles) +
                                            " triangles, the budget; simplify the model or raise it");
  // In floating point, where no sum wraps around.
  const double bytes = static_cast<double>(vertices) * sizeof(Vec3) +
                       static_cast<double>(triangles) * sizeof(Triangle) + static_cast<double>(work_bytes) +
                       static_cast<double>(work_bytes_) + static_cast<double>(bytes_.size());
  if (bytes > static_cast<double>(options_.memory_bytes) || vertices > kMaxIndices)
    return fail(ErrorCode::over_budget, name_ + ": reading it needs " + megabytes(bytes) + ", the budget is " +
                                            megabytes(static_cast<double>(options_.memory_bytes)) +
                                            "; simplify the model or allow more memory");
  return {};
}

Result<void> ReadContext::admit_polygon(std::size_t corners) const {
  constexpr std::size_t kBytesEach = 48;  // a list that doubles, points and two rings
  return admit(0, corners, kBytesEach * corners);
}

void ReadContext::note(std::string sentence) {
  constexpr std::size_t kEnough = 100;
  if (notes_.size() < kEnough && std::find(notes_.begin(), notes_.end(), sentence) == notes_.end())
    notes_.push_back(std::move(sentence));
}

Result<void> GrowingMesh::reserve(std::size_t vertices, std::size_t triangles) {
  if (auto admitted = context_->admit(vertices, triangles); !admitted) return admitted;
  mesh_.vertices.reserve(vertices);
  mesh_.triangles.reserve(triangles);
  return {};
}

bool GrowingMesh::keep(const Result<void>& admitted) {
  if (!admitted) failure_ = admitted.error();
  return admitted.has_value();
}

bool GrowingMesh::grow_vertices() {
  // While it grows, the old and the new block live side by side.
  const std::size_t now = mesh_.vertices.size(), next = std::max<std::size_t>(64, now + now / 2);
  if (!keep(context_->admit(now + next, mesh_.triangles.capacity()))) return false;
  mesh_.vertices.reserve(next);
  return true;
}

bool GrowingMesh::grow_triangles() {
  const std::size_t now = mesh_.triangles.size(), allowed = context_->options().max_triangles;
  const std::size_t next = std::max(now + 1, std::min(allowed, std::max<std::size_t>(64, now + now / 2)));
  if (!keep(context_->admit(mesh_.vertices.capacity(), next, now * sizeof(Triangle)))) return false;
  mesh_.triangles.reserve(next);
  return true;
}

std::string shown_path(std::string_view path) { return printable(path, path.size()); }

std::string short_name(std::string_view name) {
  constexpr std::size_t kMost = 1000;
  if (name.size() <= kMost) return std::string(name);
  std::size_t end = kMost;
  const auto continues = [name](std::size_t at) { return (static_cast<unsigned char>(name[at]) & 0xC0) == 0x80; };
  while (end > kMost - 4 && continues(end)) --end;
  return std::string(name.substr(0, end));
}

std::string in_quotes(std::string_view text) { return '"' + printable(text) + '"'; }

}  // namespace aplomb::detail
