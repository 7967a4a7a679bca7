// However a run ends, the old file or the complete new one is there; what a run may not do or take, it says.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "aplomb/io/read_mesh.h"
#include "cli/command_line.h"

namespace aplomb {
namespace {

using Clock = std::chrono::steady_clock;

class Killed : public CommandLine {
 protected:
  /// Starts the program, which leads a group of its own.
  static pid_t start(const std::vector<std::string>& arguments) {
    std::vector<char*> words{const_cast<char*>(APLOMB_CLI)};
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0) return child;
    setpgid(0, 0);
    execv(APLOMB_CLI, words.data());
    _exit(127);
  }
  static int ending_of(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  }
  /// Without a word to the system that nobody waits for it any more: it can still be killed.
  static void wait_until_dead(pid_t child) {
    siginfo_t info{};
    waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);
  }
  /// Until the program has taken signals into its own hands: before, while it is loaded, they end it as any other.
  static void wait_until_it_catches(pid_t child, int signal) {
    for (int tries = 0; tries < 60'000; ++tries, usleep(1'000)) {
      std::ifstream status("/proc/" + std::to_string(child) + "/status");
      std::string line;
      while (std::getline(status, line) && !line.starts_with("SigCgt:")) {
      }
      if (line.starts_with("SigCgt:") && std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) return;
    }
    FAIL() << "it never catches signal " << signal;
  }
  std::vector<std::string> standing(const std::string& model, const std::string& output) const {
    return {"stand", model, "--tip", "4deg", "--voxel", "1mm", "--wall", "2mm", "-q", "-o", output};
  }
  std::multiset<std::string> names() const {
    std::multiset<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_)) found.insert(entry.path().filename().string());
    return found;
  }
};

TEST_F(Killed, AtFiftyMomentsTheOldFileOrTheCompleteNewOneIsThere) {
  const std::string model = toppling(), output = path("out.3mf");
  const auto start_time = Clock::now();
  ASSERT_EQ(WEXITSTATUS(ending_of(start(standing(model, output)))), 0);
  const double whole_s = std::chrono::duration<double>(Clock::now() - start_time).count();
  const std::string new_file = text_of("out.3mf"), old_file = "what was there before";
  std::mt19937 random(7);
  int olds = 0, news = 0;
  for (int kill_number = 0; kill_number < 50; ++kill_number) {
    std::ofstream(output, std::ios::binary) << old_file;
    const pid_t child = start(standing(model, output));
    const bool is_late = kill_number % 2 == 1;  // half of them about the moment at which it is written
    const double share = std::uniform_real_distribution<double>(is_late ? 0.85 : 0.0, 1.1)(random);
    usleep(static_cast<useconds_t>(1e6 * share * whole_s));
    if (kill_number % 25 == 24) wait_until_dead(child);  // however slow this one is, too late
    kill(child, SIGKILL);
    ending_of(child);
    const std::string left = text_of("out.3mf");
    EXPECT_TRUE(left == old_file || left == new_file) << left.size() << " bytes after kill " << kill_number;
    ++(left == old_file ? olds : news);
  }
  EXPECT_GT(olds, 0);  // the few ms of the write itself: AtomicFile, which is killed while it writes for long
  EXPECT_GT(news, 0);
}

TEST_F(Killed, WhatAKillLeftIsClearedByTheNextRunAndNothingElseIs) {
  const std::string output = path("out.3mf");
  const pid_t gone = start({"--help"});
  ending_of(gone);
  const auto left_by = [](pid_t id, int n) {
    return ".aplomb-" + std::to_string(id) + "-" + std::to_string(n) + "-0.tmp";
  };
  const std::string dead = left_by(gone, 1), fresh = left_by(gone, 2), alive = left_by(getpid(), 1);
  for (const std::string& name : {dead, fresh, alive, std::string(".aplomb-notes.tmp")}) {
    std::ofstream(path(name)) << "half";
    if (name != fresh) fs::last_write_time(path(name), fs::file_time_type::clock::now() - std::chrono::hours(2));
  }
  ASSERT_EQ(WEXITSTATUS(ending_of(start(standing(toppling(), output)))), 0);
  EXPECT_EQ(names(), (std::multiset<std::string>{alive, fresh, ".aplomb-notes.tmp", "leaning.stl", "out.3mf"}));
}

TEST_F(Killed, InterruptedAtAnyMomentItEndsWithFourAndLeavesNothingBeside) {
  const std::string model = toppling(), output = path("out.3mf");
  std::mt19937 random(11);
  for (int n = 0; n < 12; ++n) {
    std::ofstream(output, std::ios::binary) << "old";
    const pid_t child = start(standing(model, output));
    wait_until_it_catches(child, SIGINT);
    usleep(std::uniform_int_distribution<useconds_t>(0, 600'000)(random));
    kill(child, SIGINT);
    const int status = ending_of(child);
    ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status) << " in run " << n;
    EXPECT_TRUE(WEXITSTATUS(status) == 4 || WEXITSTATUS(status) == 0) << WEXITSTATUS(status) << " in run " << n;
    const bool is_old = text_of("out.3mf") == "old";
    EXPECT_TRUE(is_old || read_mesh(fs::path(output)).has_value());
    EXPECT_EQ(names(), (std::multiset<std::string>{"leaning.stl", "out.3mf"}));
  }
}

/// The children of a process, as the kernel lists them.
std::vector<pid_t> children_of(pid_t parent) {
  std::ifstream list("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children");
  return {std::istream_iterator<pid_t>(list), {}};
}

TEST_F(Killed, AChildThatDiesInARepairCostsThatRepairAndNotTheRun) {
  const std::string output = path("out.stl");
  const pid_t program = start({"stand", std::string(APLOMB_FIXTURES) + "/broken_pushed_through.stl", "--voxel", "1.5mm",
                               "--wall", "3mm", "--ceiling", "any", "--best-effort", "-q", "-o", output});
  int killed = 0, status = 0;
  while (waitpid(program, &status, WNOHANG) == 0) {
    for (const pid_t child : children_of(program)) killed += kill(child, SIGKILL) == 0;
    usleep(500);
  }
  EXPECT_GT(killed, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_TRUE(WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 3 || WEXITSTATUS(status) == 6) << WEXITSTATUS(status);
  EXPECT_TRUE(read_mesh(fs::path(output)).has_value());  // rebuilt from a grid
}

class Limits : public Killed {
 protected:
  /// Peak of what it held of its own, in MB, and its exit code; no room for more than `file_bytes` in a file. What it
  /// says to stderr is in "stderr".
  std::pair<double, int> run_with(std::vector<std::string> arguments, rlim_t file_bytes = RLIM_INFINITY) const {
    const pid_t child = fork();
    if (child == 0) {
      const int said = open(path("stderr").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      dup2(said, STDERR_FILENO);
      close(said);
      const rlimit limit{file_bytes, file_bytes};
      setrlimit(RLIMIT_FSIZE, &limit);
      signal(SIGXFSZ, SIG_IGN);  // as on a full disk: write() fails
      std::vector<char*> words{const_cast<char*>(APLOMB_CLI)};
      for (std::string& argument : arguments) words.push_back(argument.data());
      words.push_back(nullptr);
      execv(APLOMB_CLI, words.data());
      _exit(127);
    }
    int status = 0;
    rusage used{};
    wait4(child, &status, 0, &used);
    return {static_cast<double>(used.ru_maxrss) / 1024, WIFEXITED(status) ? WEXITSTATUS(status) : -1};
  }
};

TEST_F(Limits, TheMemoryAllowedIsKeptTenfoldOverJustOverAndJustUnder) {
  std::vector<std::string> arguments{"stand",
                                     std::string(APLOMB_FIXTURES) + "/seal.stl",
                                     "--voxel",
                                     "0.6mm",
                                     "--wall",
                                     "2mm",
                                     "--ceiling",
                                     "any",
                                     "--best-effort",
                                     "-q",
                                     "-o",
                                     path("out.3mf"),
                                     "--memory",
                                     "4GB"};
  const double libraries_mb = run_with({"--version"}).first + 25;  // and 10 ms of asking for more
  const auto [whole_mb, code] = run_with(arguments);
  ASSERT_TRUE(code == 0 || code == 3) << code;
  const double own_mb = whole_mb - libraries_mb + 25;
  for (const double share : {0.1, 0.6, 0.85}) {
    fs::remove(path("out.3mf"));
    arguments.back() = std::to_string(static_cast<int>(share * own_mb)) + "MB";
    const auto [peak_mb, ending] = run_with(arguments);
    EXPECT_EQ(ending, 5) << arguments.back();
    EXPECT_LT(peak_mb, share * own_mb + libraries_mb) << arguments.back();
    EXPECT_FALSE(fs::exists(path("out.3mf")));
  }
  double enough = 1.02;  // what it takes differs from run to run
  const auto ending_with = [&](double share) {
    arguments.back() = std::to_string(static_cast<int>(std::ceil(share * own_mb))) + "MB";
    return run_with(arguments).second;
  };
  while (enough < 2 && ending_with(enough) != code) enough *= 1.05;
  std::cout << "  takes " << own_mb << " MB, " << enough << " of it are enough\n";
  EXPECT_LT(enough, 1.35);
}

TEST_F(Limits, TheTimeAllowedIsKeptTenfoldOverAndJustUnder) {
  std::vector<std::string> arguments = standing(toppling(), path("out.3mf"));
  const auto seconds = [&] {
    const auto start = Clock::now();
    EXPECT_EQ(run_with(arguments).second, 0);
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  double least_s = seconds(), most_s = least_s;
  const auto measure_again = [&] {
    const double whole_s = seconds();
    least_s = std::min(least_s, whole_s);
    most_s = std::max(most_s, whole_s);
  };
  measure_again();
  const auto ending_within = [&](double limit_s) {
    fs::remove(path("out.3mf"));
    std::vector<std::string> limited = arguments;
    limited.insert(limited.end(), {"--time", std::to_string(static_cast<int>(1000 * limit_s)) + "ms"});
    return run_with(limited).second;
  };
  for (const double share : {0.1, 0.5}) {
    int ending = ending_within(share * least_s);
    for (int again = 0; again < 4 && ending == 0; ++again) {  // the machine may be faster now than it was
      measure_again();
      ending = ending_within(share * least_s);
    }
    EXPECT_EQ(ending, 5) << share << " of " << least_s << " s";
    EXPECT_FALSE(fs::exists(path("out.3mf")));
    EXPECT_NE(text_of("stderr").find("--time"), std::string::npos) << text_of("stderr");
  }
  double enough = 1.1;  // or slower
  while (enough < 8 && ending_within(enough * most_s) != 0) enough *= 1.3;
  EXPECT_LT(enough, 8);
  EXPECT_TRUE(fs::exists(path("out.3mf")));
}

TEST_F(Limits, MemoryThatNobodyEstimatedIsWatchedWhileItIsTaken) {
  std::vector<std::string> arguments{
      "validate", std::string(APLOMB_FIXTURES) + "/seal.stl", "--process", "sla", "-q", "--memory", "4GB"};
  const auto [whole_mb, code] = run_with(arguments);
  const double own_mb = whole_mb - run_with({"--version"}).first;
  arguments.back() = std::to_string(static_cast<int>(0.6 * own_mb)) + "MB";
  const auto [peak_mb, ending] = run_with(arguments);
  EXPECT_EQ(ending, 5) << "allowed " << arguments.back() << ", takes " << own_mb << " MB";
  EXPECT_LT(peak_mb, whole_mb - 0.15 * own_mb);
  arguments.back() = std::to_string(static_cast<int>(1.3 * own_mb)) + "MB";
  EXPECT_EQ(run_with(arguments).second, code);
}

TEST_F(Limits, AFullDiskLeavesTheOldFileAndSaysSo) {
  const std::string output = path("out.stl");
  std::ofstream(output) << "old";
  EXPECT_EQ(run_with(standing(toppling(), output), 2000).second, 2);
  const std::string said = text_of("stderr");
  EXPECT_NE(said.find("cannot write " + output + ": "), std::string::npos) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_EQ(text_of("out.stl"), "old");
  EXPECT_EQ(names(), (std::multiset<std::string>{"leaning.stl", "out.stl", "stderr"}));
  EXPECT_EQ(run_with(standing(toppling(), "/dev/full")).second, 1);  // no format
}

TEST_F(Limits, TheOutputMayBeTheInputALinkOrALongNameInUnicode) {
  const std::string own = toppling(), text = text_of("leaning.stl");
  EXPECT_EQ(run_with(standing(own, own)).second, 0);
  EXPECT_NE(text_of("leaning.stl"), text);
  EXPECT_TRUE(read_mesh(fs::path(own)).has_value());
  const std::string model = toppling();
  fs::create_directory(path("real"));
  fs::create_symlink("real/target.stl", path("link.stl"));
  EXPECT_EQ(run_with(standing(model, path("link.stl"))).second, 0);
  EXPECT_TRUE(fs::is_symlink(path("link.stl")) && fs::is_regular_file(path("real/target.stl")));
  fs::path deep = folder_;
  for (int n = 0; n < 12; ++n) deep /= std::string(200, 'd') + "\xE7\xAB\x8B";  // 2.4 kB of path
  fs::create_directories(deep);
  const fs::path input = deep / (std::string(200, 'i') + "\xC3\xBC \xF0\x9F\xA6\x92.stl"),
                 output = deep / "\xE7\xAB\x8B .stl";
  fs::copy(model, input);
  EXPECT_EQ(run_with(standing(input.string(), output.string())).second, 0);
  EXPECT_TRUE(read_mesh(output).has_value());
  EXPECT_NE(run_with(standing(model, (deep / std::string(3000, 'x')).string() + ".stl")).second, 0);
}

}  // namespace
}  // namespace aplomb
