#pragma once

#include <string>
#include <string_view>

#include "aplomb/core/error.h"

namespace aplomb {

/// Something heavy that is laid into a print while it pauses: a coin, flat on its face, or a ball.
struct Insert {
  enum class Shape { disc, ball };
  std::string name;  ///< for people: "penny", "ball 10 mm"
  Shape shape = Shape::disc;
  double diameter_mm = 0;  ///< > 0
  double height_mm = 0;    ///< > 0: a disc's thickness, a ball's diameter
  double mass_g = 0;       ///< > 0

  friend bool operator==(const Insert&, const Insert&) = default;
};

/// Of the whole body.
double volume_mm3(const Insert& insert);
double density_g_per_cm3(const Insert& insert);

/// So many of one kind may be put in.
struct InsertStock {
  Insert insert;
  int most = 1;  ///< in [1, 100]

  friend bool operator==(const InsertStock&, const InsertStock&) = default;
};

/// A sentence that names what is wrong, its value and its range; empty when there is nothing to say.
std::string find_problem(const InsertStock& stock);

/// Reads a kind of insert and how many there are of it (1 where nothing is said):
///
///     penny:4                        penny, nickel, dime, quarter: US coins by the Mint's specifications
///     ball:10mm:6                    steel, or of the mass given: ball:10mm:4.2g:6
///     coin:23.25x2.33mm:7.5g:2       any disc, diameter x thickness; steel where no mass is given
///
/// Steel has 7.85 g/cm3 (PRINTABILITY).
/// \post find_problem() of it is empty. \return invalid_option that says what was understood and what may be said.
Result<InsertStock> parse_insert(std::string_view text);

}  // namespace aplomb
