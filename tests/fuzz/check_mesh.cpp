#include "check_mesh.h"

#include <cmath>
#include <limits>

#include "aplomb/io/read_mesh.h"
#include "checks.h"

namespace aplomb::fuzz {

void check_mesh(std::span<const std::byte> bytes, std::string_view name) {
  const auto file = read_mesh(bytes, name, {.max_triangles = 100'000, .memory_bytes = std::size_t{64} << 20});
  if (!file) return check_refusal(file.error(), name);
  promise(!file->objects.empty(), "at least one object");
  for (const MeshObject& object : file->objects) {
    promise(!object.mesh.triangles.empty(), "no object without triangles");
    for (const Triangle& triangle : object.mesh.triangles)
      for (const std::uint32_t corner : triangle) promise(corner < object.mesh.vertices.size(), "indices in range");
    for (const Vec3& v : object.mesh.vertices)
      for (int axis = 0; axis < 3; ++axis)
        promise(std::abs(v[axis]) <= std::numeric_limits<float>::max(), "coordinates that float32 holds");
  }
  for (const std::string& note : file->notes) check_error({ErrorCode::unusable_input, note});
}

}  // namespace aplomb::fuzz
