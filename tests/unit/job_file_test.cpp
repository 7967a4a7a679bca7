#include "aplomb/job/job_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "support/mesh_files.h"

namespace aplomb {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;
namespace fs = std::filesystem;

const fs::path examples = fs::path(APLOMB_FIXTURES) / "jobs";

Json example(const std::string& name) { return Json::parse(test::read_text_file(examples / name)); }

Result<JobFile> parse(const Json& json) { return parse_job(json.dump(), examples); }

Json written(const JobFile& job) { return Json::parse(to_json(job, examples)); }

std::string error_of(const std::string& text) {
  const auto job = parse_job(text, ".");
  return job ? "" : job.error().message;
}

/// A job with one pose, given as the inside of its braces.
std::string error_of_pose(const std::string& pose) {
  return error_of(R"({"aplomb_job": 1, "model": "a.stl", "poses": [{)" + pose + "}]}");
}

/// Of the schema, with every $ref followed; elements of a list stand under "0".
void collect_keys(const Json& root, Json schema, const std::string& at, std::set<std::string>& keys) {
  if (schema.contains("$ref")) schema = root.at(Pointer(schema["$ref"].get<std::string>().substr(1)));
  if (schema.contains("items")) return collect_keys(root, schema["items"], at + "/0", keys);
  if (!schema.contains("properties")) return void(keys.insert(at));
  for (const auto& [key, child] : schema["properties"].items()) collect_keys(root, child, at + "/" + key, keys);
}

TEST(JobFile, ReadsEveryExample) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(examples)) {
    const auto job = read_job(entry.path());
    ASSERT_TRUE(job.has_value()) << job.error().message;
    EXPECT_EQ(job->model.parent_path().lexically_normal(), fs::path(APLOMB_FIXTURES) / "") << entry.path();
    EXPECT_EQ(Json::parse(to_json(*job, examples)), written(*parse_job(to_json(*job, examples), examples)));
    ++count;
  }
  EXPECT_GE(count, 4);
}

TEST(JobFile, HasAnExampleWithEveryKeyOfTheSchema) {
  const Json schema = Json::parse(job_schema()), job = example("every_key.json");
  std::set<std::string> keys;
  collect_keys(schema, schema, "", keys);
  EXPECT_GT(keys.size(), 30u);
  for (std::string key : keys) {
    if (key.find("/poses/0/hang") == 0) key[7] = '1';  // the example's second pose hangs
    EXPECT_TRUE(job.contains(Pointer(key))) << key;
  }
}

/// A key that the schema allows and nothing reads would not change the job.
TEST(JobFile, ReadsEveryKeyOfTheExampleAndWritesItAgain) {
  const Json job = example("every_key.json"), before = written(parse(job).value());
  const Json flat = job.flatten();
  for (const auto& [at, value] : flat.items()) {
    if (at == "/aplomb_job" || at == "/process" || at == "/material") continue;
    Json changed = job;
    Json& field = changed[Pointer(at)];
    if (value.is_boolean()) field = !value.get<bool>();
    else if (value.is_number_integer()) field = value.get<int>() + 1;
    else if (value.is_number()) field = value.get<double>() * 1.01;
    else if (value == "z") field = "-x";
    else if (value == "stable") field = "light";
    else if (value == "orca") field = "cura";
    else if (value == "never") field = "auto";
    else if (value == "auto") field = "only";
    else if (value == "none") field = "auto";
    else if (value == "any") field = "auto";
    else if (value == "wall.thin" || value == "stand.robust") field = "void.island";
    else field = value.get<std::string>() + "2";
    const auto read = parse(changed);
    ASSERT_TRUE(read.has_value()) << at << ": " << read.error().message;
    EXPECT_NE(written(*read), before) << at;
    EXPECT_TRUE(before.contains(Pointer(at))) << at;
  }
}

TEST(JobFile, NamesOfProcessAndMaterialSetWhatNumbersOverride) {
  const Json schema = Json::parse(job_schema());
  Json job = example("stand.json");
  for (const std::string name : schema["properties"]["process"]["enum"]) {
    job["process"] = name;
    EXPECT_EQ(parse(job)->options.wall_mm, wall_of_process(name).value());
  }
  for (const std::string name : schema["properties"]["material"]["enum"]) {
    job["material"] = name;
    EXPECT_EQ(parse(job)->options.density_g_per_cm3, density_of_material(name).value());
  }
  job["wall_mm"] = 2.25, job["density_g_per_cm3"] = 7;
  EXPECT_EQ(parse(job)->options.wall_mm, 2.25);
  EXPECT_EQ(parse(job)->options.density_g_per_cm3, 7);
  EXPECT_FALSE(wall_of_process("clay") || density_of_material("clay"));
}

/// Every number of the schema, at its limits and just beyond them.
TEST(JobFile, RefusesEveryNumberBeyondItsRangeAndNamesPathAndRange) {
  const Json job = example("every_key.json"), schema = Json::parse(job_schema());
  const Json flat = schema.flatten();
  const std::set<std::string> limits{"minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"};
  int tried = 0;
  for (const auto& [at, limit] : flat.items()) {
    const std::string name = at.substr(at.rfind('/') + 1);
    if (!limits.count(name) || at.find("/definitions") == 0 || at.find("/items/minimum") != std::string::npos ||
        at.find("/items/maximum") != std::string::npos)
      continue;
    std::string path = at.substr(0, at.rfind('/'));
    for (const std::string word : {"/properties", "/items"})
      for (std::size_t i; (i = path.find(word)) != std::string::npos;)
        path.replace(i, word.size(), word == "/items" ? "/0" : "");
    if (path.find("/poses/0/hang") == 0) path[7] = '1';
    const bool is_low = name.find("inimum") != std::string::npos, is_open = name[0] == 'e';
    Json changed = job;
    changed[Pointer(path)] = limit;
    EXPECT_EQ(find_schema_problem(changed.dump()).empty(), !is_open) << at;
    changed[Pointer(path)] = limit.get<double>() + (is_low ? -1 : 1);
    const std::string problem = find_schema_problem(changed.dump());
    EXPECT_NE(problem.find(path.substr(path.rfind('/') + 1) + " is "), std::string::npos) << at << ": " << problem;
    EXPECT_NE(problem.find(is_low ? (is_open ? "above " : "at least ") : (is_open ? "below " : "at most ")),
              std::string::npos)
        << at << ": " << problem;
    ++tried;
  }
  EXPECT_GT(tried, 25);
}

TEST(JobFile, SaysOfEveryMistakeWhereItIsAndWhatMayBe) {
  const std::string head = R"({"aplomb_job": 1, "model": "a.stl")";
  EXPECT_EQ(error_of(R"({"aplomb_job": 2, "model": "a.stl"})"),
            "aplomb_job is 2 but must be 1: the version of this format: 1");
  EXPECT_EQ(error_of(R"({"aplomb_job": 1})").rfind("the job lacks 'model', a text that is not empty", 0), 0u);
  EXPECT_EQ(error_of(head + R"(, "walls": 1})").rfind("the job has no key 'walls'; its keys are aplomb_job, ", 0), 0u);
  EXPECT_EQ(error_of(head + R"(, "aim": "best"})").rfind("aim is \"best\" but must be one of least, light, stable", 0),
            0u);
  EXPECT_EQ(error_of(head + R"(, "threads": 1.5})").rfind("threads is 1.5 but must be a whole number at least 0", 0),
            0u);
  EXPECT_EQ(error_of(head + R"(, "robust": "yes"})").rfind("robust is \"yes\" but must be true or false", 0), 0u);
  EXPECT_EQ(error_of(head + R"(, "poses": []})").rfind("poses is [] but must be a list of 1 to 100", 0), 0u);
  EXPECT_EQ(error_of("[]").rfind("the job is [] but must be an object", 0), 0u);
  EXPECT_EQ(error_of("{\"a").rfind("the job is no JSON: parse error at line 1", 0), 0u);
  EXPECT_EQ(error_of(head + R"(, "wall_mm": 1e999})").rfind("the job is no JSON: ", 0), 0u);
  EXPECT_EQ(error_of(head + R"(, "voxel_mm": 9})").rfind("voxel_mm is 9", 0), 0u);  // too coarse for the wall
}

TEST(JobFile, SaysOfEveryMistakeInAPoseWhereItIsAndWhatMayBe) {
  EXPECT_EQ(error_of_pose(R"("name": "a")"), "poses[0] must be an object with either stand or hang");
  EXPECT_EQ(error_of_pose(R"("stand": {}, "hang": {"from_mm": [[0, 0, 1]]})"),
            "poses[0] must be an object with either stand or hang");
  EXPECT_EQ(error_of_pose(R"("stnd": {})"), "poses[0] has no key 'stnd'; its keys are name, stand, hang");
  EXPECT_EQ(
      error_of_pose(R"("stand": {"tip_deg": 95})"),
      "poses[0].stand.tip_deg is 95 but must be a number at least 0 and below 90: tip angle asked for; default 10");
  for (const char* up : {"\"w\"", "[0,0,\"a\"]", "[1,2]", "7"}) {
    const std::string said = error_of_pose(std::string("\"stand\": {\"up\": ") + up + "}");
    EXPECT_EQ(
        said.rfind(std::string("poses[0].stand.up is ") + up + " but must be x, y, z, -x, -y, -z or a direction", 0),
        0u)
        << said;
  }
  EXPECT_EQ(error_of_pose(R"("stand": {"up": [0, 0, 0]})"), "poses[0].stand: the length of up is 0 but must be 1");
  EXPECT_EQ(error_of_pose(R"("stand": {"contacts": [{"at_mm": [0, 0]}]})")
                .rfind("poses[0].stand.contacts[0].at_mm is [0,0] but must be a list of 3", 0),
            0u);
  EXPECT_EQ(error_of_pose(R"("hang": {})").rfind("poses[0].hang lacks 'from_mm', a list of 1 to 2: one or two", 0), 0u);
  EXPECT_EQ(error_of_pose(R"("hang": {"from_mm": [[0, 0, 0], [0, 0, 1]]})"),
            "poses[0].hang: the two points to hang from lie one above the other; move one aside");
}

TEST(JobFile, KeepsEveryAngleInDegreesToTheLastBit) {
  JobFile job;
  job.model = "a.stl";
  for (int i = 1; i < 900; ++i) {
    const double tip_rad = i * 0.1 * 0.017453292519943295;
    job.poses.front().pose.way = StandingPose{.required_tip_rad = tip_rad};
    const JobFile back = parse_job(to_json(job, "."), ".").value();
    EXPECT_EQ(back.poses.front().pose.standing()->required_tip_rad, tip_rad) << i;
  }
}

TEST(JobFile, GivesAContactWithoutRadiusAShareOfTheHeight) {
  const JobFile job = parse(example("every_key.json")).value();
  const StandOptions options = stand_options(job, 80);
  const auto& contacts = options.poses[0].standing()->contacts;
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_EQ(contacts[0].radius_mm, 60);
  EXPECT_EQ(contacts[1].radius_mm, 4);
  EXPECT_NEAR(norm(options.poses[1].up()), 1, 1e-15);
}

TEST(JobFile, IsRefusedWhereItCannotBeReadOrIsTooLarge) {
  const test::TempFolder folder;
  EXPECT_EQ(read_job(folder / "none.json").error().code, ErrorCode::file_system);
  EXPECT_EQ(read_job(folder.path()).error().code, ErrorCode::file_system);
  test::write_text(folder / "large.json", std::string(1'000'001, ' '));
  EXPECT_NE(read_job(folder / "large.json").error().message.find("it is longer than 1 MB"), std::string::npos);
  test::write_text(folder / "empty.json", "");
  EXPECT_NE(read_job(folder / "empty.json").error().message.find("empty.json: the job is no JSON"), std::string::npos);
}

}  // namespace
}  // namespace aplomb
