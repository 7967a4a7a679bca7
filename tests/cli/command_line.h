#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "aplomb/io/write_mesh.h"
#include "support/mesh_files.h"
#include "support/shapes.h"

namespace aplomb {

namespace fs = std::filesystem;

/// The program itself, run as a person or a script would, in a folder of its own.
class CommandLine : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  int run(const std::string& arguments) const {
    const std::string command =
        std::string(APLOMB_CLI) + " " + arguments + " >" + path("stdout") + " 2>" + path("stderr") + " </dev/null";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string text_of(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return (std::ostringstream() << file.rdbuf()).str();
  }

  std::string write(const std::string& name, const TriangleMesh& mesh) const {
    EXPECT_TRUE(write_mesh(path(name), mesh).has_value());
    return path(name);
  }

  /// Leans so far that its centre of mass lies 1 mm beyond its base.
  std::string toppling() const { return write("leaning.stl", test::leaning_prism(28, 28, 60, 30)); }

  const test::TempFolder temporary_;
  const fs::path& folder_ = temporary_.path();
};

}  // namespace aplomb
