#include "support/gcode_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace aplomb::test {

Result<PrintedPlate> read_program(std::string_view text, const GcodeOptions& options) {
  const auto path = std::filesystem::temp_directory_path() / ("aplomb_program_" + std::to_string(getpid()) + ".gcode");
  std::ofstream(path, std::ios::binary) << text;
  auto plate = read_gcode(path, options);
  std::filesystem::remove(path);
  return plate;
}

std::string plain_start() { return "G21\nG90\nM83\nG1 X0 Y0 Z0.2\n"; }

std::string square_loop(double x_mm, double y_mm, double side_mm, double z_mm) {
  const double half = side_mm / 2, e = 0.4 * 0.2 * side_mm;
  std::ostringstream out;
  out << "G1 X" << x_mm - half << " Y" << y_mm - half << " Z" << z_mm << "\n"
      << "G1 X" << x_mm + half << " E" << e << "\nG1 Y" << y_mm + half << " E" << e << "\n"
      << "G1 X" << x_mm - half << " E" << e << "\nG1 Y" << y_mm - half << " E" << e << "\n";
  return out.str();
}

const PrintedObject& only(const Result<PrintedPlate>& plate) {
  if (!plate) throw std::runtime_error(plate.error().message);
  if (plate->objects.size() != 1) throw std::runtime_error(std::to_string(plate->objects.size()) + " objects");
  return plate->objects.front();
}

BodyMass mass_of_only(const Result<PrintedPlate>& plate) { return mass_of(only(plate).body); }

}  // namespace aplomb::test
