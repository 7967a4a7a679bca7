#include "aplomb/input.h"

#include <fmt/format.h>

#include <algorithm>

#include "aplomb/balance/resting.h"
#include "aplomb/mesh/bodies.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/report/text.h"

namespace aplomb {
namespace {

std::string several_prints(const TriangleMesh& all, const PrintNumbers& prints) {
  const std::size_t listed = std::min<std::size_t>(prints.count, 10);
  std::vector<Box3> boxes(listed);
  std::vector<std::size_t> triangles(listed);
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    const std::uint32_t print = prints.of_triangle[t];
    if (print >= listed) continue;
    ++triangles[print];
    for (const std::uint32_t v : all.triangles[t]) boxes[print].add(all.vertices[v]);
  }
  std::string list;
  for (std::size_t i = 0; i < listed; ++i) {
    const Vec3 size = boxes[i].size();
    list += fmt::format("{}{}: {:.4g} x {:.4g} x {:.4g} mm, {} triangles", i == 0 ? "" : "; ", i + 1, size.x, size.y,
                        size.z, triangles[i]);
  }
  return fmt::format("the file holds {} prints that do not touch ({}{}): choose one with --object N", prints.count,
                     list, prints.count > listed ? "; ..." : "");
}

TriangleMesh all_objects(const MeshFile& file) {
  TriangleMesh all;
  std::size_t vertices = 0, triangles = 0;
  for (const MeshObject& part : file.objects)
    vertices += part.mesh.vertices.size(), triangles += part.mesh.triangles.size();
  all.vertices.reserve(vertices);
  all.triangles.reserve(triangles);
  for (const MeshObject& part : file.objects) all = joined(std::move(all), part.mesh);
  return all;
}

/// Everything in the file that touches is one print. Without a number all of them are taken.
Result<TriangleMesh> choose_print(const MeshFile& file, std::optional<std::size_t> object, const Job& job) {
  TriangleMesh all = all_objects(file);
  if (!object) return all;
  const auto prints = number_prints(all, job);
  if (!prints) return tl::unexpected(prints.error());
  if (*object < 1 || *object > prints->count)
    return fail(ErrorCode::invalid_option,
                fmt::format("--object is {}; the file holds {} prints, counted from 1", *object, prints->count));
  if (prints->count == 1) return all;
  return detail::submesh(all, [&](std::uint32_t t) { return prints->of_triangle[t] == *object - 1; });
}

/// Says that there are several prints where there are: in the solid, and in the mesh that it was made of, for an open
/// surface may look like several until it is repaired.
Result<std::string> find_several(const Repaired& repaired, const TriangleMesh& given, const Job& job) {
  if (repaired.prints.count < 2) return {};
  if (repaired.report.method == RepairMethod::none) return several_prints(repaired.solid.mesh(), repaired.prints);
  const auto prints = number_prints(given, job);
  if (!prints) return tl::unexpected(prints.error());
  return prints->count < 2 ? std::string() : several_prints(given, *prints);
}

/// A unit given by the user replaces the file's, which the reader has applied.
PlacementOptions with_file_unit(PlacementOptions placement, const MeshFile& file) {
  if (placement.unit_mm) placement.unit_mm = *placement.unit_mm / file.unit_mm;
  return placement;
}

}  // namespace

Result<TriangleMesh> load_print(const MeshFile& file, const InputOptions& options, const Job& job) {
  const auto print = choose_print(file, options.object, job);
  if (!print) return tl::unexpected(print.error());
  return place(*print, with_file_unit(options.placement, file)).map([](Placed placed) {
    return std::move(placed.mesh);
  });
}

Result<TriangleMesh> load_print(const std::filesystem::path& path, const InputOptions& options, const Job& job) {
  const auto file = read_mesh(path, options.read, job.part(0, 0.8));
  if (!file) return tl::unexpected(file.error());
  return load_print(*file, options, job.part(0.8, 1));
}

Result<Input> load_solid(const MeshFile& file, const InputOptions& options, const Job& job, const StageViewer& view) {
  StageSeconds seconds;
  StageClock clock(seconds);
  const auto print = choose_print(file, options.object, job.part(0, 0.1));
  if (!print) return tl::unexpected(print.error());
  if (view) view("1-read", *print);
  const auto placed = place(*print, with_file_unit(options.placement, file));
  if (!placed) return tl::unexpected(placed.error());
  if (view) view("2-placed", placed->mesh);
  auto repaired = repair(placed->mesh, options.repair, job.part(0.1, 0.95));
  if (!repaired) return tl::unexpected(repaired.error());
  if (!options.object) {
    auto several = find_several(*repaired, placed->mesh, job.part(0.95, 1));
    if (!several) return tl::unexpected(several.error());
    if (!several->empty()) return fail(ErrorCode::unusable_input, std::move(*several));
  }
  if (view) view("3-solid", repaired->solid.mesh());
  clock.lap("repair");
  Input input{repaired->solid,  repaired->solid.moments(), std::move(repaired->report), file.notes, seconds, {},
              placed->transform};
  if (!options.placement.up && options.hint_at_resting)
    if (const auto hint = resting_hint(input.solid.mesh(), input.moments, {})) input.notes.push_back(to_text(*hint));
  return input;
}

Result<Input> load_solid(const std::filesystem::path& path, const InputOptions& options, const Job& job,
                         const StageViewer& view) {
  StageSeconds seconds;
  StageClock clock(seconds);
  const auto file = read_mesh(path, options.read, job.part(0, 0.3));
  if (!file) return tl::unexpected(file.error());
  clock.lap("read");
  auto input = load_solid(*file, options, job.part(0.3, 1), view);
  if (input) input->stage_seconds.insert(input->stage_seconds.begin(), seconds.begin(), seconds.end());
  return input;
}

}  // namespace aplomb
