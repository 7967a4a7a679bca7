// Told to stop, reading a program stops: at any report, soon, and reports come often, whatever its lines cost.
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "support/cancelled.h"
#include "support/cost.h"
#include "support/gcode_files.h"

namespace aplomb::test {
namespace {

class CancelGcode : public testing::Test {
 protected:
  CancelGcode()
      : path_(std::filesystem::temp_directory_path() / ("aplomb_cancel_" + std::to_string(getpid()) + ".gcode")) {}
  ~CancelGcode() override { std::filesystem::remove(path_); }

  void expect_patient(const std::string& program) {
    std::ofstream(path_, std::ios::binary) << program;
    const auto read = [&](const Job& job) { return read_gcode(path_, {}, job); };
    const Patience whole = test::whole(read);
    ASSERT_GT(whole.reports(), 3);
    expect_cancelled_at_a_spread(whole, read, 6);
  }

 private:
  std::filesystem::path path_;
};

TEST_F(CancelGcode, WhileLinesAreRead) {
  std::string arcs = plain_start(), long_lines = plain_start();
  for (int i = 0; i < (is_sanitized() ? 10'000 : 40'000); ++i) arcs += "G3I" + std::to_string(1 + 1e-4 * i) + "E1\n";
  for (int i = 0; i < (is_sanitized() ? 20 : 200); ++i)
    long_lines += "G1 X" + std::to_string(i) + " E1 ;" + std::string(500'000, 'c') + "\n";
  expect_patient(arcs);
  expect_patient(long_lines + "G1 Y5 E1\n");
}

TEST_F(CancelGcode, WhileBrimsAreTakenToTheirObjects) {
  std::string program = plain_start() + ";TYPE:Skirt\n";
  for (int i = is_sanitized() ? 400 : 4'000; i-- > 0;)
    program += "G1X" + std::to_string(5.5 + 0.5 * i) + "Y5\nG1Y6E.02\n";
  for (int i = 0; i < (is_sanitized() ? 100 : 200); ++i)
    program += "; printing object " + std::to_string(i) + "\n;TYPE:Perimeter\nG1X0Y0\nG1X5E1\nG1Y5E1\n";
  expect_patient(program);
}

}  // namespace
}  // namespace aplomb::test
