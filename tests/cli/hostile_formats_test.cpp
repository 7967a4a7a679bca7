// A bad file of each format, through the program: code 2, one sentence, and the output as it was, there or not.
#include <algorithm>
#include <fstream>

#include "cli/command_line.h"
#include "support/refusal.h"
#include "support/zip_files.h"

namespace aplomb {
namespace {

struct BadFile {
  const char* name;
  std::string bytes;
  const char* words;
};

void PrintTo(const BadFile& file, std::ostream* out) { *out << file.name; }

const std::string ply_head =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string good_object = test::tetrahedron_object(1);

std::vector<BadFile> bad_files() {
  return {
      {"ascii.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n", "line 4"},
      {"binary.stl", std::string(80, ' ') + "\x02" + std::string(3 + 50, '\0'), "byte 80"},
      {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4"},
      {"count.off", "OFF\n3000000000 1 0\n0 0 0\n", "line 2"},
      {"index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6"},
      {"ascii.ply", ply_head + "end_header\n0 0 0\n1 0 inf\n0 1 0\n", "vertex 1"},
      {"count.ply", ply_head + "element face 4294967295\nproperty list uchar int vertex_index\nend_header\n",
       "promises"},
      {"truncated.3mf", test::package(test::model_xml(good_object, "<item objectid=\"1\"/>")).substr(0, 300), "zip"},
      {"cycle.3mf",
       test::package(test::model_xml("<object id=\"1\"><components><component objectid=\"1\"/></components></object>",
                                     "<item objectid=\"1\"/>")),
       "contains itself"},
      {"dtd.3mf", test::package("<!DOCTYPE m [<!ENTITY a \"aa\">]><model/>"), "document type"},
      {"empty.ply", "", "empty"},
  };
}

class HostileFormats : public CommandLine, public ::testing::WithParamInterface<BadFile> {};

TEST_P(HostileFormats, EndInTwoWithOneSentenceAndLeaveTheOutputAsItWas) {
  const BadFile& bad = GetParam();
  std::ofstream(path(bad.name), std::ios::binary) << bad.bytes;
  for (const std::string& command : {"stand " + path(bad.name) + " -o " + path("out.3mf"), "check " + path(bad.name),
                                     "hang " + path(bad.name) + " --from 0,0,0 -o " + path("out.3mf"),
                                     "validate " + path(bad.name), "poses " + path(bad.name)})
    for (const bool is_there : {false, true}) {
      fs::remove(path("out.3mf"));
      if (is_there) std::ofstream(path("out.3mf")) << "old";
      EXPECT_EQ(run(command), 2) << command << text_of("stderr");
      const std::string said = text_of("stderr"), start = "aplomb: ";
      ASSERT_TRUE(said.starts_with(start) && said.ends_with('\n')) << said;
      EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
      EXPECT_EQ(test::lack_of_refusal(said.substr(start.size(), said.size() - start.size() - 1), path(bad.name)), "")
          << said;
      EXPECT_NE(said.find(bad.words), std::string::npos) << said;
      EXPECT_EQ(text_of("stdout"), "");
      EXPECT_EQ(fs::exists(path("out.3mf")), is_there) << command;
      EXPECT_EQ(text_of("out.3mf"), is_there ? "old" : "");
    }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 4);  // it, out, stdout and stderr
}

INSTANTIATE_TEST_SUITE_P(OfEachFormat, HostileFormats, ::testing::ValuesIn(bad_files()), [](const auto& each) {
  std::string name = each.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

}  // namespace
}  // namespace aplomb
