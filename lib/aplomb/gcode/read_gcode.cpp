#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "aplomb/gcode/detail/annotations.h"
#include "aplomb/gcode/detail/command.h"
#include "aplomb/gcode/detail/line_source.h"
#include "aplomb/gcode/detail/machine.h"
#include "aplomb/gcode/detail/print_ledger.h"
#include "aplomb/gcode/printed_plate.h"

namespace aplomb {
namespace {

using detail::Annotations;
using detail::Command;
using detail::LineSource;
using detail::Machine;
using detail::PrintLedger;
using detail::Slicer;
using detail::Stroke;

constexpr std::size_t settings_bytes = 1 << 18;           // PrusaSlicer's take 15 kB, Orca's 60
constexpr std::uint64_t bytes_between_reports = 1 << 15;  // a byte may cost a microsecond
constexpr double used_error_ratio = 0.01;

tl::unexpected<Error> unusable(const std::filesystem::path& path, std::string_view what) {
  return fail(ErrorCode::unusable_input, fmt::format("{}: {}", path.string(), what));
}

/// What the first bytes tell of a file that is no program in text.
std::string refusal(std::string_view head) {
  if (head.empty()) return "byte 0: the file is empty; slice the model again";
  if (head.starts_with("GCDE"))
    return "byte 0: this is binary G-code, which cannot be read; switch it off in the slicer (PrusaSlicer: Printer "
           "settings, Binary G-code), or convert it to text";
  if (head.starts_with("PK\x03\x04"))
    return "byte 0: this is an archive (a sliced 3MF?); give the G-code file that it holds";
  if (head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF"))
    return "byte 0: the text is UTF-16; save it as UTF-8 or plain ASCII";
  const std::size_t zero = head.find('\0');
  if (zero == head.npos) return {};
  return fmt::format("line {}: this is no G-code, for it holds bytes that are no text; give the slicer's G-code file",
                     1 + std::ranges::count(head.substr(0, zero), '\n'));
}

/// The settings of the filaments, which stand before the moves or behind them.
Result<detail::FilamentSettings> settings_of(const std::filesystem::path& path) {
  auto lines = LineSource::open(path);
  if (!lines) return tl::unexpected(lines.error());
  Annotations read;
  while (lines->bytes_done() <= 2 * settings_bytes) {
    const auto line = lines->next();
    if (!line) break;
    if (line->starts_with(';')) read.note(*line);
  }
  const auto tail = lines->tail(settings_bytes);
  if (!tail) return tl::unexpected(tail.error());
  std::string_view rest(tail->data(), tail->size());
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    if (line.starts_with(';')) read.note(line);
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
  }
  return read.filaments();
}

/// Of a list by tool, the last for all further ones; 0 means that it is not said.
void choose(const std::vector<double>& given, const std::vector<double>& told, std::size_t tool, double& value,
            bool& is_known) {
  const std::vector<double>& list = given.empty() ? told : given;
  if (list.empty()) return;
  const double found = list[std::min(tool, list.size() - 1)];
  if (!(found > 0) || !std::isfinite(found)) return;
  value = found;
  is_known = true;
}

std::vector<Filament> filaments_of(const detail::FilamentSettings& told, const GcodeOptions& options) {
  std::vector<Filament> filaments(Machine::most_tools);
  for (std::size_t tool = 0; tool < filaments.size(); ++tool) {
    Filament& f = filaments[tool];
    f.tool = static_cast<unsigned>(tool);
    choose(options.diameters_mm, told.diameters_mm, tool, f.diameter_mm, f.diameter_is_known);
    choose(options.densities_g_per_cm3, told.densities_g_per_cm3, tool, f.density_g_per_cm3, f.density_is_known);
  }
  return filaments;
}

/// Reads the moves and what stands beside them.
class Reader {
 public:
  Reader(const std::filesystem::path& path, const std::vector<Filament>& filaments, bool is_one)
      : path_(path), filaments_(filaments), ledger_(filaments, is_one) {}

  Result<void> read(LineSource& lines, const Job& job);
  Result<PrintedPlate> plate(const LineSource& lines, const Job& job);

 private:
  Result<void> read_line(std::string_view line);
  std::vector<std::string> notes(const PrintedPlate& plate) const;

  const std::filesystem::path& path_;
  const std::vector<Filament>& filaments_;
  Machine machine_;
  Annotations annotations_;
  PrintLedger ledger_;
  detail::LayerHeights heights_;
  std::vector<bool> extrudes_ = std::vector<bool>(Machine::most_tools, false);
  bool is_turned_ = false;  // the ledger knows the object and feature
  double least_flow_ = 1, most_flow_ = 1;
};

Result<void> Reader::read_line(std::string_view line) {
  Command command(line);
  if (command.letter() == 0 || (command.letter() == 'M' && command.number() == 486)) {
    if (annotations_.note(line)) is_turned_ = false;
    return {};
  }
  const auto stroke = machine_.obey(command);
  if (!stroke) return tl::unexpected(stroke.error());
  if (!*stroke) return {};
  if (!is_turned_ && !ledger_.turn_to(annotations_.object(), annotations_.feature()))
    return fail(ErrorCode::over_budget,
                "there are more than 10,000 objects; print fewer at once, or count them as one (--one)");
  is_turned_ = true;
  const double seen_mm = heights_.at((*stroke)->to_mm.z, annotations_.usual_height_mm());
  if (!ledger_.enter(**stroke, annotations_.layer_height_mm().value_or(seen_mm)))
    return fail(ErrorCode::over_budget, "more than 100,000 pairs of an object and a filament; print fewer at once");
  extrudes_[(*stroke)->tool] = true;
  least_flow_ = std::min(least_flow_, machine_.flow_ratio());
  most_flow_ = std::max(most_flow_, machine_.flow_ratio());
  return {};
}

Result<void> Reader::read(LineSource& lines, const Job& job) {
  std::uint64_t next_report = 0;
  while (const auto line = lines.next()) {
    if (const auto done = read_line(*line); !done)
      return fail(done.error().code,
                  fmt::format("{}: line {}: {}", path_.string(), lines.line_number(), done.error().message));
    if (lines.bytes_done() < next_report) continue;
    next_report = lines.bytes_done() + bytes_between_reports;
    if (!job.report(static_cast<double>(lines.bytes_done()) / static_cast<double>(lines.bytes()), "read"))
      return cancelled();
  }
  if (lines.error()) return tl::unexpected(*lines.error());
  return {};
}

std::vector<std::string> Reader::notes(const PrintedPlate& plate) const {
  std::vector<std::string> notes;
  bool diameter_is_known = true, density_is_known = true;
  for (const Filament& f : plate.filaments) {
    diameter_is_known = diameter_is_known && f.diameter_is_known;
    density_is_known = density_is_known && f.density_is_known;
  }
  if (!diameter_is_known) notes.emplace_back("the G-code does not say the filament's diameter: 1.75 mm (--diameter)");
  if (!density_is_known) notes.emplace_back("the G-code does not say the filament's density: 1.24 g/cm3 (--density)");
  if (plate.objects.size() == 1 && plate.objects.front().name.empty())
    notes.emplace_back(annotations_.names_features()
                           ? "objects have no labels: all of the print counts as one (the slicer can label objects)"
                           : "neither objects nor features have labels: all that is extruded counts as one object");
  if (ledger_.leaves_brims_out())
    notes.emplace_back(
        "there are too many objects and loops of brims to tell which belong together: brims are left out");
  if (least_flow_ != 1 || most_flow_ != 1)
    notes.push_back(fmt::format("the program sets the flow to {:g} % (M221), which is counted",
                                100 * (least_flow_ != 1 ? least_flow_ : most_flow_)));
  const auto used_mm = annotations_.filaments().used_mm;
  const double flow = least_flow_ != 1 ? least_flow_ : most_flow_;
  if (used_mm && *used_mm > 0 && std::abs(plate.filament_mm / (flow * *used_mm) - 1) > used_error_ratio)
    notes.push_back(fmt::format("the slicer counts {:.1f} mm of filament, its moves push out {:.1f}", *used_mm,
                                plate.filament_mm / flow));
  return notes;
}

Result<PrintedPlate> Reader::plate(const LineSource& lines, const Job& job) {
  if (annotations_.slicer() != Slicer::unknown && !annotations_.saw_end())
    return unusable(
        path_,
        fmt::format("line {}{}: it ends too early, for what {} writes at the end is missing; export it again",
                    lines.line_number(), lines.ended_within_a_line() ? " (cut off)" : "", annotations_.slicer_name()));
  PrintedPlate plate;
  plate.slicer = annotations_.slicer_name();
  if (const auto closed = ledger_.close(annotations_.names_features(), plate, job); !closed)
    return tl::unexpected(closed.error());
  for (std::size_t tool = 0; tool < extrudes_.size(); ++tool)
    if (extrudes_[tool]) plate.filaments.push_back(filaments_[tool]);
  if (plate.objects.empty())
    return unusable(path_, fmt::format("line {}: up to here, its end, no move lays down material for an object; give "
                                       "the G-code file of a print",
                                       lines.line_number()));
  plate.notes = notes(plate);
  return plate;
}

}  // namespace

std::string find_problem(const GcodeOptions& options) {
  for (const auto& [name, values] : {std::pair{"diameters_mm", &options.diameters_mm},
                                     std::pair{"densities_g_per_cm3", &options.densities_g_per_cm3}})
    for (const double value : *values)
      if (!(value > 0) || !std::isfinite(value)) return fmt::format("{} holds {} but must be above 0", name, value);
  return {};
}

Result<PrintedPlate> read_gcode(const std::filesystem::path& path, const GcodeOptions& options, const Job& job) {
  auto lines = LineSource::open(path);
  if (!lines) return tl::unexpected(lines.error());
  if (const std::string why = refusal(lines->head()); !why.empty()) return unusable(path, why);
  const auto settings = settings_of(path);
  if (!settings) return tl::unexpected(settings.error());
  const std::vector<Filament> filaments = filaments_of(*settings, options);
  Reader reader(path, filaments, options.is_one);
  if (const auto read = reader.read(*lines, job.part(0, 0.9)); !read) return tl::unexpected(read.error());
  return reader.plate(*lines, job.part(0.9, 1));
}

}  // namespace aplomb
