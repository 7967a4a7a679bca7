#include "run_verify.h"

#include <fmt/format.h>

#include <fstream>
#include <string>

#include "aplomb/report/verification.h"
#include "talk.h"

namespace aplomb::cli {
namespace {

Result<ExpectedPrint> read_expected(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(ErrorCode::file_system, path.string() + ": the report cannot be read; check its name");
  constexpr std::streamsize most_bytes = (4 << 20) + 1;  // one more than a report may have
  std::string text(most_bytes, '\0');
  file.read(text.data(), most_bytes);
  text.resize(static_cast<std::size_t>(file.gcount()));
  return expected_print(text).map_error([&path](Error error) {
    error.message = path.string() + ": " + error.message;
    return error;
  });
}

}  // namespace

int run_verify(const Arguments& a, const Job& job) {
  const VerifyArguments& asked = a.verify;
  VerifyOptions options = asked.options;
  if (!asked.expect.empty()) {
    const auto expected = read_expected(asked.expect);
    if (!expected) return report_error(expected.error());
    options.expected = *expected;
  }
  auto plate = read_gcode(asked.program, asked.gcode, job);
  if (!plate) return report_error(plate.error());
  const auto verification = verify_print(std::move(*plate), options);
  if (!verification) return report_error(verification.error());
  if (!a.quiet) fmt::print(asked.report == "-" ? stderr : stdout, "{}", to_text(*verification));
  if (!asked.report.empty())
    if (const auto written = write_text(asked.report, to_json(*verification)); !written)
      return report_error(written.error());
  if (!verification->all_stand()) return exit_code(Ending::cannot_stand);
  return exit_code(verification->all_as_told() ? Ending::stands : Ending::does_not_print);
}

}  // namespace aplomb::cli
