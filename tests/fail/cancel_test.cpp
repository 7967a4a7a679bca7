// Whatever a run is doing, told to stop it stops: at any report, soon, and with nothing but Cancelled to show.
#include <gtest/gtest.h>

#include <cstdlib>

#include "aplomb/balance/landing.h"
#include "aplomb/io/read_mesh.h"
#include "aplomb/job/job_file.h"
#include "support/gcode_files.h"
#include "support/mesh_files.h"
#include "support/patience.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

constexpr double most_end_s = 0.2;
/// Our aim is 0.1; a checked build may take twice that.
constexpr double most_silence_s = 0.2;

/// A whole run as a program makes it, in memory: a job without its model, and the model.
struct WholeRun {
  const char* name;
  const char* keys;
  TriangleMesh (*model)();
  bool is_validation = false, ballast = false;
};

std::ostream& operator<<(std::ostream& out, const WholeRun& run) { return out << run.name; }

TriangleMesh leaning() { return test::leaning_prism(28, 28, 60, 30); }
TriangleMesh upright() { return test::box({0, 0, 0}, {30, 30, 60}); }
TriangleMesh leaning_ball() {
  return transformed(joined(test::box({-12, -12, -45}, {12, 12, -20}), test::sphere({8, 0, 0}, 30, 4)),
                     test::translation({0, 0, 45}));
}
TriangleMesh open_ball() {
  TriangleMesh mesh = leaning_ball();
  mesh.triangles.resize(mesh.triangles.size() - 40);
  return mesh;
}
TriangleMesh one_sheet() {
  TriangleMesh mesh = test::sphere({0, 0, 30}, 30, 4);
  for (Vec3& v : mesh.vertices) v.x = std::abs(v.x - 0.3);  // folded through itself
  return mesh;
}

template <class T>
Result<void> without_value(const Result<T>& result) {
  if (!result) return tl::unexpected(result.error());
  return {};
}

Result<void> go(const WholeRun& run, const MeshFile& file, const Job& job) {
  auto asked = parse_job(std::string(R"({"aplomb_job": 1, "model": "-")") + run.keys + "}", ".");
  if (!asked) return tl::unexpected(asked.error());
  asked->input.repair.insist = true;
  if (run.is_validation) {
    const auto print = load_print(file, asked->input);
    if (!print) return tl::unexpected(print.error());
    return without_value(judge(*print, asked->options.judge, nullptr, job));
  }
  const auto input = load_solid(file, asked->input, job.part(0, 0.2));
  if (!input) return tl::unexpected(input.error());
  StandOptions options = stand_options(*asked, input->solid.box().size().z);
  if (run.ballast) {
    options.profile = PrintProfile{};
    options.profile->infill_ratio = 0.15;
    options.ballast = Ballasting::only;
  }
  const auto made = stand(*input, options, job.part(0.2, 0.6));
  if (!made) return tl::unexpected(made.error());
  if (!made->shell) return fail(ErrorCode::internal, "no shell: " + made->report.hints.front());
  const auto bytes = encode_mesh(made->shell->mesh, MeshFormat::three_mf, {}, job.part(0.6, 0.7));
  if (!bytes) return tl::unexpected(bytes.error());
  const auto back = read_mesh(*bytes, "out.3mf", {}, job.part(0.7, 0.75));
  if (!back) return tl::unexpected(back.error());
  const auto measured =
      measure_output(rounded_to_float(back->objects.front().mesh), *input, *made, options, job.part(0.75, 0.9));
  if (!measured) return tl::unexpected(measured.error());
  return without_value(hole_plugs(*made, job.part(0.9, 1)));
}

class Cancelled : public testing::TestWithParam<WholeRun> {};

TEST_P(Cancelled, AtAnyReportARunEndsSoonAndSaysSo) {
  MeshFile file;
  file.objects.push_back({"model", GetParam().model()});
  test::Patience whole;
  const auto made = go(GetParam(), file, whole.job());
  ASSERT_TRUE(made.has_value()) << made.error().message;
  whole.ended();
  EXPECT_LT(whole.longest_silence_s(), most_silence_s) << whole.silent_stage();
  ASSERT_GT(whole.reports(), 5);
  double worst_s = 0;
  for (int k = 1; k <= whole.reports(); k += 1 + whole.reports() / 6) {
    test::Patience patience(k);
    const auto result = go(GetParam(), file, patience.job());
    const double end_s = patience.ended();
    ASSERT_FALSE(result.has_value()) << "goes on after report " << k << " of " << whole.reports();
    EXPECT_EQ(result.error().code, ErrorCode::cancelled) << "at report " << k << ": " << result.error().message;
    EXPECT_EQ(patience.reports(), k) << "asked again after it was told to stop";
    EXPECT_LT(end_s, most_end_s) << "at report " << k;
    worst_s = std::max(worst_s, end_s);
  }
  RecordProperty("reports", whole.reports());
  std::cout << "  " << whole.reports() << " reports, ends in at most " << 1e3 * worst_s << " ms, silent for at most "
            << 1e3 * whole.longest_silence_s() << " ms (" << whole.silent_stage() << ")\n";
}

const WholeRun runs[] = {
    {"carving", R"(, "wall_mm": 2.5, "voxel_mm": 1.2, "best_effort": true)", leaning},
    {"ceilings", R"(, "wall_mm": 2.5, "voxel_mm": 1.2, "aim": "light", "best_effort": true)", leaning_ball},
    {"bend",
     R"(, "wall_mm": 2.5, "voxel_mm": 1.2, "ceiling": "any", "deform": "auto", "deform_limit_percent": 20, "best_effort": true)",
     leaning_ball},
    {"holes", R"(, "wall_mm": 2.5, "voxel_mm": 1.2, "process": "sla", "best_effort": true)", leaning},
    {"powder", R"(, "wall_mm": 2.5, "voxel_mm": 1.2, "process": "powder", "best_effort": true)", leaning},
    {"inserts", R"(, "wall_mm": 2.5, "voxel_mm": 1.2, "ceiling": "any", "inserts": ["penny:2"], "best_effort": true)",
     leaning},
    {"ballast", R"(, "best_effort": true)", leaning, false, true},
    {"poses",
     R"(, "wall_mm": 2.5, "voxel_mm": 1.2, "ceiling": "any", "best_effort": true, "poses": [{"stand": {"tip_deg": 2}},
        {"hang": {"from_mm": [[20, 0, 60]], "tilt_deg": 8}}])",
     leaning},
    {"repair", R"(, "wall_mm": 3, "voxel_mm": 1.5, "ceiling": "any", "best_effort": true)", open_ball},
    {"rebuild", R"(, "wall_mm": 3, "voxel_mm": 1.5, "ceiling": "any", "best_effort": true)", one_sheet},
    {"elasticity", R"(, "fem": true)", upright, true},
    {"validation", R"(, "process": "binder")", leaning, true},
};

INSTANTIATE_TEST_SUITE_P(Every, Cancelled, testing::ValuesIn(runs),
                         [](const auto& run) { return std::string(run.param.name); });

}  // namespace
}  // namespace aplomb
