// Whatever a run is doing, told to stop it stops: at any report, soon, and with nothing but Cancelled to show.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "aplomb/deform/bend_preview.h"
#include "aplomb/io/read_mesh.h"
#include "aplomb/job/job_file.h"
#include "aplomb/mesh/bodies.h"
#include "page.h"
#include "support/cancelled.h"
#include "support/many_bodies.h"
#include "support/mesh_files.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

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
    const auto print = load_print(file, asked->input, job.part(0, 0.1));
    if (!print) return tl::unexpected(print.error());
    return without_value(judge(*print, asked->options.judge, nullptr, job.part(0.1, 1)));
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
  const auto run = [&](const Job& job) { return go(GetParam(), file, job); };
  const test::Patience whole = test::whole(run);
  ASSERT_GT(whole.reports(), 5);
  const double worst_s = test::expect_cancelled_at_a_spread(whole, run, 6);
  RecordProperty("reports", whole.reports());
  std::cout << "  " << whole.reports() << " reports, ends in at most " << 1e3 * worst_s << " ms\n";
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

TEST(CancelledStages, AtTheirFirstAndLastReportRunsEndSoonAndSaySo) {
  std::set<std::string> seen;
  for (const WholeRun& of : runs) {
    MeshFile file;
    file.objects.push_back({"model", of.model()});
    const auto run = [&](const Job& job) { return go(of, file, job); };
    test::expect_cancelled_in_stages(test::whole(run), run, seen);
  }
  EXPECT_GT(seen.size(), 25u);
}

/// At the voxel that is chosen for it: those above are coarse. Allowed is four times what is measured on quiet cores.
TEST(CancelledFixtures, ARunAtItsOwnResolutionIsNeverSilentForLong) {
  const auto file = read_mesh(std::filesystem::path(APLOMB_FIXTURES) / "trex.stl");
  ASSERT_TRUE(file);
  for (const char* keys : {R"(, "best_effort": true)", R"(, "best_effort": true, "process": "sla")"}) {
    const WholeRun of{"trex", keys, nullptr};
    test::never_silent([&](const Job& job) { return go(of, *file, job); }, test::is_sanitized() ? 2 : 0.4);
  }
}

/// What is no part of such a run.
class CancelledApart : public testing::Test {
 protected:
  template <class Run>
  static void expect_all(const Run& run, int least_reports) {
    const test::Patience whole = test::whole(run);
    EXPECT_GE(whole.reports(), least_reports);
    test::expect_cancelled_at_a_spread(whole, run, 8);
    std::set<std::string> seen;
    test::expect_cancelled_in_stages(whole, run, seen);
  }
};

TEST_F(CancelledApart, ACheckEndsSoonAndSaysSo) {
  MeshFile file;
  file.objects.push_back({"model", leaning_ball()});
  const auto input = load_solid(file, {});
  ASSERT_TRUE(input);
  StandOptions options;
  options.profile = PrintProfile{};
  expect_all([&](const Job& job) { return check(*input, options, job); }, 3);
}

TEST_F(CancelledApart, APageEndsSoonAndSaysSo) {
  const TriangleMesh before = leaning_ball(), after = leaning();
  page::PageContent content{.title = "page", .before = &before, .after = &after, .poses = {Pose{}}};
  content.judgement = judge(after, {}).value();
  expect_all([&](const Job& job) { return page::html_page(content, job); }, 3);
}

TEST_F(CancelledApart, APreviewOfABendEndsSoonAndSaysSo) {
  const auto solid = check_solid(test::leaning_prism(20, 20, 80, 16));
  ASSERT_TRUE(solid && solid->solid);
  const auto make = [&](const Job& job) {
    return BendPreview::make(*solid->solid, {Pose{}}, {.reshape = {.wall_mm = 3}, .samples = 8000}, job);
  };
  expect_all(make, 2);
  const auto preview = make({});
  ASSERT_TRUE(preview);
  BendWish wish;
  wish.regions.handles.push_back({{{14, 0, 76}, 6}, Vec3{22, 0, 74}});
  wish.most_steps = 6;
  expect_all([&](const Job& job) { return preview->advance(wish, {}, job); }, 2);
}

TEST_F(CancelledApart, TellingPrintsApartEndsSoonAndSaysSo) {
  const TriangleMesh mesh = test::tetrahedra_stacked(test::is_sanitized() ? 5'000 : 50'000);
  expect_all([&](const Job& job) { return split_prints(mesh, job); }, 8);
}

}  // namespace
}  // namespace aplomb
