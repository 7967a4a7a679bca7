#include "aplomb/input.h"

#include <fmt/format.h>

#include "aplomb/balance/resting.h"
#include "aplomb/mesh/bodies.h"
#include "aplomb/report/text.h"

namespace aplomb {
namespace {

std::string several_prints(const std::vector<TriangleMesh>& prints) {
  std::string list;
  for (std::size_t i = 0; i < prints.size() && i < 10; ++i) {
    const Vec3 size = bounding_box(prints[i]).size();
    list += fmt::format("{}{}: {:.4g} x {:.4g} x {:.4g} mm, {} triangles", i == 0 ? "" : "; ", i + 1, size.x, size.y,
                        size.z, prints[i].triangles.size());
  }
  return fmt::format("the file holds {} prints that do not touch ({}{}): choose one with --object N", prints.size(),
                     list, prints.size() > 10 ? "; ..." : "");
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

/// Everything in the file that touches is one print. Without a number all of them are taken, and `several` says how
/// many there are: an open surface may look like several until it is repaired.
Result<TriangleMesh> choose_print(const MeshFile& file, std::optional<std::size_t> object, std::string& several) {
  TriangleMesh all = all_objects(file);
  std::vector<TriangleMesh> prints = split_prints(all);
  if (!object) {
    if (prints.size() > 1) several = several_prints(prints);
    return all;
  }
  if (*object < 1 || *object > prints.size())
    return fail(ErrorCode::invalid_option,
                fmt::format("--object is {}; the file holds {} prints, counted from 1", *object, prints.size()));
  return std::move(prints[*object - 1]);
}

/// A unit given by the user replaces the file's, which the reader has applied.
PlacementOptions with_file_unit(PlacementOptions placement, const MeshFile& file) {
  if (placement.unit_mm) placement.unit_mm = *placement.unit_mm / file.unit_mm;
  return placement;
}

}  // namespace

Result<TriangleMesh> load_print(const MeshFile& file, const InputOptions& options) {
  std::string several;
  const auto print = choose_print(file, options.object, several);
  if (!print) return tl::unexpected(print.error());
  return place(*print, with_file_unit(options.placement, file)).map([](Placed placed) {
    return std::move(placed.mesh);
  });
}

Result<TriangleMesh> load_print(const std::filesystem::path& path, const InputOptions& options, const Job& job) {
  const auto file = read_mesh(path, options.read, job);
  if (!file) return tl::unexpected(file.error());
  return load_print(*file, options);
}

Result<Input> load_solid(const MeshFile& file, const InputOptions& options, const Job& job, const StageViewer& view) {
  StageSeconds seconds;
  StageClock clock(seconds);
  std::string several;
  const auto print = choose_print(file, options.object, several);
  if (!print) return tl::unexpected(print.error());
  if (view) view("1-read", *print);
  const auto placed = place(*print, with_file_unit(options.placement, file));
  if (!placed) return tl::unexpected(placed.error());
  if (view) view("2-placed", placed->mesh);
  auto repaired = repair(placed->mesh, options.repair, job);
  if (!repaired) return tl::unexpected(repaired.error());
  if (!several.empty() && split_prints(repaired->solid.mesh()).size() > 1)
    return fail(ErrorCode::unusable_input, std::move(several));
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
