#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "aplomb/io/write_mesh.h"
#include "aplomb/pipeline.h"

namespace aplomb {

/// A contact of a pose as a job has it.
struct JobContact {
  Vec3 center_mm;
  std::optional<double> radius_mm;  ///< none: 5 % of the model's height
};

struct JobPose {
  Pose pose;                         ///< without contacts
  std::vector<JobContact> contacts;  ///< of a standing pose
};

/// One run, as a file says it or as a command's flags do.
struct JobFile {
  std::filesystem::path model;     ///< "-" is standard input
  std::filesystem::path output;    ///< empty: the poses are only checked
  std::filesystem::path report;    ///< empty: none
  std::filesystem::path dump;      ///< empty: none
  std::filesystem::path html;      ///< empty: none
  std::filesystem::path picture;   ///< empty: none
  std::filesystem::path plugs;     ///< empty: none
  std::filesystem::path profile;   ///< how it is sliced; empty: solid. See with_profile()
  std::filesystem::path modifier;  ///< where to write the volume of denser infill as a mesh; empty: nowhere
  std::optional<Flavor> flavor;    ///< whose words a 3MF uses for it; none: the profile's slicer's
  InputOptions input;
  std::vector<JobPose> poses{JobPose{}};
  StandOptions options;          ///< all but the poses: see stand_options()
  int threads = 0;               ///< 0: one per core
  std::optional<double> time_s;  ///< > 0; after which the run ends; none: when it is done
  RuleChanges rules;             ///< what the print is judged by
  double infill_percent = 100;
  std::vector<std::string> inserts;  ///< as parse_insert() reads them
  bool fem = false;                  ///< whether strength.fem is asked for
};

/// The rules and the filling of the run. \return as rules_of(); invalid_option as find_problem() says it.
Result<JudgeOptions> judge_options(const JobFile& job);

/// The options of the run, its judge's too where its rules are sound, its poses with their contacts, whose default
/// radius depends on the model's height.
StandOptions stand_options(const JobFile& job, double height_mm);

/// The options with the job's profile read from its file, where it has one. Ballast needs a place to be written: where
/// `job` has none and does not ask for ballast, there will be none. \return as read_profile(); invalid_option.
Result<StandOptions> with_profile(StandOptions options, const JobFile& job);

/// A sentence that names field, value and range; empty when there is nothing to say.
std::string find_problem(const JobFile& job);

/// Reads a job: JSON as job_schema() describes, checked against it. Relative paths start from `folder`.
///
/// \post find_problem() of it is empty.
/// \return invalid_option naming the place in the job ("poses[0].stand.tip_deg"), what is there and what may be.
Result<JobFile> parse_job(std::string_view text, const std::filesystem::path& folder);

/// The same from a file, of at most 1 MB; paths start from the file's own folder. \return also file_system.
Result<JobFile> read_job(const std::filesystem::path& file);

/// The job as JSON that parse_job() reads as the same: every number to the last bit, but for an angle given in another
/// unit than degrees, which may differ in the last. Paths become relative to `folder` where they can.
///
/// \pre find_problem(job) is empty.
std::string to_json(const JobFile& job, const std::filesystem::path& folder);

/// What a text that is JSON breaks of the schema, as a sentence with the place, the value and what may be; or nothing.
std::string find_schema_problem(std::string_view text);

/// The published schema, as in job.schema.json: draft 7.
std::string_view job_schema();

/// "pla" and the like, with densities in g/cm3; "fdm" and the like, with walls in mm. Nothing for other names.
std::optional<double> density_of_material(std::string_view name);
std::optional<double> wall_of_process(std::string_view name);

}  // namespace aplomb
