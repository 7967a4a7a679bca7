#include "aplomb/io/read_mesh.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "aplomb/io/detail/readers.h"
#include "aplomb/io/detail/text_cursor.h"
#include "aplomb/io/detail/vertex_index.h"

namespace aplomb {
namespace detail {

MeshFile single_object(std::string format, std::string name, TriangleMesh mesh) {
  MeshFile file;
  file.format = std::move(format);
  file.objects.push_back({std::move(name), std::move(mesh)});
  return file;
}

}  // namespace detail

namespace {

using detail::ReadContext;
using Reader = Result<MeshFile> (*)(ReadContext&);

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

bool is_off_keyword(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N", "4", "n"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  return word == "OFF";
}

bool is_obj_keyword(std::string_view word) {
  constexpr std::string_view kWords[] = {"v", "vn", "vt", "vp", "f", "o", "g", "s", "l", "p", "mtllib", "usemtl"};
  return std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

/// The reader that the first bytes ask for; null where they say nothing.
Reader reader_by_content(std::string_view text, std::span<const std::byte> bytes) {
  if (detail::is_stl_binary_by_size(bytes)) return detail::read_stl_binary;
  if (text.starts_with("PK\x03\x04")) return detail::read_3mf;
  if (text.starts_with("ply\n") || text.starts_with("ply\r")) return detail::read_ply;
  detail::TextCursor cursor(text);
  cursor.skip_to_word();
  const std::string_view word = cursor.word().substr(0, 16);
  const bool has_nul = text.substr(0, 512).find('\0') != text.npos;
  if (lower(std::string(word)) == "solid" && !has_nul) return detail::read_stl_ascii;
  if (is_off_keyword(word)) return detail::read_off;
  if (is_obj_keyword(word) && !has_nul) return detail::read_obj;
  return nullptr;
}

Reader reader_by_extension(std::string_view name) {
  const std::string extension = lower(std::filesystem::path(name).extension().string());
  if (extension == ".stl" || name == "-") return detail::read_stl_binary;
  if (extension == ".obj") return detail::read_obj;
  if (extension == ".ply") return detail::read_ply;
  if (extension == ".off") return detail::read_off;
  if (extension == ".3mf") return detail::read_3mf;
  return nullptr;
}

/// Whether no triangle shares a vertex with another by index, as in a file written corner by corner.
bool is_soup(const TriangleMesh& mesh) {
  if (mesh.triangles.size() < 2 || mesh.vertices.size() != 3 * mesh.triangles.size()) return false;
  std::uint32_t corner = 0;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t index : t)
      if (index != corner++) return false;
  return true;
}

/// What every format has in common after it was read.
Result<MeshFile> finished(MeshFile file, std::string_view name, ReadContext& context) {
  const std::string stem = name == "-" ? "standard input" : std::filesystem::path(name).stem().string();
  std::size_t left_out = std::erase_if(file.objects, [](const MeshObject& o) { return o.mesh.triangles.empty(); });
  if (file.objects.empty()) return context.unusable("", "it holds no triangles; export the model as a surface mesh");
  if (left_out > 0) context.note(std::to_string(left_out) + " objects without triangles were ignored");
  for (MeshObject& object : file.objects) {
    if (object.name.empty()) object.name = stem;
    if (!is_soup(object.mesh)) continue;
    const std::size_t work_bytes = context.work_bytes();
    context.set_work_bytes(work_bytes + object.mesh.vertices.capacity() * sizeof(Vec3) +
                           object.mesh.triangles.capacity() * sizeof(Triangle));
    auto indexed = detail::indexed_by_position(object.mesh, context);
    context.set_work_bytes(work_bytes);
    if (!indexed) return tl::unexpected<Error>(indexed.error());
    object.mesh = std::move(*indexed);
    context.note("every triangle of " + detail::in_quotes(object.name) +
                 " had vertices of its own; equal positions were made one");
  }
  file.notes = context.take_notes();
  return file;
}

tl::unexpected<Error> cannot_read(const std::filesystem::path& path, int error_number) {
  return fail(ErrorCode::file_system, "cannot read " + detail::shown_path(path.string()) + ": " +
                                          std::generic_category().message(error_number));
}

/// Reads to the end, never more than `most` bytes.
Result<std::vector<std::byte>> read_all(int fd, std::size_t expected, std::size_t most,
                                        const std::filesystem::path& path) {
  std::vector<std::byte> bytes;
  bytes.resize(std::min(expected + 1, most));
  std::size_t size = 0;
  for (;;) {
    if (size == bytes.size()) {  // a stream: while it grows, the old and the new buffer live side by side
      const std::size_t larger = std::min(std::max<std::size_t>(65536, 2 * size), most - size);
      if (larger <= size)
        return fail(ErrorCode::over_budget, detail::shown_path(path.string()) + ": larger than the memory budget of " +
                                                std::to_string(most >> 20) +
                                                " MB lets a stream be; allow more memory, or save it as a file");
      bytes.resize(larger);
    }
    const ssize_t got = ::read(fd, bytes.data() + size, std::min(bytes.size() - size, std::size_t{1} << 24));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return cannot_read(path, errno);
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  bytes.resize(size);
  return bytes;
}

Result<std::vector<std::byte>> load(const std::filesystem::path& path, std::size_t most) {
  if (path == "-") return read_all(STDIN_FILENO, 65536, most, "standard input");
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return cannot_read(path, errno);
  struct stat status {};
  const bool known = ::fstat(fd, &status) == 0 && S_ISREG(status.st_mode);
  const std::size_t expected = known ? static_cast<std::size_t>(status.st_size) : 65536;
  auto bytes = expected > most ? fail(ErrorCode::over_budget, detail::shown_path(path.string()) + ": its " +
                                                                  std::to_string(expected >> 20) +
                                                                  " MB exceed the memory budget of " +
                                                                  std::to_string(most >> 20) + " MB; allow more memory")
                               : read_all(fd, expected, most, path);
  ::close(fd);
  return bytes;
}

}  // namespace

std::string find_problem(const ReadOptions& options) {
  if (options.max_triangles < 1 || options.max_triangles > 500'000'000)
    return "max_triangles is " + std::to_string(options.max_triangles) + ", not in 1 .. 500000000";
  if (options.memory_bytes < (std::size_t{1} << 20))
    return "memory_bytes is " + std::to_string(options.memory_bytes) + ", less than 1 MiB";
  return {};
}

Result<MeshFile> read_mesh(std::span<const std::byte> bytes, std::string_view name, const ReadOptions& options,
                           const Job& job) {
  if (std::string problem = find_problem(options); !problem.empty()) return fail(ErrorCode::invalid_option, problem);
  ReadContext context(bytes, name, options, job);
  if (auto admitted = context.admit(0, 0); !admitted) return tl::unexpected<Error>(admitted.error());
  const std::string_view text = context.text();
  if (text.empty()) return context.unusable("", "the file is empty; export the model again");
  Reader reader = reader_by_content(text, bytes);
  if (!reader && (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")))
    return context.unusable("byte 0", "the text is UTF-16; save it as UTF-8 or plain ASCII");
  if (!reader) reader = reader_by_extension(name);
  if (!reader)
    return context.unusable(
        "", "neither its content nor its extension is that of STL, OBJ, PLY, OFF or 3MF; export one of these");
  auto file = reader(context);
  if (!file) return file;
  return finished(std::move(*file), name, context);
}

Result<MeshFile> read_mesh(const std::filesystem::path& path, const ReadOptions& options, const Job& job) {
  if (std::string problem = find_problem(options); !problem.empty()) return fail(ErrorCode::invalid_option, problem);
  const auto bytes = load(path, options.memory_bytes);
  if (!bytes) return tl::unexpected<Error>(bytes.error());
  return read_mesh(*bytes, path.string(), options, job);
}

}  // namespace aplomb
