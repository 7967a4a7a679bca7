// campaign FIRST COUNT FOLDER [SPOIL]: runs COUNT cases from the number FIRST on and leaves in FOLDER what
// judge_cases.mjs is to judge. Prints a line for each broken promise, and how many came to which end. SPOIL, for the
// judge's own test, makes every carved case wrong in one way and leaves nothing else.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "aplomb/core/threads.h"
#include "campaign/case.h"
#include "campaign/run_case.h"

using namespace aplomb::campaign;

namespace {

constexpr std::array<const char*, 7> spoils{"nothing", "hole", "winding", "wall", "angle", "bound", "outcome"};

Spoil spoil_named(const std::string& name) {
  for (std::size_t n = 0; n < spoils.size(); ++n)
    if (name == spoils[n]) return static_cast<Spoil>(n);
  throw std::invalid_argument(name + " is nothing that can be spoilt");
}

CaseEnd run_safely(std::uint64_t number, const std::filesystem::path& folder, Spoil spoil) {
  try {
    return run_case(number, folder, spoil);
  } catch (const std::exception& error) {
    return {"error", std::string("thrown: ") + error.what()};
  }
}

int run(std::uint64_t first, std::uint64_t count, const std::filesystem::path& folder, Spoil spoil) {
  const aplomb::ThreadLimit one(1);
  std::map<std::string, int> ends;
  int carved = 0, wrong = 0;
  for (std::uint64_t number = first; number < first + count; ++number) {
    std::ofstream(folder / "running") << number;  // for who finds this program dead
    const auto begun = std::chrono::steady_clock::now();
    const CaseEnd end = run_safely(number, folder, spoil);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    ++ends[end.outcome];
    carved += end.is_carved;
    wrong += !end.wrong.empty();
    if (!end.wrong.empty()) fmt::print("WRONG case {}: {} ({})\n", number, end.wrong, describe(case_of(number)));
    if (took.count() > 30) fmt::print("slow case {}: {:.0f} s ({})\n", number, took.count(), describe(case_of(number)));
    std::fflush(stdout);
  }
  fmt::print("cases={} carved={} wrong={}", count, carved, wrong);
  for (const auto& [outcome, times] : ends) fmt::print(" {}={}", outcome, times);
  fmt::print("\n");
  return wrong > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4 || argc > 5) {
    fmt::print(stderr, "campaign FIRST COUNT FOLDER [SPOIL]\n");
    return 2;
  }
  return run(std::stoull(argv[1]), std::stoull(argv[2]), argv[3], spoil_named(argc > 4 ? argv[4] : "nothing"));
}
