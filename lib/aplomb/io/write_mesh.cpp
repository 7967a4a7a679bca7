#include "aplomb/io/write_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "aplomb/io/detail/writers.h"

namespace aplomb {
namespace detail {

void TextSink::add(float value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value == 0 ? 0.0f : value).ptr;
  text_.append(digits, end);
}

void TextSink::add(std::uint32_t value) {
  char digits[16];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  text_.append(digits, end);
}

Bytes TextSink::bytes() const {
  const auto* data = reinterpret_cast<const std::byte*>(text_.data());
  return Bytes(data, data + text_.size());
}

namespace {

static_assert(std::endian::native == std::endian::little, "STL and PLY are written as they lie in memory");

constexpr std::size_t kEvery = 65536;  // triangles between two reports

bool proceed(const Job& job, std::size_t done, std::size_t all) {
  return done % kEvery != 0 || job.report(static_cast<double>(done) / static_cast<double>(all), "write");
}

template <class T>
std::byte* put(std::byte* at, const T& value) {
  std::memcpy(at, &value, sizeof value);
  return at + sizeof value;
}

std::byte* put(std::byte* at, Vec3 v) {
  at = put(at, static_cast<float>(v.x));
  at = put(at, static_cast<float>(v.y));
  return put(at, static_cast<float>(v.z));
}

/// As a reader will find it, without negative zeros.
Vec3 as_written(Vec3 v) {
  const auto rounded = [](double x) { return double{static_cast<float>(x)}; };
  return Vec3{rounded(v.x), rounded(v.y), rounded(v.z)} + Vec3{};
}

/// Zero for a triangle without area.
Vec3 facet_normal(const std::array<Vec3, 3>& corners) {
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length = norm(normal);
  return length > 0 && std::isfinite(length) ? normal / length : Vec3{};
}

/// Makes sure of a byte above 127 within bytes 84..211 by the least change to the first normal: the sign of a zero,
/// or the lowest mantissa byte.
void mark_as_binary(Bytes& stl) {
  const auto begin = stl.begin() + 84,
             end = stl.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(212, stl.size()));
  if (std::any_of(begin, end, [](std::byte b) { return b > std::byte{127}; })) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float component = 0;
    std::memcpy(&component, stl.data() + 84 + 4 * axis, sizeof component);
    if (component == 0) {
      put(stl.data() + 84 + 4 * axis, -0.0f);
      return;
    }
  }
  stl[84] |= std::byte{0x80};
}

}  // namespace

Result<Bytes> encode_stl(const TriangleMesh& mesh, const Job& job) {
  Bytes stl(84 + 50 * mesh.triangles.size());
  constexpr std::string_view kHeader = "Binary STL by Aplomb, millimetres, z up";
  std::memcpy(stl.data(), kHeader.data(), kHeader.size());
  std::byte* at = put(stl.data() + 80, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!proceed(job, i, mesh.triangles.size())) return cancelled();
    const Triangle& t = mesh.triangles[i];
    const std::array corners{as_written(mesh.vertices[t[0]]), as_written(mesh.vertices[t[1]]),
                             as_written(mesh.vertices[t[2]])};
    at = put(at, facet_normal(corners));  // of what is written: the same after it is read and written again
    for (const Vec3& corner : corners) at = put(at, corner);
    at += 2;
  }
  mark_as_binary(stl);
  return stl;
}

Result<Bytes> encode_obj(const TriangleMesh& mesh, const WriteOptions& options, const Job& job) {
  TextSink out;
  out.reserve(mesh.vertices.size() * 34 + mesh.triangles.size() * 24 + 200);
  std::string name = options.name;
  for (char& c : name) c = static_cast<unsigned char>(c) < 32 ? ' ' : c;
  out.add("# by Aplomb, millimetres, z up\no ");
  out.add(name);
  out.add("\n");
  for (const Vec3& v : mesh.vertices) {
    out.add("v ");
    for (int axis = 0; axis < 3; ++axis) {
      out.add(static_cast<float>(v[axis]));
      out.add(axis < 2 ? " " : "\n");
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!proceed(job, i, mesh.triangles.size())) return cancelled();
    out.add("f");
    for (const std::uint32_t corner : mesh.triangles[i]) {
      out.add(" ");
      out.add(corner + 1);
    }
    out.add("\n");
  }
  return out.bytes();
}

Result<Bytes> encode_ply(const TriangleMesh& mesh, const Job& job) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment by Aplomb, millimetres, z up\nelement vertex " +
      std::to_string(mesh.vertices.size()) + "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  Bytes ply(header.size() + 12 * mesh.vertices.size() + 13 * mesh.triangles.size());
  std::memcpy(ply.data(), header.data(), header.size());
  std::byte* at = ply.data() + header.size();
  for (const Vec3& v : mesh.vertices) at = put(at, v + Vec3{});
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!proceed(job, i, mesh.triangles.size())) return cancelled();
    *at++ = std::byte{3};
    at = put(at, mesh.triangles[i]);
  }
  return ply;
}

}  // namespace detail

namespace {

bool fits_float(double value) { return std::abs(value) <= std::numeric_limits<float>::max(); }

std::string find_problem(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return "the mesh has no triangles, nothing can be written";
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    return "the mesh has too many triangles; simplify it";
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (!fits_float(mesh.vertices[i][axis]))
        return "vertex " + std::to_string(i) + " lies beyond what a file can hold; scale the model down";
  return {};
}

}  // namespace

Result<MeshFormat> format_of(const std::filesystem::path& path) {
  if (path == "-") return MeshFormat::stl;
  std::string extension = path.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (extension == ".3mf") return MeshFormat::three_mf;
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  return fail(ErrorCode::invalid_option,
              "cannot tell the format of " + path.string() + "; name a file that ends in .3mf, .stl, .obj or .ply");
}

Result<std::vector<std::byte>> encode_mesh(const TriangleMesh& mesh, MeshFormat format, const WriteOptions& options,
                                           const Job& job) {
  if (std::string problem = find_problem(mesh); !problem.empty()) return fail(ErrorCode::unusable_input, problem);
  assert(std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    return t[0] < mesh.vertices.size() && t[1] < mesh.vertices.size() && t[2] < mesh.vertices.size();
  }));
  if (format != MeshFormat::three_mf && (options.modifier || !options.parts.empty()))
    return fail(ErrorCode::invalid_option, "only a 3MF can hold what a slicer is to do within the model; write a .3mf");
  switch (format) {
    case MeshFormat::three_mf:
      return detail::encode_3mf(mesh, options, job);
    case MeshFormat::stl:
      return detail::encode_stl(mesh, job);
    case MeshFormat::obj:
      return detail::encode_obj(mesh, options, job);
    case MeshFormat::ply:
      return detail::encode_ply(mesh, job);
  }
  return fail(ErrorCode::invalid_option, "no such mesh format");
}

Result<void> write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh, const WriteOptions& options,
                        const Job& job) {
  const auto format = format_of(path);
  if (!format) return tl::unexpected<Error>(format.error());
  const auto bytes = encode_mesh(mesh, *format, options, job);
  if (!bytes) return tl::unexpected<Error>(bytes.error());
  return write_file_atomically(path, *bytes, options.on_temp_file);
}

}  // namespace aplomb
