#include "runs.h"

#include <array>
#include <nlohmann/json.hpp>

#include "aplomb/pipeline.h"
#include "aplomb/printability/judge.h"
#include "aplomb/report/json.h"
#include "aplomb/report/judgement.h"
#include "aplomb/report/text.h"

namespace aplomb::capi {
namespace {

constexpr std::size_t most_job_bytes = 1'000'000;
constexpr const char* model_key = "\"model\": \"mesh\"";  // the schema wants one

double height_mm(const Input& input) { return input.solid.box().size().z; }

Finished finished(const Report& report) { return {ending_of(report), verdict(report), to_json(report), {}}; }

}  // namespace

Result<Finished> run_stand(const MeshFile& file, const JobFile& asked, const Job& job) {
  const auto input = load_solid(file, asked.input, job.part(0, 0.3));
  if (!input) return tl::unexpected(input.error());
  const StandOptions options = stand_options(asked, height_mm(*input));
  const auto made = stand(*input, options, job.part(0.3, 0.9));
  if (!made) return tl::unexpected(made.error());
  if (!made->shell || (made->report.outcome == Outcome::best_effort && !options.best_effort))
    return finished(made->report);
  TriangleMesh mesh = rounded_to_float(made->shell->mesh);
  auto report = measure_output(mesh, *input, *made, options, job.part(0.9, 1));
  if (!report) return tl::unexpected(report.error());
  const auto why_not = refusal(*report, options);
  if (why_not) report->hints.push_back(*why_not);
  Finished done = finished(*report);
  if (why_not) done.message += "; but " + *why_not;
  else done.mesh = std::move(mesh);
  return done;
}

Result<Finished> run_check(const MeshFile& file, const JobFile& asked, const Job& job) {
  const auto input = load_solid(file, asked.input, job.part(0, 0.5));
  if (!input) return tl::unexpected(input.error());
  return check(*input, stand_options(asked, height_mm(*input)), job.part(0.5, 1)).map(finished);
}

Result<Finished> run_validate(const MeshFile& file, const JobFile& asked, const Job& job) {
  const auto mesh = load_print(file, asked.input, job.part(0, 0.1));
  if (!mesh) return tl::unexpected(mesh.error());
  const StandOptions options = stand_options(asked, bounding_box(*mesh).size().z);
  JudgeOptions judging = options.judge;
  const StandingPose* pose = options.poses.front().standing();
  judging.pose = pose ? std::optional(*pose) : std::nullopt;
  judging.density_g_per_cm3 = options.density_g_per_cm3;
  return judge(*mesh, judging, nullptr, job.part(0.1, 1)).map([](const Judgement& judgement) {
    const std::string text = to_text(judgement);
    return Finished{ending_of(judgement), text.substr(0, text.find('\n')), to_json(judgement), {}};
  });
}

Result<JobFile> job_without_files(const std::string& text) {
  if (text.empty()) return job_without_files(R"({"aplomb_job": 1})");
  if (text.size() > most_job_bytes) return fail(ErrorCode::invalid_option, "the job: it has at most 1 MB");
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || json.empty()) return parse_job(text, ".");  // which says what is wrong with it
  for (const char* key : {"model", "output", "report", "dump", "html", "picture", "plugs", "profile", "modifier"})
    if (json.contains(key))
      return fail(ErrorCode::invalid_option, std::string("the job has the key \"") + key +
                                                 "\", which names a file; here the mesh comes and goes in memory");
  if (json.contains("time_s"))
    return fail(ErrorCode::invalid_option,
                "the job has the key \"time_s\"; here the listener ends what takes too long");
  std::string whole = text;  // not json.dump(), which calls itself as deep as a hostile text nests
  whole.insert(whole.find('{') + 1, std::string(model_key) + ", ");
  return parse_job(whole, ".");
}

}  // namespace aplomb::capi
